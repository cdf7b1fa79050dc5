//! What changes from dispatch to dispatch on a GPU: which part is traced, and what comes back beside the pixels.

use bytemuck::{Pod, Zeroable};

/// The part of a picture that one dispatch traces. First in the film buffer.
///
/// The blocks of `View::crop` are numbered row by row; one workgroup traces one block.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Tile {
    /// Block of workgroup 0.
    pub first_block: u32,
    /// Number of blocks.
    pub block_count: u32,
    /// First sample of each pixel; the sums of the earlier ones lie in the film.
    pub first_sample: u32,
    /// Number of samples; with the last of `View::samples` the sums are divided.
    pub sample_count: u32,
    /// Row of the crop that the film begins with: a film that cannot hold the whole picture holds a band of it.
    pub first_row: u32,
    /// Rounds of loops after which an invocation rests between two rays; the next dispatch resumes it.
    pub step_budget: u32,
    /// 1 to go on with the invocations that rest, 0 to begin.
    pub resume: u32,
    /// Rounds of a loop that each invocation makes at its end, to see that the driver lets it.
    pub canary_rounds: u32,
    /// What that loop finds after all rounds: [`Tile::canary_result`].
    pub canary_result: u32,
    /// Pixels of the film's list; its entries are traced, in blocks of BLOCK², instead of the crop's blocks. 0 for none.
    pub listed: u32,
    /// Round of refinement, from 0.
    pub round: u32,
    /// [`Settings::adaptive`](super::Settings::adaptive).
    pub threshold: f32,
}

impl Tile {
    /// What a loop finds that begins with 0 and makes 3x + 1 of x in each round.
    #[must_use]
    pub fn canary_result(rounds: u32) -> u32 {
        (0..rounds).fold(0, |x: u32, _| x.wrapping_mul(3).wrapping_add(1))
    }
}

/// Head of the film buffer: what a dispatch is told, and what it reports.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct FilmHead {
    /// What to trace.
    pub tile: Tile,
    /// Invocations that ran to their end, those outside the picture too: BLOCK² for each block.
    pub done: u32,
    /// Invocations among them that rest, with work left.
    pub paused: u32,
    /// Invocations among them whose last loop the driver ended early: it may have ended others too.
    pub cut_short: u32,
    /// Rays from the eye.
    pub primary: u32,
    /// Children by reflection.
    pub reflection: u32,
    /// Children by refraction.
    pub refraction: u32,
    /// Rays towards lights.
    pub shadow: u32,
    /// Entries of the list of pixels to be refined; added to what it is set to.
    pub listed: u32,
}
