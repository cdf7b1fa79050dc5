//! One device with a scene: what its start takes, and its pictures, each held against the judge's.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::bench::effects::{is_same, milliseconds};
use crate::bench::{BenchError, Phases, Stage, Target, Tracer, median};
use crate::film::{Frame, Renderer};
use crate::layout::{Settings, View};

/// What one picture took.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Run {
    /// By timestamps of the adapter where it has them, else by the host's clock.
    pub(super) trace: Duration,
    wait: Duration,
    readback: Duration,
    /// Whether the adapter's timestamps told.
    by_adapter: bool,
}

/// A device that is ready for a scene.
pub(super) struct Side<'a> {
    pub(super) target: &'a Target,
    tracer: Tracer<'a>,
    settings: Settings,
    start: Phases,
    runs: Vec<Run>,
}

impl<'a> Side<'a> {
    /// Make a device ready: an adapter twice, the second time with what the first left in the pipeline cache.
    pub(super) fn open(
        stage: &'a Stage,
        target: &'a Target,
        settings: Settings,
        pipelines: &Path,
    ) -> Result<Self, BenchError> {
        let (mut tracer, mut start) = make_ready(stage, target, &settings, pipelines)?;
        if let Target::Adapter(_) = target {
            // Its memory may be needed.
            drop(tracer);
            let (again, warm) = make_ready(stage, target, &settings, pipelines)?;
            (tracer, start.compile_warm) = (again, warm.compile_cold);
        }
        tracer.start_clock()?;
        Ok(Self { target, tracer, settings, start, runs: Vec::new() })
    }

    /// Threads of the CPU that it has; none of an adapter.
    pub(super) fn threads(&self) -> Option<usize> {
        match &self.tracer {
            Tracer::Cpu(renderer) => Some(renderer.threads()),
            Tracer::Gpu(_) => None,
        }
    }

    /// A picture and what it took.
    pub(super) fn trace(&mut self, view: &View) -> Result<(Frame, Run), BenchError> {
        let frame = self.tracer.render(view, &self.settings, &())?;
        let adapter = self.tracer.device_time()?;
        let host = frame.times.trace;
        let trace = adapter.unwrap_or(host);
        let run = Run {
            trace,
            wait: host.saturating_sub(trace),
            readback: frame.times.readback,
            by_adapter: adapter.is_some(),
        };
        Ok((frame, run))
    }

    /// Trace once more, and hold the picture against the judge's; nothing is noted of another one.
    pub(super) fn trace_as(&mut self, view: &View, judge: &Frame) -> Result<Option<Duration>, BenchError> {
        let (frame, run) = self.trace(view)?;
        if !is_same(&frame, judge) {
            return Ok(None);
        }
        self.runs.push(run);
        Ok(Some(run.trace))
    }

    /// Forget the first run.
    pub(super) fn forget_warm_up(&mut self) {
        self.runs.drain(..1.min(self.runs.len()));
    }

    /// Count milliseconds of reading the scene and of building its tree to its start.
    pub(super) fn add_preparation(&mut self, (load, bvh): (f64, f64)) {
        self.start.load += load;
        self.start.bvh += bvh;
    }

    /// The times of its traces.
    pub(super) fn traces(&self) -> Vec<Duration> {
        self.runs.iter().map(|run| run.trace).collect()
    }

    /// Whether all these are by timestamps of the adapter.
    pub(super) fn has_timestamps(&self) -> bool {
        self.runs.iter().all(|run| run.by_adapter)
    }

    /// Its start, and the medians of its runs.
    pub(super) fn phases(&self) -> Phases {
        let median_of = |part: fn(&Run) -> Duration| {
            milliseconds(median(&self.runs.iter().map(part).collect::<Vec<_>>()))
        };
        Phases {
            trace: median_of(|run| run.trace),
            wait: median_of(|run| run.wait),
            readback: median_of(|run| run.readback),
            ..self.start
        }
    }
}

/// Open a device and trace a few pixels: what that took before the first ray.
fn make_ready<'a>(
    stage: &'a Stage,
    target: &Target,
    settings: &Settings,
    pipelines: &Path,
) -> Result<(Tracer<'a>, Phases), BenchError> {
    let started = Instant::now();
    let mut tracer = target.open_keeping(&stage.scene, Some(pipelines))?;
    let opened = started.elapsed();
    let frame = tracer.render(&stage.glance, settings, &())?;
    let before_rays = started.elapsed().saturating_sub(opened + frame.times.trace + frame.times.readback);
    let phases = match tracer {
        // The CPU collapses the tree when it is first asked for a picture.
        Tracer::Cpu(_) => {
            Phases { open: milliseconds(opened), bvh: milliseconds(before_rays), ..Phases::default() }
        }
        Tracer::Gpu(_) => Phases {
            open: milliseconds(opened.saturating_sub(frame.times.upload)),
            upload: milliseconds(frame.times.upload),
            compile_cold: milliseconds(frame.times.compile),
            ..Phases::default()
        },
    };
    Ok((tracer, phases))
}
