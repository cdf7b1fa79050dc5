//! The cases, a file each or a family.

mod closed_meshes;

use super::Case;

/// Every case, in the order of tables.
pub const CASES: &[Case] = &[closed_meshes::T1, closed_meshes::T2];
