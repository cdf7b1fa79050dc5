//! The bounding volume hierarchy: build, encode, check, statistics.
//!
//! A builder decides only *which* triangles go together, as a `tree::Tree`; `encode` writes the nodes
//! and takes their boxes from the triangles themselves, so that every box is the exact least and greatest
//! coordinate of what lies below it, whichever builder was at work. The traversal widens the boxes; the
//! data hold no padding.
//!
//! [`Collapse`] makes wide nodes of binary ones; [`pack`] writes those that adapters traverse.

mod aabb;
mod binned;
mod build;
mod check;
mod collapse;
mod encode;
mod pack;
mod reinsertion;
mod slots;
mod stats;
mod testing;
mod tree;

pub use build::{Bvh, BvhError, Preset, build};
pub use check::{CheckError, check};
pub use collapse::{Collapse, LeafRule, Part, WIDTH};
pub use pack::{MOST_PACKED, PackedBvh, pack};
pub use stats::Statistics;

/// Triangles in a leaf, at most.
pub const MAX_LEAF: u32 = 4;

/// What visiting a node (testing its two boxes) costs, in ray–triangle tests. Between 0.6 and 1.5 the time to
/// trace does not change measurably.
pub const NODE_COST: f64 = 1.0;
