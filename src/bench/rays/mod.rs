//! Raw traversal: rays against a mesh, without shading.
//!
//! [`RayStage`] is a mesh with its trees, [`RaySets`] the rays that a picture of it would trace, [`measure()`] times them
//! after holding every answer against the scalar kernel. Rays and answers can be written and read ([`read_rays`]), so that
//! any other engine can run the very same ones. [`FrameRays`] are those of a frame.

mod adapter;
mod frame;
mod host;
mod measure;
mod record;
mod sets;
mod stage;

pub use adapter::RayAdapter;
pub use frame::FrameRays;
pub use host::{Mode, Query, RayHost};
pub use measure::{Measured, RayRun, measure};
pub use record::{RayAnswer, RayError, RayRecord, read_answers, read_rays, write_answers, write_rays};
pub use sets::{RaySets, SIDE};
pub use stage::{Pinhole, RayStage, Trees};
