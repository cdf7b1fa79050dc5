//! The cases, a file each or a family.

mod agreement;
mod beyond;
mod built_in;
mod closed_meshes;
mod duplicates;
mod hostile_rays;
mod sharing;

use super::Case;

/// Every case, in the order of tables.
pub const CASES: &[Case] = &[
    closed_meshes::T1,
    closed_meshes::T2,
    duplicates::T14,
    hostile_rays::T18,
    agreement::T20,
    sharing::T21,
    beyond::T22,
];
