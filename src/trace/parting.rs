//! Where two devices part.

use serde::Serialize;

use crate::layout::TreeNode;

/// The first ray at which two trees differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Parting {
    /// The ray, in the order of tracing.
    pub node: usize,
    /// What differs.
    pub what: &'static str,
}

/// The first ray at which two recorded trees go other ways: another kind, end, body, side, medium, light or child.
/// Where `exact`, every bit counts.
#[must_use]
pub fn part(a: &[TreeNode], b: &[TreeNode], exact: bool) -> Option<Parting> {
    let differing = (0..a.len().min(b.len()))
        .find_map(|node| difference(&a[node], &b[node], exact).map(|what| Parting { node, what }));
    differing.or_else(|| {
        (a.len() != b.len()).then(|| Parting { node: a.len().min(b.len()), what: "one tree ends here" })
    })
}

fn difference(a: &TreeNode, b: &TreeNode, exact: bool) -> Option<&'static str> {
    type Word = fn(&TreeNode) -> u32;
    let words: [(&'static str, Word); 9] = [
        ("kind", |node| node.kind),
        ("end", |node| node.end),
        ("depth", |node| node.depth),
        ("body", |node| node.body),
        ("side", |node| node.front),
        ("medium before", |node| node.media),
        ("medium behind", |node| node.media_behind),
        ("children", |node| node.children),
        ("lights seen", |node| node.seen),
    ];
    let other = words.iter().find(|(_, word)| word(a) != word(b)).map(|(what, _)| *what);
    let bits = || (exact && bytemuck::bytes_of(a) != bytemuck::bytes_of(b)).then_some("bits of a number");
    other.or_else(bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_difference_is_found_and_named() {
        let plain = TreeNode::default();
        let elsewhere = TreeNode { body: 3, ..plain };
        let nearly = TreeNode { distance: 1e-30, ..plain };
        assert_eq!(
            part(&[plain; 3], &[plain, elsewhere, plain], false),
            Some(Parting { node: 1, what: "body" })
        );
        assert_eq!(part(&[plain, nearly], &[plain; 2], false), None);
        let bits = Parting { node: 1, what: "bits of a number" };
        assert_eq!(part(&[plain, nearly], &[plain; 2], true), Some(bits));
        assert_eq!(part(&[plain], &[plain; 2], false).map(|parting| parting.node), Some(1));
    }
}
