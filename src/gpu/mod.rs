//! The Vulkan renderer: the shaders of `shaders/`, assembled for the scene and settings, on one adapter.
//!
//! [`assemble()`] joins shader files into one checked module; [`write_spirv()`] writes it, strict if asked; [`GpuRenderer`]
//! uploads a scene and traces it tile after tile, each submission short and each accounted for; [`Prober`] runs single
//! functions for the lock-step comparison with the CPU. Nothing here knows the CPU's kernel.
//!
//! **Rests.** An invocation counts the rounds of its loops. After a budget of them it rests between two rays, its tree in
//! the film buffer, and the next dispatch resumes it: no submission is long, however deep the tree. Loops within a
//! ray are not cut. Mesa's llvmpipe ends those, in silence, after 65535 rounds; a canary loop at the end of each
//! invocation tells, and the picture is refused.
//!
//! **f64.** WGSL's f64 has arithmetic, `sqrt`, `floor` and `abs`, and the kernel needs three functions more. exp is a
//! Taylor series in f64. Two go through f32: the power of the specular lobe, whose highlights are good to β·2^-24 of
//! their brightness, and the arctangent that finds a direction in a background picture, good to 2^-22 of a turn. On
//! lavapipe all the rest is the CPU's f64: without highlights the pictures are the same to the last bit of the film
//! but one, with those of `scenes/opaque.toml` to 7e-7, where f32 is off by 5e-6.

mod adapters;
mod adaptive;
mod assemble;
mod blocks;
mod buffers;
mod cache;
mod clock;
mod context;
mod error;
mod exposure;
mod film;
mod float_controls;
mod job;
mod locate;
mod pace;
mod pipeline;
mod pipelines;
mod portions;
mod probe;
mod quiet;
mod render;
mod rolling;
mod shared;
mod sources;
mod spirv;
mod testing;
mod tree;
mod variant;

use std::path::PathBuf;

pub use adapters::{AdapterKind, AdapterReport, adapters, instance};
pub use assemble::{Shader, Source, assemble};
pub use error::GpuError;
pub use exposure::{Exposure, Film, Watch};
pub use float_controls::{FloatControls, Promises};
pub use portions::Portions;
pub use probe::{Prober, Records};
pub use render::{GpuRenderer, InvocationMemory};
pub use rolling::Rolling;
pub use shared::SharedDevice;
pub use sources::{SOURCES, sources_in};
pub use spirv::write_spirv;
pub use tree::GpuTree;
pub use variant::Variant;

/// Which adapter to take.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Part of its name, in any case; without it `WGPU_ADAPTER_NAME` decides, else the best kind is taken.
    pub adapter: Option<String>,
    /// Folder that keeps compiled pipelines from one run to the next, if any. It is made where it is missing; faults with
    /// it are logged, and cost only the time to compile.
    pub pipeline_cache: Option<PathBuf>,
}
