//! What depth, cut-off and precision cost in accuracy: the picture in fewer pixels, held against its whole tree in f64.

use std::collections::HashMap;
use std::time::Duration;

use super::super::StudyError;
use super::super::lab::Shot;
use super::super::metrics::Seen;
use super::super::plan::Setup;
use super::super::reference::{Reference, Uncertainty, whole};
use super::Request;
use super::bisection::first;
use super::estimate::{figure, values};
use crate::cpu::CpuRenderer;
use crate::film::{Metric, Renderer};
use crate::flatten::view;
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{Precision, Settings};

/// Pixels times samples of a probe.
const PROBE: u32 = 16_384;
/// Least pixels of a probe.
const LEAST_PIXELS: u32 = 4_096;
/// The judge may take as long as this many probes of the coarsest candidate.
const JUDGE_PROBES: u32 = 60;
/// As which a probe counts that takes no time.
const LEAST_PROBE: Duration = Duration::from_millis(20);
/// Exponents of the coarsest and the finest cut-off.
const COARSEST: i32 = 4;
const FINEST: i32 = 24;

/// Settings on the probe.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tried {
    pub(super) settings: Settings,
    /// The figure, and what it is below with 95 % confidence.
    pub(super) figure: [f64; 2],
}

/// The picture in fewer pixels, a stratified sample of the errors of the whole one; with its judge.
pub(super) struct Probe<'a> {
    request: Request<'a>,
    size: [u32; 2],
    renderer: CpuRenderer<'a>,
    judge: Seen,
    pub(super) uncertainty: Uncertainty,
    metric: Metric,
    /// What it is of the picture: 1 where it has all pixels and their samples, else 0, for it has others.
    share: f64,
    /// By depth, bits of the cut-off, and precision.
    known: HashMap<(u32, u32, Precision), Tried>,
}

impl<'a> Probe<'a> {
    /// Trace the judge, as far as its time goes: the whole tree in f64 of the request's samples, of one where those are to
    /// be chosen. The mean of more errs no more than each of them; but they meet what the middle of a pixel does not, so that
    /// of a small picture more is probed than it has pixels.
    pub(super) fn new(request: &Request<'a>, metric: Metric) -> Result<Self, StudyError> {
        let mut request = *request;
        let (size, share) = if request.keeps_samples {
            let size = size_of(request.size, request.base.samples);
            (size, if size == request.size { 1.0 } else { 0.0 })
        } else {
            request.base = Settings { samples: 1, adaptive: None, ..request.base };
            (shape_of(request.size, PROBE), 0.0)
        };
        let base = request.base;
        let mut renderer = CpuRenderer::new(request.scene, 0)?;
        let mut shoot = |settings: &Settings| shoot(&mut renderer, &request, size, settings);
        let coarsest =
            Settings { depth: MAX_DEPTH, cutoff: cutoff(COARSEST), precision: Precision::F64, ..base };
        let coarse = shoot(&coarsest)?;
        let limit = coarse.time.max(LEAST_PROBE) * JUDGE_PROBES;
        let mut traced = |setup: &Setup, _| shoot(&setup.settings).map(Some);
        let judge = whole(&mut traced, base, &Seen::of(&coarse.frame), limit)?;
        let Some(Reference { seen, record }) = judge else {
            return Err(StudyError::TooSlow { seconds: limit.as_secs_f64() });
        };
        Ok(Self {
            share,
            request,
            size,
            renderer,
            judge: seen,
            uncertainty: record.uncertainty,
            metric,
            known: HashMap::new(),
        })
    }

    /// Pixels of the probe.
    pub(super) fn pixels(&self) -> usize {
        self.judge.radiance.len()
    }

    /// Settings that were tried.
    pub(super) fn tried(&self) -> usize {
        self.known.len()
    }

    /// Hold settings against the judge.
    pub(super) fn try_out(&mut self, settings: Settings) -> Result<Tried, StudyError> {
        let key = (settings.depth, settings.cutoff.to_bits(), settings.precision);
        if let Some(&known) = self.known.get(&key) {
            return Ok(known);
        }
        let shot = shoot(&mut self.renderer, &self.request, self.size, &settings)?;
        let values = values(self.metric, &Seen::of(&shot.frame), &self.judge);
        let tried = Tried { settings, figure: figure(self.metric, &values, self.share, true) };
        self.known.insert(key, tried);
        Ok(tried)
    }

    /// The coarsest cut-off that keeps a limit in that precision, then the least depth; the finest where none does.
    pub(super) fn coarsest(&mut self, precision: Precision, limit: f64) -> Result<Tried, StudyError> {
        let deep = Settings { depth: MAX_DEPTH, precision, ..self.request.base };
        let cut = |exponent: i32| Settings { cutoff: cutoff(exponent), ..deep };
        match first(
            [COARSEST, FINEST],
            |exponent| self.try_out(cut(exponent)),
            |tried| tried.figure[1] <= limit,
        )? {
            Some(cut) => self.shallowest(cut, limit),
            None => self.try_out(cut(FINEST)),
        }
    }

    /// The same with the least depth that keeps the limit.
    pub(super) fn shallowest(&mut self, tried: Tried, limit: f64) -> Result<Tried, StudyError> {
        let depth = |depth: i32| Settings { depth: depth.unsigned_abs(), ..tried.settings };
        let found =
            first([0, MAX_DEPTH as i32], |at| self.try_out(depth(at)), |tried| tried.figure[1] <= limit)?;
        Ok(found.unwrap_or(tried))
    }
}

/// Trace a probe.
fn shoot(
    renderer: &mut CpuRenderer<'_>,
    request: &Request<'_>,
    size: [u32; 2],
    settings: &Settings,
) -> Result<Shot, StudyError> {
    let view = view(request.camera, request.scene, size, None, settings);
    let frame = renderer.render(&view, settings, &())?;
    Ok(Shot { time: frame.times.trace, frame })
}

/// The picture's shape in about [`PROBE`] samples, but no more pixels than it has.
pub(super) fn size_of([width, height]: [u32; 2], samples: u32) -> [u32; 2] {
    let wanted = (PROBE / samples.max(1)).max(LEAST_PIXELS);
    if width * height <= wanted { [width, height] } else { shape_of([width, height], wanted) }
}

/// The picture's shape in about so many pixels.
fn shape_of(size: [u32; 2], pixels: u32) -> [u32; 2] {
    let [width, height] = size.map(f64::from);
    let scale = (f64::from(pixels) / (width * height)).sqrt();
    size.map(|side| ((f64::from(side) * scale).round() as u32).max(1))
}

fn cutoff(exponent: i32) -> f32 {
    2.0_f32.powi(-exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probe_keeps_the_shape_and_is_no_larger_than_the_picture() {
        assert_eq!(size_of([1280, 720], 1), [171, 96]);
        assert_eq!(size_of([64, 48], 1), [64, 48]);
        assert_eq!(size_of([1280, 720], 64), [85, 48]);
        assert_eq!(size_of([16384, 1], 1), [16384, 1]);
    }

    #[test]
    fn where_samples_are_chosen_a_small_picture_is_probed_in_more_pixels_than_it_has() {
        assert_eq!(shape_of([16, 12], PROBE), [148, 111]);
        assert_eq!(shape_of([1280, 720], PROBE), [171, 96]);
    }
}
