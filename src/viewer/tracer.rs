//! The thread that traces: always what was asked for last, coarse while that changes and fine when it rests.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::inbox::Inbox;
use super::scale::{Scale, scaled};
use super::stage::Stage;
use super::turntable::Turntable;
use super::worker::Worker;
use super::{Backend, TraceError};
use crate::flatten::view;
use crate::gpu::{Exposure, GpuError, SharedDevice, Source};
use crate::layout::{Settings, TreeNode, View};
use crate::scene::Camera;

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
    /// The shader files that an adapter traces by.
    pub shaders: &'static [Source<'static>],
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
    pub(super) fn size_at_rest(&self) -> [u32; 2] {
        match self.resolution {
            Resolution::Auto => self.size,
            Resolution::Every(side) => scaled(self.size, 1.0 / f64::from(side.max(1))),
        }
    }

    pub(super) fn size_in_motion(&self, scale: Scale) -> [u32; 2] {
        match self.resolution {
            Resolution::Auto => scale.of(self.size),
            Resolution::Every(_) => self.size_at_rest(),
        }
    }

    /// What the camera sees in a picture of this size, with so many samples.
    pub(super) fn view(&self, size: [u32; 2], settings: &Settings) -> View {
        view(&self.camera, &self.stage.flat.scene, size, None, settings)
    }

    /// Whether both ask for the same picture.
    #[must_use]
    pub fn is(&self, other: &Self) -> bool {
        self.is_of_same_view(other)
            && (self.settings, self.compares) == (other.settings, other.compares)
            && std::ptr::eq(self.shaders, other.shaders)
    }

    /// Whether both are of the same scene, camera and size on the same device: what differs are the settings.
    #[must_use]
    pub fn is_of_same_view(&self, other: &Self) -> bool {
        self.is_on(other)
            && (&self.camera, self.size, self.resolution) == (&other.camera, other.size, other.resolution)
    }

    /// Whether the same engine serves both.
    pub(super) fn is_on(&self, other: &Self) -> bool {
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
    /// Other shader files are in use, or cannot be compiled: then those before are.
    Shaders(Result<(), GpuError>),
    /// How far a turntable is.
    Turned {
        /// Pictures that are written.
        done: u32,
        /// All of them.
        of: u32,
        /// Where they are.
        folder: PathBuf,
    },
    /// A turntable that ends early.
    TurnedNoMore(String),
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

/// Handle of the thread; dropped, the thread ends.
pub struct Tracer {
    inbox: Arc<Inbox>,
    thread: Option<JoinHandle<()>>,
}

impl Tracer {
    /// Start the thread. What it traces lies on `device`, whichever backend traces; `say` is called from it.
    #[must_use]
    pub fn start(device: SharedDevice, say: impl Fn(Report) + Send + Sync + 'static) -> Self {
        let inbox = Arc::new(Inbox::default());
        let worker = Worker::new(Arc::clone(&inbox), device, Box::new(say));
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

    /// The window was painted, and the device has been told.
    pub fn note_paint(&self) {
        self.inbox.note_paint();
    }

    /// Trace the tree of a pixel of a picture at rest on the adapter, once there is time for it.
    pub fn ask(&self, wanted: Wanted, pixel: [u32; 2]) {
        self.inbox.lock().question = Some((wanted, pixel));
        self.inbox.changed.notify_one();
    }

    /// Trace and write pictures from round the target, whenever nothing else is to be traced.
    pub fn turn(&self, turntable: Turntable) {
        self.inbox.lock().turntable = Some(turntable);
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
