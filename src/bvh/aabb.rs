//! Axis-aligned boxes.

use rayon::prelude::*;

use crate::layout::Triangle;

/// An axis-aligned box; empty where `lo > hi`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Aabb {
    pub(super) lo: [f32; 3],
    pub(super) hi: [f32; 3],
}

impl Aabb {
    /// Holds nothing; the neutral element of [`Aabb::union`].
    pub(super) const EMPTY: Self = Self { lo: [f32::MAX; 3], hi: [f32::MIN; 3] };

    /// The exact box of a triangle.
    pub(super) fn of(triangle: &Triangle) -> Self {
        [triangle.v0, triangle.v1, triangle.v2].into_iter().fold(Self::EMPTY, Self::with)
    }

    /// The box of `self` and a point.
    pub(super) fn with(self, point: [f32; 3]) -> Self {
        self.union(&Self { lo: point, hi: point })
    }

    /// The box of both.
    pub(super) fn union(self, other: &Self) -> Self {
        Self {
            lo: std::array::from_fn(|axis| self.lo[axis].min(other.lo[axis])),
            hi: std::array::from_fn(|axis| self.hi[axis].max(other.hi[axis])),
        }
    }

    /// Half the surface area, in f64: it overflows f32 long before coordinates do. 0 where empty.
    pub(super) fn half_area(&self) -> f64 {
        let [x, y, z] = std::array::from_fn(|axis| f64::from(self.hi[axis]) - f64::from(self.lo[axis]));
        if x < 0.0 { 0.0 } else { x * y + y * z + z * x }
    }
}

/// The power of two that brings every coordinate into [−1, 1], where areas do not overflow f32.
pub(super) fn unit_scale(triangles: &[Triangle]) -> f32 {
    let Aabb { lo, hi } = triangles.par_iter().map(Aabb::of).reduce(|| Aabb::EMPTY, |a, b| a.union(&b));
    let largest = lo.into_iter().chain(hi).fold(f32::MIN_POSITIVE, |largest, x| largest.max(x.abs()));
    // The exponent is in −126..=127, so that the scale's is in −127..=126: within f32, subnormals included.
    let exponent = (largest.to_bits() >> 23) as i32 - 127;
    2.0_f32.powi(-exponent - 1)
}
