//! How the time of a trace grows with what is asked for.
//!
//! An [`Axis`] is one quantity, with a made scene in which nothing else changes; [`grow()`] traces its points in turn and
//! fits a power: time ∝ quantity^slope, a straight line where both are logarithmic.

mod axis;
mod fit;
mod measure;
mod scenes;

pub use axis::Axis;
pub use measure::{Growth, GrowthPoint, grow};
