//! Small scenes, built in code for the tests.

use glam::DVec3;

use super::{Flattened, flatten};
use crate::scene::{Falloff, Light, Material, MaterialId, Mesh, Model, Scene, SceneError, Triangle};

pub(super) const ICE: MaterialId = MaterialId(0);
pub(super) const WATER: MaterialId = MaterialId(1);
pub(super) const STONE: MaterialId = MaterialId(2);

/// Nothing but ice, water and stone to make things of.
pub(super) fn empty_scene() -> Scene {
    let clear = |name, ior| Material { reflection: DVec3::ZERO, ..Material::clear(name, ior) };
    Scene::of(vec![clear("ice", 1.31), clear("water", 1.333), stone("stone")], vec![])
}

pub(super) fn stone(name: &str) -> Material {
    Material { diffuse: DVec3::splat(0.5), ..Material::black(name) }
}

pub(super) fn scene_of(models: Vec<Model>) -> Scene {
    Scene { models, ..empty_scene() }
}

pub(super) fn flattened(models: Vec<Model>) -> Result<Flattened, SceneError> {
    flatten(&scene_of(models))
}

pub(super) fn lamp(position: DVec3, intensity: f64, falloff: Falloff) -> Light {
    Light { position, intensity: DVec3::splat(intensity), falloff }
}

pub(super) fn model(name: &str, mesh: Mesh, material: MaterialId) -> Model {
    Model::of(name, mesh, material)
}

pub(super) fn mesh(positions: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
    Mesh::of(positions.to_vec(), triangles)
}

pub(super) fn cuboid(lo: DVec3, hi: DVec3) -> Mesh {
    Mesh::cuboid(lo, hi)
}

/// A cube around the origin with sides of length 2·`half`.
pub(super) fn cube(half: f64) -> Mesh {
    cuboid(DVec3::splat(-half), DVec3::splat(half))
}

/// The same mesh with every face looking to the other side.
pub(super) fn inside_out(mut mesh: Mesh) -> Mesh {
    mesh.triangles.iter_mut().for_each(super::place::reverse);
    mesh
}

/// All meshes as one.
pub(super) fn joined(meshes: &[Mesh]) -> Mesh {
    let mut whole = Mesh::default();
    for part in meshes {
        let shift = whole.positions.len() as u32;
        whole.positions.extend(&part.positions);
        let moved = |t: &Triangle| Triangle { positions: t.positions.map(|index| index + shift), ..*t };
        whole.triangles.extend(part.triangles.iter().map(moved));
    }
    whole
}
