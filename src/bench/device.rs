//! What a scene is measured on.

use super::rays::RayError;
use crate::cpu::{CpuError, CpuRenderer};
use crate::film::{Frame, Progress, Renderer};
use crate::gpu::{AdapterReport, GpuError, GpuOptions, GpuRenderer};
use crate::layout::{FlatScene, Settings, View};
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
    /// A mesh or a file of rays is not usable.
    #[error(transparent)]
    Rays(#[from] RayError),
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
        Ok(match self {
            Self::Cpu { threads } => Tracer::Cpu(CpuRenderer::new(scene, *threads)?),
            Self::Adapter(report) => {
                let options = GpuOptions { adapter: Some(report.name.clone()), ..GpuOptions::default() };
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
