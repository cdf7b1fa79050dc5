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

/// What lies below a branch, itself included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Size {
    /// Nodes with children.
    pub(super) nodes: u32,
    /// Triangles.
    pub(super) triangles: u32,
    /// Nodes with children on the longest path down.
    pub(super) depth: u32,
}

impl Tree {
    /// The size of each branch. Without recursion, since reinsertion may return a tree of any depth.
    pub(super) fn sizes(&self) -> Vec<Size> {
        let mut sizes = vec![Size { nodes: 0, triangles: 0, depth: 0 }; self.nodes.len()];
        // Depth first, each before those below it.
        let mut order = Vec::with_capacity(self.nodes.len());
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            order.push(index);
            let Branch { first, count } = self.nodes[index as usize];
            if count == 0 {
                stack.extend([first + 1, first]);
            }
        }
        for index in order.into_iter().rev() {
            let Branch { first, count } = self.nodes[index as usize];
            sizes[index as usize] = if count > 0 {
                Size { nodes: 0, triangles: count, depth: 0 }
            } else {
                let (a, b) = (sizes[first as usize], sizes[first as usize + 1]);
                Size {
                    nodes: 1 + a.nodes + b.nodes,
                    triangles: a.triangles + b.triangles,
                    depth: 1 + a.depth.max(b.depth),
                }
            };
        }
        sizes
    }
}
