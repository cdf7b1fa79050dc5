//! The pictures that judge the rows, and how far they may be from the truth themselves.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::lab::{Lab, Shot};
use super::metrics::Seen;
use super::plan::{Setup, Target, cutoff_label};
use super::report::ReferenceRecord;
use super::{Errors, StudyError};
use crate::layout::constants::{MAX_DEPTH, ROUNDOFF_F32};
use crate::layout::{Precision, Settings};

/// How far a reference may be from the truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Uncertainty {
    /// What the certified bounds of the reference's own pixels prove, where they say anything.
    pub certified: Option<Certified>,
    /// Its distance to the next coarser reference: it is nearer to the truth than that one wherever refining
    /// helps at all.
    pub estimated: Errors,
    /// Where the figures come from, in words.
    pub source: String,
}

/// What is proven of a reference: errors of clamped radiance are no greater.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Certified {
    /// Root mean square of the pixels' bounds: by Minkowski's inequality an RMSE is off by no more.
    pub rmse: f64,
    /// The greatest bound of a pixel.
    pub max: f64,
}

/// A reference picture and what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reference {
    pub(super) seen: Seen,
    pub(super) record: ReferenceRecord,
}

/// Cut-offs of the truncation reference, as far as time goes.
const RUNGS: [f32; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];
/// The next rung takes at least this many times as long.
const LEAST_GROWTH: f64 = 1.3;
/// Samples of the sampling reference, as time allows.
const MOST_SAMPLES: [u32; 2] = [256, 128];
/// And at the least: fewer judge no row of as many samples. They may take twice the time.
const LEAST_SAMPLES: u32 = 64;

impl Reference {
    fn new(shot: &Shot, setup: String, uncertainty: Uncertainty) -> Self {
        let record = ReferenceRecord {
            setup,
            uncertainty,
            time_ms: shot.time.as_secs_f64() * 1e3,
            rays: shot.frame.rays.into(),
            cutoff: None,
        };
        Self { seen: Seen::of(&shot.frame), record }
    }
}

/// The baseline in f64: the truth of what arithmetic changes.
pub(super) fn arithmetic(
    lab: &mut Lab,
    base: Settings,
    limit: Duration,
) -> Result<Option<Reference>, StudyError> {
    let Some(shot) = lab.shoot(&judge(base), limit)? else { return Ok(None) };
    let roundoff = Errors { rmse: ROUNDOFF_F32, p999: ROUNDOFF_F32, max: ROUNDOFF_F32, ..Errors::default() };
    let source = "the film rounds f64 to f32: at most 2^-24 of radiance up to 1".to_owned();
    let uncertainty = Uncertainty { certified: None, estimated: roundoff, source };
    Ok(Some(Reference::new(&shot, "the baseline in f64".to_owned(), uncertainty)))
}

/// The whole tree in the baseline's own arithmetic: as uncertain as its twin in f64.
pub(super) fn truncation(
    lab: &mut Lab,
    settings: Settings,
    whole: &ReferenceRecord,
) -> Result<Option<Reference>, StudyError> {
    let limit = Duration::from_secs_f64(whole.time_ms / 1e3) * 4;
    let Some(shot) = lab.shoot(&Setup { settings, ..judge(settings) }, limit)? else { return Ok(None) };
    let uncertainty = Uncertainty {
        certified: Some(certified(&Seen::of(&shot.frame))),
        source: "proven by the certified bound of each pixel; estimated as for the same tree in f64"
            .to_owned(),
        ..whole.uncertainty.clone()
    };
    let words = format!("f32, depth {MAX_DEPTH}, cut-off {}", cutoff_label(settings.cutoff));
    Ok(Some(Reference::new(&shot, words, uncertainty)))
}

/// Traces a setup, or gives up when it takes longer than the duration.
type Shoot<'a> = dyn FnMut(&Setup, Duration) -> Result<Option<Shot>, StudyError> + 'a;

/// The tree of depth 64 at the least cut-off that fits the time: rung after rung, until the next would be too
/// long or nothing is cut any more. `coarse` is the picture to compare the first rung with.
pub(super) fn whole(
    shoot: &mut Shoot<'_>,
    base: Settings,
    coarse: &Seen,
    limit: Duration,
) -> Result<Option<Reference>, StudyError> {
    let mut left = limit;
    let mut best: Option<(Shot, Settings)> = None;
    let mut coarser = coarse.clone();
    let mut growth = 2.0;
    for cutoff in RUNGS {
        let settings = Settings { depth: MAX_DEPTH, cutoff, ..base };
        let expected = best.as_ref().map_or(Duration::ZERO, |(shot, _)| shot.time.mul_f64(growth));
        if expected > left {
            break;
        }
        // The first rung is worth any time: without it there is no reference.
        let patience = if best.is_none() { limit * 4 } else { left * 2 };
        let Some(shot) = shoot(&judge(settings), patience)? else { break };
        left = left.saturating_sub(shot.time);
        if let Some((last, _)) = best.replace((shot, settings)) {
            coarser = Seen::of(&last.frame);
            let now = best.as_ref().map_or(Duration::ZERO, |(shot, _)| shot.time);
            growth = (now.as_secs_f64() / last.time.as_secs_f64()).max(LEAST_GROWTH);
        }
        if best.as_ref().is_some_and(|(shot, _)| shot.frame.texels.iter().all(|texel| texel.bound == 0.0)) {
            break;
        }
    }
    let Some((shot, settings)) = best else { return Ok(None) };
    let uncertainty = Uncertainty {
        certified: Some(certified(&Seen::of(&shot.frame))),
        estimated: Errors::between(&coarser, &Seen::of(&shot.frame))?,
        source: "proven by the certified bound of each pixel; estimated by the next coarser cut-off"
            .to_owned(),
    };
    let words = format!("f64, depth {MAX_DEPTH}, cut-off {}", cutoff_label(settings.cutoff));
    let mut reference = Reference::new(&shot, words, uncertainty);
    reference.record.cutoff = Some(settings.cutoff);
    Ok(Some(reference))
}

/// As many samples in f64 as fit the time, and a quarter of them in the rows' own arithmetic, whose roundoff is nothing
/// beside the error of so few. The means of N independent samples of variance σ² and of their first quarter are
/// √(4/N − 1/N)·σ apart, √3 standard errors σ/√N of the former. Samples of a low-discrepancy sequence err less than that.
pub(super) fn sampling(
    lab: &mut Lab,
    base: Settings,
    one_sample: Duration,
    limit: Duration,
) -> Result<Option<Reference>, StudyError> {
    let affordable = |samples: &u32| one_sample.mul_f64(f64::from(*samples) * 1.25) <= limit;
    let samples = MOST_SAMPLES.into_iter().find(affordable).unwrap_or(LEAST_SAMPLES);
    let few = Setup { settings: Settings { samples: samples / 4, ..base }, ..judge(base) };
    let many = judge(Settings { samples, ..base });
    let Some(quarter) = lab.shoot(&few, limit)? else { return Ok(None) };
    let Some(whole) = lab.shoot(&many, limit * 2)? else { return Ok(None) };
    let apart = Errors::between(&Seen::of(&quarter.frame), &Seen::of(&whole.frame))?;
    let uncertainty = Uncertainty {
        certified: None,
        estimated: apart.scaled(1.0 / 3.0_f64.sqrt()),
        source: "standard error of the mean, from its distance to that of its first quarter".to_owned(),
    };
    Ok(Some(Reference::new(&whole, format!("f64, {samples} samples"), uncertainty)))
}

/// The finest solids, in f64; estimated by the next coarser ones.
pub(super) fn tessellation(
    lab: &mut Lab,
    base: Settings,
    steps: i32,
    limit: Duration,
) -> Result<Option<Reference>, StudyError> {
    let mut shoot = |steps| lab.shoot(&Setup { steps, ..judge(base) }, limit);
    let (Some(coarse), Some(fine)) = (shoot(steps - 1)?, shoot(steps)?) else { return Ok(None) };
    let uncertainty = Uncertainty {
        certified: None,
        estimated: Errors::between(&Seen::of(&coarse.frame), &Seen::of(&fine.frame))?,
        source: "estimated by solids one level coarser".to_owned(),
    };
    Ok(Some(Reference::new(&fine, format!("f64, solids {steps:+} levels"), uncertainty)))
}

/// How references are traced: on all threads of the CPU, in f64.
fn judge(settings: Settings) -> Setup {
    let settings = Settings { precision: Precision::F64, ..settings };
    Setup { target: Target::Cpu { threads: 0 }, steps: 0, settings }
}

fn certified(seen: &Seen) -> Certified {
    let bounds = || seen.bounds.iter().copied().map(f64::from);
    // Errors of clamped radiance are at most 1.
    let squares: f64 = bounds().map(|bound| bound.min(1.0).powi(2)).sum();
    Certified {
        rmse: (squares / seen.bounds.len().max(1) as f64).sqrt(),
        max: bounds().fold(0.0, f64::max).min(1.0),
    }
}

/// What an error figure is worth beside the reference's own uncertainty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Worth {
    /// Above all that the reference may be off.
    Proven,
    /// Above what it is estimated to be off, below what is proven.
    Estimated,
    /// Below the reference's uncertainty: the true error may be anything up to that.
    Nothing,
}

impl Uncertainty {
    /// What an RMSE is worth.
    pub(super) fn worth_of_rmse(&self, rmse: f64) -> Worth {
        worth(rmse, self.certified.map_or(0.0, |certified| certified.rmse), self.estimated.rmse)
    }

    /// What a greatest error is worth.
    pub(super) fn worth_of_max(&self, max: f64) -> Worth {
        worth(max, self.certified.map_or(0.0, |certified| certified.max), self.estimated.max)
    }
}

fn worth(error: f64, certified: f64, estimated: f64) -> Worth {
    if error <= estimated.min(if certified > 0.0 { certified } else { f64::MAX }) {
        Worth::Nothing
    } else if error <= certified {
        Worth::Estimated
    } else {
        Worth::Proven
    }
}

#[cfg(test)]
mod tests {
    use super::super::metrics::tests::seen;
    use super::*;

    #[test]
    fn what_is_proven_is_the_root_mean_square_of_the_bounds() {
        let mut picture = seen(&[0.0; 4]);
        picture.bounds = vec![0.5, 0.0, 0.0, 9.0];
        assert_eq!(certified(&picture), Certified { rmse: (1.25_f64 / 4.0).sqrt(), max: 1.0 });
    }

    #[test]
    fn an_error_is_worth_what_exceeds_the_uncertainty() {
        assert_eq!(worth(1e-2, 1e-3, 1e-4), Worth::Proven);
        assert_eq!(worth(5e-4, 1e-3, 1e-4), Worth::Estimated);
        assert_eq!(worth(5e-5, 1e-3, 1e-4), Worth::Nothing);
        assert_eq!(worth(2e-4, 0.0, 1e-4), Worth::Proven);
        assert_eq!(worth(0.0, 0.0, 0.0), Worth::Nothing);
    }
}
