//! What must hold of every hierarchy, as a check that can fail.

use thiserror::Error;

use super::aabb::Aabb;
use super::{Bvh, MAX_LEAF};
use crate::layout::constants::MAX_BVH_DEPTH;
use crate::layout::{Node, Triangle};

/// The first fault found in a hierarchy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum CheckError {
    /// A child's index lies outside the nodes, or the node is reached twice.
    #[error("node {node} names node {child}, which is missing or has another parent")]
    Tree {
        /// The parent.
        node: u32,
        /// What it names.
        child: u32,
    },
    /// A leaf names places outside the order, or too many.
    #[error("node {node} holds a leaf of {count} triangles from place {first}")]
    Leaf {
        /// The parent.
        node: u32,
        /// The leaf's first place.
        first: u32,
        /// The leaf's size.
        count: u32,
    },
    /// A box is not the exact box of what lies below it.
    #[error("node {node} holds a box that is not its triangles'")]
    Box {
        /// The parent.
        node: u32,
    },
    /// A triangle is not in exactly one leaf.
    #[error("triangle {triangle} is in {leaves} leaves")]
    Triangle {
        /// Index into what the hierarchy was built over.
        triangle: u32,
        /// How many leaves hold it.
        leaves: u32,
    },
    /// The order is not as long as the list of triangles.
    #[error("the order has {0} places")]
    Order(usize),
    /// A node is not reached from the root.
    #[error("{0} nodes are not reached from the root")]
    Unreached(usize),
    /// The stated depth is wrong or beyond the traversal's stack.
    #[error("the depth is {found}, stated as {stated}")]
    Depth {
        /// Counted.
        found: u32,
        /// [`Bvh::depth`].
        stated: u32,
    },
}

/// Hold a hierarchy against the triangles it was built over: every triangle is in exactly one leaf (a
/// lone triangle in both), every box is exact, every node has one parent, depth and leaf sizes are within
/// their bounds.
///
/// # Errors
/// The first fault found.
pub fn check(bvh: &Bvh, triangles: &[Triangle]) -> Result<(), CheckError> {
    if bvh.order.len() != triangles.len() {
        return Err(CheckError::Order(bvh.order.len()));
    }
    let mut walk = Walk { bvh, triangles, leaves: vec![0; triangles.len()], reached: 0 };
    let (_, depth) = walk.node(0, 0)?;
    if depth != bvh.depth || depth > MAX_BVH_DEPTH {
        return Err(CheckError::Depth { found: depth, stated: bvh.depth });
    }
    if walk.reached != bvh.nodes.len() {
        return Err(CheckError::Unreached(bvh.nodes.len() - walk.reached));
    }
    let expected = if triangles.len() == 1 { 2 } else { 1 };
    match walk.leaves.iter().zip(0..).find(|&(&leaves, _)| leaves != expected) {
        Some((&leaves, triangle)) => Err(CheckError::Triangle { triangle, leaves }),
        None => Ok(()),
    }
}

struct Walk<'a> {
    bvh: &'a Bvh,
    triangles: &'a [Triangle],
    leaves: Vec<u32>,
    reached: usize,
}

impl Walk<'_> {
    /// The box of a node and the number of nodes on the longest path from it.
    fn node(&mut self, parent: u32, index: u32) -> Result<(Aabb, u32), CheckError> {
        let fault = CheckError::Tree { node: parent, child: index };
        let node: Node = *self.bvh.nodes.get(index as usize).ok_or(fault)?;
        // Nodes stand in the order in which this walk reaches them: another index has another parent.
        if index as usize != self.reached {
            return Err(fault);
        }
        self.reached += 1;
        let a = self.child(index, node.a_first, node.a_count)?;
        let b = self.child(index, node.b_first, node.b_count)?;
        let stated = (Aabb { lo: node.a_lo, hi: node.a_hi }, Aabb { lo: node.b_lo, hi: node.b_hi });
        if stated != (a.0, b.0) {
            return Err(CheckError::Box { node: index });
        }
        Ok((a.0.union(&b.0), 1 + a.1.max(b.1)))
    }

    fn child(&mut self, node: u32, first: u32, count: u32) -> Result<(Aabb, u32), CheckError> {
        if count == 0 {
            return self.node(node, first);
        }
        let fault = CheckError::Leaf { node, first, count };
        let places = first as usize..first as usize + count as usize;
        let order = self.bvh.order.get(places).filter(|_| count <= MAX_LEAF).ok_or(fault)?;
        let mut aabb = Aabb::EMPTY;
        for &index in order {
            let triangle = self.triangles.get(index as usize).ok_or(fault)?;
            self.leaves[index as usize] += 1;
            aabb = aabb.union(&Aabb::of(triangle));
        }
        Ok((aabb, 0))
    }
}
