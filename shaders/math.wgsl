// Vector products and elementary functions, out of operations that every device rounds alike. Twin of src/kernel/math.rs.

import package::real::{real, vec3r, greatest};
import package::constants::{
    EXP_LIMIT, LN2, LN2_DOUBLE, LN2_HI, LN2_LO, LOG2_3_2_HI, LOG2_3_2_LO, LOG2_5_4_HI, LOG2_5_4_LO, LOG2_7_4_HI, LOG2_7_4_LO,
    LOG2_E, PI_4_HI, PI_4_LO, TAN_PI_8, TWO_OVER_LN2_HI, TWO_OVER_LN2_LO,
};

// Inner product, summed from x to z.
fn dot3(a: vec3r, b: vec3r) -> real {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Vector product.
fn cross3(a: vec3r, b: vec3r) -> vec3r {
    return vec3r(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Euclidean length.
fn length3(v: vec3r) -> real {
    return sqrt(dot3(v, v));
}

// v / |v|: a division a component, not a product with a reciprocal.
fn unit3(v: vec3r) -> vec3r {
    let l = length3(v);
    return vec3r(v.x / l, v.y / l, v.z / l);
}

// Largest component.
fn max3(v: vec3r) -> real {
    return greatest(greatest(v.x, v.y), v.z);
}

// exp(-x) for x >= 0; 0 where the result would be subnormal in f32. In f64 by its series.
fn exp_neg(x: real) -> real {
    @if(!f64) return exp_neg_f32(x);
    @if(f64) return exp_neg_f64(x);
}

// x^y for x in [0, 1] and y >= 0. In f64 variants through f32.
fn power(x: real, y: real) -> real {
    return real(power_f32(f32(x), f32(y)));
}

// The angle of the point (x, y) in [-pi, pi]; 0 at the origin. In f64 variants through f32.
fn arctangent(y: real, x: real) -> real {
    return real(arctangent_f32(f32(y), f32(x)));
}

fn exp_neg_f32(x: f32) -> f32 {
    if x >= EXP_LIMIT {
        return 0.0;
    }
    // Cody–Waite: x = n ln 2 + r, |r| <= ln 2 / 2, with an exact product by the upper bits.
    let n = floor(x * LOG2_E + 0.5);
    let r = (x - n * LN2_HI) - n * LN2_LO;
    return scale2(exp_poly(-r), -i32(n));
}

// The same in f64, by Taylor's series to the 13th power: remainder below 1e-16.
@if(f64)
fn exp_neg_f64(x: f64) -> f64 {
    if x >= f64(EXP_LIMIT) {
        return 0.0;
    }
    let n = floor(x * f64(LOG2_E) + 0.5);
    let r = n * LN2_DOUBLE - x;
    var p = f64(1.0);
    for (var i = 13; i > 0; i--) {
        p = 1.0 + p * r / f64(i);
    }
    return p * f64(scale2(1.0, -i32(n)));
}

fn power_f32(x: f32, y: f32) -> f32 {
    if y == 0.0 {
        return 1.0;
    }
    if x <= 0.0 {
        return 0.0;
    }
    // log2 x = a + b, b below the last bit of a.
    let parts = log2_parts(x);
    let coarse = parts.x;
    let high = parts.y;
    let low = parts.z;
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
    let n = floor(w + 0.5);
    let r = (p - n) + q;
    return scale2(exp_poly(r * LN2), i32(n));
}

fn arctangent_f32(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let lo = select(ax, ay, ay < ax);
    let hi = select(ay, ax, ay < ax);
    if hi == 0.0 {
        return 0.0;
    }
    // Fold to the first octant, then by pi/4 below tan(pi/8).
    let folded = lo > hi * TAN_PI_8;
    var q: f32;
    if folded {
        q = (lo - hi) / (lo + hi);
    } else {
        q = lo / hi;
    }
    var base = f32(0.0);
    var angle = atan_poly(q);
    if folded {
        base = PI_4_HI;
        angle = angle + PI_4_LO;
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
    return select(half, -half, y < 0.0);
}

// exp(r) for |r| <= 0.35: Taylor's series to the seventh power.
fn exp_poly(r: f32) -> f32 {
    var p = f32(1.0 / 5040.0);
    p = p * r + f32(1.0 / 720.0);
    p = p * r + f32(1.0 / 120.0);
    p = p * r + f32(1.0 / 24.0);
    p = p * r + f32(1.0 / 6.0);
    p = p * r + 0.5;
    p = p * r + 1.0;
    return p * r + 1.0;
}

// log2 of a positive normal x as a coarse, an upper and a lower part.
fn log2_parts(x: f32) -> vec3f {
    let bits = bitcast<u32>(x);
    let exponent = i32(bits >> 23) - 127;
    let m = bitcast<f32>((bits & 0x007fffffu) | 0x3f800000u);
    // The nearest c, and its logarithm.
    var c = f32(1.0);
    var coarse = f32(0.0);
    var fine = f32(0.0);
    if m > 1.118 {
        c = 1.25;
        coarse = LOG2_5_4_HI;
        fine = LOG2_5_4_LO;
    }
    if m > 1.369 {
        c = 1.5;
        coarse = LOG2_3_2_HI;
        fine = LOG2_3_2_LO;
    }
    if m > 1.62 {
        c = 1.75;
        coarse = LOG2_7_4_HI;
        fine = LOG2_7_4_LO;
    }
    if m > 1.871 {
        c = 2.0;
        coarse = 1.0;
        fine = 0.0;
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
    var p = f32(1.0 / 9.0);
    p = p * z + f32(1.0 / 7.0);
    p = p * z + f32(1.0 / 5.0);
    p = p * z + f32(1.0 / 3.0);
    let tail = s * z * p + s_lo;
    let high = s_hi * TWO_OVER_LN2_HI;
    let low = s_hi * TWO_OVER_LN2_LO + tail * (TWO_OVER_LN2_HI + TWO_OVER_LN2_LO);
    return vec3f(f32(exponent) + coarse, high, low + fine);
}

// atan(q) for |q| <= tan(pi/8): Taylor's series.
fn atan_poly(q: f32) -> f32 {
    let z = q * q;
    var p = f32(-1.0 / 19.0);
    p = p * z + f32(1.0 / 17.0);
    p = p * z - f32(1.0 / 15.0);
    p = p * z + f32(1.0 / 13.0);
    p = p * z - f32(1.0 / 11.0);
    p = p * z + f32(1.0 / 9.0);
    p = p * z - f32(1.0 / 7.0);
    p = p * z + f32(1.0 / 5.0);
    p = p * z - f32(1.0 / 3.0);
    return q + q * z * p;
}

// x with its lower 12 bits cleared.
fn upper(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

// x · 2^n for n in [-126, 127].
fn scale2(x: f32, n: i32) -> f32 {
    return x * bitcast<f32>(u32(n + 127) << 23);
}
