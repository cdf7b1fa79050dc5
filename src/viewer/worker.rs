//! What the tracer's thread does: coarse pictures while requests come, fine ones when they rest.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::engine::{CpuEngine, Engine, Followed, GpuEngine};
use super::inbox::{Inbox, Request, Task};
use super::scale::{Scale, TARGET};
use super::stage::Stage;
use super::tracer::{Kind, Report, Resolution, Traced, Wanted};
use super::turntable::Turntable;
use super::{Backend, TraceError};
use crate::gpu::{Exposure, GpuRenderer, SharedDevice, Source};
use crate::layout::{Settings, View};

/// How long nothing changes until a picture is refined.
const REST: Duration = Duration::from_millis(80);
/// How often a picture in work is shown.
const SHOW: Duration = Duration::from_millis(120);
/// How soon a moving picture is shown in part where the device cannot trace the smallest one in its time.
const SHOW_IN_MOTION: Duration = Duration::from_millis(12);

/// How long a picture in motion waits for the window to show what there is of it.
const PAINT: Duration = Duration::from_millis(40);

/// Settings of pictures in motion: those at rest, so that one pipeline serves both, but for what needs many samples.
fn in_motion(settings: &Settings) -> Settings {
    Settings { adaptive: None, ..*settings }
}

pub(super) struct Worker {
    inbox: Arc<Inbox>,
    device: SharedDevice,
    say: Box<dyn Fn(Report) + Send + Sync>,
    scale: Scale,
    /// Of which scene's file on which device the scale is.
    scaled: Option<(PathBuf, Backend)>,
    /// Shader files that could not be compiled.
    refused: Option<&'static [Source<'static>]>,
    /// Pictures that are traced while nothing else is.
    turntable: Option<Turntable>,
    /// What the engine in use was made for.
    serves: Option<Wanted>,
}

impl Worker {
    pub(super) fn new(
        inbox: Arc<Inbox>,
        device: SharedDevice,
        say: Box<dyn Fn(Report) + Send + Sync>,
    ) -> Self {
        Self {
            inbox,
            device,
            say,
            scale: Scale::default(),
            scaled: None,
            refused: None,
            turntable: None,
            serves: None,
        }
    }

    pub(super) fn run(mut self) {
        let mut gpu: Option<(Arc<Stage>, GpuRenderer)> = None;
        let mut next = self.first();
        while let Some(request) = next {
            let stage = Arc::clone(&request.wanted.stage);
            let served = match request.wanted.backend {
                Backend::Gpu => {
                    // Of another scene only what is compiled is of use.
                    let renderer = match gpu.take() {
                        Some((of, renderer)) if Arc::ptr_eq(&of, &stage) => Ok(renderer),
                        Some((_, mut renderer)) => {
                            renderer.show(&stage.flat.scene).map(|()| renderer).map_err(TraceError::Gpu)
                        }
                        None => GpuRenderer::on(&self.device, &stage.flat.scene).map_err(TraceError::Gpu),
                    };
                    renderer.and_then(|renderer| {
                        let mut engine = GpuEngine::new(renderer);
                        let next = self.serve(&mut engine, request);
                        gpu = Some((stage, engine.into_renderer()));
                        next
                    })
                }
                Backend::Cpu { threads } => CpuEngine::new(&stage.flat.scene, threads, &self.device)
                    .and_then(|mut engine| self.serve(&mut engine, request)),
            };
            next = served.unwrap_or_else(|error| {
                gpu = None;
                (self.say)(Report::Failed(error));
                self.first()
            });
        }
    }

    /// The next request while there is no engine to answer questions.
    fn first(&self) -> Option<Request> {
        loop {
            match self.inbox.wait(None)? {
                Task::Trace(request) => return Some(request),
                Task::Answer(..) | Task::Turn(_) => {}
            }
        }
    }

    /// The next request; none at the end, or when `patience` is over. Questions are answered on the way, and pictures
    /// from round the target traced.
    fn next(
        &mut self,
        engine: &mut dyn Engine,
        patience: Option<Duration>,
    ) -> Result<Option<Request>, TraceError> {
        loop {
            match self.inbox.wait(patience) {
                None => return Ok(None),
                Some(Task::Trace(request)) => return Ok(Some(request)),
                Some(Task::Answer(wanted, pixel)) => {
                    let view = wanted.view(wanted.size, &wanted.settings);
                    if let Some((nodes, is_strict)) = engine.tree(&view, &wanted.settings, pixel)? {
                        (self.say)(Report::Tree { pixel, nodes, is_strict });
                    }
                }
                Some(Task::Turn(turntable)) => {
                    self.turntable = Some(turntable);
                    self.turn(engine)?;
                }
            }
        }
    }

    /// Trace requests of one scene on one device; returns the first of another.
    fn serve(&mut self, engine: &mut dyn Engine, first: Request) -> Result<Option<Request>, TraceError> {
        let backend = first.wanted.clone();
        // Another scene takes another time; not one whose lights and materials are edited.
        let scaled = Some((backend.stage.path.clone(), backend.backend));
        if self.scaled != scaled {
            (self.scale, self.scaled) = (Scale::default(), scaled);
        }
        self.serves = Some(backend.clone());
        let mut request = first;
        loop {
            self.take_shaders(engine, &request);
            self.settle(engine, &request)?;
            self.trace_in_motion(engine, &request)?;
            let next = match self.next(engine, Some(REST))? {
                Some(next) => Some(next),
                None => {
                    self.trace_at_rest(engine, &request)?;
                    self.turn(engine)?;
                    self.next(engine, None)?
                }
            };
            match next {
                Some(next) if next.wanted.is_on(&backend) => request = next,
                other => return Ok(other),
            }
        }
    }

    /// Trace by the request's shader files from now on; where they cannot be compiled, by those before.
    fn take_shaders(&mut self, engine: &mut dyn Engine, request: &Request) {
        let shaders = request.wanted.shaders;
        if self.refused.is_some_and(|refused| std::ptr::eq(refused, shaders)) || engine.has_shaders(shaders) {
            return;
        }
        (self.say)(Report::Compiling(true));
        let taken = engine.take_shaders(shaders, &request.wanted.settings);
        (self.say)(Report::Compiling(false));
        self.refused = taken.is_err().then_some(shaders);
        (self.say)(Report::Shaders(taken));
    }

    /// See that a pipeline is there which serves the request, unless another comes before.
    fn settle(&self, engine: &mut dyn Engine, request: &Request) -> Result<(), TraceError> {
        let rest = request.wanted.settings;
        for settings in [in_motion(&rest), rest] {
            if engine.is_ready(&settings) {
                continue;
            }
            (self.say)(Report::Compiling(true));
            while !engine.prepare(&settings)? && self.inbox.serial() == request.serial {
                thread::sleep(Duration::from_millis(5));
            }
            (self.say)(Report::Compiling(false));
        }
        Ok(())
    }

    /// One sample of as many pixels as there is time for.
    fn trace_in_motion(&mut self, engine: &mut dyn Engine, request: &Request) -> Result<(), TraceError> {
        let wanted = &request.wanted;
        let settings = in_motion(&wanted.settings);
        if !engine.is_ready(&settings) {
            return Ok(());
        }
        let size = engine.fitting(wanted.size_in_motion(self.scale), &settings)?;
        let view = View { samples: 1, ..wanted.view(size, &settings) };
        // What comes within its time is not torn.
        let patience = if self.scale.is_late() { SHOW_IN_MOTION } else { TARGET };
        let start = Instant::now();
        let show = shows(patience, |exposure| {
            let kind = if exposure.is_complete() { Kind::Motion } else { Kind::Growing };
            self.inbox.have_painted(PAINT, || self.tell(exposure.clone(), request, kind));
        });
        let listen = |exposure: Option<&Exposure>| {
            show(exposure);
            if start.elapsed() < patience { ControlFlow::Continue(()) } else { self.goes_on(request.serial) }
        };
        let Followed { share, time, whole } = engine.follow(&view, &settings, &listen)?;
        drop(show);
        if wanted.resolution == Resolution::Auto && share > 0.0 {
            self.scale.took(wanted.size, time.div_f64(share));
        }
        if let Some(exposure) = whole {
            self.tell(exposure, request, Kind::Motion);
        }
        Ok(())
    }

    /// The whole picture, shown as it grows, until something else is asked for.
    fn trace_at_rest(&self, engine: &mut dyn Engine, request: &Request) -> Result<(), TraceError> {
        let wanted = &request.wanted;
        engine.rest();
        if !engine.is_ready(&wanted.settings) {
            return Ok(());
        }
        let size = engine.fitting(wanted.size_at_rest(), &wanted.settings)?;
        let show = shows(SHOW, |exposure| self.tell(exposure.clone(), request, Kind::Growing));
        let listen = |exposure: Option<&Exposure>| {
            let flow = self.goes_on(request.serial);
            if flow == ControlFlow::Continue(()) {
                show(exposure.filter(|exposure| !exposure.is_complete()));
            }
            flow
        };
        let view = wanted.view(size, &wanted.settings);
        if let Some(exposure) = engine.expose(&view, &wanted.settings, &listen)? {
            self.tell(exposure, request, Kind::Complete);
            self.compare(request, size)?;
            engine.prepare_for_changes(&wanted.settings);
        }
        Ok(())
    }

    /// Whether nothing else was asked for since that request.
    fn goes_on(&self, serial: u64) -> ControlFlow<()> {
        if self.inbox.serial() == serial { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    /// The finished picture once more, by the CPU, if that is asked for.
    fn compare(&self, request: &Request, size: [u32; 2]) -> Result<(), TraceError> {
        let wanted = &request.wanted;
        if !wanted.compares {
            return Ok(());
        }
        let mut engine = CpuEngine::new(&wanted.stage.flat.scene, wanted.threads, &self.device)?;
        let listen = |_: Option<&Exposure>| self.goes_on(request.serial);
        if let Some(exposure) =
            engine.expose(&wanted.view(size, &wanted.settings), &wanted.settings, &listen)?
        {
            self.tell(exposure, request, Kind::Reference);
        }
        Ok(())
    }

    /// Trace and write pictures from round the target, until all are there or something else is asked for.
    fn turn(&mut self, engine: &mut dyn Engine) -> Result<(), TraceError> {
        let serial = self.inbox.serial();
        while let Some(mut turntable) = self.turntable.take() {
            let Some(camera) = turntable.camera().filter(|_| !turntable.is_stopped()) else { break };
            let wanted = Wanted { camera, ..turntable.wanted.clone() };
            if !self.serves.as_ref().is_some_and(|serves| wanted.is_on(serves)) {
                (self.say)(Report::TurnedNoMore("the scene or its device is another by now".to_owned()));
                break;
            }
            let listen = |_: Option<&Exposure>| {
                if turntable.is_stopped() { ControlFlow::Break(()) } else { self.goes_on(serial) }
            };
            let size = engine.fitting(wanted.size_at_rest(), &wanted.settings)?;
            let view = wanted.view(size, &wanted.settings);
            let Some(exposure) = engine.expose(&view, &wanted.settings, &listen)? else {
                // Once more when that is done.
                self.turntable = Some(turntable).filter(|turntable| !turntable.is_stopped());
                break;
            };
            let frame = exposure.frame(&self.device)?;
            match turntable.write(&frame) {
                Ok(done) => {
                    let (of, folder) = (turntable.pictures, turntable.folder.clone());
                    (self.say)(Report::Turned { done, of, folder });
                    self.turntable = Some(turntable);
                }
                Err(message) => (self.say)(Report::TurnedNoMore(message)),
            }
        }
        Ok(())
    }

    fn tell(&self, exposure: Exposure, request: &Request, kind: Kind) {
        let traced = Traced { exposure, serial: request.serial, kind, age: request.since.elapsed() };
        (self.say)(Report::Traced(traced));
    }
}

/// Calls `tell` with what there is of a picture: when the first time is over, then again and again.
fn shows<'a>(
    first: Duration,
    tell: impl Fn(&Exposure) + Sync + 'a,
) -> impl Fn(Option<&Exposure>) + Sync + 'a {
    let next = Mutex::new(Instant::now() + first);
    move |exposure| {
        let mut next = next.lock().unwrap_or_else(PoisonError::into_inner);
        let has_begun = |one: &&Exposure| one.blocks + one.passes > 0;
        if let Some(exposure) = exposure.filter(has_begun)
            && Instant::now() >= *next
        {
            *next = Instant::now() + SHOW;
            tell(exposure);
        }
    }
}
