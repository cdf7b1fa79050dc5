//! The tree of a pixel: nodes with their parents.

use serde::Serialize;

use super::Node;
use crate::layout::constants::{CHILD_REFLECTION, CHILD_REFRACTION, END_SURFACE};
use crate::layout::{FlatScene, TreeNode, View};

/// The tree of a pixel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tree {
    /// The rays in the order in which they are traced: parents before children.
    pub nodes: Vec<Node>,
}

impl Tree {
    /// Find the parents of what a device recorded, and put names to it.
    #[must_use]
    pub fn new(records: &[TreeNode], scene: &FlatScene, view: &View) -> Self {
        let nodes = parents(records)
            .into_iter()
            .zip(records)
            .enumerate()
            .map(|(id, (parent, record))| Node::new(id, parent, record, scene, view))
            .collect();
        Self { nodes }
    }

    /// Rays traced: those that were cut are in the tree, but were not.
    #[must_use]
    pub fn rays(&self) -> usize {
        self.nodes.iter().filter(|node| !node.end.is_untraced()).count()
    }

    /// Shadow rays traced.
    #[must_use]
    pub fn shadow_rays(&self) -> u64 {
        self.nodes.iter().filter_map(|node| node.hit.as_ref()).map(|hit| u64::from(hit.shadow_rays)).sum()
    }

    /// The sum of all contributions, in f64: the pixel up to rounding.
    #[must_use]
    pub fn radiance(&self) -> [f64; 3] {
        let sum = |channel: usize| self.nodes.iter().map(|node| f64::from(node.contribution[channel])).sum();
        [sum(0), sum(1), sum(2)]
    }

    /// The children of each node, in the order of tracing: refraction first.
    #[must_use]
    pub fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.nodes.len()];
        for node in &self.nodes {
            if let Some(list) = node.parent.and_then(|parent| children.get_mut(parent)) {
                list.push(node.id);
            }
        }
        children
    }
}

/// Refraction comes next, and reflection when all that came of it is done: the order in which rays are traced tells
/// their parents.
fn parents(records: &[TreeNode]) -> Vec<Option<usize>> {
    let mut waiting: Vec<usize> = Vec::new();
    let mut parent = None;
    let mut parents = Vec::with_capacity(records.len());
    for (id, record) in records.iter().enumerate() {
        parents.push(parent);
        let children = if record.end == END_SURFACE { record.children } else { 0 };
        parent = match (children & CHILD_REFRACTION != 0, children & CHILD_REFLECTION != 0) {
            (true, true) => {
                waiting.push(id);
                Some(id)
            }
            (true, false) | (false, true) => Some(id),
            (false, false) => waiting.pop(),
        };
    }
    parents
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::constants::{END_BACKGROUND, END_DEPTH};

    fn met(children: u32) -> TreeNode {
        TreeNode { end: END_SURFACE, children, ..TreeNode::default() }
    }

    #[test]
    fn parents_follow_from_the_order_of_tracing() {
        let both = CHILD_REFLECTION + CHILD_REFRACTION;
        let away = TreeNode { end: END_BACKGROUND, ..TreeNode::default() };
        let cut = TreeNode { end: END_DEPTH, children: both, ..TreeNode::default() };
        // 0 → refracted 1 → refracted 2 (escapes), reflected 3 → reflected 4 (cut); then 0's reflected 5.
        let records = [met(both), met(both), away, met(CHILD_REFLECTION), cut, away];
        assert_eq!(parents(&records), [None, Some(0), Some(1), Some(1), Some(3), Some(0)]);
    }
}
