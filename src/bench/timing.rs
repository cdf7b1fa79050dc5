//! Runs in turn, and what their times say.

use std::time::Duration;

use serde::{Deserialize, Serialize};

/// Chance that an interval misses the ratio that it is for, at each of its ends.
const TAIL: f64 = 0.025;

/// Run every side, by its number, once to warm up, then all of them in turn for so many rounds; returns each side's times.
///
/// Every other round goes the other way round: what grows steadily, such as heat, then weighs on all sides alike.
///
/// # Errors
/// The first of a side.
pub fn take_turns<E>(
    rounds: usize,
    sides: usize,
    mut run: impl FnMut(usize) -> Result<Duration, E>,
) -> Result<Vec<Vec<Duration>>, E> {
    let mut times = vec![Vec::new(); sides];
    for side in 0..sides {
        run(side)?;
    }
    for round in 0..rounds {
        for step in 0..sides {
            let side = if round % 2 == 0 { step } else { sides - 1 - step };
            times[side].push(run(side)?);
        }
    }
    Ok(times)
}

/// The middle time, or the mean of the middle two; zero of none.
#[must_use]
pub fn median(times: &[Duration]) -> Duration {
    let mut sorted = times.to_vec();
    sorted.sort_unstable();
    match sorted.len() {
        0 => Duration::ZERO,
        n => (sorted[(n - 1) / 2] + sorted[n / 2]) / 2,
    }
}

/// How many times as long one side takes as the other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    /// Median of the rounds' ratios.
    pub median: f64,
    /// Lower end of the interval that holds the true median at 95 % confidence, or the least ratio of too few rounds.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl Ratio {
    /// Fewest rounds of which the interval holds at 95 %.
    pub const LEAST_ROUNDS: usize = 6;

    /// Of times that were taken in turn; all 1 of none.
    ///
    /// The interval lies between order statistics, whatever the distribution: the true median is below the k-th of n
    /// ratios with the chance that fewer than k of n coins fall heads (David and Nagaraja, *Order Statistics*, 3rd ed.,
    /// section 7.1).
    #[must_use]
    pub fn of(times: &[Duration], others: &[Duration]) -> Self {
        let pairs = times.iter().zip(others);
        let ratios: Vec<f64> =
            pairs.map(|(a, b)| a.as_secs_f64() / b.as_secs_f64().max(f64::MIN_POSITIVE)).collect();
        if ratios.is_empty() {
            return Self { median: 1.0, low: 1.0, high: 1.0 };
        }
        let Spread { median, low, high } = Spread::of(ratios);
        Self { median, low, high }
    }
}

/// Any figure of several rounds: the median, with the interval that [`Ratio`] describes.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl Spread {
    /// Of the rounds' figures; all 0 of none.
    #[must_use]
    pub fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let n = values.len();
        if n == 0 {
            return Self::default();
        }
        let outside = ends_beyond(n).saturating_sub(1);
        Self {
            median: f64::midpoint(values[(n - 1) / 2], values[n / 2]),
            low: values[outside],
            high: values[n - 1 - outside],
        }
    }

    /// Of the rounds' times, in milliseconds.
    #[must_use]
    pub fn of_times(times: &[Duration]) -> Self {
        Self::of(times.iter().map(|time| time.as_secs_f64() * 1e3).collect())
    }
}

/// The greatest k with which fewer than k of n coins fall heads at a chance of at most [`TAIL`].
fn ends_beyond(n: usize) -> usize {
    let mut chance = 0.5_f64.powi(n as i32);
    let mut below = 0.0;
    let mut k = 0;
    while k < n && below + chance <= TAIL {
        below += chance;
        chance *= (n - k) as f64 / (k + 1) as f64;
        k += 1;
    }
    k
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    #[test]
    fn sides_take_turns_after_a_warm_up_and_every_other_round_goes_back() {
        let mut order = String::new();
        let times = take_turns(3, 2, |side| {
            order.push(['a', 'b'][side]);
            Ok::<_, Infallible>(Duration::from_millis([3, 6][side]))
        })
        .unwrap();
        assert_eq!(order, "ababbaab");
        assert_eq!(times, [3, 6].map(|ms| vec![Duration::from_millis(ms); 3]));
    }

    #[test]
    fn medians_are_between_the_middle_two() {
        let millis = |all: &[u64]| all.iter().map(|&ms| Duration::from_millis(ms)).collect::<Vec<_>>();
        assert_eq!(median(&millis(&[9, 1, 4])), Duration::from_millis(4));
        assert_eq!(median(&millis(&[9, 1, 4, 6])), Duration::from_millis(5));
        assert_eq!(median(&[]), Duration::ZERO);
    }

    #[test]
    fn the_interval_is_that_of_the_sign_test() {
        // Tables of the sign test: critical values at 5 %, both ends.
        assert_eq!([5, 6, 8, 9, 12, 20, 25].map(ends_beyond), [0, 1, 1, 2, 3, 6, 8]);
        let times: Vec<_> = (1..=9).map(Duration::from_secs).collect();
        let ratio = Ratio::of(&times, &[Duration::from_secs(1); 9]);
        assert_eq!((ratio.low, ratio.median, ratio.high), (2.0, 5.0, 8.0));
        let spread = Spread::of_times(&times);
        assert_eq!((spread.low, spread.median, spread.high), (2e3, 5e3, 8e3));
        assert_eq!(Spread::of(vec![]), Spread::default());
    }
}
