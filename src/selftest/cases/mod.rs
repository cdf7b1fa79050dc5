//! The cases, a file each or a family.

mod agreement;
mod beyond;
mod boxes;
mod built_in;
mod closed_meshes;
mod critical;
mod degenerate;
mod duplicates;
mod furnace;
mod hollow_cube;
mod hostile_rays;
mod index_match;
mod leaving;
mod mirrors;
mod parity;
mod places;
mod prism;
mod reflectance;
mod reversal;
mod rod;
mod scale;
mod sharing;
mod slab;
mod strict;
mod terminator;
mod walls;

use super::Case;

/// Every case, in the order of tables.
pub const CASES: &[Case] = &[
    closed_meshes::T1,
    closed_meshes::T2,
    boxes::T3,
    leaving::T4,
    walls::T5,
    critical::T6,
    index_match::T7,
    reflectance::T8,
    reversal::T9,
    furnace::T10,
    furnace::T11,
    hollow_cube::T12,
    parity::T13,
    duplicates::T14,
    degenerate::T15,
    scale::T16,
    places::T17,
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
    strict::S1,
];
