//! Times of all points of an axis, in turn, and the power that they follow.

use std::time::{Duration, Instant};

use serde::Serialize;

use super::Axis;
use super::axis::Case;
use super::fit::{exponent, value_at};
use crate::bench::devices::plan::rounds_within;
use crate::bench::effects::is_same;
use crate::bench::{BenchError, Spread, Target, Tracer, take_turns};
use crate::film::{Frame, Renderer};

/// How trace times of a device grow along an axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Growth {
    /// What grows.
    pub axis: &'static str,
    /// What is counted of it.
    pub label: &'static str,
    /// The device.
    pub device: String,
    /// Rounds in which all points were traced in turn.
    pub rounds: usize,
    /// The least first.
    pub points: Vec<GrowthPoint>,
    /// Time ∝ amount^slope: the median of the rounds' fits, with its interval.
    pub slope: Spread,
    /// The greatest slope that is accepted, where there is one.
    pub limit: Option<f64>,
}

/// One amount.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct GrowthPoint {
    /// How much of it.
    pub amount: u32,
    /// Rays of a picture.
    pub rays: u64,
    /// The trace.
    pub trace_ms: Spread,
}

impl Growth {
    /// Whether time grows no faster than is accepted.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.limit.is_none_or(|limit| self.slope.median <= limit)
    }

    /// Milliseconds of an amount by the fitted power.
    #[must_use]
    pub fn fitted(&self, amount: f64) -> f64 {
        let points = self.points.iter().map(|point| (f64::from(point.amount), point.trace_ms.median));
        value_at(amount, self.slope.median, points)
    }
}

/// Trace an axis of these amounts on a device, in as many rounds as are asked for or fit the budget. The inner error tells
/// why there are no figures: a picture that does not show what it should, or that the CPU traces otherwise.
///
/// # Errors
/// What the device reports.
pub fn grow(
    axis: Axis,
    amounts: &[u32],
    target: &Target,
    rounds: Option<usize>,
    budget: Duration,
) -> Result<Result<Growth, String>, BenchError> {
    let cases = amounts.iter().map(|&amount| axis.case(amount, target)).collect::<Result<Vec<_>, _>>()?;
    let mut sides = Vec::new();
    let mut took = Duration::ZERO;
    for case in &cases {
        let mut side = Side { case, tracer: case.target.open(&case.stage.scene)? };
        side.tracer.start_clock()?;
        side.picture()?;
        let started = Instant::now();
        let frame = side.picture()?;
        took += started.elapsed();
        if let Some(fault) = axis.fault(case.value, &frame) {
            return Ok(Err(format!("{}: {fault}", case.stage.name)));
        }
        if !is_same(&frame, &judged(case)?) {
            let device = case.target.name();
            return Ok(Err(format!("{}: {device} traces another picture than the CPU", case.stage.name)));
        }
        sides.push((side, frame.rays.total()));
    }
    let rounds = rounds.unwrap_or_else(|| rounds_within(budget, took));
    let times = take_turns(rounds, sides.len(), |index| sides[index].0.time())?;
    let amount = |index: usize| f64::from(cases[index].value);
    let slopes = (0..rounds).map(|round| {
        exponent(times.iter().enumerate().map(|(index, times)| (amount(index), times[round].as_secs_f64())))
    });
    let point = |((case, (_, rays)), times): ((&Case, &(Side<'_>, u64)), &Vec<Duration>)| GrowthPoint {
        amount: case.value,
        rays: *rays,
        trace_ms: Spread::of_times(times),
    };
    Ok(Ok(Growth {
        axis: axis.name(),
        label: axis.label(),
        device: if axis == Axis::Threads { "CPU".to_owned() } else { target.name() },
        rounds,
        points: cases.iter().zip(&sides).zip(&times).map(point).collect(),
        slope: Spread::of(slopes.collect()),
        limit: axis.limit(),
    }))
}

/// A point, ready to be traced.
struct Side<'a> {
    case: &'a Case,
    tracer: Tracer<'a>,
}

impl Side<'_> {
    fn picture(&mut self) -> Result<Frame, BenchError> {
        self.tracer.render(&self.case.view, &self.case.settings, &())
    }

    fn time(&mut self) -> Result<Duration, BenchError> {
        let host = self.picture()?.times.trace;
        // A zero has no logarithm.
        Ok(self.tracer.device_time()?.unwrap_or(host).max(Duration::from_nanos(1)))
    }
}

/// The point's picture by all threads of the CPU.
fn judged(case: &Case) -> Result<Frame, BenchError> {
    Target::Cpu { threads: 0 }.open(&case.stage.scene)?.render(&case.view, &case.settings, &())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const CPU: Target = Target::Cpu { threads: 1 };

    #[test]
    fn time_grows_in_proportion_to_the_rays_of_a_path() {
        let growth = grow(Axis::Depth, &[4, 16, 64], &CPU, Some(6), Duration::ZERO).unwrap().unwrap();
        assert_eq!(growth.points.iter().map(|point| point.amount).collect::<Vec<_>>(), [4, 16, 64]);
        assert_eq!(growth.points[2].rays, 160 * 120 * 64);
        assert!((0.6..1.4).contains(&growth.slope.median), "{growth:?}");
        assert!(growth.holds() && growth.fitted(64.0) > growth.fitted(4.0));
    }

    #[test]
    fn a_slope_above_the_limit_does_not_hold() {
        let slope = |median: f64| Growth {
            axis: "triangles",
            label: "",
            device: String::new(),
            rounds: 6,
            points: vec![],
            slope: Spread { median, low: median, high: median },
            limit: Some(0.25),
        };
        assert!(slope(0.25).holds() && !slope(0.26).holds());
        assert!(Growth { limit: None, ..slope(2.0) }.holds());
    }
}
