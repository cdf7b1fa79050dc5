//! The nodes that adapters traverse: eight boxes in bytes.

use super::aabb::Aabb;
use super::collapse::{Collapse, LeafRule, Part, WIDTH};
use super::slots::by_octant;
use crate::layout::constants::SIBLING_BITS;
use crate::layout::{Node, Triangle, WideNode};
use bytemuck::Zeroable;

/// A leaf is met with the node above it, then its triangles are fetched and tested one by one.
const LEAVES: LeafRule = LeafRule { most: super::MAX_LEAF, cost: |count| 0.5 + 0.3 * count as f32 };
/// Exponent of the least scale, as f32 has it: 2^-100.
const LEAST_EXPONENT: u32 = 27;
/// Where a leaf's byte holds its number of triangles.
const COUNT_SHIFT: u32 = 5;

/// Most nodes of a packed tree that adapters reach: their places are part of a word on a ray's stack.
pub const MOST_PACKED: usize = 1 << (u32::BITS - SIBLING_BITS);

/// A tree of [`WideNode`]s.
#[derive(Debug, Clone, PartialEq)]
pub struct PackedBvh {
    /// The root first. A few places between them are empty: zero.
    pub nodes: Vec<WideNode>,
    /// For each place of the packed tree's triangles, which triangle of the binary tree's stands there.
    pub order: Vec<u32>,
}

/// Collapse a binary tree over triangles in the order of its leaves. It gets no deeper.
#[must_use]
pub fn pack(nodes: &[Node], triangles: &[Triangle]) -> PackedBvh {
    let collapse = Collapse::new(nodes, LEAVES);
    let mut packed =
        PackedBvh { nodes: vec![WideNode::zeroed()], order: Vec::with_capacity(triangles.len()) };
    let mut places = Places::after_the_root();
    // Binary nodes, and the places of the wide ones that stand for them.
    let mut left = vec![(0, 0)];
    while let Some((binary, place)) = left.pop() {
        let (parts, count) = collapse.children(binary);
        let (mut node, inner) = node(&parts[..count], &mut packed.order);
        node.first_child = places.take(node.scales >> 24);
        packed.nodes[place] = node;
        packed.nodes.resize(places.end(), WideNode::zeroed());
        let at = |(number, binary): (usize, u32)| (binary, node.first_child as usize + number);
        left.extend(inner.into_iter().rev().map(at));
    }
    packed
}

/// Which of the last places are taken.
struct Places {
    first: u32,
    /// A bit each from `first` on; what is free before stays empty.
    taken: u128,
}

impl Places {
    /// As many as are looked at for gaps.
    const WINDOW: u32 = 64;

    fn after_the_root() -> Self {
        Self { first: 0, taken: 1 }
    }

    /// Take places for the inner children of these numbers; tells where number 0 is.
    fn take(&mut self, numbers: u32) -> u32 {
        let numbers = u128::from(numbers);
        let gap = (0..=Self::WINDOW).find(|gap| self.taken & numbers << gap == 0).unwrap_or(Self::WINDOW);
        self.taken |= numbers << gap;
        let place = self.first + gap;
        let beyond = (u128::BITS - self.taken.leading_zeros()).saturating_sub(Self::WINDOW);
        self.taken >>= beyond;
        self.first += beyond;
        place
    }

    /// Behind the last that is taken.
    fn end(&self) -> usize {
        (self.first + u128::BITS - self.taken.leading_zeros()) as usize
    }
}

/// The node of these children, and the inner ones by number, as binary nodes; appends the triangles of the others.
fn node(parts: &[Part], order: &mut Vec<u32>) -> (WideNode, Vec<(usize, u32)>) {
    let first_triangle = order.len() as u32;
    let Aabb { lo, hi } =
        parts.iter().fold(Aabb::EMPTY, |aabb, part| aabb.union(&Aabb { lo: part.lo, hi: part.hi }));
    let slots = by_octant(parts);
    let mut node = WideNode { origin: lo, first_triangle, ..WideNode::zeroed() };
    let mut inner = Vec::new();
    for (slot, part) in slots.iter().enumerate() {
        let Some(part) = part.map(|index| &parts[index]) else { continue };
        if let Some(binary) = part.inner {
            node.scales |= 1 << (24 + slot);
            inner.push((slot, binary));
        } else {
            let leaf = part.count << COUNT_SHIFT | (order.len() as u32 - first_triangle);
            node.leaves[slot / 4] |= leaf << (slot % 4 * 8);
            order.extend(part.first..part.first + part.count);
        }
    }
    for axis in 0..3 {
        let boxes = slots.map(|slot| slot.map(|index| (parts[index].lo[axis], parts[index].hi[axis])));
        let (exponent, planes) = planes(lo[axis], hi[axis], &boxes);
        node.scales |= exponent << (axis * 8);
        node.planes[axis] = planes;
    }
    (node, inner)
}

/// The least exponent by which every box of an axis lies within bytes, and the words of the planes.
fn planes(lo: f32, hi: f32, boxes: &[Option<(f32, f32)>; WIDTH]) -> (u32, [u32; 4]) {
    let step = (f64::from(hi) - f64::from(lo)) / 255.0;
    let least = ((step as f32).to_bits() >> 23).max(LEAST_EXPONENT);
    for exponent in least.. {
        let scale = f32::from_bits(exponent << 23);
        let Some(bytes) = bytes(lo, scale, boxes) else { continue };
        let word = |row: usize, half: usize| {
            (0..4).fold(0, |word, lane| word | bytes[half * 4 + lane][row] << (lane * 8))
        };
        return (exponent, [word(0, 0), word(0, 1), word(1, 0), word(1, 1)]);
    }
    unreachable!("a scale beyond all floats holds every box")
}

/// Lower and upper plane of each box: none where one is beyond a byte.
fn bytes(origin: f32, scale: f32, boxes: &[Option<(f32, f32)>; WIDTH]) -> Option<[[u32; 2]; WIDTH]> {
    let mut bytes = [[0; 2]; WIDTH];
    for (bytes, extent) in bytes.iter_mut().zip(boxes) {
        let Some((lo, hi)) = *extent else { continue };
        let steps = |x: f32| (f64::from(x) - f64::from(origin)) / f64::from(scale);
        let lower = (steps(lo).floor() as u32).min(255);
        let upper = steps(hi).ceil() as u32;
        // Rounding may move a plane into the box.
        let lower = (0..=lower).rev().find(|&byte| is_at_most(origin, byte, scale, lo))?;
        let upper = (upper..=255).find(|&byte| is_at_least(origin, byte, scale, hi))?;
        *bytes = [lower, upper];
    }
    Some(bytes)
}

fn is_at_most(origin: f32, byte: u32, scale: f32, x: f32) -> bool {
    let (single, double) = plane(origin, byte, scale);
    single <= x && double <= f64::from(x)
}

fn is_at_least(origin: f32, byte: u32, scale: f32, x: f32) -> bool {
    let (single, double) = plane(origin, byte, scale);
    single >= x && double >= f64::from(x)
}

/// A plane as the shader of each precision finds it; the product is exact in both.
fn plane(origin: f32, byte: u32, scale: f32) -> (f32, f64) {
    (origin + byte as f32 * scale, f64::from(origin) + f64::from(byte) * f64::from(scale))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::testing::{soup, triangle};
    use super::super::{Preset, build};
    use super::*;

    /// What lies below a node, as the shader reads it: its box, how often each triangle is there, the number of nodes.
    struct Walk<'a> {
        triangles: &'a [Triangle],
        packed: &'a PackedBvh,
        found: Vec<u32>,
        nodes: usize,
    }

    impl Walk<'_> {
        fn node(&mut self, index: u32) -> Aabb {
            self.nodes += 1;
            let node = self.packed.nodes[index as usize];
            let inner = node.scales >> 24;
            let mut whole = Aabb::EMPTY;
            for slot in 0..WIDTH {
                let leaf = node.leaves[slot / 4] >> (slot % 4 * 8) & 0xff;
                let (from, count) = (node.first_triangle + (leaf & 31), leaf >> COUNT_SHIFT);
                let below = if inner >> slot & 1 == 1 {
                    assert_eq!(count, 0);
                    self.node(node.first_child + slot as u32)
                } else {
                    let places = from..from + count;
                    places.fold(Aabb::EMPTY, |aabb, place| aabb.union(&self.triangle(place)))
                };
                if inner >> slot & 1 == 1 || count > 0 {
                    holds(&node, slot, &below);
                }
                whole = whole.union(&below);
            }
            whole
        }

        fn triangle(&mut self, place: u32) -> Aabb {
            let index = self.packed.order[place as usize];
            self.found[index as usize] += 1;
            Aabb::of(&self.triangles[index as usize])
        }
    }

    /// A child's box in bytes holds what lies below it, and is at most two steps wider at each end.
    fn holds(node: &WideNode, slot: usize, below: &Aabb) {
        for axis in 0..3 {
            let scale = f32::from_bits((node.scales >> (axis * 8) & 0xff) << 23);
            let byte = |row: usize| node.planes[axis][row * 2 + slot / 4] >> (slot % 4 * 8) & 0xff;
            let ((lo, lo64), (hi, hi64)) =
                (plane(node.origin[axis], byte(0), scale), plane(node.origin[axis], byte(1), scale));
            let (least, greatest) = (below.lo[axis], below.hi[axis]);
            assert!(lo <= least && hi >= greatest, "{lo} {least} {greatest} {hi}");
            assert!(lo64 <= f64::from(least) && hi64 >= f64::from(greatest));
            let slack = 2.0 * f64::from(scale) + f64::from(least.abs().max(greatest.abs())) * 2f64.powi(-22);
            assert!(f64::from(least) - lo64 <= slack && hi64 - f64::from(greatest) <= slack);
        }
    }

    fn assert_sound(triangles: &[Triangle]) {
        let tree = build(triangles, Preset::Best).unwrap();
        let triangles: Vec<_> = tree.order.iter().map(|&index| triangles[index as usize]).collect();
        let packed = pack(&tree.nodes, &triangles);
        let mut walk =
            Walk { triangles: &triangles, packed: &packed, found: vec![0; triangles.len()], nodes: 0 };
        walk.node(0);
        let times = if triangles.len() == 1 { 2 } else { 1 };
        assert!(walk.found.iter().all(|&found| found == times), "{:?}", walk.found);
        let used = packed.nodes.iter().filter(|node| **node != WideNode::zeroed()).count();
        assert_eq!((walk.nodes, packed.order.len()), (used, triangles.len() * times as usize));
    }

    #[test]
    fn boxes_hold_what_lies_below_them_and_every_triangle_is_there_once() {
        for count in [1, 2, 3, 9, 100, 5000] {
            assert_sound(&soup(count, 1.0));
        }
        assert_sound(&soup(500, 2f32.powi(59)));
        assert_sound(&soup(500, 2f32.powi(-59)));
    }

    #[test]
    fn rounding_far_from_the_origin_moves_no_plane_into_its_box() {
        let far = |t: &Triangle| {
            let moved = |v: [f32; 3]| v.map(|x| x + 1.0e5);
            Triangle { v0: moved(t.v0), v1: moved(t.v1), v2: moved(t.v2), ..*t }
        };
        assert_sound(&soup(2000, 1.0).iter().map(far).collect::<Vec<_>>());
    }

    #[test]
    fn points_lines_and_copies_are_packed() {
        assert_sound(&(0..300).map(|x| triangle([[x as f32, 0.0, 0.0]; 3], 0)).collect::<Vec<_>>());
        assert_sound(&vec![soup(1, 1.0)[0]; 300]);
    }

    #[test]
    fn nodes_are_well_filled() {
        let triangles = soup(5000, 1.0);
        let tree = build(&triangles, Preset::Best).unwrap();
        let packed = pack(&tree.nodes, &triangles);
        assert!(packed.nodes.len() * 4 < tree.nodes.len(), "{} of {}", packed.nodes.len(), tree.nodes.len());
        let empty = packed.nodes.iter().filter(|node| **node == WideNode::zeroed()).count();
        assert!(empty * 50 < packed.nodes.len(), "{empty} of {} are empty", packed.nodes.len());
    }

    #[test]
    fn siblings_fill_the_gaps_of_others() {
        let mut places = Places::after_the_root();
        assert_eq!([0b101, 0b101, 0b11].map(|numbers| places.take(numbers)), [1, 2, 5]);
        assert_eq!(places.end(), 7);
        for _ in 0..100 {
            places.take(0xff);
        }
        assert_eq!((places.end(), places.take(0)), (807, 743));
    }
}
