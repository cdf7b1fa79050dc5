//! The measured comparison behind `snellius bench`.
//!
//! A row compares ways to trace the same picture. [`take_turns`] runs them in turn, so that whatever else the machine does
//! meets all alike; [`Ratio`] is the median of their paired ratios with its 95 % interval. [`compare_devices`] is the
//! comparison of a machine's devices, [`compare_effects`] that of effect sets: neither has figures of a side whose picture
//! differs. [`grow()`] tells how times grow with a scene. [`rays`] is raw traversal.

mod device;
mod devices;
mod effects;
pub mod rays;
mod scale;
mod timing;

pub use device::{BenchError, Target, Tracer, cpu_instructions};
pub use devices::{
    BreakEven, ByKind, Change, Compared, Comparison, DeviceRow, Phases, Scaling, SceneRow, Verdict,
    compare_devices, compare_with,
};
pub use effects::{EffectRow, Sides, Stage, compare_effects, idle_effects};
pub use scale::{Axis, Growth, GrowthPoint, grow};
pub use timing::{Ratio, Spread, median, take_turns};
