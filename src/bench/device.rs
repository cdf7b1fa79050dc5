//! What a scene is measured on.

use std::io;
use std::path::Path;
use std::time::Duration;

use bytemuck::Zeroable;

use super::rays::RayError;
use crate::bvh::{self, Preset};
use crate::cpu::{CpuError, CpuRenderer, WideBvh};
use crate::film::{EncodeError, Frame, Progress, Renderer};
use crate::gpu::{AdapterReport, GpuError, GpuOptions, GpuRenderer};
use crate::layout::{FlatScene, Settings, Triangle, View};
use crate::scene::SceneError;

/// Why a comparison cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// The scene cannot be read or flattened.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The CPU cannot trace.
    #[error(transparent)]
    Cpu(#[from] CpuError),
    /// The adapter cannot trace.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// No folder can be made for what adapters compile.
    #[error("cannot make a folder for compiled pipelines: {0}")]
    Folder(io::Error),
    /// A picture cannot be made a file.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A mesh or a file of rays is not usable.
    #[error(transparent)]
    Rays(#[from] RayError),
}

/// The vector instructions that the CPU traces rays with.
#[must_use]
pub fn cpu_instructions() -> &'static str {
    // A tree of anything tells.
    let triangles = [Triangle::zeroed()];
    bvh::build(&triangles, Preset::Fast)
        .map_or("none", |tree| WideBvh::new(&tree.nodes, &triangles).instructions())
}

/// A device to measure.
#[derive(Debug, Clone)]
pub enum Target {
    /// So many threads; 0 for one a core.
    Cpu {
        /// Number of threads.
        threads: usize,
    },
    /// A Vulkan adapter.
    Adapter(Box<AdapterReport>),
}

impl Target {
    /// Make it ready for a scene.
    ///
    /// # Errors
    /// [`BenchError::Cpu`], [`BenchError::Gpu`].
    pub fn open<'a>(&self, scene: &'a FlatScene) -> Result<Tracer<'a>, BenchError> {
        self.open_keeping(scene, None)
    }

    /// The same with a folder in which an adapter keeps what it compiles.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_keeping<'a>(
        &self,
        scene: &'a FlatScene,
        pipelines: Option<&Path>,
    ) -> Result<Tracer<'a>, BenchError> {
        Ok(match self {
            Self::Cpu { threads } => Tracer::Cpu(CpuRenderer::new(scene, *threads)?),
            Self::Adapter(report) => {
                let options = GpuOptions {
                    adapter: Some(report.name.clone()),
                    pipeline_cache: pipelines.map(Path::to_path_buf),
                };
                Tracer::Gpu(Box::new(GpuRenderer::new(scene, &options)?))
            }
        })
    }

    /// The name for a table.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Cpu { threads: 0 } => "CPU, all threads".to_owned(),
            Self::Cpu { threads: 1 } => "CPU, 1 thread".to_owned(),
            Self::Cpu { threads } => format!("CPU, {threads} threads"),
            Self::Adapter(report) => {
                let software = if report.kind.is_real() { "" } else { " (software)" };
                format!("{}{software}", report.name)
            }
        }
    }
}

/// A device that is ready for a scene.
pub enum Tracer<'a> {
    /// Threads of the processor.
    Cpu(CpuRenderer<'a>),
    /// A Vulkan adapter.
    Gpu(Box<GpuRenderer>),
}

impl Tracer<'_> {
    /// From now on let an adapter measure its passes.
    pub(super) fn start_clock(&mut self) -> Result<(), BenchError> {
        match self {
            Self::Cpu(_) => Ok(()),
            Self::Gpu(renderer) => Ok(renderer.start_clock()?),
        }
    }

    /// What the adapter says that it traced the last picture in, if it has timestamps that run.
    pub(super) fn device_time(&self) -> Result<Option<Duration>, BenchError> {
        match self {
            Self::Cpu(_) => Ok(None),
            Self::Gpu(renderer) => Ok(renderer.device_time()?.filter(|time| !time.is_zero())),
        }
    }
}

impl Renderer for Tracer<'_> {
    type Error = BenchError;

    fn render(
        &mut self,
        view: &View,
        settings: &Settings,
        progress: &dyn Progress,
    ) -> Result<Frame, BenchError> {
        Ok(match self {
            Self::Cpu(renderer) => renderer.render(view, settings, progress)?,
            Self::Gpu(renderer) => renderer.render(view, settings, progress)?,
        })
    }
}
