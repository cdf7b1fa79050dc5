//! The median of repeated times, with an interval that assumes nothing about their distribution.

use serde::{Deserialize, Serialize};

/// The confidence that an interval should have.
const CONFIDENCE: f64 = 0.95;

/// A median with its confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// The middle time, in milliseconds; the mean of the two middle ones of an even number.
    pub median: f64,
    /// Where the interval begins.
    pub low: f64,
    /// Where it ends.
    pub high: f64,
    /// The probability that it holds the true median: at least 0.95 from six runs on.
    pub confidence: f64,
    /// Runs.
    pub runs: usize,
}

impl Timing {
    /// The median of these times; `None` of none.
    ///
    /// The interval lies between two order statistics, the k-th from below and from above: it holds the
    /// median with probability 1 − 2·P(B < k), B binomial with n and ½, whatever the distribution (David and
    /// Nagaraja 2003, Order Statistics, 3rd ed., section 7.1). The largest k that keeps 95 % is taken; up to
    /// five runs cannot reach that, and the interval is all of them.
    #[must_use]
    pub fn of(times_ms: &[f64]) -> Option<Self> {
        let mut sorted = times_ms.to_vec();
        sorted.sort_by(f64::total_cmp);
        let runs = sorted.len();
        let middle = [sorted.get(runs.checked_sub(1)? / 2)?, sorted.get(runs / 2)?];
        let (rank, confidence) = rank(runs);
        Some(Self {
            median: f64::midpoint(*middle[0], *middle[1]),
            low: sorted[rank - 1],
            high: sorted[runs - rank],
            confidence,
            runs,
        })
    }
}

/// The rank k of the interval's ends, from 1, and the confidence that it gives.
fn rank(runs: usize) -> (usize, f64) {
    // P(B < k), one k after the other.
    let mut probability = 0.5_f64.powi(i32::try_from(runs).unwrap_or(i32::MAX));
    let mut below = probability;
    let mut best = (1, (1.0 - 2.0 * below).max(0.0));
    for k in 2..=runs / 2 {
        probability *= (runs + 2 - k) as f64 / (k - 1) as f64;
        below += probability;
        if 1.0 - 2.0 * below < CONFIDENCE {
            break;
        }
        best = (k, 1.0 - 2.0 * below);
    }
    best
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_those_of_the_published_table() {
        // Le Boudec 2010, Performance Evaluation of Computer and Communication Systems, table A.1.
        for (runs, expected) in [(6, 1), (7, 1), (8, 1), (9, 2), (10, 2), (12, 3), (15, 4), (20, 6), (30, 10)]
        {
            let (k, confidence) = rank(runs);
            assert_eq!(k, expected, "{runs}");
            assert!(confidence >= 0.95, "{runs}: {confidence}");
        }
    }

    #[test]
    fn few_runs_have_all_of_them_as_interval_and_say_how_sure_that_is() {
        let timing = Timing::of(&[3.0, 1.0, 2.0]).unwrap();
        assert_eq!((timing.low, timing.median, timing.high), (1.0, 2.0, 3.0));
        assert_eq!(timing.confidence, 0.75);
        assert_eq!(Timing::of(&[5.0]).unwrap().confidence, 0.0);
        assert_eq!(Timing::of(&[]), None);
    }

    #[test]
    fn an_outlier_moves_neither_the_median_nor_the_interval() {
        let mut times: Vec<f64> = (1..=12).map(f64::from).collect();
        let calm = Timing::of(&times).unwrap();
        times[11] = 1e9;
        assert_eq!(Timing::of(&times).unwrap(), calm);
        assert_eq!((calm.low, calm.median, calm.high), (3.0, 6.5, 10.0));
    }
}
