//! The wide tree.

use super::layout::{Child, Leaf, Node, WIDTH};
use super::pages;
#[cfg(target_arch = "x86_64")]
use super::x86::prefetch;
use crate::bvh::{Collapse, LeafRule, Part};
use crate::layout::{self, Triangle};
use rayon::prelude::*;

/// A leaf's triangles are tested together, however many they are, at little more than what a node's boxes cost.
const LEAVES: LeafRule = LeafRule { most: WIDTH as u32, cost: |_| 1.2 };

/// Nodes of eight children over leaves of up to eight triangles.
#[derive(Debug, Clone)]
pub(super) struct Tree {
    /// The root first.
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<Leaf>,
    /// Index of each leaf's first triangle.
    firsts: Vec<u32>,
    /// Least and greatest corner of all boxes.
    pub(super) bounds: [[f32; 3]; 2],
}

impl Tree {
    /// The word that names the first node.
    pub(super) const ROOT: u32 = 0;

    /// Collapse a binary tree, each of whose subtrees holds triangles that stand in a row.
    pub(super) fn new(nodes: &[layout::Node], triangles: &[Triangle]) -> Self {
        let mut writer = Writer {
            collapse: Collapse::new(nodes, LEAVES),
            nodes: Vec::with_capacity(nodes.len() / 2),
            rows: vec![],
        };
        writer.node(0);
        let Writer { nodes: written, rows, .. } = writer;
        let leaf = |&(first, count): &(u32, u32)| Leaf::new(&triangles[first as usize..][..count as usize]);
        let mut leaves = pages::with_capacity(rows.len());
        rows.par_iter().map(leaf).collect_into_vec(&mut leaves);
        let mut wide = pages::with_capacity(written.len());
        wide.extend(written);
        Self {
            nodes: wide,
            leaves,
            firsts: rows.into_iter().map(|(first, _)| first).collect(),
            bounds: bounds(&nodes[0]),
        }
    }

    /// Index of the triangle at a place.
    #[inline(always)]
    pub(super) fn index(&self, place: u32) -> u32 {
        self.firsts[place as usize / WIDTH] + place % WIDTH as u32
    }

    /// The triangle at a place.
    #[inline(always)]
    pub(super) fn triangle(&self, place: u32) -> Triangle {
        self.leaves[place as usize / WIDTH].triangle(place as usize % WIDTH)
    }

    /// Begin to fetch the children of a node whose bit is set.
    #[inline(always)]
    pub(super) fn prefetch(&self, node: &Node, mut bits: u32) {
        while bits != 0 {
            match Child::unpack(node.children[bits.trailing_zeros() as usize % WIDTH]) {
                Child::Node(index) => prefetch(&self.nodes[index]),
                Child::Leaf { index, .. } => prefetch(&self.leaves[index]),
            }
            bits &= bits - 1;
        }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.leaves) + size_of_val(&*self.firsts)
    }
}

/// Elsewhere the processor is left to itself.
#[cfg(not(target_arch = "x86_64"))]
fn prefetch<T>(_: &T) {}

/// The box of both children.
fn bounds(root: &layout::Node) -> [[f32; 3]; 2] {
    [
        std::array::from_fn(|axis| root.a_lo[axis].min(root.b_lo[axis])),
        std::array::from_fn(|axis| root.a_hi[axis].max(root.b_hi[axis])),
    ]
}

/// Writes nodes depth first, and which triangles the leaves hold.
struct Writer<'a> {
    collapse: Collapse<'a>,
    nodes: Vec<Node>,
    rows: Vec<(u32, u32)>,
}

impl Writer<'_> {
    /// Write the node that stands for a binary one, and all below it.
    fn node(&mut self, binary: u32) -> usize {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let (parts, count) = self.collapse.children(binary);
        for (lane, part) in parts.iter().take(count).enumerate() {
            let child = match *part {
                Part { inner: Some(inner), .. } => Child::Node(self.node(inner)),
                Part { first, count, .. } => self.leaf(first, count),
            };
            self.nodes[index].set(lane, part.lo, part.hi, child);
        }
        index
    }

    fn leaf(&mut self, first: u32, count: u32) -> Child {
        self.rows.push((first, count));
        Child::Leaf { index: self.rows.len() - 1, count: count as usize }
    }
}
