//! A mesh, ready to be traced.

use std::path::Path;
use std::time::{Duration, Instant};

use bytemuck::Zeroable;
use glam::DVec3;
use rayon::prelude::*;

use super::RayError;
use crate::bench::BenchError;
use crate::bvh::{self, Bvh, BvhError, Preset};
use crate::cpu::WideBvh;
use crate::kernel::World;
use crate::layout::{EffectSet, FlatScene, Intersector, Triangle, View};
use crate::scene::Scene;

/// Farthest coordinate of a mesh, as of a scene.
const MOST_COORDINATE: f32 = (1_u64 << 60) as f32;

/// The binary tree of the kernel and the wide one of the CPU over the same triangles.
pub struct Trees {
    /// The kernel's.
    pub binary: Bvh,
    /// In the order of the trees.
    pub triangles: Vec<Triangle>,
    /// The CPU's.
    pub wide: WideBvh,
    /// How long both took to build, encoding and collapsing included.
    pub time: Duration,
}

impl Trees {
    /// Build both with all threads.
    ///
    /// # Errors
    /// [`BvhError`].
    pub fn build(triangles: &[Triangle], preset: Preset) -> Result<Self, BvhError> {
        let started = Instant::now();
        let binary = bvh::build(triangles, preset)?;
        let triangles: Vec<Triangle> =
            binary.order.par_iter().map(|&index| triangles[index as usize]).collect();
        let wide = WideBvh::new(&binary.nodes, &triangles);
        Ok(Self { time: started.elapsed(), binary, triangles, wide })
    }
}

/// What of the view is not the mesh's default.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pinhole {
    /// Where the eye is.
    pub eye: Option<[f64; 3]>,
    /// What it looks at.
    pub target: Option<[f64; 3]>,
    /// Vertical field of view in degrees, in (0, 180).
    pub fov: Option<f64>,
}

/// A mesh with the binary tree of the kernel and the wide one of the CPU, seen from somewhere.
pub struct RayStage {
    /// Triangles, each with its place in the file as id, in the order of the tree.
    pub(super) scene: FlatScene,
    pub(super) view: View,
    pub(super) wide: WideBvh,
    pub(super) eye: DVec3,
    /// Unit vectors, right and up times the tangent of half the field of view: the picture is square.
    pub(super) forward: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    pub(super) light: DVec3,
    build: Duration,
}

impl RayStage {
    /// Read a mesh and build its trees with all threads; as it is: nothing is merged or left out. The light is that
    /// of a bare mesh.
    ///
    /// # Errors
    /// [`BenchError::Scene`], [`BenchError::Rays`].
    pub fn load(path: &Path, preset: Preset, pinhole: Pinhole) -> Result<Self, BenchError> {
        let scene = Scene::load(path)?;
        let triangles: Vec<Triangle> = triangles(&scene);
        if !triangles.iter().flat_map(|t| [t.v0, t.v1, t.v2]).flatten().all(|x| x.abs() <= MOST_COORDINATE) {
            return Err(RayError::Range.into());
        }
        let Trees { binary: tree, triangles, wide, time: build } =
            Trees::build(&triangles, preset).map_err(RayError::Bvh)?;
        let root = &tree.nodes[0];
        let bounds = [
            std::array::from_fn(|axis| root.a_lo[axis].min(root.b_lo[axis])),
            std::array::from_fn(|axis| root.a_hi[axis].max(root.b_hi[axis])),
        ];
        let camera = &scene.camera;
        let eye = pinhole.eye.map_or(camera.eye, DVec3::from);
        let target = pinhole.target.map_or(camera.eye + camera.forward * camera.target_distance, DVec3::from);
        let forward = (target - eye).try_normalize().unwrap_or(camera.forward);
        let right = forward.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::X);
        let half = (pinhole.fov.unwrap_or(camera.fov_y).to_radians() / 2.0).tan();
        Ok(Self {
            view: View { scene_lo: bounds[0], scene_hi: bounds[1], ..View::zeroed() },
            scene: FlatScene::of_triangles(tree.nodes, triangles, bounds, tree.depth),
            wide,
            eye,
            forward,
            right: right * half,
            up: right.cross(forward) * half,
            light: scene.lights.first().map_or(eye, |light| light.position),
            build,
        })
    }

    /// How long the trees took to build, encoding and collapsing included.
    #[must_use]
    pub fn build_time(&self) -> Duration {
        self.build
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.scene.triangles.len()
    }

    /// Memory of the tree that rays go through, triangles included.
    #[must_use]
    pub fn bytes_per_triangle(&self) -> f64 {
        self.wide.bytes() as f64 / self.triangles() as f64
    }

    /// The triangles with the binary tree; nothing of shading.
    #[must_use]
    pub fn scene(&self) -> &FlatScene {
        &self.scene
    }

    /// What rays need to know of a view: the scene's extent.
    #[must_use]
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The tree that the CPU's rays go through.
    #[must_use]
    pub fn tree(&self) -> &WideBvh {
        &self.wide
    }

    /// What the scalar kernel traces in.
    #[must_use]
    pub fn world(&self) -> World<'_> {
        World {
            scene: &self.scene,
            view: &self.view,
            intersector: Intersector::Watertight,
            effects: EffectSet::NONE,
        }
    }
}

/// All faces of a scene's models, numbered as the files have them.
fn triangles(scene: &Scene) -> Vec<Triangle> {
    let faces = scene.models.iter().flat_map(|model| {
        let corner = |index: u32| model.mesh.positions[index as usize].as_vec3().to_array();
        model.mesh.triangles.iter().map(move |triangle| triangle.positions.map(corner))
    });
    let triangle =
        |([v0, v1, v2], id): ([[f32; 3]; 3], u32)| Triangle { v0, id, v1, reserved1: 0, v2, reserved2: 0 };
    faces.zip(0..).map(triangle).collect()
}
