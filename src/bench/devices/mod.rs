//! The same scene on every device of a machine.
//!
//! [`compare_devices`] opens them, holds every picture against that of all threads of the CPU, and times them in turn; what
//! it tells is a [`SceneRow`]. [`compare_with`] holds rows against those of an earlier program or day.

mod baseline;
mod compare;
mod host;
mod phases;
pub(super) mod plan;
mod row;
mod side;

pub use baseline::{Change, Verdict, compare_with};
pub use compare::{Compared, Comparison, compare_devices};
pub use phases::{BreakEven, Phases};
pub use row::{ByKind, DeviceRow, Scaling, SceneRow};
