//! All that is known of a picture's errors, and the cheapest settings that keep one.

use super::super::StudyError;
use super::estimate::{rest, together};
use super::pilot::{Pilot, Sampled};
use super::probe::{Probe, Tried};
use super::{Choice, Request};
use crate::film::Metric;
use crate::layout::{Precision, Settings};

/// Of an allowed RMSE, what truncation may take, and what f32 may: samples are what is dear, so they are left nearly all of
/// it, √(1 − 0.4² − 0.3²) = 0.87.
const RMSE_SHARES: [f64; 2] = [0.4, 0.3];
/// Of other figures, which add up in the worst case.
const OTHER_SHARES: [f64; 2] = [0.2, 0.2];
/// f32 errs by itself, so that it may need a finer cut-off; it is worth that only so far.
const FINER: [f32; 3] = [1.0, 0.5, 0.25];

/// The errors of a picture by their causes, as far as they have been asked for.
pub(super) struct Model<'a> {
    request: Request<'a>,
    metric: Metric,
    probe: Probe<'a>,
    /// Where samples are to be chosen.
    pilot: Option<Pilot<'a>>,
}

/// Settings, and what is estimated of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Picked {
    pub(super) settings: Settings,
    pub(super) figure: [f64; 2],
    pub(super) sampling: Option<[f64; 2]>,
    /// Samples of a pixel, the mean.
    pub(super) samples: f64,
    pub(super) meets: bool,
}

impl<'a> Model<'a> {
    pub(super) fn new(request: &Request<'a>, metric: Metric) -> Result<Self, StudyError> {
        let probe = Probe::new(request, metric)?;
        let pilot = if request.keeps_samples { None } else { Some(Pilot::new(request, metric)?) };
        Ok(Self { request: *request, metric, probe, pilot })
    }

    /// The cheapest settings that keep a limit with at most so many samples.
    pub(super) fn cheapest(&mut self, limit: f64, most_samples: u32) -> Result<Picked, StudyError> {
        match self.pilot.take() {
            None => self.cheapest_of_given_samples(limit),
            Some(mut pilot) => {
                let picked = self.cheapest_with_samples(&mut pilot, limit, most_samples);
                self.pilot = Some(pilot);
                picked
            }
        }
    }

    /// What is told of it.
    pub(super) fn choice(&self, picked: Picked) -> Choice {
        let Picked { settings, figure, sampling, samples, meets } = picked;
        Choice {
            settings,
            figure,
            sampling,
            samples,
            judge: self.probe.uncertainty.clone(),
            probed: self.probe.pixels() + self.pilot.as_ref().map_or(0, Pilot::pixels),
            tried: self.probe.tried() + self.pilot.as_ref().map_or(0, Pilot::tried),
            meets,
        }
    }

    fn can(&self, precision: Precision) -> bool {
        self.request.precisions.contains(&precision)
    }

    /// Truncation and precision share the whole limit: first the coarsest cut-off in the best precision, then f32 if it does
    /// as well.
    fn cheapest_of_given_samples(&mut self, limit: f64) -> Result<Picked, StudyError> {
        let best = if self.can(Precision::F64) { Precision::F64 } else { Precision::F32 };
        let mut chosen = self.probe.coarsest(best, limit)?;
        if best == Precision::F64 && self.can(Precision::F32) && chosen.figure[1] <= limit {
            for finer in FINER {
                let cutoff = chosen.settings.cutoff * finer;
                let single = Settings { precision: Precision::F32, cutoff, ..chosen.settings };
                let tried = self.probe.try_out(single)?;
                if tried.figure[1] <= limit {
                    chosen = self.probe.shallowest(tried, limit)?;
                    break;
                }
            }
        }
        Ok(Picked {
            settings: chosen.settings,
            figure: chosen.figure,
            sampling: None,
            samples: f64::from(self.request.base.samples),
            meets: chosen.figure[1] <= limit,
        })
    }

    /// A small share for truncation, judged in f64; then samples for what is left; then f32, if what it errs by beyond that
    /// is little enough in the mean of so many samples.
    fn cheapest_with_samples(
        &mut self,
        pilot: &mut Pilot<'a>,
        limit: f64,
        most_samples: u32,
    ) -> Result<Picked, StudyError> {
        let shares = if self.metric == Metric::Rmse { RMSE_SHARES } else { OTHER_SHARES };
        let [for_truncation, for_single] = shares.map(|share| share * limit);
        let cut = self.probe.coarsest(Precision::F64, for_truncation)?;
        let single = self.probe.try_out(Settings { precision: Precision::F32, ..cut.settings })?;
        let left = rest(self.metric, limit, &[cut.figure[1], for_single]);
        let sampled = pilot.cheapest(left, most_samples)?;
        let combined = |precision: f64, at: usize| {
            together(self.metric, &[cut.figure[at], precision, sampled.figure[at]])
        };
        let noise = |at| self.noise(&cut, &single, &sampled, at);
        let in_single = [0, 1].map(|at| combined(noise(at), at));
        let in_double = [0, 1].map(|at| combined(0.0, at));
        let takes_single = self.can(Precision::F32) && (in_single[1] <= limit || !self.can(Precision::F64));
        let figure = if takes_single { in_single } else { in_double };
        let precision = if takes_single { Precision::F32 } else { Precision::F64 };
        let Sampled { samples, adaptive, mean, .. } = sampled;
        Ok(Picked {
            settings: Settings { precision, samples, adaptive, ..cut.settings },
            figure,
            sampling: Some(sampled.figure),
            samples: mean,
            meets: figure[1] <= limit,
        })
    }

    /// What f32 adds in the mean of the samples. It sends some rays another way, each for itself: the mean of n errs by the
    /// n-th part of the square.
    fn noise(&self, cut: &Tried, single: &Tried, sampled: &Sampled, at: usize) -> f64 {
        rest(self.metric, single.figure[at], &[cut.figure[at]]) * sampled.inverse.sqrt()
    }
}
