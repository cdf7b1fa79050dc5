//! How far two pictures are apart.

use std::fmt;

use serde::Serialize;

use super::{Channel, Picture, flip};

/// How far two pictures are apart.
///
/// `rmse`, `max`, `psnr` are over linear R, G, B, or over all planes of a picture that has no colours.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Difference {
    /// Root mean square over pixels and channels.
    pub rmse: f64,
    /// Greatest absolute difference of a channel; NaN if any is.
    pub max: f64,
    /// Peak signal-to-noise ratio in dB for a peak of 1; infinite for equal pictures (`null` in JSON).
    pub psnr: f64,
    /// Mean LDR-ꟻLIP error, in [0, 1]; absent for planes that are not colours.
    pub flip: Option<f64>,
    /// Pixels where any bit of any plane differs.
    pub differing_pixels: usize,
    /// Pixels compared.
    pub pixels: usize,
}

/// Pictures that cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DifferenceError {
    /// Other sizes.
    #[error("the pictures differ in size: {}×{} and {}×{}", .0[0], .0[1], .1[0], .1[1])]
    Size([u32; 2], [u32; 2]),
    /// Other planes.
    #[error("the pictures hold different planes: {0} and {1}")]
    Channels(String, String),
}

impl Difference {
    /// Compare two pictures.
    ///
    /// # Errors
    /// Pictures of other sizes, or with planes of other names or types.
    pub fn between(a: &Picture, b: &Picture) -> Result<Self, DifferenceError> {
        check_comparable(a, b)?;
        let pixels = a.pixels();
        let differs = |&i: &usize| {
            a.channels.iter().zip(&b.channels).any(|(a, b)| a.samples.bits(i) != b.samples.bits(i))
        };
        let differing_pixels = (0..pixels).filter(differs).count();
        let (rmse, max) = spread(&measured(a), &measured(b), pixels);
        Ok(Self {
            rmse,
            max,
            psnr: -20.0 * rmse.log10(),
            // Equal bits look equal, NaN included; and the common case costs no filtering.
            flip: if differing_pixels == 0 { a.rgb().map(|_| 0.0) } else { mean_flip(a, b) },
            differing_pixels,
            pixels,
        })
    }
}

fn check_comparable(a: &Picture, b: &Picture) -> Result<(), DifferenceError> {
    let planes = |picture: &Picture| {
        let names = picture.channels.iter().map(|c| format!("{} ({})", c.name, c.samples.type_name()));
        names.collect::<Vec<_>>().join(", ")
    };
    if (a.width, a.height) != (b.width, b.height) {
        return Err(DifferenceError::Size([a.width, a.height], [b.width, b.height]));
    }
    if planes(a) != planes(b) {
        return Err(DifferenceError::Channels(planes(a), planes(b)));
    }
    Ok(())
}

/// The planes that error figures are taken over.
fn measured(picture: &Picture) -> Vec<&Channel> {
    picture.rgb().map_or_else(|| picture.channels.iter().collect(), |rgb| rgb.to_vec())
}

/// Root mean square and greatest absolute difference. Equal bits differ by 0, NaN and infinities included.
fn spread(a: &[&Channel], b: &[&Channel], pixels: usize) -> (f64, f64) {
    let apart = |(a, b): (&Channel, &Channel), i: usize| {
        let same = a.samples.bits(i) == b.samples.bits(i);
        if same { 0.0 } else { (a.samples.value(i) - b.samples.value(i)).abs() }
    };
    let (mut squares, mut max) = (0.0_f64, 0.0_f64);
    for pair in a.iter().copied().zip(b.iter().copied()) {
        for distance in (0..pixels).map(|i| apart(pair, i)) {
            squares += distance * distance;
            max = if distance <= max || max.is_nan() { max } else { distance };
        }
    }
    let samples = (pixels * a.len()).max(1) as f64;
    ((squares / samples).sqrt(), max)
}

fn mean_flip(a: &Picture, b: &Picture) -> Option<f64> {
    let pixels = |picture: &Picture| -> Option<Vec<[f32; 3]>> {
        let rgb = picture.rgb()?;
        Some((0..picture.pixels()).map(|i| rgb.map(|c| c.samples.value(i) as f32)).collect())
    };
    let map = flip(&pixels(a)?, &pixels(b)?, a.width as usize);
    Some(map.iter().copied().map(f64::from).sum::<f64>() / map.len().max(1) as f64)
}

/// A figure that a comparison may be failed by: larger is worse for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Metric {
    /// [`Difference::rmse`].
    Rmse,
    /// [`Difference::max`].
    Max,
    /// [`Difference::flip`].
    Flip,
    /// [`Difference::differing_pixels`].
    DifferingPixels,
}

impl Metric {
    /// All figures.
    pub const ALL: [Self; 4] = [Self::Rmse, Self::Max, Self::Flip, Self::DifferingPixels];

    /// The name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rmse => "rmse",
            Self::Max => "max",
            Self::Flip => "flip",
            Self::DifferingPixels => "differing_pixels",
        }
    }

    /// The figure; `None` where it has no meaning for these pictures.
    #[must_use]
    pub fn of(self, difference: &Difference) -> Option<f64> {
        match self {
            Self::Rmse => Some(difference.rmse),
            Self::Max => Some(difference.max),
            Self::Flip => difference.flip,
            Self::DifferingPixels => Some(difference.differing_pixels as f64),
        }
    }
}

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn grey(values: &[f32]) -> Picture {
        let pixels: Vec<_> = values.iter().map(|&v| [v; 3]).collect();
        Picture::from_rgb(values.len() as u32, 1, &pixels)
    }

    fn ids(values: &[u32]) -> Picture {
        Picture::new(values.len() as u32, 1, vec![Channel::u32("body", values.iter().copied())])
    }

    #[test]
    fn equal_pictures_have_no_difference() {
        let a = grey(&[0.0, 0.5, f32::NAN, f32::INFINITY]);
        let difference = Difference::between(&a, &a).unwrap();
        assert_eq!((difference.rmse, difference.max, difference.differing_pixels), (0.0, 0.0, 0));
        assert_eq!((difference.psnr, difference.flip), (f64::INFINITY, Some(0.0)));
    }

    #[test]
    fn figures_are_those_worked_out_by_hand() {
        let difference =
            Difference::between(&grey(&[0.0, 0.5, 1.0, 0.25]), &grey(&[0.0, 0.25, 1.0, 0.25])).unwrap();
        assert_eq!(difference.rmse, 0.125);
        assert_eq!(difference.max, 0.25);
        assert!((difference.psnr - 18.061_799_7).abs() < 1e-6);
        assert_eq!((difference.differing_pixels, difference.pixels), (1, 4));
    }

    #[test]
    fn one_bit_makes_a_differing_pixel_even_in_the_sign_of_zero() {
        let difference = Difference::between(&grey(&[0.0, 1.0]), &grey(&[-0.0, 1.0_f32.next_up()])).unwrap();
        assert_eq!(difference.differing_pixels, 2);
    }

    #[test]
    fn a_nan_on_one_side_makes_every_figure_nan() {
        let difference = Difference::between(&grey(&[f32::NAN, 1.0]), &grey(&[0.5, 0.0])).unwrap();
        assert!(difference.max.is_nan() && difference.rmse.is_nan() && difference.flip.unwrap().is_nan());
    }

    #[test]
    fn hashes_are_compared_by_all_their_bits() {
        let difference = Difference::between(&ids(&[u32::MAX, 5]), &ids(&[u32::MAX - 1, 5])).unwrap();
        assert_eq!((difference.differing_pixels, difference.flip), (1, None));
    }

    #[test]
    fn pictures_that_cannot_be_compared_say_why() {
        let sizes = Difference::between(&grey(&[0.0]), &grey(&[0.0, 0.0])).unwrap_err();
        assert_eq!(sizes.to_string(), "the pictures differ in size: 1×1 and 2×1");
        let planes = Difference::between(&grey(&[0.0]), &ids(&[0])).unwrap_err();
        assert_eq!(
            planes.to_string(),
            "the pictures hold different planes: B (f32), G (f32), R (f32) and body (u32)"
        );
    }
}
