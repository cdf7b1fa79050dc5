//! An error budget: the cheapest settings that meet an error, or the most accurate ones that fit a time.
//!
//! What is chosen is depth, cut-off and precision. The judge is the whole tree in f64 of the same samples: how many of
//! those are taken stays with the caller, for halving that error costs two to four times the time, on some scenes
//! without end. Candidates are held against the judge on a probe, the same picture in fewer pixels: a stratified
//! sample of the errors of the whole one.

use std::time::Duration;

use super::lab::Shot;
use super::metrics::Seen;
use super::plan::{Setup, Target};
use super::reference::{Reference, Uncertainty, whole};
use super::{Errors, StudyError};
use crate::cpu::CpuRenderer;
use crate::film::{Metric, Renderer, flip};
use crate::flatten::view;
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{FlatScene, Precision, Settings};
use crate::scene::Camera;

/// What a picture is to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// An error against the whole tree in f64, in linear RGB clamped to [0, 1].
    Error {
        /// The most that is allowed.
        limit: f64,
        /// Which figure: RMSE, greatest error or mean ꟻLIP.
        metric: Metric,
    },
    /// A time of tracing.
    Time(Duration),
}

/// What was chosen, and what is known of it.
#[derive(Debug, Clone)]
pub struct Choice {
    /// The settings to render with.
    pub settings: Settings,
    /// Errors that the probe had with them.
    pub estimate: Errors,
    /// The figure of the goal's metric (RMSE for a time), and what it is below with 95 % confidence.
    pub figure: [f64; 2],
    /// How far the judge may be from the truth.
    pub judge: Uncertainty,
    /// Pixels of the probe.
    pub probed: usize,
    /// Candidates that were tried.
    pub tried: usize,
    /// Whether the probe meets the goal.
    pub meets: bool,
}

/// Pixels times samples of a probe.
const PROBE: u32 = 16_384;
/// Least pixels of a probe.
const LEAST_PIXELS: u32 = 4_096;
/// The judge may take as long as this many probes of the coarsest candidate.
const JUDGE_PROBES: u32 = 60;
/// As which a probe counts that takes no time.
const LEAST_PROBE: Duration = Duration::from_millis(20);
/// Cut-offs are 2^-4 to 2^-24.
const CUTOFFS: std::ops::RangeInclusive<i32> = 4..=24;
/// One-sided 95 % of the normal distribution.
const CONFIDENCE: f64 = 1.645;
/// Of a time, what is aimed at: pictures take a little longer some times than others.
const TIME_MARGIN: f64 = 0.9;

/// A candidate on the probe.
struct Tried {
    settings: Settings,
    errors: Errors,
    figure: [f64; 2],
}

/// Tells what the device that is to trace needs for a picture of a size with given settings.
type Clock<'a, E> = &'a mut dyn FnMut([u32; 2], &Settings) -> Result<Duration, E>;

/// The probe with its judge.
struct Probe<'a> {
    scene: &'a FlatScene,
    camera: &'a Camera,
    size: [u32; 2],
    renderer: CpuRenderer<'a>,
    judge: Seen,
    metric: Metric,
    /// Whether it is the whole picture: then nothing can have been missed.
    is_whole: bool,
    tried: usize,
}

/// Choose depth, cut-off and one of the precisions, the cheaper first, for a picture of `size` with these settings
/// otherwise. `time` tells what the device that is to trace needs for a picture of a size with given settings, and is
/// only asked for [`Goal::Time`].
///
/// # Errors
/// [`StudyError::Cpu`], [`StudyError::TooSlow`] where not even a judge can be traced, and what `time` reports.
pub fn choose<E: From<StudyError>>(
    (scene, camera): (&FlatScene, &Camera),
    size: [u32; 2],
    base: Settings,
    precisions: &[Precision],
    goal: Goal,
    time: Clock<'_, E>,
) -> Result<Choice, E> {
    let metric = match goal {
        Goal::Error { metric, .. } => metric,
        Goal::Time(_) => Metric::Rmse,
    };
    let (mut probe, judge) = Probe::new((scene, camera), size, base, metric)?;
    let (chosen, meets) = match goal {
        Goal::Error { limit, .. } => {
            let chosen = probe.cheapest(base, precisions, limit)?;
            let meets = chosen.figure[1] <= limit;
            (chosen, meets)
        }
        Goal::Time(most) => {
            let pixels = |[w, h]: [u32; 2]| f64::from(w) * f64::from(h);
            let scale = pixels(size) / pixels(probe.size);
            probe.most_accurate(base, precisions, most.mul_f64(TIME_MARGIN / scale), time)?
        }
    };
    Ok(Choice {
        settings: chosen.settings,
        estimate: chosen.errors,
        figure: chosen.figure,
        judge,
        probed: probe.judge.radiance.len(),
        tried: probe.tried,
        meets,
    })
}

impl<'a> Probe<'a> {
    /// Trace the judge: the whole tree in f64, as far as its time goes.
    fn new(
        (scene, camera): (&'a FlatScene, &'a Camera),
        size: [u32; 2],
        base: Settings,
        metric: Metric,
    ) -> Result<(Self, Uncertainty), StudyError> {
        let is_whole = probe_size(size, base.samples) == size;
        let size = probe_size(size, base.samples);
        let mut renderer = CpuRenderer::new(scene, 0)?;
        let mut shoot = |setup: &Setup| shoot(&mut renderer, (scene, camera), size, &setup.settings);
        let coarsest = Settings {
            depth: MAX_DEPTH,
            cutoff: cutoff(*CUTOFFS.start()),
            precision: Precision::F64,
            ..base
        };
        let coarse = shoot(&Setup { target: Target::Cpu { threads: 0 }, steps: 0, settings: coarsest })?;
        let limit = coarse.time.max(LEAST_PROBE) * JUDGE_PROBES;
        let judge = whole(&mut |setup, _| shoot(setup).map(Some), base, &Seen::of(&coarse.frame), limit)?;
        let Some(Reference { seen, record }) = judge else {
            return Err(StudyError::TooSlow { seconds: limit.as_secs_f64() });
        };
        let probe = Self { scene, camera, size, renderer, judge: seen, metric, is_whole, tried: 0 };
        Ok((probe, record.uncertainty))
    }

    /// Hold settings against the judge.
    fn try_out(&mut self, settings: Settings) -> Result<Tried, StudyError> {
        self.tried += 1;
        let shot = shoot(&mut self.renderer, (self.scene, self.camera), self.size, &settings)?;
        let seen = Seen::of(&shot.frame);
        let errors = Errors::between(&seen, &self.judge)?;
        let figure = figure(self.metric, &errors, &seen, &self.judge, self.is_whole);
        Ok(Tried { settings, errors, figure })
    }

    /// The cheapest settings that keep the limit: first the coarsest cut-off in f64, then f32 if it does as well, at
    /// last the least depth. The finest in f64 where none does.
    fn cheapest(
        &mut self,
        base: Settings,
        precisions: &[Precision],
        limit: f64,
    ) -> Result<Tried, StudyError> {
        let keeps = |tried: &Tried| tried.figure[1] <= limit;
        let last = precisions.last().copied().unwrap_or_default();
        let deep = Settings { depth: MAX_DEPTH, precision: last, ..base };
        let cut = |exponent: i32| Settings { cutoff: cutoff(exponent), ..deep };
        let (coarsest, finest) = (*CUTOFFS.start(), *CUTOFFS.end());
        let Some(mut chosen) = self.first(coarsest, finest, cut, keeps)? else {
            return self.try_out(cut(finest));
        };
        // f32 errs by itself, so that it may need a finer cut-off; it is worth that only once.
        for finer in [1.0, 0.5, 0.25] {
            let single = Settings {
                precision: Precision::F32,
                cutoff: chosen.settings.cutoff * finer,
                ..chosen.settings
            };
            if last == Precision::F32 || !precisions.contains(&Precision::F32) {
                break;
            }
            let tried = self.try_out(single)?;
            if keeps(&tried) {
                chosen = tried;
                break;
            }
        }
        let depth = |depth: i32| Settings { depth: depth.unsigned_abs(), ..chosen.settings };
        Ok(self.first(0, MAX_DEPTH as i32, depth, keeps)?.unwrap_or(chosen))
    }

    /// The most accurate settings that keep a time on the probe: for each precision the finest cut-off, of these the
    /// better one; the greatest depth at the coarsest cut-off where none does. And whether the time is kept.
    fn most_accurate<E: From<StudyError>>(
        &mut self,
        base: Settings,
        precisions: &[Precision],
        most: Duration,
        time: Clock<'_, E>,
    ) -> Result<(Tried, bool), E> {
        let (coarsest, finest) = (*CUTOFFS.start(), *CUTOFFS.end());
        let mut best: Option<Tried> = None;
        for &precision in precisions {
            let deep = Settings { depth: MAX_DEPTH, precision, ..base };
            let cut = |step: i32| Settings { cutoff: cutoff(finest - step), ..deep };
            // Counted from the finest, so that the first one that is fast enough is the best.
            let fitting = self.first_in_time(0, finest - coarsest, cut, most, time)?;
            let Some(settings) = fitting else { continue };
            let tried = self.try_out(settings)?;
            if best.as_ref().is_none_or(|best| tried.figure[0] < best.figure[0]) {
                best = Some(tried);
            }
        }
        if let Some(best) = best {
            return Ok((best, true));
        }
        let shallow = |step: i32| Settings {
            depth: MAX_DEPTH - step.unsigned_abs(),
            cutoff: cutoff(coarsest),
            precision: precisions.first().copied().unwrap_or_default(),
            ..base
        };
        let fitting = self.first_in_time(0, MAX_DEPTH as i32, shallow, most, time)?;
        let meets = fitting.is_some();
        Ok((self.try_out(fitting.unwrap_or_else(|| shallow(MAX_DEPTH as i32)))?, meets))
    }

    /// The first of a row of ever finer settings that holds, by bisection.
    fn first(
        &mut self,
        from: i32,
        to: i32,
        settings: impl Fn(i32) -> Settings,
        holds: impl Fn(&Tried) -> bool,
    ) -> Result<Option<Tried>, StudyError> {
        let (mut low, mut high, mut found) = (from, to + 1, None);
        while low < high {
            let middle = i32::midpoint(low, high);
            let tried = self.try_out(settings(middle.min(to)))?;
            if holds(&tried) {
                found = Some(tried);
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        Ok(found)
    }

    /// The first of a row of ever faster settings that keeps a time, by bisection.
    fn first_in_time<E>(
        &self,
        from: i32,
        to: i32,
        settings: impl Fn(i32) -> Settings,
        most: Duration,
        time: Clock<'_, E>,
    ) -> Result<Option<Settings>, E> {
        let (mut low, mut high, mut found) = (from, to + 1, None);
        while low < high {
            let middle = i32::midpoint(low, high);
            let tried = settings(middle.min(to));
            if time(self.size, &tried)? <= most {
                found = Some(tried);
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        Ok(found)
    }
}

/// Trace a probe.
fn shoot(
    renderer: &mut CpuRenderer,
    (scene, camera): (&FlatScene, &Camera),
    size: [u32; 2],
    settings: &Settings,
) -> Result<Shot, StudyError> {
    let view = view(camera, scene, size, None, settings);
    let frame = renderer.render(&view, settings, &())?;
    Ok(Shot { time: frame.times.trace, frame })
}

/// The picture's shape in about [`PROBE`] samples, but no more pixels than it has.
fn probe_size([width, height]: [u32; 2], samples: u32) -> [u32; 2] {
    let wanted = f64::from((PROBE / samples.max(1)).max(LEAST_PIXELS));
    let scale = (wanted / (f64::from(width) * f64::from(height))).sqrt().min(1.0);
    [width, height].map(|side| ((f64::from(side) * scale).round() as u32).max(1))
}

fn cutoff(exponent: i32) -> f32 {
    2.0_f32.powi(-exponent)
}

/// A figure of a picture, and what it is below with 95 % confidence if the probe's pixels are a random sample of the
/// picture's. Of a greatest error a sample says nothing more than itself.
fn figure(metric: Metric, errors: &Errors, seen: &Seen, judge: &Seen, is_whole: bool) -> [f64; 2] {
    match metric {
        Metric::Max => [errors.max; 2],
        Metric::DifferingPixels => {
            let differing = seen.clamped().iter().zip(judge.clamped()).filter(|(a, b)| **a != *b).count();
            [differing as f64; 2]
        }
        Metric::Flip => {
            let map = flip(&judge.clamped(), &seen.clamped(), seen.width as usize);
            let (mean, above) = mean_and_above(map.into_iter().map(f64::from), is_whole);
            [mean, above]
        }
        Metric::Rmse => {
            let square = |(a, b): ([f32; 3], [f32; 3])| {
                (0..3).map(|c| f64::from(a[c] - b[c]).powi(2)).sum::<f64>() / 3.0
            };
            let squares: Vec<_> = seen.clamped().into_iter().zip(judge.clamped()).map(square).collect();
            let (mean, above) = mean_and_above(squares.into_iter(), is_whole);
            [mean.sqrt(), above.sqrt()]
        }
    }
}

/// The mean of a sample, and what that of the whole is below with 95 % confidence: the end of the normal one-sided
/// interval, and what rare pixels may add. Events rarer than 3/n are missed by one sample of n in twenty (the rule of
/// three: Hanley and Lippman-Hand 1983, JAMA 249(13)); they are taken to be as bad as the worst that is there. A ray that
/// f32 sends another way is such an event.
fn mean_and_above(values: impl ExactSizeIterator<Item = f64> + Clone, is_whole: bool) -> (f64, f64) {
    let n = values.len().max(1) as f64;
    let mean = values.clone().sum::<f64>() / n;
    if is_whole {
        return (mean, mean);
    }
    let variance = values.clone().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
    let worst = values.fold(0.0, f64::max);
    (mean, mean + CONFIDENCE * (variance / n).sqrt() + 3.0 / n * worst)
}

#[cfg(test)]
mod tests {
    use super::super::metrics::tests::seen;
    use super::*;

    #[test]
    fn a_probe_keeps_the_shape_and_is_no_larger_than_the_picture() {
        assert_eq!(probe_size([1280, 720], 1), [171, 96]);
        assert_eq!(probe_size([64, 48], 1), [64, 48]);
        assert_eq!(probe_size([1280, 720], 64), [85, 48]);
        assert_eq!(probe_size([16384, 1], 1), [16384, 1]);
    }

    #[test]
    fn what_is_claimed_is_above_what_is_measured() {
        let (a, b) = (seen(&[0.5, 0.25, 0.0, 0.75]), seen(&[0.5, 0.5, 0.0, 0.75]));
        let errors = Errors::between(&a, &b).unwrap_or_default();
        let [mean, above] = figure(Metric::Rmse, &errors, &a, &b, false);
        assert!((mean - errors.rmse).abs() < 1e-9 && above > mean);
        assert_eq!(figure(Metric::Max, &errors, &a, &b, false), [0.25; 2]);
        // Nothing is missed where everything is seen.
        assert_eq!(figure(Metric::Rmse, &errors, &a, &b, true), [mean; 2]);
    }
}
