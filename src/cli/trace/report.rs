//! What devices say of a pixel's tree, and where they part.

use serde::Serialize;

use crate::layout::TreeNode;
use crate::trace::{Parting, Tree, outline, part};

/// What one device says.
#[derive(Debug, Serialize)]
pub(super) struct Told {
    /// "cpu", or the adapter's name.
    pub(super) device: String,
    pub(super) precision: String,
    pub(super) float: String,
    /// Rays traced, without those towards lights.
    pub(super) rays: usize,
    pub(super) shadow_rays: u64,
    /// Of the pixel's first sample, linear.
    pub(super) radiance: [f32; 3],
    #[serde(flatten)]
    pub(super) tree: Tree,
    #[serde(skip)]
    pub(super) records: Vec<TreeNode>,
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
pub(super) struct TraceReport {
    pub(super) scene: String,
    pub(super) size: [u32; 2],
    pub(super) pixel: [u32; 2],
    pub(super) depth: u32,
    pub(super) cutoff: f64,
    pub(super) trees: Vec<Told>,
    /// Where each further tree parts from the first.
    pub(super) partings: Vec<Parted>,
}

/// Where two trees part.
#[derive(Debug, Serialize)]
pub(super) struct Parted {
    from: String,
    device: String,
    /// Rays that go another way.
    way: Option<Parting>,
    /// Rays that differ in any bit; only of the same precision, strict on both sides.
    bits: Option<Parting>,
}

/// Where a tree parts from the first.
pub(super) fn parted(first: &Told, other: &Told) -> Parted {
    let is_exact = first.precision == other.precision && first.float == other.float;
    Parted {
        from: heading(first),
        device: heading(other),
        way: part(&first.records, &other.records, false),
        bits: if is_exact { part(&first.records, &other.records, true) } else { None },
    }
}

/// A device with its arithmetic.
pub(super) fn heading(told: &Told) -> String {
    format!("{} {} {}", told.device, told.precision, told.float)
}

/// The first tree, and what parts the others from it.
pub(super) fn text(trees: &[Told], partings: &[Parted]) -> String {
    let mut text = String::new();
    if let Some(told) = trees.first() {
        let [r, g, b] = told.radiance;
        text += &format!(
            "{}: {} rays and {} towards lights; radiance {r} {g} {b}\n\n{}",
            heading(told),
            told.rays,
            told.shadow_rays,
            outline(&told.tree)
        );
    }
    for parted in partings {
        text += &format!("\n{}\n", line(parted));
    }
    text
}

/// Whether two trees are one, and where they part.
fn line(Parted { from, device, way, bits }: &Parted) -> String {
    match (way, bits) {
        (Some(Parting { node, what }), _) => {
            format!("{device} goes another way than {from} from ray {node} on: {what}")
        }
        (None, Some(Parting { node, what })) => {
            format!("{device} goes the same way as {from}; ray {node} is the first to differ: {what}")
        }
        (None, None) => format!("{device} goes the same way as {from} with every ray"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_is_said_with_the_ray() {
        let parted =
            |way, bits| Parted { from: "CPU f32 strict".into(), device: "CPU f64 strict".into(), way, bits };
        let other = Some(Parting { node: 7, what: "body" });
        assert!(line(&parted(other, None)).ends_with("from ray 7 on: body"));
        assert!(line(&parted(None, None)).ends_with("with every ray"));
    }
}
