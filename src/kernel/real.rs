//! The number that the kernel computes in: `alias real` of the shaders.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::layout::constants::{ROUNDOFF_F32, ROUNDOFF_F64};

use super::math::Transcendental;

/// f32 or f64, with the operations that IEEE 754 rounds correctly and the few functions of [`Transcendental`].
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Transcendental
    + Send
    + Sync
    + 'static
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// Unit roundoff.
    const ROUNDOFF: f64;

    /// A value of the scene; exact.
    fn real(x: f32) -> Self;
    /// A constant, rounded to nearest as WGSL rounds its abstract floats.
    fn of(x: f64) -> Self;
    /// Rounded to nearest.
    fn to_f32(self) -> f32;
    /// A whole number to i32; saturates, never panics.
    fn to_i32(self) -> i32;
    /// A whole number below 2^24; exact.
    fn from_i32(x: i32) -> Self;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Greatest whole number not above.
    fn floor(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;

    /// `if self < other { self } else { other }`: a select, so that both devices treat ties and NaN alike.
    fn least(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    /// `if self > other { self } else { other }`.
    fn greatest(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
}

macro_rules! impl_real {
    ($real:ty, $roundoff:expr) => {
        #[allow(clippy::cast_lossless, clippy::unnecessary_cast)]
        impl Real for $real {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const ROUNDOFF: f64 = $roundoff;

            fn real(x: f32) -> Self {
                x as Self
            }
            fn of(x: f64) -> Self {
                x as Self
            }
            fn to_f32(self) -> f32 {
                self as f32
            }
            fn to_i32(self) -> i32 {
                self as i32
            }
            fn from_i32(x: i32) -> Self {
                x as Self
            }
            fn sqrt(self) -> Self {
                <$real>::sqrt(self)
            }
            fn floor(self) -> Self {
                <$real>::floor(self)
            }
            fn abs(self) -> Self {
                <$real>::abs(self)
            }
        }
    };
}

impl_real!(f32, ROUNDOFF_F32);
impl_real!(f64, ROUNDOFF_F64);
