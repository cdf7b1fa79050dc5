//! The orbit viewer: a window in which a scene turns under the mouse.
//!
//! Three parts, each of which knows little of the others. The [`Tracer`] is a thread that traces what was asked for last:
//! few pixels while that changes, all of them when it rests. [`Session`] is what the user has set, and the panels show
//! and change it; it needs no window, and tests drive it without one. The window itself runs egui over the session, asks
//! the tracer where something changed, and shows the films that come back: they stay on the device, where
//! [`Presenter`] reads them. Nothing is painted and nothing traced while nothing changes.

mod acts;
mod app;
mod canvas;
mod cost;
mod engine;
mod files;
mod frame;
mod groups;
mod inbox;
mod inspection;
mod look;
mod lost;
mod orbit;
mod orders;
mod panels;
mod picture;
mod play;
mod player;
mod present;
mod reels;
mod reports;
mod scale;
mod script;
mod session;
mod sight;
mod stage;
mod timings;
mod tracer;
mod turntable;
mod window;
mod worker;

use std::path::PathBuf;

use thiserror::Error;
use winit::error::EventLoopError;

pub use app::run;
pub use cost::Cost;
pub use inspection::{Comparison, Inspection};
pub use look::{Look, ViewKind};
pub use orbit::{Orbit, Side};
pub use present::{Presenter, Ranges};
pub use scale::{LEAST_SIDE, Scale, TARGET};
pub use script::{Event, Expectation, ScriptError, parse as parse_script};
pub use session::{Order, Session, Status, Toast};
pub use stage::Stage;
pub use timings::{AnswerTime, FrameTime, Timings};
pub use tracer::{Kind, Report, Resolution, Traced, Tracer, Wanted};
pub use turntable::{Turning, Turntable};

use crate::cpu::CpuError;
use crate::film::{EncodeError, OutputError};
use crate::gpu::{GpuError, GpuOptions};
use crate::layout::Settings;

/// Which device traces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Backend {
    /// The window's adapter.
    Gpu,
    /// rayon.
    Cpu {
        /// 0 for one each core.
        threads: usize,
    },
}

/// What to open, and how.
pub struct Options {
    /// The scene.
    pub stage: Stage,
    /// How to trace it.
    pub settings: Settings,
    /// By which device.
    pub backend: Backend,
    /// Threads for the CPU when it is chosen; 0 for one each core.
    pub threads: usize,
    /// Which adapter shows the window, and traces with [`Backend::Gpu`].
    pub gpu: GpuOptions,
    /// A folder of shader files that take the place of the program's own, and are compiled again when they change.
    pub shaders: Option<PathBuf>,
    /// Size of the picture beside the panel in pixels.
    pub size: [u32; 2],
    /// Write the window to a file and quit.
    pub screenshot: Option<Screenshot>,
    /// Play these events, with their lines in the file.
    pub script: Option<Script>,
}

/// Events to be played.
#[derive(Debug, Clone, PartialEq)]
pub struct Script {
    /// Where they come from, for messages.
    pub path: PathBuf,
    /// With their lines, from 1.
    pub events: Vec<(usize, Event)>,
}

/// A picture of the window.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Screenshot {
    /// A PNG file.
    pub path: PathBuf,
    /// Frames of the window before it is taken, beside that the picture is complete.
    pub frames: u32,
}

/// What the tracer could not do.
#[derive(Debug, Error)]
pub enum TraceError {
    /// On the CPU.
    #[error(transparent)]
    Cpu(#[from] CpuError),
    /// On an adapter.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// Why the viewer ended.
#[derive(Debug, Error)]
pub enum ViewerError {
    /// No display to open a window on.
    #[error("no window can be opened: {}", first_line(.0))]
    Display(EventLoopError),
    /// The system refuses the window.
    #[error("no window can be opened: {0}")]
    Window(#[from] winit::error::OsError),
    /// No Vulkan for this window.
    #[error("nothing can be shown on this window: {0}")]
    Surface(String),
    /// The adapter.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The CPU.
    #[error(transparent)]
    Cpu(#[from] CpuError),
    /// A folder without all shader files.
    #[error("--shaders: {0}")]
    Shaders(std::io::Error),
    /// A script's event has not the effect that it is to have.
    #[error("{}:{line}: {message}", path.display())]
    Script {
        /// The script.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// What is missing.
        message: String,
    },
    /// A picture cannot be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A picture cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl ViewerError {
    /// The program's exit code for this error: 1 for a script that fails, 3 without display or
    /// adapter, 4 for a device lost on the way, else 2.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Display(_) | Self::Window(_) | Self::Surface(_) => 3,
            Self::Gpu(error) => error.exit_code(),
            Self::Script { .. } => 1,
            Self::Cpu(_) | Self::Shaders(_) | Self::Encode(_) | Self::Output(_) => 2,
        }
    }

    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Display(_) | Self::Window(_) => Some(
                "`snellius render SCENE -o PICTURE.png` needs no display; on Linux DISPLAY or WAYLAND_DISPLAY names one",
            ),
            Self::Surface(_) | Self::Gpu(GpuError::NoAdapter { .. }) => Some(
                "the window itself needs a Vulkan driver, also with --backend cpu; `snellius render` needs none",
            ),
            _ => None,
        }
    }
}

impl From<TraceError> for ViewerError {
    fn from(error: TraceError) -> Self {
        match error {
            TraceError::Cpu(error) => Self::Cpu(error),
            TraceError::Gpu(error) => Self::Gpu(error),
        }
    }
}

/// The first line of a message.
fn first_line(error: &EventLoopError) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}
