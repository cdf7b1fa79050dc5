//! The measured comparison behind `snellius bench`.
//!
//! A row compares two ways to trace the same picture on one device. [`interleave`] runs both in turn, so that whatever
//! else the machine does meets both alike; [`Ratio`] is the median of their paired ratios with its 95 % interval.
//! [`compare_effects`] is the comparison of effect sets: it returns no figures where the pictures differ. [`rays`] is raw
//! traversal.

mod device;
mod effects;
pub mod rays;
mod timing;

pub use device::{BenchError, Target, Tracer};
pub use effects::{EffectRow, Sides, Stage, compare_effects, idle_effects};
pub use timing::{Ratio, interleave, median, take_turns};
