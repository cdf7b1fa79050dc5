// Path hashes and the sample pattern. Twin of src/kernel/hash.rs.

import package::real::real;
import package::constants::{FRACTION, HASH_MULTIPLIER, WEYL_X, WEYL_Y};

// The hash after one more word.
fn mix_hash(hash: u32, word: u32) -> u32 {
    let h = (hash ^ word) * HASH_MULTIPLIER;
    return h ^ (h >> 15);
}

// Where sample `i` lies in its pixel, in [0, 1)².
fn sample_offset(i: u32) -> array<real, 2> {
    return array<real, 2>(fraction(i * WEYL_X), fraction(i * WEYL_Y));
}

// 1/2 + word · 2^-32 modulo 1, cut to 24 bits.
fn fraction(word: u32) -> real {
    return real(i32((word + 0x80000000u) >> 8)) * FRACTION;
}
