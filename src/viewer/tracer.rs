//! The thread that traces: always what was asked for last, coarse while that changes and fine when it rests.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::engine::{CpuEngine, Engine, GpuEngine};
use super::scale::{Scale, scaled};
use super::stage::Stage;
use super::{Backend, TraceError};
use crate::flatten::view;
use crate::gpu::{Exposure, GpuRenderer, SharedDevice};
use crate::layout::{Settings, TreeNode, View};
use crate::scene::Camera;

/// How long nothing changes until a picture is refined.
const REST: Duration = Duration::from_millis(80);
/// How often a picture in work is shown.
const SHOW: Duration = Duration::from_millis(120);

/// What is to be traced.
#[derive(Debug, Clone)]
pub struct Wanted {
    /// The scene.
    pub stage: Arc<Stage>,
    /// Seen from here.
    pub camera: Camera,
    /// Size of the picture at rest in pixels.
    pub size: [u32; 2],
    /// How.
    pub settings: Settings,
    /// By which device.
    pub backend: Backend,
    /// Threads of the CPU; 0 for one each core.
    pub threads: usize,
    /// How many pixels.
    pub resolution: Resolution,
    /// Whether the CPU is to trace the finished picture too.
    pub compares: bool,
}

/// How many pixels are traced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Resolution {
    /// As many as keep a frame within its time while something changes, all at rest.
    #[default]
    Auto,
    /// One for so many pixels of the window along each side, always.
    Every(u32),
}

impl Wanted {
    fn size_at_rest(&self) -> [u32; 2] {
        match self.resolution {
            Resolution::Auto => self.size,
            Resolution::Every(side) => scaled(self.size, 1.0 / f64::from(side.max(1))),
        }
    }

    fn size_in_motion(&self, scale: Scale) -> [u32; 2] {
        match self.resolution {
            Resolution::Auto => scale.of(self.size),
            Resolution::Every(_) => self.size_at_rest(),
        }
    }

    /// What the camera sees in a picture of this size, with so many samples.
    fn view(&self, size: [u32; 2], settings: &Settings) -> View {
        view(&self.camera, &self.stage.flat.scene, size, None, settings)
    }

    /// Whether both ask for the same picture.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        self.is_of_same_view(other) && self.settings == other.settings && self.compares == other.compares
    }

    /// Whether both are of the same scene, camera and size on the same device: what differs are the settings.
    #[must_use]
    pub fn is_of_same_view(&self, other: &Self) -> bool {
        self.is_on(other)
            && (&self.camera, self.size, self.resolution) == (&other.camera, other.size, other.resolution)
    }

    /// Whether the same engine serves both.
    fn is_on(&self, other: &Self) -> bool {
        self.backend == other.backend && Arc::ptr_eq(&self.stage, &other.stage)
    }
}

/// What the thread says.
pub enum Report {
    /// A picture, or what there is of it.
    Traced(Traced),
    /// A pipeline is compiled; the pictures wait for it, or come from a general one.
    Compiling(bool),
    /// There will be no picture of what was asked for.
    Failed(TraceError),
    /// The tree of a pixel, as the adapter traces it.
    Tree {
        /// The pixel.
        pixel: [u32; 2],
        /// Its rays in the order of tracing.
        nodes: Vec<TreeNode>,
        /// Whether they are to be the CPU's bit for bit.
        is_strict: bool,
    },
}

/// A picture, or what there is of it.
pub struct Traced {
    /// The film.
    pub exposure: Exposure,
    /// Of which request.
    pub serial: u64,
    /// Whether it is what was asked for, or quick and coarse.
    pub kind: Kind,
    /// From the request until now.
    pub age: Duration,
}

/// What a picture is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// One sample, of as many pixels as there is time for.
    Motion,
    /// At rest, with more to come.
    Growing,
    /// At rest, and complete.
    Complete,
    /// The same by the CPU, to compare with.
    Reference,
}

/// Settings of pictures in motion: those at rest, so that one pipeline serves both, but for what needs many samples.
fn in_motion(settings: &Settings) -> Settings {
    Settings { adaptive: None, ..*settings }
}

/// Handle of the thread; dropped, the thread ends.
pub struct Tracer {
    inbox: Arc<Inbox>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Inbox {
    letter: Mutex<Letter>,
    changed: Condvar,
    /// Of the last request.
    serial: AtomicU64,
}

#[derive(Default)]
struct Letter {
    wanted: Option<(Wanted, Instant)>,
    /// A pixel whose tree is asked for, of this picture.
    question: Option<(Wanted, [u32; 2])>,
    quits: bool,
}

impl Tracer {
    /// Start the thread. What it traces lies on `device`, whichever backend traces; `say` is called from it.
    #[must_use]
    pub fn start(device: SharedDevice, say: impl Fn(Report) + Send + Sync + 'static) -> Self {
        let inbox = Arc::new(Inbox::default());
        let worker =
            Worker { inbox: Arc::clone(&inbox), device, say: Box::new(say), scale: Scale::default() };
        Self { inbox, thread: Some(thread::spawn(move || worker.run())) }
    }

    /// Trace this from now on; returns the request's number.
    pub fn want(&self, wanted: Wanted) -> u64 {
        let mut letter = self.inbox.lock();
        letter.wanted = Some((wanted, Instant::now()));
        let serial = self.inbox.serial.fetch_add(1, Ordering::Release) + 1;
        self.inbox.changed.notify_one();
        serial
    }
}

impl Tracer {
    /// Trace the tree of a pixel of a picture at rest on the adapter, once there is time for it.
    pub fn ask(&self, wanted: Wanted, pixel: [u32; 2]) {
        self.inbox.lock().question = Some((wanted, pixel));
        self.inbox.changed.notify_one();
    }
}

impl Drop for Tracer {
    fn drop(&mut self) {
        self.inbox.lock().quits = true;
        // Breaks off what is traced.
        self.inbox.serial.fetch_add(1, Ordering::Release);
        self.inbox.changed.notify_one();
        if let Some(thread) = self.thread.take() {
            // A panic there was printed there.
            let _ = thread.join();
        }
    }
}

impl Inbox {
    fn lock(&self) -> MutexGuard<'_, Letter> {
        self.letter.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn serial(&self) -> u64 {
        self.serial.load(Ordering::Acquire)
    }

    /// What is to be done next; none at the end, or when `patience` is over.
    fn wait(&self, patience: Option<Duration>) -> Option<Task> {
        let nothing_new =
            |letter: &mut Letter| letter.wanted.is_none() && letter.question.is_none() && !letter.quits;
        let letter = self.lock();
        let mut letter = match patience {
            None => self.changed.wait_while(letter, nothing_new).unwrap_or_else(PoisonError::into_inner),
            Some(patience) => {
                let waited = self.changed.wait_timeout_while(letter, patience, nothing_new);
                waited.unwrap_or_else(PoisonError::into_inner).0
            }
        };
        if letter.quits {
            return None;
        }
        if let Some((wanted, since)) = letter.wanted.take() {
            return Some(Task::Trace(Request { wanted, since, serial: self.serial() }));
        }
        letter.question.take().map(|(wanted, pixel)| Task::Answer(wanted, pixel))
    }
}

/// What the thread is to do.
enum Task {
    Trace(Request),
    /// Trace the tree of a pixel.
    Answer(Wanted, [u32; 2]),
}

/// A request, its time and its number.
struct Request {
    wanted: Wanted,
    since: Instant,
    serial: u64,
}

struct Worker {
    inbox: Arc<Inbox>,
    device: SharedDevice,
    say: Box<dyn Fn(Report) + Send + Sync>,
    scale: Scale,
}

impl Worker {
    fn run(mut self) {
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
                Task::Answer(..) => {}
            }
        }
    }

    /// The next request; none at the end, or when `patience` is over. Questions are answered on the way.
    fn next(
        &self,
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
            }
        }
    }

    /// Trace requests of one scene on one device; returns the first of another.
    fn serve(&mut self, engine: &mut dyn Engine, first: Request) -> Result<Option<Request>, TraceError> {
        let backend = first.wanted.clone();
        let mut request = first;
        loop {
            self.settle(engine, &request)?;
            self.trace_in_motion(engine, &request)?;
            let next = match self.next(engine, Some(REST))? {
                Some(next) => Some(next),
                None => {
                    self.trace_at_rest(engine, &request)?;
                    self.next(engine, None)?
                }
            };
            match next {
                Some(next) if next.wanted.is_on(&backend) => request = next,
                other => return Ok(other),
            }
        }
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
        let start = Instant::now();
        let view = View { samples: 1, ..wanted.view(size, &settings) };
        let exposure = engine.expose(&view, &settings, &|_| ControlFlow::Continue(()))?;
        if wanted.resolution == Resolution::Auto {
            self.scale.took(wanted.size, start.elapsed());
        }
        if let Some(exposure) = exposure {
            self.tell(exposure, request, Kind::Motion);
        }
        Ok(())
    }

    /// The whole picture, shown as it grows, until something else is asked for.
    fn trace_at_rest(&self, engine: &mut dyn Engine, request: &Request) -> Result<(), TraceError> {
        let wanted = &request.wanted;
        if !engine.is_ready(&wanted.settings) {
            return Ok(());
        }
        let size = engine.fitting(wanted.size_at_rest(), &wanted.settings)?;
        let shown = Mutex::new(Instant::now());
        let listen = |exposure: Option<&Exposure>| {
            if self.inbox.serial() != request.serial {
                return ControlFlow::Break(());
            }
            let mut shown = shown.lock().unwrap_or_else(PoisonError::into_inner);
            let something = |exposure: &&Exposure| exposure.blocks + exposure.passes > 0;
            if let Some(exposure) = exposure.filter(something)
                && shown.elapsed() > SHOW
            {
                *shown = Instant::now();
                self.tell(exposure.clone(), request, Kind::Growing);
            }
            ControlFlow::Continue(())
        };
        if let Some(exposure) =
            engine.expose(&wanted.view(size, &wanted.settings), &wanted.settings, &listen)?
        {
            self.tell(exposure, request, Kind::Complete);
            self.compare(request, size)?;
            engine.prepare_for_changes(&wanted.settings);
        }
        Ok(())
    }

    /// The finished picture once more, by the CPU, if that is asked for.
    fn compare(&self, request: &Request, size: [u32; 2]) -> Result<(), TraceError> {
        let wanted = &request.wanted;
        if !wanted.compares {
            return Ok(());
        }
        let mut engine = CpuEngine::new(&wanted.stage.flat.scene, wanted.threads, &self.device)?;
        let listen = |_: Option<&Exposure>| {
            if self.inbox.serial() == request.serial {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        if let Some(exposure) =
            engine.expose(&wanted.view(size, &wanted.settings), &wanted.settings, &listen)?
        {
            self.tell(exposure, request, Kind::Reference);
        }
        Ok(())
    }

    fn tell(&self, exposure: Exposure, request: &Request, kind: Kind) {
        let traced = Traced { exposure, serial: request.serial, kind, age: request.since.elapsed() };
        (self.say)(Report::Traced(traced));
    }
}
