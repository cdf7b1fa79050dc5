//! The cases, a file each or a family.

mod boxes;
mod closed_meshes;
mod degenerate;
mod leaving;
mod places;
mod walls;

use super::Case;

/// Every case, in the order of tables.
pub const CASES: &[Case] =
    &[closed_meshes::T1, closed_meshes::T2, boxes::T3, leaving::T4, walls::T5, degenerate::T15, places::T17];
