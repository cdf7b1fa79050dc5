//! The finished picture: film, tone mapping, PNG/EXR/HDR files, difference metrics.

mod frame;

pub use frame::{Frame, Progress, RayCounts, Renderer, TraceTimes};
