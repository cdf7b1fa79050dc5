//! How far a picture is from its reference.

use serde::{Deserialize, Serialize};

use super::StudyError;
use crate::film::{Difference, Picture};

/// How far a picture is from its reference, in linear RGB clamped to [0, 1].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Errors {
    /// Root mean square over pixels and channels.
    pub rmse: f64,
    /// The error that 99.9 % of all channels of all pixels keep (nearest rank).
    pub p999: f64,
    /// The greatest error of a channel.
    pub max: f64,
    /// Mean LDR-ꟻLIP error (Andersson et al. 2020).
    pub flip: f64,
    /// Pixels whose first sample met other bodies, sides, branches or lights.
    pub paths: usize,
    /// Pixels that are not finite; they count as black.
    pub non_finite: usize,
}

/// What errors are taken of: radiance and path of each pixel.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Seen {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Linear radiance, not clamped.
    pub(super) radiance: Vec<[f32; 3]>,
    /// Body hashes.
    pub(super) paths: Vec<u32>,
    /// Certified bounds on the truncation error.
    pub(super) bounds: Vec<f32>,
    /// Rays traced for each pixel.
    pub(super) rays: Vec<u32>,
}

impl Seen {
    pub(super) fn of(frame: &crate::film::Frame) -> Self {
        Self {
            width: frame.width,
            height: frame.height,
            radiance: frame.radiance(),
            paths: frame.texels.iter().map(|texel| texel.body_hash).collect(),
            bounds: frame.texels.iter().map(|texel| texel.bound).collect(),
            rays: frame.texels.iter().map(|texel| texel.rays).collect(),
        }
    }

    /// Radiance clamped to [0, 1], with 0 for what is no number.
    pub(super) fn clamped(&self) -> Vec<[f32; 3]> {
        let clamp = |v: f32| if v.is_nan() { 0.0 } else { v.clamp(0.0, 1.0) };
        self.radiance.iter().map(|pixel| pixel.map(clamp)).collect()
    }

    /// The clamped radiance as a picture.
    pub(super) fn picture(&self) -> Picture {
        Picture::from_rgb(self.width, self.height, &self.clamped())
    }
}

impl Errors {
    /// The errors of a picture.
    ///
    /// # Errors
    /// [`StudyError::Difference`] for pictures of different sizes.
    pub(super) fn between(picture: &Seen, reference: &Seen) -> Result<Self, StudyError> {
        let difference = Difference::between(&reference.picture(), &picture.picture())?;
        let is_finite = |pixel: &&[f32; 3]| pixel.iter().all(|v| v.is_finite());
        Ok(Self {
            rmse: difference.rmse,
            p999: quantile(&picture.clamped(), &reference.clamped(), 0.999),
            max: difference.max,
            flip: difference.flip.unwrap_or(0.0),
            paths: picture.paths.iter().zip(&reference.paths).filter(|(a, b)| a != b).count(),
            non_finite: picture.radiance.len() - picture.radiance.iter().filter(is_finite).count(),
        })
    }
}

impl Errors {
    /// All distances times a factor.
    pub(super) fn scaled(self, factor: f64) -> Self {
        let Self { rmse, p999, max, flip, .. } = self;
        Self { rmse: rmse * factor, p999: p999 * factor, max: max * factor, flip: flip * factor, ..self }
    }
}

/// The absolute difference that a share of all channels keeps: the value of the nearest rank.
fn quantile(a: &[[f32; 3]], b: &[[f32; 3]], share: f64) -> f64 {
    let mut apart: Vec<f32> =
        a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| (a - b).abs()).collect();
    if apart.is_empty() {
        return 0.0;
    }
    let rank = ((share * apart.len() as f64).ceil() as usize).clamp(1, apart.len());
    let (_, &mut value, _) = apart.select_nth_unstable_by(rank - 1, f32::total_cmp);
    f64::from(value)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
pub(super) mod tests {
    use super::*;

    /// A row of grey pixels, each with its own path.
    pub(in super::super) fn seen(values: &[f32]) -> Seen {
        let n = values.len() as u32;
        Seen {
            width: n,
            height: 1,
            radiance: values.iter().map(|&v| [v; 3]).collect(),
            paths: (0..n).collect(),
            bounds: vec![0.0; values.len()],
            rays: vec![1; values.len()],
        }
    }

    #[test]
    fn errors_are_those_of_clamped_radiance() {
        let errors = Errors::between(&seen(&[5.0, 0.25]), &seen(&[1.0, 0.5])).unwrap();
        assert_eq!(errors.max, 0.25);
        assert!((errors.rmse - (0.0625_f64 / 2.0).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn what_is_not_a_number_counts_as_black_and_is_counted() {
        let errors = Errors::between(&seen(&[f32::NAN, 0.5]), &seen(&[0.75, 0.5])).unwrap();
        assert_eq!((errors.max, errors.non_finite), (0.75, 1));
    }

    #[test]
    fn the_quantile_leaves_out_the_thousandth_part() {
        let mut values = vec![0.0; 2000];
        values[7] = 0.5;
        values[8] = 0.25;
        values[9] = 0.125;
        let errors = Errors::between(&seen(&values), &seen(&vec![0.0; 2000])).unwrap();
        assert_eq!((errors.max, errors.p999), (0.5, 0.125));
    }

    #[test]
    fn other_paths_are_counted_even_where_the_colour_is_the_same() {
        let mut other = seen(&[0.5, 0.5]);
        other.paths[1] = 99;
        assert_eq!(Errors::between(&other, &seen(&[0.5, 0.5])).unwrap().paths, 1);
    }
}
