//! The instruction sets of x86-64, and all that is `unsafe` about them.
//!
//! [`Avx2`] and [`Avx512`] can be had from their `detect` alone, which asks the processor: whoever has one may use its
//! intrinsics. That is the reason for every `unsafe` block of the implementations below; loads and stores are of whole
//! arrays, which their types guarantee.

use std::arch::x86_64::*;

use super::layout::WIDTH;
use super::simd::{Simd, Task};
use super::stack::keys_of_lanes;

/// AVX2: eight lanes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Avx2(());

impl Avx2 {
    /// If the processor has it.
    pub(super) fn detect() -> Option<Self> {
        let has = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt");
        has.then_some(Self(()))
    }

    /// Run a task compiled for it.
    #[inline(always)]
    pub(super) fn run<T: Task>(self, task: T) -> T::Output {
        #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
        fn enabled<T: Task>(s: Avx2, task: T) -> T::Output {
            task.run::<WIDTH, _, _>(s, s)
        }
        unsafe { enabled(self, task) }
    }
}

/// AVX-512 F, VL, DQ and BW: eight or sixteen lanes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Avx512(());

impl Avx512 {
    /// If the processor has it.
    pub(super) fn detect() -> Option<Self> {
        let has = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512bw");
        Avx2::detect().filter(|_| has).map(|_| Self(()))
    }

    /// Run a task compiled for it.
    #[inline(always)]
    pub(super) fn run<T: Task>(self, task: T) -> T::Output {
        #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,bmi1,bmi2,lzcnt,popcnt")]
        fn enabled<T: Task>(s: Avx512, task: T) -> T::Output {
            task.run::<16, _, _>(s, s)
        }
        unsafe { enabled(self, task) }
    }
}

/// Begin to fetch all cache lines of a value.
#[inline(always)]
pub(super) fn prefetch<T>(value: &T) {
    const LINE: usize = 64;
    let at: *const i8 = std::ptr::from_ref(value).cast();
    for line in 0..size_of::<T>().div_ceil(LINE) {
        // SSE, which every x86-64 has; an address is only a hint.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(line * LINE)) };
    }
}

/// Functions of the same name for each instruction set, from one list of intrinsics.
macro_rules! arithmetic {
    ($n:literal: $splat:ident $load:ident $store:ident $add:ident $sub:ident $mul:ident $div:ident $least:ident $greatest:ident) => {
        #[inline(always)]
        fn splat(self, x: f32) -> Self::F {
            unsafe { $splat(x) }
        }
        #[inline(always)]
        fn load(self, from: &[f32; $n]) -> Self::F {
            unsafe { $load(from.as_ptr()) }
        }
        #[inline(always)]
        fn store(self, v: Self::F, to: &mut [f32; $n]) {
            unsafe { $store(to.as_mut_ptr(), v) }
        }
        #[inline(always)]
        fn add(self, a: Self::F, b: Self::F) -> Self::F {
            unsafe { $add(a, b) }
        }
        #[inline(always)]
        fn sub(self, a: Self::F, b: Self::F) -> Self::F {
            unsafe { $sub(a, b) }
        }
        #[inline(always)]
        fn mul(self, a: Self::F, b: Self::F) -> Self::F {
            unsafe { $mul(a, b) }
        }
        #[inline(always)]
        fn div(self, a: Self::F, b: Self::F) -> Self::F {
            unsafe { $div(a, b) }
        }
        #[inline(always)]
        fn least(self, a: Self::F, b: Self::F) -> Self::F {
            unsafe { $least(a, b) }
        }
        #[inline(always)]
        fn greatest(self, a: Self::F, b: Self::F) -> Self::F {
            unsafe { $greatest(a, b) }
        }
    };
}

/// The least and the greatest of some lanes, by halves: eight, or twice as many.
macro_rules! extremes {
    ($n:literal: $halve:ident) => {
        #[inline(always)]
        fn least_of(self, v: Self::F, bits: u32) -> f32 {
            let among = Simd::<$n>::select(self, bits, v, Simd::<$n>::splat(self, f32::INFINITY));
            unsafe { $halve!(among, _mm256_min_ps, _mm_min_ps) }
        }
        #[inline(always)]
        fn greatest_of(self, v: Self::F, bits: u32) -> f32 {
            let among = Simd::<$n>::select(self, bits, v, Simd::<$n>::splat(self, f32::NEG_INFINITY));
            unsafe { $halve!(among, _mm256_max_ps, _mm_max_ps) }
        }
    };
}

/// One number of eight lanes, by an operation on two vectors.
macro_rules! of_eight {
    ($v:expr, $eight:ident, $four:ident) => {{
        let v = $v;
        let v = $four(_mm256_castps256_ps128(v), _mm256_extractf128_ps::<1>(v));
        let v = $four(v, _mm_movehl_ps(v, v));
        _mm_cvtss_f32($four(v, _mm_shuffle_ps::<1>(v, v)))
    }};
}

/// The same of sixteen.
macro_rules! of_sixteen {
    ($v:expr, $eight:ident, $four:ident) => {{
        let v = $v;
        of_eight!($eight(_mm512_castps512_ps256(v), _mm512_extractf32x8_ps::<1>(v)), $eight, $four)
    }};
}

/// Comparisons into mask registers.
macro_rules! masks {
    ($n:literal: $compare:ident $blend:ident $mask:ty) => {
        #[inline(always)]
        fn lt(self, a: Self::F, b: Self::F) -> Self::M {
            unsafe { $compare::<_CMP_LT_OQ>(a, b) }
        }
        #[inline(always)]
        fn le(self, a: Self::F, b: Self::F) -> Self::M {
            unsafe { $compare::<_CMP_LE_OQ>(a, b) }
        }
        #[inline(always)]
        fn ne(self, a: Self::F, b: Self::F) -> Self::M {
            unsafe { $compare::<_CMP_NEQ_UQ>(a, b) }
        }
        #[inline(always)]
        fn select(self, bits: u32, yes: Self::F, no: Self::F) -> Self::F {
            unsafe { $blend(bits as $mask, no, yes) }
        }
        #[inline(always)]
        fn and(self, a: Self::M, b: Self::M) -> Self::M {
            a & b
        }
        #[inline(always)]
        fn bits(self, m: Self::M) -> u32 {
            u32::from(m)
        }
    };
}

impl Simd<8> for Avx2 {
    type F = __m256;
    type M = __m256;

    arithmetic!(8: _mm256_set1_ps _mm256_loadu_ps _mm256_storeu_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps
        _mm256_div_ps _mm256_min_ps _mm256_max_ps);
    extremes!(8: of_eight);

    #[inline(always)]
    fn lt(self, a: __m256, b: __m256) -> __m256 {
        unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(a, b) }
    }
    #[inline(always)]
    fn le(self, a: __m256, b: __m256) -> __m256 {
        unsafe { _mm256_cmp_ps::<_CMP_LE_OQ>(a, b) }
    }
    #[inline(always)]
    fn ne(self, a: __m256, b: __m256) -> __m256 {
        unsafe { _mm256_cmp_ps::<_CMP_NEQ_UQ>(a, b) }
    }
    #[inline(always)]
    fn select(self, bits: u32, yes: __m256, no: __m256) -> __m256 {
        unsafe {
            let lanes = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let set = _mm256_and_si256(_mm256_set1_epi32(bits as i32), lanes);
            _mm256_blendv_ps(no, yes, _mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lanes)))
        }
    }
    #[inline(always)]
    fn and(self, a: __m256, b: __m256) -> __m256 {
        unsafe { _mm256_and_ps(a, b) }
    }
    #[inline(always)]
    fn bits(self, m: __m256) -> u32 {
        unsafe { _mm256_movemask_ps(m) as u32 }
    }
    #[inline(always)]
    fn equal(self, to: &[u32; 8], x: u32) -> u32 {
        unsafe {
            let to = _mm256_loadu_si256(to.as_ptr().cast());
            let same = _mm256_cmpeq_epi32(to, _mm256_set1_epi32(x as i32));
            _mm256_movemask_ps(_mm256_castsi256_ps(same)) as u32
        }
    }
    #[inline(always)]
    fn keys(self, distance: __m256, children: &[u32; 8], bits: u32, to: &mut [u64; 8]) {
        let mut lanes = [0.0; 8];
        self.store(distance, &mut lanes);
        keys_of_lanes(&lanes, children, bits, to);
    }
}

impl Simd<8> for Avx512 {
    type F = __m256;
    type M = __mmask8;

    arithmetic!(8: _mm256_set1_ps _mm256_loadu_ps _mm256_storeu_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps
        _mm256_div_ps _mm256_min_ps _mm256_max_ps);
    extremes!(8: of_eight);
    masks!(8: _mm256_cmp_ps_mask _mm256_mask_blend_ps __mmask8);

    #[inline(always)]
    fn equal(self, to: &[u32; 8], x: u32) -> u32 {
        unsafe {
            let to = _mm256_loadu_si256(to.as_ptr().cast());
            u32::from(_mm256_cmpeq_epi32_mask(to, _mm256_set1_epi32(x as i32)))
        }
    }
    #[inline(always)]
    fn keys(self, distance: __m256, children: &[u32; 8], bits: u32, to: &mut [u64; 8]) {
        unsafe {
            let low = _mm512_cvtepu32_epi64(_mm256_loadu_si256(children.as_ptr().cast()));
            let high = _mm512_slli_epi64::<32>(_mm512_cvtepu32_epi64(_mm256_castps_si256(distance)));
            let keys = _mm512_maskz_compress_epi64(bits as __mmask8, _mm512_or_si512(low, high));
            _mm512_storeu_si512(to.as_mut_ptr().cast(), keys);
        }
    }
}

impl Simd<16> for Avx512 {
    type F = __m512;
    type M = __mmask16;

    arithmetic!(16: _mm512_set1_ps _mm512_loadu_ps _mm512_storeu_ps _mm512_add_ps _mm512_sub_ps _mm512_mul_ps
        _mm512_div_ps _mm512_min_ps _mm512_max_ps);
    extremes!(16: of_sixteen);
    masks!(16: _mm512_cmp_ps_mask _mm512_mask_blend_ps __mmask16);

    #[inline(always)]
    fn equal(self, to: &[u32; 16], x: u32) -> u32 {
        unsafe {
            let to = _mm512_loadu_si512(to.as_ptr().cast());
            u32::from(_mm512_cmpeq_epi32_mask(to, _mm512_set1_epi32(x as i32)))
        }
    }
    #[inline(always)]
    fn keys(self, distance: __m512, children: &[u32; 16], bits: u32, to: &mut [u64; 16]) {
        let mut lanes = [0.0; 16];
        self.store(distance, &mut lanes);
        keys_of_lanes(&lanes, children, bits, to);
    }
}
