//! Adaptive antialiasing: what the film knows of a pixel's samples, and how far refinement reaches.
//!
//! Whitted (1980, "An improved illumination model for shaded display", CACM 23(6)) samples a picture coarsely and
//! goes on where neighbours differ. Here
//! every pixel gets `BASE_SAMPLES`; then rounds follow. In a round, each pixel whose mean is still expected to move by
//! more than a threshold with one more sample gets as many samples again as it has. `kernel::adaptive` decides.

use bytemuck::{Pod, Zeroable};

use super::constants::BASE_SAMPLES;

/// What a pixel's samples are like, in values for a display: the square root of linear radiance, cut to [0, 1].
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Statistics {
    /// Sum over the samples.
    pub sum: [f32; 3],
    /// Sum over the samples and channels of the squares.
    pub squares: f32,
    /// Number of samples.
    pub samples: u32,
    /// Body that they all met first, [`Attribute::NONE`](super::Attribute::NONE) for the background, or `SEVERAL`.
    pub body: u32,
    /// Samples that the pixel had when its round of refinement began.
    pub start: u32,
    /// On a GPU, slot i of the film holds entry i of the round's list of pixels, whichever pixel that is. On the CPU,
    /// 1 if this pixel is to be refined.
    pub listed: u32,
}

/// How often a pixel's samples may double until it has `samples`: rounds of refinement, and how far in pixels they
/// let a pixel learn from others.
#[must_use]
pub fn refinement_rounds(samples: u32) -> u32 {
    samples.div_ceil(BASE_SAMPLES).max(1).next_power_of_two().ilog2()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounds_double_the_samples_until_all_are_there() {
        for (samples, rounds) in [(1, 0), (2, 0), (3, 1), (4, 1), (5, 2), (64, 5), (65_536, 15)] {
            assert_eq!(refinement_rounds(samples), rounds, "{samples}");
            assert!(BASE_SAMPLES << rounds >= samples);
        }
    }
}
