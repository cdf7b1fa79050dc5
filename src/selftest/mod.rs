//! The hard cases, as data: the rays, pictures and numbers at which renderers of nested glass go wrong.
//!
//! A [`Case`] asks a [`Device`] for answers and returns [`Finding`]s: a figure each, with the bound that it must keep
//! and where that bound comes from. The same cases run on the CPU in f32 and f64 and on every Vulkan adapter, in the
//! tests and by `snellius selftest`. A planted fault must push at least one figure of its case over the bound
//! (tests/selftest).

mod agreement;
mod arithmetic;
mod case;
mod cases;
mod cpu;
mod device;
mod gpu;
pub mod lockstep;
mod paper;
mod paths;
mod props;
mod random;
mod rays;
pub mod solids;
mod stage;

pub use agreement::{Agreement, LEAST_EQUAL_F64, LEAST_EQUAL_FAST, greatest_difference};
pub use arithmetic::{Arithmetic, Operation, Rewrite};
pub use case::{Bound, Case, Effort, Finding, Verdict};
pub use cases::CASES;
pub use cpu::CpuDevice;
pub use device::{Answered, Bend, Bent, Device, DeviceError, Ending, Escape, Leave, Left, Walk, Walked};
pub use gpu::GpuDevice;
pub use random::Random;
pub use stage::Stage;
