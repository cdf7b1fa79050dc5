//! What changes from dispatch to dispatch on a GPU: which part is traced, and what comes back beside the pixels.

use bytemuck::{Pod, Zeroable};

/// The part of a picture that one dispatch traces. Uniform buffer.
///
/// The blocks of `View::crop` are numbered row by row; one workgroup traces one block.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct Tile {
    /// Block of workgroup 0.
    pub first_block: u32,
    /// Number of blocks.
    pub block_count: u32,
    /// First sample of each pixel; the sums of the earlier ones lie in the film.
    pub first_sample: u32,
    /// Number of samples; with the last of `View::samples` the sums are divided.
    pub sample_count: u32,
}

/// Head of the film buffer: what a dispatch reports. The host reads and clears it after each submission.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct FilmHead {
    /// Invocations that ran to their end, those outside the picture too: BLOCK² for each block.
    pub done: u32,
    /// Rays from the eye.
    pub primary: u32,
    /// Children by reflection.
    pub reflection: u32,
    /// Children by refraction.
    pub refraction: u32,
    /// Rays towards lights.
    pub shadow: u32,
    /// Unused, 0.
    pub reserved0: u32,
    /// Unused, 0.
    pub reserved1: u32,
    /// Unused, 0.
    pub reserved2: u32,
}
