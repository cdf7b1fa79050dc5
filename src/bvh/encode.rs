//! From a builder's tree to the records of the storage buffer.

use super::aabb::Aabb;
use super::build::Bvh;
use super::tree::{Branch, Tree};
use crate::layout::{Node, Triangle};

/// What a parent says about a child.
#[derive(Clone, Copy)]
struct Child {
    aabb: Aabb,
    first: u32,
    count: u32,
}

/// Write the tree depth first, with each box taken from the triangles below it. The tree is not deeper
/// than the traversal's stack and holds at least one triangle.
pub(super) fn encode(triangles: &[Triangle], tree: Tree) -> Bvh {
    let mut encoder = Encoder {
        triangles,
        tree: &tree,
        nodes: Vec::with_capacity(tree.nodes.len() / 2 + 1),
        order: Vec::with_capacity(tree.order.len()),
    };
    let root = tree.nodes[0];
    let depth = if root.count == 0 {
        encoder.child(root);
        tree.depth()
    } else {
        encoder.lone_leaf(root);
        1
    };
    Bvh { nodes: encoder.nodes, order: encoder.order, depth }
}

struct Encoder<'a> {
    triangles: &'a [Triangle],
    tree: &'a Tree,
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Encoder<'_> {
    /// Write everything below `branch`. A parent comes right before its first child, so that a ray that
    /// goes down finds the next node nearby in memory.
    fn child(&mut self, branch: Branch) -> Child {
        if branch.count > 0 {
            return self.leaf(branch);
        }
        let index = self.nodes.len();
        self.nodes.push(bytemuck::Zeroable::zeroed());
        let a = self.child(self.tree.nodes[branch.first as usize]);
        let b = self.child(self.tree.nodes[branch.first as usize + 1]);
        self.nodes[index] = node(&a, &b);
        Child { aabb: a.aabb.union(&b.aabb), first: index as u32, count: 0 }
    }

    /// Append a leaf's triangles to the order, by index, so that equal trees give equal orders.
    fn leaf(&mut self, branch: Branch) -> Child {
        let first = self.order.len();
        self.order.extend(&self.tree.order[branch.first as usize..(branch.first + branch.count) as usize]);
        let leaf = &mut self.order[first..];
        leaf.sort_unstable();
        let aabb = leaf
            .iter()
            .fold(Aabb::EMPTY, |aabb, &index| aabb.union(&Aabb::of(&self.triangles[index as usize])));
        Child { aabb, first: first as u32, count: branch.count }
    }

    /// A root needs two children: a lone leaf is halved, a lone triangle is named twice.
    fn lone_leaf(&mut self, root: Branch) {
        let half = root.count / 2;
        let b = self.leaf(Branch { first: root.first + half, count: root.count - half });
        let a = if half == 0 { b } else { self.leaf(Branch { first: root.first, count: half }) };
        self.nodes.push(node(&a, &b));
    }
}

fn node(a: &Child, b: &Child) -> Node {
    Node {
        a_lo: a.aabb.lo,
        a_first: a.first,
        a_hi: a.aabb.hi,
        a_count: a.count,
        b_lo: b.aabb.lo,
        b_first: b.first,
        b_hi: b.aabb.hi,
        b_count: b.count,
    }
}
