//! The sRGB transfer function (IEC 61966-2-1:1999, section 5.2), both ways.

/// Encode a linear value in [0, 1] for display; values outside are clamped, NaN becomes 0.
#[must_use]
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = if linear > 0.0 { linear.min(1.0) } else { 0.0 };
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Decode a display value in [0, 1] to linear light.
#[must_use]
pub fn linear_from_srgb(display: f64) -> f64 {
    if display <= 0.040_45 { display / 12.92 } else { ((display + 0.055) / 1.055).powf(2.4) }
}

/// Encode a linear value in [0, 1] as a code value in `0..=max`, to the nearest.
#[must_use]
pub fn srgb_code(linear: f32, max: u16) -> u16 {
    (srgb_from_linear(linear) * f32::from(max)).round() as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_8_bit_code_survives_decoding_and_encoding() {
        for code in 0..=255_u16 {
            let linear = linear_from_srgb(f64::from(code) / 255.0) as f32;
            assert_eq!(srgb_code(linear, 255), code);
        }
    }

    #[test]
    fn the_standard_middle_grey_is_met() {
        // 18 % grey is code 118 in every sRGB table.
        assert_eq!(srgb_code(0.18, 255), 118);
        assert!((linear_from_srgb(0.5) - 0.214_041).abs() < 1e-6);
    }

    #[test]
    fn values_outside_the_unit_interval_are_clamped() {
        assert_eq!(srgb_code(7.0, 65535), 65535);
        assert_eq!(srgb_code(-1.0, 65535), 0);
        assert_eq!(srgb_code(f32::NAN, 255), 0);
    }
}
