//! Which nodes of a binary tree become children of one wide node, and which become its leaves: the cheapest choice by the
//! surface area heuristic, found from the leaves up (Ylitie, Karras, Laine 2017, "Efficient incoherent ray traversal on
//! GPUs through compressed wide BVHs", section 3.1).

use super::aabb::Aabb;
use crate::layout::Node;

/// Children of a wide node, at most.
pub const WIDTH: usize = 8;

/// What a traversal's leaves are like.
#[derive(Debug, Clone, Copy)]
pub struct LeafRule {
    /// Triangles, at most.
    pub most: u32,
    /// What testing so many triangles costs, against visiting a node.
    pub cost: fn(u32) -> f32,
}

/// A child of a wide node.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// Least corner of its box.
    pub lo: [f32; 3],
    /// Greatest corner.
    pub hi: [f32; 3],
    /// The binary node that becomes a wide one; none for a leaf.
    pub inner: Option<u32>,
    /// The first of its triangles.
    pub first: u32,
    /// How many there are.
    pub count: u32,
}

/// A part of the binary tree: a node, or a leaf below one.
#[derive(Clone, Copy)]
struct Subtree {
    lo: [f32; 3],
    hi: [f32; 3],
    node: Option<u32>,
    first: u32,
    count: u32,
}

impl Subtree {
    fn aabb(&self) -> Aabb {
        Aabb { lo: self.lo, hi: self.hi }
    }
}

/// The cheapest ways to spend lanes on a binary node.
#[derive(Clone, Copy)]
struct Choice {
    /// Cost of what lies below, given up to i + 1 lanes of the parent.
    costs: [f32; WIDTH - 1],
    /// Lanes that go to the first child of i + 1: none where one lane fewer is as cheap. The last is the split of the
    /// wide node's own lanes.
    splits: [u8; WIDTH],
    /// Whether one lane is a leaf.
    is_leaf: bool,
    first: u32,
    count: u32,
}

/// The choices for every binary node.
pub struct Collapse<'a> {
    nodes: &'a [Node],
    choices: Vec<Choice>,
}

/// Subtrees of fewer nodes are chosen for by one thread.
const PARALLEL: usize = 4096;

impl<'a> Collapse<'a> {
    /// Choose for a tree that stands depth first, each of whose leaves is within the rule.
    #[must_use]
    pub fn new(nodes: &'a [Node], leaves: LeafRule) -> Self {
        let none = Choice { costs: [0.0; WIDTH - 1], splits: [0; WIDTH], is_leaf: false, first: 0, count: 0 };
        let mut choices = vec![none; nodes.len()];
        Chooser { nodes, leaves }.fill(0, &mut choices);
        Self { nodes, choices }
    }

    /// The children of the wide node that stands for a binary one, and how many there are.
    #[must_use]
    pub fn children(&self, node: u32) -> ([Part; WIDTH], usize) {
        let nothing = Part { lo: [0.0; 3], hi: [0.0; 3], inner: None, first: 0, count: 0 };
        let (mut parts, mut count) = ([nothing; WIDTH], 0);
        self.split(node, WIDTH, &mut |part| {
            parts[count] = part;
            count += 1;
        });
        (parts, count)
    }

    /// Give `lanes` to a node's children.
    fn split(&self, node: u32, lanes: usize, found: &mut dyn FnMut(Part)) {
        let left = usize::from(self.choices[node as usize].splits[lanes - 1]);
        let [a, b] = subtrees(&self.nodes[node as usize], |index| &self.choices[index as usize]);
        self.spend(&a, left, found);
        self.spend(&b, lanes - left, found);
    }

    /// Give `lanes` to a subtree.
    fn spend(&self, part: &Subtree, lanes: usize, found: &mut dyn FnMut(Part)) {
        let Subtree { lo, hi, node, first, count } = *part;
        let Some(node) = node else { return found(Part { lo, hi, inner: None, first, count }) };
        let choice = &self.choices[node as usize];
        let used = (1..lanes).rev().find(|&i| choice.splits[i] > 0).map_or(1, |i| i + 1);
        if used > 1 {
            self.split(node, used, found);
        } else {
            found(Part { lo, hi, inner: (!choice.is_leaf).then_some(node), first, count });
        }
    }
}

/// A node's children, by the choices for those that are nodes.
fn subtrees<'c>(node: &Node, choice: impl Fn(u32) -> &'c Choice) -> [Subtree; 2] {
    let subtree = |lo, hi, first: u32, count: u32| {
        if count > 0 {
            return Subtree { lo, hi, node: None, first, count };
        }
        let below = choice(first);
        Subtree { lo, hi, node: Some(first), first: below.first, count: below.count }
    };
    [
        subtree(node.a_lo, node.a_hi, node.a_first, node.a_count),
        subtree(node.b_lo, node.b_hi, node.b_first, node.b_count),
    ]
}

/// Finds the choices, from the leaves up.
#[derive(Clone, Copy)]
struct Chooser<'a> {
    nodes: &'a [Node],
    leaves: LeafRule,
}

impl Chooser<'_> {
    /// Choose for the subtree of a node, which stands in a row from there on.
    fn fill(self, node: usize, choices: &mut [Choice]) {
        if choices.len() < PARALLEL {
            for index in (0..choices.len()).rev() {
                let (before, below) = choices.split_at_mut(index + 1);
                before[index] = self.choose(node + index, below);
            }
            return;
        }
        let Node { b_first, b_count, .. } = self.nodes[node];
        let second = if b_count == 0 { b_first as usize } else { node + choices.len() };
        let (own, below) = choices.split_at_mut(1);
        let (left, right) = below.split_at_mut(second - node - 1);
        rayon::join(|| self.fill(node + 1, left), || self.fill(second, right));
        own[0] = self.choose(node, below);
    }

    /// The choice for a node; `below` are those for all nodes that follow.
    fn choose(self, node: usize, below: &[Choice]) -> Choice {
        let choice = |index: u32| &below[index as usize - node - 1];
        let [a, b] = subtrees(&self.nodes[node], choice);
        let costs = |part: &Subtree| match part.node {
            Some(node) => choice(node).costs,
            None => [part.aabb().half_area() as f32 * (self.leaves.cost)(part.count); WIDTH - 1],
        };
        let (x, y) = (costs(&a), costs(&b));
        // The cheapest split of so many lanes.
        let split = |lanes: usize| {
            (1..lanes)
                .map(|left| (x[left - 1] + y[lanes - left - 1], left as u8))
                .fold((f32::INFINITY, 1), |best, next| if next.0 < best.0 { next } else { best })
        };
        let first = a.first.min(b.first);
        let count = (a.first + a.count).max(b.first + b.count) - first;
        let area = a.aabb().union(&b.aabb()).half_area() as f32;
        let (own, own_split) = split(WIDTH);
        let as_leaf = area * (self.leaves.cost)(count);
        let is_leaf = count <= self.leaves.most && as_leaf <= area + own;
        let mut costs = [if is_leaf { as_leaf } else { area + own }; WIDTH - 1];
        let mut splits = [0; WIDTH];
        splits[WIDTH - 1] = own_split;
        for lanes in 2..WIDTH {
            let (cost, left) = split(lanes);
            costs[lanes - 1] = costs[lanes - 2];
            if cost < costs[lanes - 1] {
                (costs[lanes - 1], splits[lanes - 1]) = (cost, left);
            }
        }
        Choice { costs, splits, is_leaf, first, count }
    }
}
