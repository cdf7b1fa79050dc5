//! The cases, a file each or a family.

mod agreement;
mod beyond;
mod built_in;
mod closed_meshes;
mod critical;
mod duplicates;
mod furnace;
mod hollow_cube;
mod hostile_rays;
mod index_match;
mod mirrors;
mod parity;
mod prism;
mod reflectance;
mod reversal;
mod rod;
mod scale;
mod sharing;
mod slab;
mod terminator;

use super::Case;

/// Every case, in the order of tables.
pub const CASES: &[Case] = &[
    closed_meshes::T1,
    closed_meshes::T2,
    critical::T6,
    index_match::T7,
    reflectance::T8,
    reversal::T9,
    furnace::T10,
    furnace::T11,
    hollow_cube::T12,
    parity::T13,
    duplicates::T14,
    scale::T16,
    hostile_rays::T18,
    terminator::T19,
    agreement::T20,
    sharing::T21,
    beyond::T22,
    reflectance::C1,
    critical::C2,
    reflectance::C3,
    slab::C4,
    slab::C5,
    slab::C6,
    rod::C7,
    prism::C8,
    rod::C9,
    slab::C10,
    mirrors::C11,
    mirrors::C12,
    hollow_cube::C13,
];
