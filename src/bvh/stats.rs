//! How good a hierarchy is, in numbers.

use super::aabb::Aabb;
use super::{Bvh, MAX_LEAF, NODE_COST};
use crate::layout::Node;

/// Size and expected cost of a hierarchy.
#[derive(Debug, Clone, PartialEq)]
pub struct Statistics {
    /// Inner nodes.
    pub nodes: usize,
    /// Nodes on the longest path from the root.
    pub depth: u32,
    /// How many leaves hold 0, 1, 2 … triangles.
    pub leaf_sizes: [usize; MAX_LEAF as usize + 1],
    /// Expected cost of a random ray through the scene's box, in ray–triangle tests, by the surface area
    /// heuristic (MacDonald and Booth 1990): nodes weigh [`NODE_COST`], triangles 1.
    pub sah_cost: f64,
}

impl Statistics {
    /// Measure a hierarchy.
    #[must_use]
    pub fn of(bvh: &Bvh) -> Self {
        let mut leaf_sizes = [0; MAX_LEAF as usize + 1];
        let mut weighed = 0.0;
        for [a, b] in bvh.nodes.iter().map(children) {
            // A node is visited as often as its box is hit.
            weighed += NODE_COST * a.0.union(&b.0).half_area();
            for (aabb, count) in [a, b].into_iter().filter(|&(_, count)| count > 0) {
                leaf_sizes[count.min(MAX_LEAF) as usize] += 1;
                weighed += aabb.half_area() * f64::from(count);
            }
        }
        let [a, b] = children(&bvh.nodes[0]);
        let whole = a.0.union(&b.0).half_area();
        let sah_cost = if whole > 0.0 { weighed / whole } else { 0.0 };
        Self { nodes: bvh.nodes.len(), depth: bvh.depth, leaf_sizes, sah_cost }
    }
}

fn children(node: &Node) -> [(Aabb, u32); 2] {
    [
        (Aabb { lo: node.a_lo, hi: node.a_hi }, node.a_count),
        (Aabb { lo: node.b_lo, hi: node.b_hi }, node.b_count),
    ]
}
