//! A scene of one triangle, for probes that need none and pictures that show one.

use std::sync::Arc;

use bytemuck::Zeroable;
use snellius::layout::constants::NONE;
use snellius::layout::{Attribute, FlatScene, Light, Material, Node, Triangle, View};

/// A white, matt triangle at z = 0 that covers the lower left half of the picture.
pub(super) fn triangle() -> FlatScene {
    let (lo, hi) = ([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]);
    FlatScene {
        nodes: Arc::new([Node {
            a_lo: lo,
            a_first: 0,
            a_hi: hi,
            a_count: 1,
            b_lo: lo,
            b_first: 0,
            b_hi: hi,
            b_count: 1,
        }]),
        triangles: Arc::new([Triangle {
            v0: [-1.0, -1.0, 0.0],
            id: 0,
            v1: [1.0, -1.0, 0.0],
            reserved1: 0,
            v2: [-1.0, 1.0, 0.0],
            reserved2: 0,
        }]),
        attributes: Arc::new([Attribute {
            normal: [0.0, 0.0, 1.0],
            material: 1,
            other: NONE,
            uvs: NONE,
            ..Attribute::zeroed()
        }]),
        uvs: Arc::default(),
        materials: vec![
            Material { ior: 1.0, transmission: [1.0; 3], texture: NONE, ..Material::zeroed() },
            Material { ior: 1.0, diffuse: [1.0; 3], texture: NONE, ..Material::zeroed() },
        ],
        material_names: vec!["air".into(), "paper".into()],
        lights: vec![Light { position: [0.0, 0.0, 3.0], intensity: [1.0; 3], ..Light::zeroed() }],
        texels: Arc::default(),
        bodies: Vec::new(),
        transmissive_bodies: 0,
        bounds: [lo, hi],
        bvh_depth: 1,
        ambient: [0.0; 3],
        horizon: [0.25, 0.5, 1.0],
        zenith: [1.0, 0.5, 0.25],
        environment: None,
        radiance_bound: vec![1.0; 66],
    }
}

/// The triangle from the front.
pub(super) fn view(scene: &FlatScene, width: u32, height: u32, samples: u32) -> View {
    View {
        eye: [0.0, 0.0, 2.0],
        width,
        forward: [0.0, 0.0, -1.0],
        height,
        right: [0.5, 0.0, 0.0],
        up: [0.0, 0.5, 0.0],
        depth: 4,
        cutoff: 1e-4,
        samples,
        horizon: scene.horizon,
        zenith: scene.zenith,
        lights: scene.lights.len() as u32,
        scene_lo: scene.bounds[0],
        scene_hi: scene.bounds[1],
        environment: NONE,
        crop: [0, 0, width, height],
        ..View::zeroed()
    }
}
