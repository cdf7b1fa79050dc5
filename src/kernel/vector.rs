//! Three reals: WGSL's vec3, with the same componentwise operations.

use std::ops::{Add, Mul, Neg, Sub};

use super::Real;

/// A point, direction or colour.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vec3<R> {
    /// First component; red.
    pub x: R,
    /// Second component; green.
    pub y: R,
    /// Third component; blue.
    pub z: R,
}

impl<R: Real> Vec3<R> {
    /// From components.
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// The same value three times.
    pub const fn splat(value: R) -> Self {
        Self { x: value, y: value, z: value }
    }

    /// A vector of the scene; exact.
    pub fn load(v: [f32; 3]) -> Self {
        Self { x: R::real(v[0]), y: R::real(v[1]), z: R::real(v[2]) }
    }

    /// All zero.
    pub fn zero() -> Self {
        Self::splat(R::ZERO)
    }

    /// All one.
    pub fn one() -> Self {
        Self::splat(R::ONE)
    }

    /// Each component's absolute value.
    pub fn abs(self) -> Self {
        self.map(R::abs)
    }

    /// A function of each component.
    pub fn map(self, f: impl Fn(R) -> R) -> Self {
        Self { x: f(self.x), y: f(self.y), z: f(self.z) }
    }
}

macro_rules! componentwise {
    ($trait:ident, $method:ident, $op:tt) => {
        impl<R: Real> $trait for Vec3<R> {
            type Output = Self;
            fn $method(self, o: Self) -> Self {
                Self { x: self.x $op o.x, y: self.y $op o.y, z: self.z $op o.z }
            }
        }
    };
}

componentwise!(Add, add, +);
componentwise!(Sub, sub, -);
componentwise!(Mul, mul, *);

impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    fn mul(self, s: R) -> Self {
        Self { x: self.x * s, y: self.y * s, z: self.z * s }
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}
