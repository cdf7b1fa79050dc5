//! Small scenes, built in code for the tests.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{Flattened, flatten};
use crate::scene::{
    Background, Camera, Falloff, Light, Material, MaterialId, Mesh, Model, Normals, RenderDefaults, Repeat,
    Scene, SceneError, Triangle,
};

pub(super) const ICE: MaterialId = MaterialId(0);
pub(super) const WATER: MaterialId = MaterialId(1);
pub(super) const STONE: MaterialId = MaterialId(2);

/// Nothing but ice, water and stone to make things of.
pub(super) fn empty_scene() -> Scene {
    let ice = Material { transmission: DVec3::ONE, ior: 1.31, fresnel: true, ..stone("ice") };
    let water = Material { ior: 1.333, ..ice.clone() };
    Scene {
        source: "sample.toml".into(),
        camera: Camera {
            eye: DVec3::new(0.0, 0.0, 5.0),
            right: DVec3::X,
            up: DVec3::Y,
            forward: DVec3::NEG_Z,
            target_distance: 5.0,
            fov_y: 90.0,
        },
        render: RenderDefaults::default(),
        ambient: DVec3::ZERO,
        background: Background::Color(DVec3::ZERO),
        lights: vec![],
        materials: vec![ice, Material { name: "water".into(), ..water }, stone("stone")],
        textures: vec![],
        models: vec![],
        warnings: vec![],
    }
}

pub(super) fn stone(name: &str) -> Material {
    Material {
        name: name.into(),
        ambient: DVec3::ZERO,
        diffuse: DVec3::splat(0.5),
        texture: None,
        specular: DVec3::ZERO,
        shininess: 0.0,
        reflection: DVec3::ZERO,
        transmission: DVec3::ZERO,
        fresnel: false,
        ior: 1.0,
        absorption: DVec3::ZERO,
    }
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
    Model {
        name: name.into(),
        mesh: Arc::new(mesh),
        materials: vec![material],
        priority: 0,
        world_from_object: DAffine3::IDENTITY,
        normals: Normals::Flat,
        repeat: Repeat::default(),
        location: None,
    }
}

/// Triangles over positions, without normals or texture coordinates.
pub(super) fn mesh(positions: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
    let triangle = |&positions: &[u32; 3]| Triangle {
        positions,
        normals: [Triangle::NONE; 3],
        uvs: [Triangle::NONE; 3],
        material: 0,
    };
    Mesh {
        positions: positions.to_vec(),
        triangles: triangles.iter().map(triangle).collect(),
        ..Mesh::default()
    }
}

/// A box of twelve triangles, counter-clockwise from outside; corner k has the x, y, z of `hi` where bit 0,
/// 1, 2 of k is set. The first four triangles lie on the sides x = lo and x = hi.
pub(super) fn cuboid(lo: DVec3, hi: DVec3) -> Mesh {
    let corner = |k: u32| {
        let pick = |axis: usize| if k >> axis & 1 == 0 { lo[axis] } else { hi[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles: Vec<[u32; 3]> =
        quads.iter().flat_map(|&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]]).collect();
    mesh(&(0..8).map(corner).collect::<Vec<_>>(), &triangles)
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
