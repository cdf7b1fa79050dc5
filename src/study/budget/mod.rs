//! Budgets: the cheapest settings that keep an error, or the most accurate ones that fit a time.
//!
//! The judge is the picture as it should be: the whole tree in f64 with samples without end. What is chosen keeps three
//! errors apart, for each has its own cure: what depth and cut-off leave out ([`Probe`]), the rays that f32 sends another
//! way, and what too few samples miss ([`Pilot`]). Where the samples are given, the judge is the whole tree in f64 of the
//! same ones.

mod bisection;
mod estimate;
mod model;
mod pilot;
mod probe;

use std::collections::HashMap;
use std::time::Duration;

use super::StudyError;
use super::reference::Uncertainty;
use crate::film::Metric;
use crate::layout::{FlatScene, Precision, Settings};
use crate::scene::Camera;

use model::{Model, Picked};

/// What a picture is to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// An error in linear RGB clamped to [0, 1].
    Error {
        /// The most that is allowed.
        limit: f64,
        /// Which figure: RMSE, greatest error or mean ꟻLIP.
        metric: Metric,
    },
    /// A time of tracing.
    Time(Duration),
}

/// The picture that settings are chosen for.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// What is traced.
    pub scene: &'a FlatScene,
    /// From where.
    pub camera: &'a Camera,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Everything that is not chosen.
    pub base: Settings,
    /// Whether samples and threshold of `base` stay: then the error is that against the same samples.
    pub keeps_samples: bool,
    /// What the device can compute in, the cheaper first.
    pub precisions: &'a [Precision],
}

/// What was chosen, and what is known of it.
#[derive(Debug, Clone)]
pub struct Choice {
    /// The settings to render with.
    pub settings: Settings,
    /// The figure of the goal's metric (RMSE for a time), and what it is below with 95 % confidence.
    pub figure: [f64; 2],
    /// The part of the figure that comes of too few samples, in the same form; `None` where the samples were given.
    pub sampling: Option<[f64; 2]>,
    /// Samples that a pixel is expected to take, the mean.
    pub samples: f64,
    /// How far the judge may be from the truth.
    pub judge: Uncertainty,
    /// Pixels on which settings were tried.
    pub probed: usize,
    /// Settings that were tried.
    pub tried: usize,
    /// Whether the goal is met, as far as the estimates tell.
    pub meets: bool,
}

/// Most samples that a budget asks for.
pub const MOST_SAMPLES: u32 = 16_384;
/// Of a time, what is aimed at: pictures take a little longer some times than others.
const TIME_MARGIN: f64 = 0.9;
/// Errors from 1 down to 2^-20 that a time is tried with: as many steps to a half.
const STEPS_TO_A_HALF: i32 = 2;
const FINEST_STEP: i32 = 20 * STEPS_TO_A_HALF;

/// Tells what the device that is to trace needs for a picture of a size with given settings.
type Clock<'a, E> = &'a mut dyn FnMut([u32; 2], &Settings) -> Result<Duration, E>;

/// Choose depth, cut-off, precision and, unless they are given, samples and threshold. `time` tells what the device that is
/// to trace needs for a picture of a size with given settings, and is only asked for [`Goal::Time`].
///
/// # Errors
/// [`StudyError::Cpu`], [`StudyError::TooSlow`] where not even a judge can be traced, and what `time` reports.
pub fn choose<E: From<StudyError>>(
    request: &Request<'_>,
    goal: Goal,
    time: Clock<'_, E>,
) -> Result<Choice, E> {
    let metric = match goal {
        Goal::Error { metric, .. } => metric,
        Goal::Time(_) => Metric::Rmse,
    };
    let mut model = Model::new(request, metric)?;
    let picked = match goal {
        Goal::Error { limit, .. } => model.cheapest(limit, MOST_SAMPLES)?,
        Goal::Time(most) => most_accurate(&mut model, request, most.mul_f64(TIME_MARGIN), time)?,
    };
    Ok(model.choice(picked))
}

/// The settings of the least error of which the cheapest settings fit a time; the coarsest there are where none fit.
fn most_accurate<E: From<StudyError>>(
    model: &mut Model<'_>,
    request: &Request<'_>,
    most: Duration,
    time: Clock<'_, E>,
) -> Result<Picked, E> {
    let error = |step: i32| 0.5_f64.powf(f64::from(step) / f64::from(STEPS_TO_A_HALF));
    let mut watch = Stopwatch { time, size: request.size, known: HashMap::new() };
    let coarsest = model.cheapest(error(0), 1)?;
    let least = watch.expected(&coarsest, request.keeps_samples)?;
    let (mut low, mut high) = (1, FINEST_STEP + 1);
    let mut best = Picked { meets: least <= most, ..coarsest };
    let most_samples = (most.as_secs_f64() / least.as_secs_f64().max(1e-9)) as u32;
    while best.meets && low < high {
        let middle = i32::midpoint(low, high);
        let picked = model.cheapest(error(middle), most_samples.clamp(1, MOST_SAMPLES))?;
        if picked.meets && watch.expected(&picked, request.keeps_samples)? <= most {
            best = picked;
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    Ok(best)
}

/// What the device was found to need.
struct Stopwatch<'a, E> {
    time: Clock<'a, E>,
    size: [u32; 2],
    /// By depth, bits of the cut-off, and precision.
    known: HashMap<(u32, u32, Precision), Duration>,
}

impl<E> Stopwatch<'_, E> {
    /// What the whole picture is expected to take: what a smaller one takes, for as many pixels and samples.
    fn expected(&mut self, picked: &Picked, keeps_samples: bool) -> Result<Duration, E> {
        let settings = picked.settings;
        let one = if keeps_samples { settings } else { Settings { samples: 1, adaptive: None, ..settings } };
        let size = probe::size_of(self.size, one.samples);
        let key = (one.depth, one.cutoff.to_bits(), one.precision);
        let taken = match self.known.get(&key) {
            Some(&taken) => taken,
            None => *self.known.entry(key).or_insert((self.time)(size, &one)?),
        };
        let pixels = |[w, h]: [u32; 2]| f64::from(w) * f64::from(h);
        let samples = if keeps_samples { 1.0 } else { picked.samples };
        Ok(taken.mul_f64(samples * pixels(self.size) / pixels(size)))
    }
}
