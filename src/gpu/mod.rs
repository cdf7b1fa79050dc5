//! The Vulkan renderer: the shaders of `shaders/`, assembled for the scene and settings, on one adapter.
//!
//! [`assemble()`] joins shader files into one checked module; [`write_spirv()`] writes it, strict if asked; [`GpuRenderer`]
//! uploads a scene and traces it tile after tile, each submission short and each accounted for; [`Prober`] runs single
//! functions for the lock-step comparison with the CPU. Nothing here knows the CPU's kernel.

mod adapters;
mod assemble;
mod buffers;
mod context;
mod error;
mod film;
mod job;
mod locate;
mod pace;
mod pipeline;
mod probe;
mod render;
mod sources;
mod spirv;
#[cfg(test)]
mod testing;
mod variant;

pub use adapters::{AdapterKind, AdapterReport, adapters};
pub use assemble::{Shader, Source, assemble};
pub use error::GpuError;
pub use probe::Prober;
pub use render::GpuRenderer;
pub use sources::SOURCES;
pub use spirv::write_spirv;
pub use variant::Variant;

/// Which adapter to take.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Part of its name, in any case; without it `WGPU_ADAPTER_NAME` decides, else the best kind is taken.
    pub adapter: Option<String>,
}
