//! Scenes and devices that stay ready while rows take turns.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use super::plan::{Setup, Target};
use super::{Baseline, StudyError, Watch};
use crate::cpu::CpuRenderer;
use crate::film::{Frame, Progress, Renderer};
use crate::flatten::{Flattened, flatten, view};
use crate::gpu::{GpuOptions, GpuRenderer};
use crate::scene::Scene;

/// The scene with its built-in solids at one level.
pub(super) struct Subject {
    /// Levels above those of the file.
    pub(super) steps: i32,
    pub(super) scene: Scene,
    pub(super) flat: Flattened,
}

impl Subject {
    pub(super) fn load(path: &Path, steps: i32) -> Result<Self, StudyError> {
        let scene = Scene::load_refined(path, steps)?;
        let flat = flatten(&scene)?;
        Ok(Self { steps, scene, flat })
    }

    pub(super) fn triangles(&self) -> usize {
        self.flat.scene.triangles.len()
    }
}

/// A device with a scene on it.
enum Tracer<'a> {
    Cpu(CpuRenderer<'a>),
    Gpu(Box<GpuRenderer>),
}

/// A traced picture.
pub(super) struct Shot {
    pub(super) frame: Frame,
    /// Tracing and reading back; without compilation and upload, which happen once.
    pub(super) time: Duration,
}

/// Scenes and devices that stay ready while rows take turns.
pub(super) struct Lab<'a> {
    subjects: &'a [Subject],
    size: [u32; 2],
    tracers: HashMap<(i32, Target), Tracer<'a>>,
    watch: &'a dyn Watch,
}

impl<'a> Lab<'a> {
    pub(super) fn new(subjects: &'a [Subject], baseline: &Baseline, watch: &'a dyn Watch) -> Self {
        Self { subjects, size: baseline.size, tracers: HashMap::new(), watch }
    }

    /// Trace a picture; `None` if that took longer than the limit.
    pub(super) fn shoot(&mut self, setup: &Setup, limit: Duration) -> Result<Option<Shot>, StudyError> {
        let Some(subject) = self.subjects.iter().find(|subject| subject.steps == setup.steps) else {
            return Ok(None);
        };
        let (scene, watch, size) = (&subject.flat.scene, self.watch, self.size);
        let view = view(&subject.scene.camera, scene, size, None, &setup.settings);
        let tracer = self.tracer(setup, subject)?;
        let deadline = Deadline { watch, until: Instant::now() + limit };
        let frame = match tracer {
            Tracer::Cpu(renderer) => renderer.render(&view, &setup.settings, &deadline)?,
            Tracer::Gpu(renderer) => renderer.render(&view, &setup.settings, &deadline)?,
        };
        if watch.is_interrupted() {
            return Err(StudyError::Interrupted);
        }
        let time = frame.times.trace + frame.times.readback;
        Ok(frame.complete.then_some(Shot { frame, time }))
    }

    fn tracer(&mut self, setup: &Setup, subject: &'a Subject) -> Result<&mut Tracer<'a>, StudyError> {
        match self.tracers.entry((setup.steps, setup.target.clone())) {
            Entry::Occupied(open) => Ok(open.into_mut()),
            Entry::Vacant(place) => Ok(place.insert(Tracer::open(&setup.target, subject)?)),
        }
    }
}

impl<'a> Tracer<'a> {
    fn open(target: &Target, subject: &'a Subject) -> Result<Self, StudyError> {
        let scene = &subject.flat.scene;
        Ok(match target {
            Target::Cpu { threads } => Self::Cpu(CpuRenderer::new(scene, *threads)?),
            Target::Gpu { adapter } => {
                let options = GpuOptions { adapter: Some(adapter.clone()), ..GpuOptions::default() };
                Self::Gpu(Box::new(GpuRenderer::new(scene, &options)?))
            }
        })
    }
}

/// Stops a trace that takes too long, or that nobody waits for any more.
struct Deadline<'a> {
    watch: &'a dyn Watch,
    until: Instant,
}

impl Progress for Deadline<'_> {
    fn advance(&self, done: u64, total: u64) -> ControlFlow<()> {
        self.watch.tick();
        // The last tile's report must not throw a finished picture away.
        let late = done < total && Instant::now() >= self.until;
        if late || self.watch.is_interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
