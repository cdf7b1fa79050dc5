//! Triangles for the tests of this folder.

#![cfg(test)]

use crate::layout::Triangle;

pub(super) fn triangle(corners: [[f32; 3]; 3], id: usize) -> Triangle {
    let [v0, v1, v2] = corners;
    Triangle { v0, id: id as u32, v1, reserved1: 0, v2, reserved2: 0 }
}

/// Uniform in [0, 1): a linear congruential generator (Knuth's MMIX constants).
pub(super) fn random() -> impl FnMut() -> f32 {
    let mut state = 1_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1 << 24) as f32
    }
}

/// Small triangles all over a cube of the given size.
pub(super) fn soup(count: usize, size: f32) -> Vec<Triangle> {
    let mut random = random();
    let mut point = |scale: f32| [random() * scale, random() * scale, random() * scale];
    (0..count)
        .map(|id| {
            let (centre, a, b) = (point(size), point(size * 0.02), point(size * 0.02));
            let moved = |by: [f32; 3]| std::array::from_fn(|axis| centre[axis] + by[axis]);
            triangle([centre, moved(a), moved(b)], id)
        })
        .collect()
}
