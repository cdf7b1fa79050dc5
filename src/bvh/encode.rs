//! From a builder's tree to the records of the storage buffer.

use bytemuck::Zeroable;

use super::aabb::Aabb;
use super::build::Bvh;
use super::tree::{Branch, Size, Tree};
use crate::layout::{Node, Triangle};

/// Subtrees over fewer triangles are written by one thread.
const PARALLEL: u32 = 8192;

/// What a parent says about a child.
#[derive(Clone, Copy)]
struct Child {
    aabb: Aabb,
    first: u32,
    count: u32,
}

/// Write the tree depth first, with each box taken from the triangles below it. `sizes` are those of the tree, which is
/// not deeper than the traversal's stack and holds at least one triangle.
pub(super) fn encode(triangles: &[Triangle], tree: &Tree, sizes: &[Size]) -> Bvh {
    let encoder = Encoder { triangles, tree, sizes };
    let mut nodes = vec![Node::zeroed(); (sizes[0].nodes as usize).max(1)];
    let mut order = vec![0; tree.order.len()];
    let root = tree.nodes[0];
    if root.count == 0 {
        encoder.child(0, 0, 0, &mut nodes, &mut order);
    } else {
        nodes[0] = encoder.lone_leaf(root, &mut order);
    }
    Bvh { nodes, order, depth: sizes[0].depth.max(1) }
}

struct Encoder<'a> {
    triangles: &'a [Triangle],
    tree: &'a Tree,
    sizes: &'a [Size],
}

impl Encoder<'_> {
    /// Write everything below a branch: its nodes, of which the first is number `node` of all, and the order of its
    /// triangles, of which the first has place `place`. A parent comes right before its first child, so that a ray that goes
    /// down finds the next node nearby in memory.
    fn child(&self, branch: u32, node: u32, place: u32, nodes: &mut [Node], order: &mut [u32]) -> Child {
        let Branch { first, count } = self.tree.nodes[branch as usize];
        let Some((own, below)) = nodes.split_first_mut().filter(|_| count == 0) else {
            return self.leaf(&self.tree.order[first as usize..][..count as usize], place, order);
        };
        let left = self.sizes[first as usize];
        let (left_nodes, right_nodes) = below.split_at_mut(left.nodes as usize);
        let (left_order, right_order) = order.split_at_mut(left.triangles as usize);
        let mut a = || self.child(first, node + 1, place, left_nodes, left_order);
        let (right_node, right_place) = (node + 1 + left.nodes, place + left.triangles);
        let mut b = || self.child(first + 1, right_node, right_place, right_nodes, right_order);
        let (a, b) =
            if self.sizes[branch as usize].triangles < PARALLEL { (a(), b()) } else { rayon::join(a, b) };
        *own = parent(&a, &b);
        Child { aabb: a.aabb.union(&b.aabb), first: node, count: 0 }
    }

    /// Write a leaf's triangles, by index, so that equal trees give equal orders.
    fn leaf(&self, triangles: &[u32], place: u32, order: &mut [u32]) -> Child {
        order.copy_from_slice(triangles);
        order.sort_unstable();
        let aabb = order
            .iter()
            .fold(Aabb::EMPTY, |aabb, &index| aabb.union(&Aabb::of(&self.triangles[index as usize])));
        Child { aabb, first: place, count: order.len() as u32 }
    }

    /// A root needs two children: a lone leaf is halved, a lone triangle is named twice.
    fn lone_leaf(&self, root: Branch, order: &mut [u32]) -> Node {
        let triangles = &self.tree.order[root.first as usize..][..root.count as usize];
        let half = triangles.len() / 2;
        let (left, right) = order.split_at_mut(half);
        let b = self.leaf(&triangles[half..], half as u32, right);
        let a = if half == 0 { b } else { self.leaf(&triangles[..half], 0, left) };
        parent(&a, &b)
    }
}

fn parent(a: &Child, b: &Child) -> Node {
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
