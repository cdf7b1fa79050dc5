//! From radiance to what a display shows: exposure, then a stated tone curve.

use std::fmt;

/// Rec. 709 luminance of linear RGB (ITU-R BT.709-6, section 3.2).
#[must_use]
pub fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// How radiance above what a display can show is brought into its range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tone {
    /// Clamp each channel to [0, 1].
    #[default]
    None,
    /// Reinhard, Stark, Shirley, Ferwerda 2002, equation 4, on luminance: the brightest pixel of the
    /// picture becomes white, hues are kept.
    Reinhard,
    /// Narkowicz 2015, "ACES Filmic Tone Mapping Curve": a rational fit, per channel.
    Aces,
}

impl Tone {
    /// All curves.
    pub const ALL: [Self; 3] = [Self::None, Self::Reinhard, Self::Aces];

    /// The name on the command line and in metadata.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Reinhard => "reinhard",
            Self::Aces => "aces",
        }
    }
}

impl fmt::Display for Tone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Exposure and tone curve.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Development {
    /// The curve.
    pub tone: Tone,
    /// Stops: radiance is multiplied by 2^exposure before the curve.
    pub exposure: f32,
}

impl Development {
    /// What a pixel that is NaN or infinite looks like: magenta, so that it cannot be overlooked.
    pub const NON_FINITE: [f32; 3] = [1.0, 0.0, 1.0];

    /// Linear display values in [0, 1] of a picture's linear radiance.
    #[must_use]
    pub fn apply(&self, radiance: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let gain = self.exposure.exp2();
        let white = match self.tone {
            Tone::Reinhard => brightest(radiance) * gain,
            Tone::None | Tone::Aces => 1.0,
        };
        radiance.iter().map(|&pixel| self.apply_to_pixel(pixel, gain, white)).collect()
    }

    fn apply_to_pixel(&self, radiance: [f32; 3], gain: f32, white: f32) -> [f32; 3] {
        let exposed = radiance.map(|v| v * gain);
        if !exposed.iter().all(|v| v.is_finite()) {
            return Self::NON_FINITE;
        }
        let toned = match self.tone {
            Tone::None => exposed,
            Tone::Reinhard => reinhard(exposed, white),
            Tone::Aces => exposed.map(aces),
        };
        toned.map(|v| v.clamp(0.0, 1.0))
    }
}

/// The greatest luminance of a finite pixel, 0 for none.
fn brightest(radiance: &[[f32; 3]]) -> f32 {
    radiance.iter().map(|&pixel| luminance(pixel)).filter(|l| l.is_finite()).fold(0.0, f32::max)
}

/// `L·(1 + L/white²)/(1 + L)` in place of the luminance L; `white` becomes 1.
fn reinhard(rgb: [f32; 3], white: f32) -> [f32; 3] {
    // Below 1 there is nothing to compress: with a dimmer white the curve would brighten the picture.
    let white = white.max(1.0);
    let scale = (1.0 + luminance(rgb) / white / white) / (1.0 + luminance(rgb));
    rgb.map(|v| v * scale)
}

/// Narkowicz's fit; 1 is approached from below and crossed near 16, hence the clamp by the caller.
fn aces(x: f32) -> f32 {
    // Beyond this both polynomials could overflow, and the quotient has long reached its end.
    let x = x.clamp(0.0, 1e6);
    (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn develop(tone: Tone, exposure: f32, pixels: &[[f32; 3]]) -> Vec<[f32; 3]> {
        Development { tone, exposure }.apply(pixels)
    }

    #[test]
    fn no_tone_curve_only_clamps() {
        assert_eq!(develop(Tone::None, 0.0, &[[0.25, 1.5, -0.5]]), [[0.25, 1.0, 0.0]]);
    }

    #[test]
    fn one_stop_doubles() {
        assert_eq!(develop(Tone::None, 1.0, &[[0.25, 0.125, 0.0]]), [[0.5, 0.25, 0.0]]);
    }

    #[test]
    fn reinhard_maps_the_brightest_pixel_to_white() {
        let pixels = develop(Tone::Reinhard, 0.0, &[[8.0; 3], [1.0; 3]]);
        assert!((pixels[0][0] - 1.0).abs() < 1e-5);
        // Equation 4 at L = 1, white = 8: (1 + 1/64)/2.
        assert!((pixels[1][0] - 0.507_812_5).abs() < 1e-6);
    }

    #[test]
    fn aces_meets_the_published_fit() {
        // (1·2.54)/(3.02 + 0.14)
        assert!((develop(Tone::Aces, 0.0, &[[1.0; 3]])[0][0] - 0.803_797_5).abs() < 1e-6);
        assert_eq!(develop(Tone::Aces, 0.0, &[[f32::MAX; 3]])[0][0], 1.0);
    }

    #[test]
    fn non_finite_pixels_are_magenta_under_every_curve() {
        for tone in Tone::ALL {
            let pixels = [[f32::NAN, 0.0, 0.0], [0.0, f32::INFINITY, 0.0], [0.5; 3]];
            let shown = develop(tone, 0.0, &pixels);
            assert_eq!(shown[..2], [Development::NON_FINITE; 2]);
            assert_ne!(shown[2], Development::NON_FINITE);
        }
    }
}
