//! One ray at a time.

use super::layout::{Child, WIDTH};
use super::ray::Spread;
use super::simd::Simd;
use super::stack::{Stack, child, distance, key};
use super::tree::Tree;
use crate::layout::constants::NONE;

/// The nearest crossing so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best {
    pub(super) t: f32,
    pub(super) id: u32,
    /// Leaf times [`WIDTH`], plus lane; `NONE` for a miss.
    pub(super) place: u32,
    pub(super) b1: f32,
    pub(super) b2: f32,
    /// Whether the signed area is positive.
    pub(super) turns: bool,
}

impl Best {
    #[inline(always)]
    pub(super) fn none(limit: f32) -> Self {
        Self { t: limit, id: 0, place: NONE, b1: 0.0, b2: 0.0, turns: false }
    }
}

/// Find the nearest crossing in the tree below `root`, if it wins over `best`.
#[inline(always)]
pub(super) fn closest<S: Simd<WIDTH>>(s: S, tree: &Tree, ray: &Spread<S::F>, root: u32, best: &mut Best) {
    let mut stack = Stack::new();
    let mut current = root;
    loop {
        match Child::unpack(current) {
            Child::Node(index) => {
                let node = &tree.nodes[index];
                let (bits, entry) = ray.meet(s, node, s.splat(best.t));
                if bits != 0 {
                    tree.prefetch(node, bits);
                    let first = bits.trailing_zeros() as usize % WIDTH;
                    let others = bits & (bits - 1);
                    if others == 0 {
                        current = node.children[first];
                        continue;
                    }
                    let second = others.trailing_zeros() as usize % WIDTH;
                    if others & (others - 1) == 0 {
                        // A branch, so that the processor goes on with the likelier child.
                        let mut distances = [0.0; WIDTH];
                        s.store(entry, &mut distances);
                        let (a, b) = (distances[first], distances[second]);
                        if a <= b {
                            stack.push(key(b, node.children[second]));
                            current = node.children[first];
                        } else {
                            stack.push(key(a, node.children[first]));
                            current = node.children[second];
                        }
                    } else {
                        current = child(stack.nearest(s, entry, &node.children, bits));
                    }
                    continue;
                }
            }
            Child::Leaf { index, .. } => {
                let leaf = &tree.leaves[index];
                if let Some(found) = ray.cross(s, leaf, s.splat(best.t)) {
                    let (mut t, mut b1, mut b2, mut det) =
                        ([0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH]);
                    s.store(found.t, &mut t);
                    s.store(found.b1, &mut b1);
                    s.store(found.b2, &mut b2);
                    s.store(found.det, &mut det);
                    let mut bits = found.bits;
                    while bits != 0 {
                        let lane = bits.trailing_zeros() as usize % WIDTH;
                        bits &= bits - 1;
                        let id = leaf.ids[lane];
                        if t[lane] < best.t || (t[lane] == best.t && id < best.id) {
                            let place = (index * WIDTH + lane) as u32;
                            *best = Best {
                                t: t[lane],
                                id,
                                place,
                                b1: b1[lane],
                                b2: b2[lane],
                                turns: det[lane] > 0.0,
                            };
                        }
                    }
                }
            }
        }
        loop {
            let Some(key) = stack.pop() else { return };
            if distance(key) <= best.t {
                current = child(key);
                break;
            }
        }
    }
}

/// Whether anything is crossed before `limit`.
#[inline(always)]
pub(super) fn any<S: Simd<WIDTH>>(s: S, tree: &Tree, ray: &Spread<S::F>, root: u32, limit: f32) -> bool {
    let mut stack = Stack::new();
    let end = s.splat(limit);
    let mut current = root;
    loop {
        match Child::unpack(current) {
            Child::Node(index) => {
                let node = &tree.nodes[index];
                let (mut bits, _) = ray.meet(s, node, end);
                if bits != 0 {
                    current = node.children[bits.trailing_zeros() as usize % WIDTH];
                    bits &= bits - 1;
                    while bits != 0 {
                        stack.push(u64::from(node.children[bits.trailing_zeros() as usize % WIDTH]));
                        bits &= bits - 1;
                    }
                    continue;
                }
            }
            Child::Leaf { index, .. } => {
                let crossed = ray.cross(s, &tree.leaves[index], end);
                if crossed.is_some_and(|found| found.bits & s.bits(s.lt(found.t, end)) != 0) {
                    return true;
                }
            }
        }
        let Some(key) = stack.pop() else { return false };
        current = child(key);
    }
}
