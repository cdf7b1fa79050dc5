//! The builder of best quality: PLOC with reinsertion and collapsed leaves, from the crate `obvhs`
//! (Meister and Bittner 2018, "Parallel locally-ordered clustering for bounding volume hierarchy
//! construction"; Meister and Bittner 2018, "Parallel reinsertion for bounding volume hierarchy
//! optimization").

use std::time::Duration;

use obvhs::bvh2::builder::build_bvh2;
use obvhs::{Boundable, BvhBuildParams};
use rayon::slice::ParallelSliceMut;

use super::aabb::Aabb;
use super::tree::{Branch, Tree};
use super::{MAX_LEAF, NODE_COST};
use crate::layout::Triangle;

/// Equal boxes, at most: among n of them nothing guides the search, which then takes time of order n².
const MAX_EQUAL_BOXES: usize = 1024;

/// Random part of a box's size by which it is widened for the builder alone, so that no costs are equal: in a
/// row of equally spaced equal boxes each prefers its right neighbour, and PLOC merges one pair a pass.
const DITHER_OF_SIZE: f32 = 1.0 / 64.0;
/// As much of a coordinate (a few roundoffs), for boxes smaller than what f32 resolves there.
const DITHER_OF_COORDINATE: f32 = 1.0 / (1 << 21) as f32;

/// Build a tree of any depth with at most [`MAX_LEAF`] triangles a leaf; `None` for scenes that the
/// method does not suit. `triangles` is not empty, its corners are finite.
pub(super) fn build(triangles: &[Triangle]) -> Option<Tree> {
    if most_equal_boxes(triangles) > MAX_EQUAL_BOXES {
        return None;
    }
    let params = BvhBuildParams {
        max_prims_per_leaf: MAX_LEAF,
        collapse_traversal_cost: NODE_COST as f32,
        ..BvhBuildParams::medium_build()
    };
    let scale = unit_scale(triangles);
    let boxes: Vec<UnitBox> =
        triangles.iter().zip(0..).map(|(triangle, index)| UnitBox::new(triangle, index, scale)).collect();
    let built = build_bvh2(&boxes, params, &mut Duration::default());
    let nodes =
        built.nodes.iter().map(|node| Branch { first: node.first_index, count: node.prim_count }).collect();
    Some(Tree { nodes, order: built.primitive_indices })
}

/// A triangle's box as `obvhs` gets it: scaled and dithered.
struct UnitBox(Aabb);

impl UnitBox {
    fn new(triangle: &Triangle, index: u32, scale: f32) -> Self {
        let Aabb { lo, hi } = Aabb::of(triangle);
        let (lo, hi) = (lo.map(|x| x * scale), hi.map(|x| x * scale));
        let dithered = |axis: usize| {
            let reach = (hi[axis] - lo[axis]) * DITHER_OF_SIZE + hi[axis].abs() * DITHER_OF_COORDINATE;
            hi[axis] + reach * dither(index, axis as u32)
        };
        Self(Aabb { lo, hi: std::array::from_fn(dithered) })
    }
}

/// A hash of a triangle and an axis, in [0, 1) (Fibonacci hashing: Knuth, TAOCP volume 3, section 6.4).
fn dither(index: u32, axis: u32) -> f32 {
    let hash = (index.wrapping_mul(3).wrapping_add(axis)).wrapping_mul(0x9E37_79B9);
    (hash >> 8) as f32 / (1 << 24) as f32
}

impl Boundable for UnitBox {
    fn aabb(&self) -> obvhs::aabb::Aabb {
        obvhs::aabb::Aabb::new(self.0.lo.into(), self.0.hi.into())
    }
}

/// The power of two that brings every coordinate into [−1, 1]: `obvhs` computes areas in f32 and sorts
/// their differences, which must not overflow to NaN.
fn unit_scale(triangles: &[Triangle]) -> f32 {
    let Aabb { lo, hi } =
        triangles.iter().fold(Aabb::EMPTY, |aabb, triangle| aabb.union(&Aabb::of(triangle)));
    let largest = lo.into_iter().chain(hi).fold(f32::MIN_POSITIVE, |largest, x| largest.max(x.abs()));
    // The exponent is in −126..=127, so that the scale's is in −127..=126: within f32, subnormals included.
    let exponent = (largest.to_bits() >> 23) as i32 - 127;
    2.0_f32.powi(-exponent - 1)
}

/// The size of the largest group of triangles with the same box (up to collisions of a 64-bit hash).
fn most_equal_boxes(triangles: &[Triangle]) -> usize {
    let mut hashes: Vec<u64> = triangles.iter().map(|triangle| hash(&Aabb::of(triangle))).collect();
    hashes.par_sort_unstable();
    hashes.chunk_by(|a, b| a == b).map(<[u64]>::len).max().unwrap_or(0)
}

/// FNV-1a over the six coordinates, a word at a time.
fn hash(aabb: &Aabb) -> u64 {
    aabb.lo
        .iter()
        .chain(&aabb.hi)
        .fold(0xcbf2_9ce4_8422_2325, |hash, x| (hash ^ u64::from(x.to_bits())).wrapping_mul(0x0100_0000_01b3))
}
