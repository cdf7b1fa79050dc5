//! What a builder returns: a binary tree over triangle indices, without boxes.

/// One node of a [`Tree`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Branch {
    /// The children are nodes `first` and `first + 1` where `count` is 0; else the leaf's first place in
    /// [`Tree::order`].
    pub(super) first: u32,
    /// Triangles of a leaf; 0 for an inner node.
    pub(super) count: u32,
}

/// A binary tree over triangle indices, root first.
#[derive(Debug)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Branch>,
    pub(super) order: Vec<u32>,
}

impl Tree {
    /// Nodes with children on the longest path from the root. Counts without recursion, since
    /// reinsertion may return a tree of any depth.
    pub(super) fn depth(&self) -> u32 {
        let mut deepest = 0;
        let mut stack = vec![(0, 1)];
        while let Some((index, depth)) = stack.pop() {
            let Branch { first, count } = self.nodes[index as usize];
            if count == 0 {
                deepest = deepest.max(depth);
                stack.extend([(first, depth + 1), (first + 1, depth + 1)]);
            }
        }
        deepest
    }
}
