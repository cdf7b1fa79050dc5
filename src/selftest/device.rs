//! What a case may ask a device for.

use glam::DVec3;

use super::Stage;
use super::lockstep::Difference;
use crate::film::Frame;
use crate::layout::constants::BEND_LIMIT;
use crate::layout::{Precision, Settings};

/// A device that answers a case: the CPU in one precision, or a Vulkan adapter in one kind of float.
///
/// All inputs and answers are f32 or words: an f64 device widens and rounds once. Answers come in the order of the
/// queries.
pub trait Device {
    /// For the head of a column: `CPU f64`, `llvmpipe strict`.
    fn name(&self) -> &str;

    /// The arithmetic.
    fn precision(&self) -> Precision;

    /// Whether every operation is rounded as IEEE 754 says: the CPU, and strict adapters.
    fn is_exact(&self) -> bool;

    /// Half the distance from 1 to the next number: 2^-24 or 2^-53, 2^-23 where the driver may rewrite f32.
    fn roundoff(&self) -> f64;

    /// Follow straight rays from face to face.
    ///
    /// # Errors
    /// As the device's.
    fn walk(&mut self, stage: &Stage, rays: &[Walk]) -> Answered<Walked>;

    /// Leave faces, and look whether a ray meets what it has just left.
    ///
    /// # Errors
    /// As the device's.
    fn leave(&mut self, stage: &Stage, rays: &[Leave]) -> Answered<Left>;

    /// Follow one path each of reflected and refracted rays.
    ///
    /// # Errors
    /// As the device's.
    fn bend(&mut self, stage: &Stage, rays: &[Bend]) -> Answered<Bent>;

    /// Fresnel reflectance for (cosine, η) pairs; `None` where it is total.
    ///
    /// # Errors
    /// As the device's.
    fn fresnel(&mut self, inputs: &[[f32; 2]]) -> Answered<Option<f32>>;

    /// Compare every function of the kernel with the CPU's in f32, over so many inputs each: those that differ, the
    /// simplest first. The CPU is what others are compared with, and has none.
    ///
    /// # Errors
    /// As the device's.
    fn differences(&mut self, records: usize) -> Answered<Difference>;

    /// Trace a picture by the stage's camera. Depth, cut-off, samples and auxiliary pictures are as the settings say;
    /// precision, float and ray–triangle test are the device's own.
    ///
    /// # Errors
    /// As the device's.
    fn picture(&mut self, stage: &Stage, settings: &Settings) -> Result<Frame, DeviceError>;

    /// The same picture once for each way of sharing out the work, told in words: threads and tiles on the CPU, rests and
    /// bands on an adapter.
    ///
    /// # Errors
    /// As the device's.
    fn shared_out(&mut self, stage: &Stage, settings: &Settings) -> Answered<(String, Frame)>;
}

/// One answer a query.
pub type Answered<T> = Result<Vec<T>, DeviceError>;

/// A device does not answer.
#[derive(Debug, thiserror::Error)]
pub enum DeviceError {
    /// The CPU.
    #[error(transparent)]
    Cpu(#[from] crate::cpu::CpuError),
    /// The adapter.
    #[error(transparent)]
    Gpu(#[from] crate::gpu::GpuError),
    /// A scene that a case made is refused.
    #[error("a scene of the self-test is refused: {0}")]
    Scene(#[from] crate::scene::SceneError),
}

/// A straight ray through a scene: at each face it goes on behind it, as a refracted ray would leave it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walk {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Unit direction.
    pub direction: [f32; 3],
    /// Media mask at the origin.
    pub media: u32,
    /// Most faces to cross, ≤ 64.
    pub limit: u32,
}

/// What a straight ray met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walked {
    /// How it ended.
    pub escape: Escape,
    /// Faces crossed.
    pub faces: u32,
    /// Times that a face did not change its own body's bit: double hits of an edge, or missing ones.
    pub idle: u32,
    /// Media mask at the end.
    pub media: u32,
    /// Hash of the primitive ids in order.
    pub hash: u32,
    /// Primitive id of the first face, `NONE` where there is none.
    pub first: u32,
    /// Distance to the first face.
    pub distance: f32,
    /// Hit point on the first face, from barycentrics.
    pub point: [f32; 3],
}

/// How a straight ray ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Escape {
    /// It met nothing more.
    Free,
    /// The limit of faces was reached.
    Limit,
}

/// A ray that leaves a given point of a given face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leave {
    /// Primitive id of the face.
    pub id: u32,
    /// Barycentrics of the second and third corner.
    pub barycentrics: [f32; 2],
    /// Unit direction in which it was met: the side decides on which side it is left.
    pub arriving: [f32; 3],
    /// Unit direction in which it leaves.
    pub leaving: [f32; 3],
    /// Whether it goes on behind the face, or back from it.
    pub behind: bool,
}

/// Where a ray that left a face began, and what it met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Left {
    /// Start of the ray.
    pub origin: [f32; 3],
    /// Primitive id of the nearest face met, `NONE` for none: the face itself is a self-hit.
    pub met: u32,
    /// Distance to it.
    pub distance: f32,
}

/// A ray that goes on with one child at each surface it meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Unit direction.
    pub direction: [f32; 3],
    /// Media mask at the origin.
    pub media: u32,
    /// Bit k: go on with the reflected child of surface k, else with the refracted one; with the other where there is
    /// no such child.
    pub reflect: u32,
    /// Most surfaces to meet, ≤ [`Bend::LIMIT`].
    pub limit: u32,
}

impl Bend {
    /// Surfaces whose ids an answer holds.
    pub const LIMIT: u32 = BEND_LIMIT;

    /// A ray from the air that is refracted wherever it can be.
    #[must_use]
    pub fn through(origin: DVec3, direction: DVec3) -> Self {
        Self {
            origin: origin.as_vec3().to_array(),
            direction: direction.normalize().as_vec3().to_array(),
            media: 0,
            reflect: 0,
            limit: Self::LIMIT,
        }
    }

    /// A ray from the air that is reflected wherever it can be.
    #[must_use]
    pub fn back(origin: DVec3, direction: DVec3) -> Self {
        Self { reflect: u32::MAX, ..Self::through(origin, direction) }
    }
}

/// Where a bent ray went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bent {
    /// How it ended.
    pub end: Ending,
    /// Surfaces met: interfaces that change the medium, and opaque ones.
    pub surfaces: u32,
    /// Bit k: it was reflected at surface k.
    pub reflected: u32,
    /// Media mask at the end.
    pub media: u32,
    /// Primitive ids of the surfaces in order, then `NONE`.
    pub ids: [u32; BEND_LIMIT as usize],
    /// Where the last ray starts.
    pub origin: [f32; 3],
    /// Its unit direction.
    pub direction: [f32; 3],
    /// Its weight per channel: of every surface, and of every medium up to the last surface.
    pub weight: [f32; 3],
}

/// How a bent ray ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// It met nothing more.
    Free,
    /// The limit of surfaces was reached.
    Limit,
    /// The last surface has no children.
    Absorbed,
}
