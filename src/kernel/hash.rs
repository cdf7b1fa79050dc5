//! Path hashes and the sample pattern. Twin of `shaders/hash.wgsl`.

use crate::layout::constants::{FRACTION, HASH_MULTIPLIER, WEYL_X, WEYL_Y};

use super::Real;

/// The hash after one more word.
pub fn mix_hash(hash: u32, word: u32) -> u32 {
    let h = (hash ^ word).wrapping_mul(HASH_MULTIPLIER);
    h ^ (h >> 15)
}

/// Where sample `i` lies in its pixel, in [0, 1)²: the R2 sequence from the pixel's centre, exact in 24 bits.
pub fn sample_offset<R: Real>(i: u32) -> [R; 2] {
    [fraction(i.wrapping_mul(WEYL_X)), fraction(i.wrapping_mul(WEYL_Y))]
}

/// ½ + word · 2^-32 modulo 1, cut to 24 bits.
fn fraction<R: Real>(word: u32) -> R {
    R::from_i32((word.wrapping_add(0x8000_0000) >> 8) as i32) * R::of(FRACTION)
}
