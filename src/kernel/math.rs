//! Vector products and elementary functions, out of operations that every device rounds alike. Twin of
//! `shaders/math.wgsl`.
//!
//! WGSL leaves the rounding of `dot`, `normalize`, `exp` and `pow` to the driver; these are written out instead.
//! Each elementary function is within 2 ULP of the true value in f32; the tests hold that against f64.

use crate::layout::constants::{
    EXP_LIMIT, LN2, LN2_HI, LN2_LO, LOG2_3_2_HI, LOG2_3_2_LO, LOG2_5_4_HI, LOG2_5_4_LO, LOG2_7_4_HI,
    LOG2_7_4_LO, LOG2_E, PI_4_HI, PI_4_LO, TAN_PI_8, TWO_OVER_LN2_HI, TWO_OVER_LN2_LO,
};

use super::{Real, Vec3};

/// Inner product, summed from x to z.
pub fn dot3<R: Real>(a: Vec3<R>, b: Vec3<R>) -> R {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// Vector product.
pub fn cross3<R: Real>(a: Vec3<R>, b: Vec3<R>) -> Vec3<R> {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

/// Euclidean length.
pub fn length3<R: Real>(v: Vec3<R>) -> R {
    dot3(v, v).sqrt()
}

/// v / |v|: a division a component, not a product with a reciprocal.
pub fn unit3<R: Real>(v: Vec3<R>) -> Vec3<R> {
    let l = length3(v);
    Vec3::new(v.x / l, v.y / l, v.z / l)
}

/// Largest component.
pub fn max3<R: Real>(v: Vec3<R>) -> R {
    v.x.greatest(v.y).greatest(v.z)
}

/// The functions that need more than correctly rounded operations. f64 takes the standard library's.
pub trait Transcendental {
    /// exp(−x) for x ≥ 0; 0 where the result would be subnormal in f32.
    fn exp_neg(x: Self) -> Self;
    /// x^y for x in [0, 1] and y ≥ 0; 0^0 = 1; 0 where the result would be subnormal in f32.
    fn power(x: Self, y: Self) -> Self;
    /// The angle of the point (x, y) in [−π, π]; 0 at the origin.
    fn arctangent(y: Self, x: Self) -> Self;
}

impl Transcendental for f32 {
    fn exp_neg(x: f32) -> f32 {
        exp_neg_f32(x)
    }

    fn power(x: f32, y: f32) -> f32 {
        power_f32(x, y)
    }

    fn arctangent(y: f32, x: f32) -> f32 {
        arctangent_f32(y, x)
    }
}

impl Transcendental for f64 {
    fn exp_neg(x: f64) -> f64 {
        if x >= f64::from(EXP_LIMIT) { 0.0 } else { (-x).exp() }
    }

    fn power(x: f64, y: f64) -> f64 {
        let p = x.powf(y);
        if p < f64::from(f32::MIN_POSITIVE) { 0.0 } else { p }
    }

    fn arctangent(y: f64, x: f64) -> f64 {
        y.atan2(x)
    }
}

/// See [`Transcendental::exp_neg`].
pub fn exp_neg_f32(x: f32) -> f32 {
    if x >= EXP_LIMIT {
        return 0.0;
    }
    // Cody–Waite: x = n ln 2 + r, |r| ≤ ln 2 / 2, with an exact product by the upper bits.
    let n = (x * LOG2_E + 0.5).floor();
    let r = (x - n * LN2_HI) - n * LN2_LO;
    scale2(exp_poly(-r), -(n as i32))
}

/// See [`Transcendental::power`].
pub fn power_f32(x: f32, y: f32) -> f32 {
    if y == 0.0 {
        return 1.0;
    }
    if x <= 0.0 {
        return 0.0;
    }
    // log2 x = a + b, b below the last bit of a.
    let [coarse, high, low] = log2_parts(x);
    let a = coarse + high;
    let b = (high - (a - coarse)) + low;
    // y · log2 x: the product of the upper halves is exact.
    let log_hi = upper(a + b);
    let log_lo = b - (log_hi - a);
    let y_hi = upper(y);
    let y_lo = y - y_hi;
    let p = y_hi * log_hi;
    let q = y_lo * log_hi + y * log_lo;
    let w = p + q;
    if w <= -126.0 {
        return 0.0;
    }
    let n = (w + 0.5).floor();
    let r = (p - n) + q;
    scale2(exp_poly(r * LN2), n as i32)
}

/// See [`Transcendental::arctangent`].
pub fn arctangent_f32(y: f32, x: f32) -> f32 {
    let (ax, ay) = (x.abs(), y.abs());
    let lo = if ay < ax { ay } else { ax };
    let hi = if ay < ax { ax } else { ay };
    if hi == 0.0 {
        return 0.0;
    }
    // Fold to the first octant, then by π/4 below tan(π/8).
    let folded = lo > hi * TAN_PI_8;
    let q = if folded { (lo - hi) / (lo + hi) } else { lo / hi };
    let mut base = 0.0;
    let mut angle = atan_poly(q);
    if folded {
        base = PI_4_HI;
        angle += PI_4_LO;
    }
    // Unfold, the small part apart to the end.
    if ay > ax {
        base = 2.0 * PI_4_HI - base;
        angle = 2.0 * PI_4_LO - angle;
    }
    if x < 0.0 {
        base = 4.0 * PI_4_HI - base;
        angle = 4.0 * PI_4_LO - angle;
    }
    let half = base + angle;
    if y < 0.0 { -half } else { half }
}

/// exp(r) for |r| ≤ 0.35: Taylor's series to the seventh power, remainder below 6e-9.
fn exp_poly(r: f32) -> f32 {
    let mut p = 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = p * r + 1.0;
    p * r + 1.0
}

/// log2 of a positive normal x as a coarse part of few bits, an upper part and a lower part; relative error about 2^-32.
///
/// log2(m/c) = 2/ln 2 · (s + s³/3 + s⁵/5 + …) with s = (m − c)/(m + c) for the nearest c of 1, 5/4, 3/2, 7/4, 2, so that
/// |s| ≤ 0.056. s and 2/ln 2 are split in halves of 12 bits by masking: a device that reassociates keeps the leading
/// products exact too.
fn log2_parts(x: f32) -> [f32; 3] {
    let exponent = (x.to_bits() >> 23) as i32 - 127;
    let m = f32::from_bits((x.to_bits() & 0x007f_ffff) | 0x3f80_0000);
    // The nearest c, and its logarithm.
    let (mut c, mut coarse, mut fine) = (1.0, 0.0, 0.0);
    if m > 1.118 {
        (c, coarse, fine) = (1.25, LOG2_5_4_HI, LOG2_5_4_LO);
    }
    if m > 1.369 {
        (c, coarse, fine) = (1.5, LOG2_3_2_HI, LOG2_3_2_LO);
    }
    if m > 1.62 {
        (c, coarse, fine) = (1.75, LOG2_7_4_HI, LOG2_7_4_LO);
    }
    if m > 1.871 {
        (c, coarse, fine) = (2.0, 1.0, 0.0);
    }
    // s = f / g, with the remainder of the division.
    let f = m - c;
    let g = m + c;
    let g_hi = upper(g);
    let g_lo = m - (g_hi - c);
    let s = f / g;
    let s_hi = upper(s);
    let s_lo = ((f - s_hi * g_hi) - s_hi * g_lo) / g;
    // The rest of the series: about 0.1 % of s.
    let z = s * s;
    let mut p = 1.0 / 9.0;
    p = p * z + 1.0 / 7.0;
    p = p * z + 1.0 / 5.0;
    p = p * z + 1.0 / 3.0;
    let tail = s * z * p + s_lo;
    let high = s_hi * TWO_OVER_LN2_HI;
    let low = s_hi * TWO_OVER_LN2_LO + tail * (TWO_OVER_LN2_HI + TWO_OVER_LN2_LO);
    [exponent as f32 + coarse, high, low + fine]
}

/// atan(q) for |q| ≤ tan(π/8): Taylor's series, remainder below 2^-26 of q.
fn atan_poly(q: f32) -> f32 {
    let z = q * q;
    let mut p = -1.0 / 19.0;
    p = p * z + 1.0 / 17.0;
    p = p * z - 1.0 / 15.0;
    p = p * z + 1.0 / 13.0;
    p = p * z - 1.0 / 11.0;
    p = p * z + 1.0 / 9.0;
    p = p * z - 1.0 / 7.0;
    p = p * z + 1.0 / 5.0;
    p = p * z - 1.0 / 3.0;
    q + q * z * p
}

/// x with its lower 12 bits cleared.
fn upper(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0xffff_f000)
}

/// x · 2^n for n in [−126, 127].
fn scale2(x: f32, n: i32) -> f32 {
    x * f32::from_bits(((n + 127) as u32) << 23)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ulps(value: f32, truth: f64) -> f64 {
        let unit =
            f64::from(f32::from_bits((truth as f32).abs().to_bits() + 1)) - f64::from((truth as f32).abs());
        (f64::from(value) - truth).abs() / unit
    }

    /// Worst error in ULP over a deterministic sweep.
    fn worst(n: u32, f: impl Fn(f64) -> Option<f64>) -> f64 {
        (0..n).filter_map(|i| f((f64::from(i) + 0.5) / f64::from(n))).fold(0.0, f64::max)
    }

    #[test]
    fn exp_neg_is_within_two_ulps() {
        let error = worst(400_000, |t| {
            let x = (t * t * 86.9) as f32;
            Some(ulps(f32::exp_neg(x), (-f64::from(x)).exp()))
        });
        assert!(error < 1.5, "{error}");
        assert_eq!((f32::exp_neg(0.0), f32::exp_neg(1e30)), (1.0, 0.0));
    }

    #[test]
    fn power_is_within_two_ulps() {
        for beta in [0.25f32, 1.0, 2.0, 10.5, 77.0, 200.0, 1000.0, 12345.0] {
            let error = worst(100_000, |t| {
                let x = (1.0 - t.powi(3)) as f32;
                let truth = f64::from(x).powf(f64::from(beta));
                (truth > 1.2e-38 && truth < 1.0).then(|| ulps(f32::power(x, beta), truth))
            });
            assert!(error <= 2.0, "{beta}: {error}");
        }
        assert_eq!((f32::power(0.0, 2.0), f32::power(0.5, 0.0), f32::power(1.0, 1e6)), (0.0, 1.0, 1.0));
    }

    #[test]
    fn arctangent_is_within_two_ulps_in_every_octant() {
        let error = worst(400_000, |t| {
            let a = (t - 0.5) * std::f64::consts::TAU;
            let (y, x) = ((a.sin() * 3.0) as f32, (a.cos() * 3.0) as f32);
            Some(ulps(f32::arctangent(y, x), f64::from(y).atan2(f64::from(x))))
        });
        assert!(error <= 2.0, "{error}");
        assert_eq!(f32::arctangent(0.0, 0.0), 0.0);
    }
}
