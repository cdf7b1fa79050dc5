//! Scenes made in code, as the self-test makes them: bare, with what matters to be filled in.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{
    Background, Camera, Material, MaterialId, Mesh, Model, Normals, RenderDefaults, Repeat, Scene, Triangle,
};

impl Scene {
    /// Models of these materials in the dark: black background, no light. The camera stands at (0, 0, 5) and looks at the
    /// origin, 90° high.
    #[must_use]
    pub fn of(materials: Vec<Material>, models: Vec<Model>) -> Self {
        Self {
            source: "(made in code)".into(),
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
            lights: Vec::new(),
            materials,
            textures: Vec::new(),
            models,
            meshes: Vec::new(),
            warnings: Vec::new(),
        }
    }
}

impl Material {
    /// Opaque matter that returns no light.
    #[must_use]
    pub fn black(name: &str) -> Self {
        Self {
            name: name.into(),
            ambient: DVec3::ZERO,
            diffuse: DVec3::ZERO,
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

    /// Clear matter of a refractive index, with Fresnel's weights: kr = kt = 1.
    #[must_use]
    pub fn clear(name: &str, ior: f64) -> Self {
        Self { reflection: DVec3::ONE, transmission: DVec3::ONE, fresnel: true, ior, ..Self::black(name) }
    }
}

impl Model {
    /// A body of flat faces where its mesh stands, of one material.
    #[must_use]
    pub fn of(name: &str, mesh: Mesh, material: MaterialId) -> Self {
        Self {
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
}

impl Mesh {
    /// Triangles over positions, without normals or texture coordinates, all of material 0.
    #[must_use]
    pub fn of(positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let triangle = |&positions: &[u32; 3]| Triangle {
            positions,
            normals: [Triangle::NONE; 3],
            uvs: [Triangle::NONE; 3],
            material: 0,
        };
        Self { positions, triangles: triangles.iter().map(triangle).collect(), ..Self::default() }
    }

    /// A box of twelve triangles; corner k has the x, y, z of `hi` where bit 0, 1, 2 of k is set. The first four triangles
    /// lie on the sides x = lo and x = hi.
    #[must_use]
    pub fn cuboid(lo: DVec3, hi: DVec3) -> Self {
        let corner = |k: u32| {
            let pick = |axis: usize| if k >> axis & 1 == 0 { lo[axis] } else { hi[axis] };
            DVec3::new(pick(0), pick(1), pick(2))
        };
        let quads: [[u32; 4]; 6] =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles: Vec<[u32; 3]> =
            quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Self::of((0..8).map(corner).collect(), &triangles)
    }
}
