//! Lanes of f32: one source for every instruction set.
//!
//! A type that implements [`Simd`] is a proof that the processor has its instructions: beyond the portable one they are
//! made by `detect` alone. So every operation is safe to call, and all that is `unsafe` about instruction sets stands in
//! [`x86`](super::x86). Operations round as scalar ones do; nothing is contracted.

use super::layout::WIDTH;
use super::stack::keys_of_lanes;

/// What is compiled for every instruction set: its eight lanes, and N where that has more.
pub(super) trait Task {
    type Output;

    /// Implementations are `#[inline(always)]`, so that they become part of a function with the instructions enabled.
    fn run<const N: usize, W: Simd<WIDTH>, S: Simd<N>>(self, w: W, s: S) -> Self::Output;
}

/// Operations on N lanes.
pub(super) trait Simd<const N: usize>: Copy {
    /// N numbers.
    type F: Copy;
    /// N answers.
    type M: Copy;

    fn splat(self, x: f32) -> Self::F;
    fn load(self, from: &[f32; N]) -> Self::F;
    fn store(self, v: Self::F, to: &mut [f32; N]);
    fn add(self, a: Self::F, b: Self::F) -> Self::F;
    fn sub(self, a: Self::F, b: Self::F) -> Self::F;
    fn mul(self, a: Self::F, b: Self::F) -> Self::F;
    fn div(self, a: Self::F, b: Self::F) -> Self::F;
    /// `if a < b { a } else { b }`.
    fn least(self, a: Self::F, b: Self::F) -> Self::F;
    /// `if a > b { a } else { b }`.
    fn greatest(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a < b`; false for a NaN.
    fn lt(self, a: Self::F, b: Self::F) -> Self::M;
    /// `a <= b`; false for a NaN.
    fn le(self, a: Self::F, b: Self::F) -> Self::M;
    /// `a != b`; true for a NaN.
    fn ne(self, a: Self::F, b: Self::F) -> Self::M;
    /// Lane i of `yes` where bit i is set, else of `no`.
    fn select(self, bits: u32, yes: Self::F, no: Self::F) -> Self::F;
    fn and(self, a: Self::M, b: Self::M) -> Self::M;
    /// Bit i is lane i's answer.
    fn bits(self, m: Self::M) -> u32;
    /// The least of the lanes whose bit is set, +∞ of none. None of them is a NaN.
    fn least_of(self, v: Self::F, bits: u32) -> f32;
    /// The greatest of the lanes whose bit is set, −∞ of none. None of them is a NaN.
    fn greatest_of(self, v: Self::F, bits: u32) -> f32;
    /// Which lanes equal `x`.
    fn equal(self, to: &[u32; N], x: u32) -> u32;
    /// Distance and child of the lanes whose bit is set, packed as [`key`](super::stack::key) does, to the front of `to`.
    fn keys(self, distance: Self::F, children: &[u32; N], bits: u32, to: &mut [u64; N]);
}

/// Arrays, which the compiler turns into what the target has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portable;

impl<const N: usize> Simd<N> for Portable {
    type F = [f32; N];
    type M = [bool; N];

    #[inline(always)]
    fn splat(self, x: f32) -> [f32; N] {
        [x; N]
    }
    #[inline(always)]
    fn load(self, from: &[f32; N]) -> [f32; N] {
        *from
    }
    #[inline(always)]
    fn store(self, v: [f32; N], to: &mut [f32; N]) {
        *to = v;
    }
    #[inline(always)]
    fn add(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] + b[i])
    }
    #[inline(always)]
    fn sub(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] - b[i])
    }
    #[inline(always)]
    fn mul(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] * b[i])
    }
    #[inline(always)]
    fn div(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] / b[i])
    }
    #[inline(always)]
    fn least(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn greatest(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn lt(self, a: [f32; N], b: [f32; N]) -> [bool; N] {
        std::array::from_fn(|i| a[i] < b[i])
    }
    #[inline(always)]
    fn le(self, a: [f32; N], b: [f32; N]) -> [bool; N] {
        std::array::from_fn(|i| a[i] <= b[i])
    }
    #[inline(always)]
    fn ne(self, a: [f32; N], b: [f32; N]) -> [bool; N] {
        std::array::from_fn(|i| a[i] != b[i])
    }
    #[inline(always)]
    fn select(self, bits: u32, yes: [f32; N], no: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| if bits >> i & 1 == 1 { yes[i] } else { no[i] })
    }
    #[inline(always)]
    fn and(self, a: [bool; N], b: [bool; N]) -> [bool; N] {
        std::array::from_fn(|i| a[i] & b[i])
    }
    #[inline(always)]
    fn bits(self, m: [bool; N]) -> u32 {
        (0..N).fold(0, |bits, i| bits | u32::from(m[i]) << i)
    }
    #[inline(always)]
    fn least_of(self, v: [f32; N], bits: u32) -> f32 {
        let among = |i: usize| if bits >> i & 1 == 1 { v[i] } else { f32::INFINITY };
        (0..N).fold(f32::INFINITY, |least, i| if among(i) < least { among(i) } else { least })
    }
    #[inline(always)]
    fn greatest_of(self, v: [f32; N], bits: u32) -> f32 {
        let among = |i: usize| if bits >> i & 1 == 1 { v[i] } else { f32::NEG_INFINITY };
        (0..N).fold(f32::NEG_INFINITY, |greatest, i| if among(i) > greatest { among(i) } else { greatest })
    }
    #[inline(always)]
    fn equal(self, to: &[u32; N], x: u32) -> u32 {
        (0..N).fold(0, |bits, i| bits | u32::from(to[i] == x) << i)
    }
    #[inline(always)]
    fn keys(self, distance: [f32; N], children: &[u32; N], bits: u32, to: &mut [u64; N]) {
        keys_of_lanes(&distance, children, bits, to);
    }
}
