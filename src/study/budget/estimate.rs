//! Figures of a sample of a picture, and what they say of the whole.

use super::super::metrics::Seen;
use crate::film::{Metric, flip};

/// One-sided 95 % of the normal distribution.
const CONFIDENCE: f64 = 1.645;

/// What each pixel gives to a figure: the mean of these is its [`whole`], but for a greatest error.
pub(super) fn values(metric: Metric, seen: &Seen, judge: &Seen) -> Vec<f64> {
    let (a, b) = (seen.clamped(), judge.clamped());
    let apart = |(a, b): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|c| f64::from((a[c] - b[c]).abs()));
    let pairs = || a.iter().zip(&b);
    match metric {
        Metric::Rmse => pairs().map(apart).map(|d| d.map(|d| d * d).iter().sum::<f64>() / 3.0).collect(),
        Metric::Max => pairs().map(apart).map(|d| d.into_iter().fold(0.0, f64::max)).collect(),
        Metric::Flip => flip(&b, &a, seen.width as usize).into_iter().map(f64::from).collect(),
        Metric::DifferingPixels => pairs().map(|(a, b)| f64::from(u8::from(a != b))).collect(),
    }
}

/// The figure of groups of pixels, each with the mean of its values, and what that of the whole picture is below with 95 %
/// confidence if they are a random sample of it: the end of the normal interval, and what `rare` events may add. `share` is
/// what they are of the picture: what is seen is not uncertain (the finite population correction: Cochran 1977, Sampling
/// Techniques, 3rd ed., section 2.6). Of a greatest error a sample says nothing more than itself.
pub(super) fn figure(metric: Metric, groups: &[f64], share: f64, rare: bool) -> [f64; 2] {
    let worst = groups.iter().copied().fold(0.0, f64::max);
    if metric == Metric::Max {
        return [worst; 2];
    }
    let n = groups.len().max(1) as f64;
    let mean = groups.iter().sum::<f64>() / n;
    let variance = groups.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
    let unseen = (1.0 - share).max(0.0);
    // Events rarer than 3/n are missed by one sample of n in twenty (the rule of three: Hanley and Lippman-Hand 1983,
    // JAMA 249(13)); they are taken to be as bad as the worst that is there. A ray that f32 sends another way is one.
    let missed = if rare { 3.0 / n * worst * unseen } else { 0.0 };
    let above = mean + CONFIDENCE * (variance / n * unseen).sqrt() + missed;
    [mean, above].map(|value| if metric == Metric::Rmse { value.sqrt() } else { value })
}

/// The figure of errors of several independent causes together: squares add up in the mean; of others not more is known
/// than that the sum is not exceeded.
pub(super) fn together(metric: Metric, parts: &[f64]) -> f64 {
    match metric {
        Metric::Rmse => parts.iter().map(|part| part * part).sum::<f64>().sqrt(),
        _ => parts.iter().sum(),
    }
}

/// What `parts` leave of a whole for one more cause, at least 0.
pub(super) fn rest(metric: Metric, whole: f64, parts: &[f64]) -> f64 {
    match metric {
        Metric::Rmse => (whole * whole - parts.iter().map(|part| part * part).sum::<f64>()).max(0.0).sqrt(),
        _ => (whole - parts.iter().sum::<f64>()).max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::metrics::tests::seen;
    use super::*;

    #[test]
    fn what_is_claimed_is_above_what_is_measured() {
        let (a, b) = (seen(&[0.5, 0.25, 0.0, 0.75]), seen(&[0.5, 0.5, 0.0, 0.75]));
        let squares = values(Metric::Rmse, &a, &b);
        let [mean, above] = figure(Metric::Rmse, &squares, 0.1, false);
        let [_, with_rare] = figure(Metric::Rmse, &squares, 0.1, true);
        assert!((mean - 0.125).abs() < 1e-9 && above > mean && with_rare > above);
        assert_eq!(figure(Metric::Max, &values(Metric::Max, &a, &b), 0.1, true), [0.25; 2]);
        // Nothing is missed where everything is seen.
        assert_eq!(figure(Metric::Rmse, &squares, 1.0, true), [mean; 2]);
    }

    #[test]
    fn what_is_left_and_what_is_taken_make_the_whole() {
        for metric in [Metric::Rmse, Metric::Flip] {
            let left = rest(metric, 0.5, &[0.3]);
            assert!((together(metric, &[0.3, left]) - 0.5).abs() < 1e-12);
            assert_eq!(rest(metric, 0.1, &[0.3]), 0.0);
        }
        assert!((rest(Metric::Rmse, 0.5, &[0.3]) - 0.4).abs() < 1e-12);
    }
}
