//! Figures over a whole picture: what was cut off, what the error is bounded by, what is not a number.

use serde::Serialize;

use super::Frame;

/// Mean and maximum over the pixels; both 0 for a picture without pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct MeanMax {
    /// Arithmetic mean, summed in f64 in pixel order.
    pub mean: f64,
    /// Greatest value; NaN if any is.
    pub max: f64,
}

impl MeanMax {
    /// Of any values.
    pub fn over(values: impl ExactSizeIterator<Item = f64>) -> Self {
        let count = values.len().max(1) as f64;
        let (sum, max) = values
            .fold((0.0, 0.0), |(sum, max), v| (sum + v, if v <= max || max.is_nan() { max } else { v }));
        Self { mean: sum / count, max }
    }
}

/// Figures over a whole picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Summary {
    /// Weight of cut rays.
    pub dropped: MeanMax,
    /// Certified bound on the truncation error, as linear radiance.
    pub bound: MeanMax,
    /// Samples that a pixel is the mean of.
    pub samples: MeanMax,
    /// Pixels with a channel that is NaN or infinite.
    pub non_finite_pixels: usize,
}

impl Summary {
    /// The figures of a finished or interrupted frame.
    #[must_use]
    pub fn of(frame: &Frame) -> Self {
        let is_finite = |radiance: &[f32; 3]| radiance.iter().all(|v| v.is_finite());
        Self {
            dropped: MeanMax::over(frame.texels.iter().map(|t| f64::from(t.dropped))),
            bound: MeanMax::over(frame.texels.iter().map(|t| f64::from(t.bound))),
            samples: MeanMax::over((0..frame.texels.len()).map(|i| f64::from(frame.samples.of(i)))),
            non_finite_pixels: frame.texels.iter().filter(|t| !is_finite(&t.radiance)).count(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{SampleCounts, test_frame};

    #[test]
    fn dropped_weight_is_averaged_over_all_pixels() {
        let mut frame = test_frame(2, 2);
        for (texel, dropped) in frame.texels.iter_mut().zip([0.0, 0.5, 0.25, 0.25]) {
            texel.dropped = dropped;
        }
        assert_eq!(Summary::of(&frame).dropped, MeanMax { mean: 0.25, max: 0.5 });
    }

    #[test]
    fn a_nan_pixel_is_counted_once() {
        let mut frame = test_frame(2, 2);
        frame.texels[1].radiance = [f32::NAN, f32::INFINITY, 0.0];
        frame.texels[3].radiance = [0.0, f32::NEG_INFINITY, 0.0];
        assert_eq!(Summary::of(&frame).non_finite_pixels, 2);
    }

    #[test]
    fn a_nan_bound_is_not_hidden_by_larger_or_later_values() {
        let mut frame = test_frame(2, 2);
        for (texel, bound) in frame.texels.iter_mut().zip([1.0, f32::NAN, 0.5, 0.25]) {
            texel.bound = bound;
        }
        let bound = Summary::of(&frame).bound;
        assert!(bound.mean.is_nan() && bound.max.is_nan());
    }

    #[test]
    fn an_empty_frame_has_no_mean() {
        assert_eq!(Summary::of(&test_frame(0, 0)), Summary::default());
    }

    #[test]
    fn samples_are_averaged_over_all_pixels() {
        let frame = Frame { samples: SampleCounts::Each(vec![2, 2, 4, 64]), ..test_frame(2, 2) };
        assert_eq!(Summary::of(&frame).samples, MeanMax { mean: 18.0, max: 64.0 });
    }
}
