//! The certified bound held against the true truncation error.

use serde::{Deserialize, Serialize};

use super::metrics::Seen;
use crate::film::MeanMax;
use crate::layout::constants::ROUNDOFF_F32;

/// The certified bound of a picture held against its true truncation error: unclamped radiance, the greatest
/// channel of each pixel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Mean of the bound over the pixels.
    pub bound_mean: f64,
    /// Greatest bound of a pixel.
    pub bound_max: f64,
    /// Mean distance to the reference.
    pub error_mean: f64,
    /// Greatest distance of a pixel to the reference.
    pub error_max: f64,
    /// Pixels whose bound is broken: none, or the bound is wrong.
    pub broken: usize,
}

impl Certificate {
    /// Hold the bounds of a picture against a reference of the same arithmetic and the same samples.
    ///
    /// Equal arithmetic traces the common part of both trees with the same bits, so the pictures differ by what
    /// was cut and by the rounding of their sums alone. A bound is broken where the distance exceeds the sum of
    /// both pictures' bounds and of those roundings: n terms ≥ 0 are summed to within n·u of their sum (Higham
    /// 2002, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 4.2), with at most as many terms
    /// as rays.
    pub(super) fn of(picture: &Seen, reference: &Seen) -> Self {
        let pixels = picture.radiance.len();
        let distance = |i: usize| {
            let (a, b) = (picture.radiance[i], reference.radiance[i]);
            let apart = (0..3).map(|c| (f64::from(a[c]) - f64::from(b[c])).abs());
            // Keeps what is not a number, which `f64::max` would drop.
            apart.fold(0.0, |most, d| if d > most || d.is_nan() { d } else { most })
        };
        let allowed = |i: usize| {
            let rounding = |seen: &Seen| {
                let greatest = seen.radiance[i].iter().copied().fold(0.0, f32::max);
                // One more for each bound's own rounding, and for the division by the number of samples.
                f64::from(seen.rays[i] + 2) * 2.0 * ROUNDOFF_F32 * f64::from(greatest + seen.bounds[i])
            };
            let bounds = f64::from(picture.bounds[i]) + f64::from(reference.bounds[i]);
            bounds + rounding(picture) + rounding(reference)
        };
        let bound = MeanMax::over(picture.bounds.iter().copied().map(f64::from));
        let error = MeanMax::over((0..pixels).map(distance));
        Self {
            bound_mean: bound.mean,
            bound_max: bound.max,
            error_mean: error.mean,
            error_max: error.max,
            broken: (0..pixels).filter(|&i| distance(i) > allowed(i) || distance(i).is_nan()).count(),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::lab::Subject;
    use super::super::metrics::tests::seen;
    use super::*;
    use crate::cpu::CpuRenderer;
    use crate::film::Renderer;
    use crate::flatten;
    use crate::layout::Settings;

    #[test]
    fn a_bound_that_is_kept_is_not_broken_and_one_too_small_is() {
        let mut picture = seen(&[0.5, 0.25]);
        picture.bounds = vec![0.25, 0.125];
        let kept = Certificate::of(&picture, &seen(&[0.75, 0.125]));
        assert_eq!((kept.broken, kept.error_max, kept.bound_max), (0, 0.25, 0.25));
        let broken = Certificate::of(&picture, &seen(&[0.75, 0.126 - 0.125 * 2.0]));
        assert_eq!(broken.broken, 1);
    }

    #[test]
    fn the_bound_of_the_reference_counts_too() {
        let mut reference = seen(&[0.75]);
        assert_eq!(Certificate::of(&seen(&[0.5]), &reference).broken, 1);
        reference.bounds[0] = 0.25;
        assert_eq!(Certificate::of(&seen(&[0.5]), &reference).broken, 0);
    }

    #[test]
    fn radiance_above_what_a_display_shows_is_not_clamped_away() {
        assert_eq!(Certificate::of(&seen(&[2.0]), &seen(&[5.0])).broken, 1);
    }

    #[test]
    fn what_is_not_a_number_breaks_every_bound() {
        assert_eq!(Certificate::of(&seen(&[f32::NAN]), &seen(&[0.0])).broken, 1);
    }

    #[test]
    fn bounds_of_a_picture_that_are_too_small_are_found_out() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/whitted.toml");
        let subject = Subject::load(&path, 0).unwrap();
        let flat = &subject.flat.scene;
        let mut renderer = CpuRenderer::new(flat, 0).unwrap();
        let mut picture = |settings: Settings| {
            let view = flatten::view(&subject.scene.camera, flat, [24, 18], None, &settings);
            Seen::of(&renderer.render(&view, &settings, &()).unwrap())
        };
        let tree = picture(Settings { depth: 64, cutoff: 1e-6, ..Settings::default() });
        let mut cut = picture(Settings { depth: 2, ..Settings::default() });
        assert_eq!(Certificate::of(&cut, &tree).broken, 0);
        cut.bounds.iter_mut().for_each(|bound| *bound *= 0.01);
        assert!(Certificate::of(&cut, &tree).broken > 0);
    }
}
