//! What a person writes: names, units, colours, files and decoded textures.
//!
//! [`Scene::load`] reads a TOML scene (or a bare OBJ) with everything it names, validates it, and
//! reports every fault with file, line, column and a hint. Nothing here knows buffers, ids or a device:
//! [`crate::flatten`] turns a [`Scene`] into what renderers read.

use std::path::PathBuf;
use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec2, DVec3};

mod camera;
mod code;
mod color;
mod default_view;
mod diagnostic;
mod document;
#[cfg(test)]
mod documentation;
mod error;
mod fault;
mod illumination;
mod limits;
mod load;
mod material;
mod model;
mod mtl;
mod normals;
mod number;
mod obj;
mod polygon;
mod shapes;
mod source;
mod statement;
mod surroundings;
mod table;
mod texture;
mod triple;

pub use color::linear_from_srgb8;
pub use diagnostic::{Diagnostic, Location, Severity};
pub use error::SceneError;
pub use limits::Limits;

/// A validated scene: every number finite and in range, every file read and decoded.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The file it came from.
    pub source: PathBuf,
    /// The mesh files that were read for it.
    pub meshes: Vec<PathBuf>,
    /// Where the picture is taken from.
    pub camera: Camera,
    /// Defaults for the command line's flags.
    pub render: RenderDefaults,
    /// Ia: linear RGB, colour × intensity.
    pub ambient: DVec3,
    /// What a ray that meets nothing sees.
    pub background: Background,
    /// Point lights, in file order.
    pub lights: Vec<Light>,
    /// Materials; [`Model::materials`] index into this list.
    pub materials: Vec<Material>,
    /// Decoded images; [`TextureId`]s index into this list.
    pub textures: Vec<Texture>,
    /// Bodies, in file order.
    pub models: Vec<Model>,
    /// What is legal but suspicious (an inside-out mesh is found later, by `flatten`).
    pub warnings: Vec<Diagnostic>,
}

/// A pinhole camera. `right`, `up` and `forward` are orthonormal, with `right × up = −forward`.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Position in scene units.
    pub eye: DVec3,
    /// Unit vector to the right of the picture.
    pub right: DVec3,
    /// Unit vector to the top of the picture.
    pub up: DVec3,
    /// Unit vector into the picture.
    pub forward: DVec3,
    /// Distance from the eye to the target, in scene units: the orbit viewer's pivot.
    pub target_distance: f64,
    /// Vertical field of view in degrees, in (0, 180).
    pub fov_y: f64,
}

impl Camera {
    /// The camera carried round the vertical axis through its target by so many degrees, counter-clockwise seen from above.
    #[must_use]
    pub fn turned(&self, degrees: f64) -> Self {
        let turn = DQuat::from_axis_angle(DVec3::Y, degrees.to_radians());
        let target = self.eye + self.forward * self.target_distance;
        Self {
            eye: target + turn * (self.eye - target),
            right: turn * self.right,
            up: turn * self.up,
            forward: turn * self.forward,
            ..self.clone()
        }
    }
}

/// The scene's own settings; the command line overrides each.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderDefaults {
    /// Width and height in pixels, each in 1..=16384.
    pub size: [u32; 2],
    /// The deepest ray that is traced, in 0..=64; the primary ray has depth 0.
    pub depth: u32,
    /// The least weight that is traced, in [0, 1].
    pub cutoff: f64,
    /// Samples per pixel, in 1..=65536.
    pub samples: u32,
    /// Threshold of adaptive antialiasing in [0, 1], or none: every pixel gets all samples.
    pub adaptive: Option<f64>,
}

impl Default for RenderDefaults {
    fn default() -> Self {
        Self { size: [1280, 720], depth: 16, cutoff: 1e-4, samples: 4, adaptive: None }
    }
}

/// Radiance from infinity, linear RGB.
#[derive(Debug, Clone, PartialEq)]
pub enum Background {
    /// The same in every direction.
    Color(DVec3),
    /// `horizon + (zenith − horizon)·clamp(d.y, 0, 1)`.
    Gradient {
        /// Straight up.
        zenith: DVec3,
        /// At and below the horizon.
        horizon: DVec3,
    },
    /// An equirectangular picture: +Y up, its centre towards −Z, +X to the right of that.
    Image {
        /// The picture.
        texture: TextureId,
        /// Rotation about +Y in degrees.
        rotation_y: f64,
        /// Factor on the picture's radiance, ≥ 0.
        intensity: f64,
    },
}

/// A point light.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Position in scene units.
    pub position: DVec3,
    /// Ij: linear RGB, colour × intensity.
    pub intensity: DVec3,
    /// How it weakens with distance.
    pub falloff: Falloff,
}

/// How a light weakens with distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all (Whitted 1980).
    None,
    /// Divided by the squared distance.
    InverseSquare,
}

/// Index into [`Scene::textures`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct TextureId(pub usize);

/// Index into [`Scene::materials`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MaterialId(pub usize);

/// A decoded image, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// The file it came from.
    pub path: PathBuf,
    /// Pixels in a row, ≥ 1.
    pub width: u32,
    /// Rows, ≥ 1.
    pub height: u32,
    /// `width · height` pixels.
    pub pixels: Pixels,
}

/// The pixels of a [`Texture`].
#[derive(Debug, Clone, PartialEq)]
pub enum Pixels {
    /// 8 bits a channel with the sRGB transfer function; alpha is dropped.
    Srgb8(Vec<[u8; 3]>),
    /// Linear radiance, every value finite and ≥ 0.
    Linear(Vec<[f32; 3]>),
}

/// Surface and matter. Colours are already multiplied by their coefficient, linear RGB.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name in the scene or MTL file.
    pub name: String,
    /// ka × ambient colour.
    pub ambient: DVec3,
    /// kd × diffuse colour.
    pub diffuse: DVec3,
    /// Multiplies `diffuse` (and `ambient`, which MTL and Whitted tie to it) by texture coordinates.
    pub texture: Option<TextureId>,
    /// ks × specular colour.
    pub specular: DVec3,
    /// β, ≥ 0.
    pub shininess: f64,
    /// kr, each channel ≥ 0.
    pub reflection: DVec3,
    /// kt (× Tf of an MTL), each channel ≥ 0. Any channel above 0 makes the body transmissive.
    pub transmission: DVec3,
    /// Weight kr and kt by Fresnel's equations.
    pub fresnel: bool,
    /// Refractive index, > 0.
    pub ior: f64,
    /// σ per scene unit and channel, each ≥ 0.
    pub absorption: DVec3,
}

impl Material {
    /// Whether light passes through matter of this kind.
    #[must_use]
    pub fn is_transmissive(&self) -> bool {
        self.transmission.max_element() > 0.0
    }
}

/// Triangles in object space, counter-clockwise seen from outside the matter.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Unit normals from the file or the analytic shape.
    pub normals: Vec<DVec3>,
    /// Texture coordinates, v upwards.
    pub uvs: Vec<DVec2>,
    /// Faces.
    pub triangles: Vec<Triangle>,
}

/// Indices into the arrays of a [`Mesh`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle {
    /// Corner positions.
    pub positions: [u32; 3],
    /// Corner normals, or all [`Triangle::NONE`].
    pub normals: [u32; 3],
    /// Corner texture coordinates, or all [`Triangle::NONE`].
    pub uvs: [u32; 3],
    /// Index into [`Model::materials`].
    pub material: u32,
}

impl Triangle {
    /// Marks an absent normal or texture coordinate.
    pub const NONE: u32 = u32::MAX;
}

/// One body: a mesh, its materials and where it stands.
#[derive(Debug, Clone)]
pub struct Model {
    /// A name for messages: the mesh's file stem or the shape's kind, made unique.
    pub name: String,
    /// Shared between models of the same file or shape.
    pub mesh: Arc<Mesh>,
    /// What each [`Triangle::material`] of the mesh means.
    pub materials: Vec<MaterialId>,
    /// Wins where bodies overlap; equal: the earlier model.
    pub priority: i32,
    /// `world_from_object`: scale, then rotation about x, y, z, then translation.
    pub world_from_object: DAffine3,
    /// Which normals shade it.
    pub normals: Normals,
    /// Copies along a grid; the copies are one body.
    pub repeat: Repeat,
    /// Where the model stands in the scene file, for messages about it.
    pub location: Option<Location>,
}

/// Which normals shade a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Normals {
    /// The mesh's own where it has them, flat elsewhere.
    File,
    /// The face's.
    Flat,
    /// Averaged over faces that meet at less than this angle in degrees, in (0, 180].
    Crease(f64),
}

/// Copies of a model along a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeat {
    /// Copies along x, y and z, each ≥ 1.
    pub count: [u32; 3],
    /// Distance between copies along each axis, in scene units.
    pub step: DVec3,
}

impl Default for Repeat {
    fn default() -> Self {
        Self { count: [1; 3], step: DVec3::ZERO }
    }
}
