//! From f64 to the f32 of the storage buffers.

use glam::DVec3;

/// Coordinates must lie within ±2^60: squared distances and the products of the triangle test then stay far
/// within f32, and every distance is below [`FAR`](crate::layout::constants::FAR).
pub(super) const MAX_COORDINATE: f64 = (1_u64 << 60) as f64;

/// Round to f32; subnormal results and −0 become 0 (devices disagree about them), what is beyond f32 its
/// greatest number.
pub(super) fn narrow(x: f64) -> f32 {
    let rounded = (x as f32).clamp(f32::MIN, f32::MAX);
    if rounded.abs() < f32::MIN_POSITIVE { 0.0 } else { rounded }
}

/// [`narrow`] by component.
pub(super) fn narrow3(v: DVec3) -> [f32; 3] {
    v.to_array().map(narrow)
}

/// Exactly.
pub(super) fn widen3(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// The least f32 that is not below `x ≥ 0`; the greatest one where `x` is beyond f32.
pub(super) fn narrow_up(x: f64) -> f32 {
    let rounded = narrow(x);
    if f64::from(rounded) < x && rounded < f32::MAX {
        rounded.next_up().max(f32::MIN_POSITIVE)
    } else {
        rounded
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subnormals_and_negative_zero_become_zero() {
        for x in [1e-39, -1e-39, -0.0, 1e-320] {
            assert_eq!(narrow(x).to_bits(), 0, "{x}");
        }
        assert_eq!(narrow(f64::from(f32::MIN_POSITIVE)), f32::MIN_POSITIVE);
    }

    #[test]
    fn numbers_beyond_f32_are_capped() {
        assert_eq!(narrow(1e39), f32::MAX);
        assert_eq!(narrow(-1e39), f32::MIN);
        assert_eq!(narrow_up(1e39), f32::MAX);
    }

    #[test]
    fn rounding_up_never_goes_below() {
        for x in [0.0, 1e-45, 0.1, 1.0 / 3.0, 1.0, 16_777_217.0] {
            let up = narrow_up(x);
            assert!(f64::from(up) >= x, "{x}");
            assert!(x == 0.0 || f64::from(up.next_down()) < x || up == f32::MIN_POSITIVE, "{x}");
        }
    }
}
