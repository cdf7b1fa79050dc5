//! A scene that calls for everything at once: random triangles of all materials, smooth and flat, textured, in
//! overlapping bodies, under a background picture. It looks like nothing.

use crate::layout::constants::{NONE, OPPOSITE};
use crate::layout::{Attribute, FlatScene, FlatTexture, Light, Material, Node, Triangle, View};
use bytemuck::Zeroable;

use super::inputs::{Generator, Input};

pub(super) const TRIANGLES: u32 = 64;
/// Air, glass, water, clear metal, paper.
pub(super) const MATERIALS: u32 = 5;
/// Masks of the three transmissive bodies.
pub(super) const MEDIA_MASKS: u32 = 8;
/// Side of the picture in pixels.
pub(super) const SIZE: u32 = 128;

/// Words of the table of 8-bit sRGB values.
const TABLE: u32 = 256;
const TEXTURE: FlatTexture = FlatTexture { first: TABLE, width: 5, height: 3 };
const ENVIRONMENT: FlatTexture = FlatTexture { first: TABLE + 15, width: 8, height: 4 };

pub(super) fn scene() -> FlatScene {
    let mut random = Generator::new("soup");
    let triangles: Vec<_> = (0..TRIANGLES).map(|id| triangle(&mut random, id)).collect();
    let mut nodes = Vec::new();
    let depth = add_node(&mut nodes, &triangles, 0, TRIANGLES);
    FlatScene {
        nodes: nodes.into(),
        attributes: triangles.iter().map(|triangle| attribute(&mut random, triangle)).collect(),
        uvs: (0..3 * TRIANGLES).map(|_| uv(&mut random)).collect(),
        triangles: triangles.into(),
        materials: materials(),
        material_names: ["air", "glass", "water", "metal", "paper"].map(str::to_owned).to_vec(),
        lights: vec![
            Light { position: [1.5, 2.5, 1.0], intensity: [0.9, 0.8, 0.7], ..Light::zeroed() },
            Light { position: [-2.0, 0.5, 2.0], inverse_square: 1, intensity: [3.0, 4.0, 5.0], reserved: 0 },
        ],
        texels: texels(&mut random).into(),
        bodies: Vec::new(),
        transmissive_bodies: 3,
        bounds: [[-2.0; 3], [2.0; 3]],
        bvh_depth: depth,
        ambient: [0.1, 0.2, 0.3],
        horizon: [0.25, 0.5, 1.0],
        zenith: [1.0, 0.5, 0.25],
        environment: Some((ENVIRONMENT, 0.3, 0.7)),
        radiance_bound: Vec::new(),
    }
}

pub(super) fn view(scene: &FlatScene) -> View {
    let mut view = View {
        eye: [0.1, 0.2, 4.0],
        width: SIZE,
        forward: [0.0, 0.0, -1.0],
        height: SIZE,
        right: [0.6, 0.0, 0.0],
        up: [0.0, 0.6, 0.0],
        // Each level may leave one branch waiting.
        depth: 8,
        cutoff: 1e-3,
        samples: 1,
        ambient: scene.ambient,
        horizon: scene.horizon,
        zenith: scene.zenith,
        lights: scene.lights.len() as u32,
        scene_lo: scene.bounds[0],
        scene_hi: scene.bounds[1],
        transmissive_bodies: scene.transmissive_bodies,
        environment: ENVIRONMENT.first,
        environment_width: ENVIRONMENT.width,
        environment_height: ENVIRONMENT.height,
        environment_turn: 0.3,
        environment_intensity: 0.7,
        crop: [0, 0, SIZE, SIZE],
        ..View::zeroed()
    };
    view.media[0] = [1, 2, 3, 0];
    for (index, row) in view.radiance_bound.iter_mut().enumerate() {
        *row = [0.0, 1.0, 2.0, 3.0].map(|step| 1.0 + step + 4.0 * index as f32);
    }
    view
}

/// A node over `count` triangles from `first`, and those below it; how deep it goes.
fn add_node(nodes: &mut Vec<Node>, triangles: &[Triangle], first: u32, count: u32) -> u32 {
    let index = nodes.len();
    nodes.push(Node::zeroed());
    let half = count / 2;
    let mut child = |first: u32, count: u32| {
        let (lo, hi) = bounds(&triangles[first as usize..(first + count) as usize]);
        if count <= 2 {
            return (lo, hi, first, count, 0);
        }
        let node = nodes.len() as u32;
        let depth = add_node(nodes, triangles, first, count);
        (lo, hi, node, 0, depth)
    };
    let (a_lo, a_hi, a_first, a_count, a_depth) = child(first, half);
    let (b_lo, b_hi, b_first, b_count, b_depth) = child(first + half, count - half);
    nodes[index] = Node { a_lo, a_first, a_hi, a_count, b_lo, b_first, b_hi, b_count };
    1 + a_depth.max(b_depth)
}

fn bounds(triangles: &[Triangle]) -> ([f32; 3], [f32; 3]) {
    let corners = || triangles.iter().flat_map(|triangle| [triangle.v0, triangle.v1, triangle.v2]);
    let reach = |start: f32, pick: fn(f32, f32) -> f32| {
        corners().fold([start; 3], |reached, corner| [0, 1, 2].map(|axis| pick(reached[axis], corner[axis])))
    };
    (reach(f32::MAX, f32::min), reach(f32::MIN, f32::max))
}

fn triangle(random: &mut Generator, id: u32) -> Triangle {
    let [v0, v1, v2] = [0; 3].map(|_| vector(random, Input::Point));
    Triangle { v0, id, v1, reserved1: 0, v2, reserved2: 0 }
}

/// Bodies 0 to 2 transmit; every other face is smooth, two of three are textured; some are interfaces of two bodies.
fn attribute(random: &mut Generator, triangle: &Triangle) -> Attribute {
    let id = triangle.id;
    let body = id % 4;
    let other = match id % 7 {
        0 => (body + 1) % 3,
        1 => ((body + 1) % 3) | OPPOSITE,
        _ => NONE,
    };
    let [e1, e2] = [triangle.v1, triangle.v2].map(|v| [0, 1, 2].map(|a| v[a] - triangle.v0[a]));
    let cross = [(1, 2), (2, 0), (0, 1)].map(|(a, b)| e1[a] * e2[b] - e1[b] * e2[a]);
    let length = cross.iter().map(|x| x * x).sum::<f32>().sqrt();
    let is_smooth = id.is_multiple_of(2);
    let [normal0, normal1, normal2] =
        [0; 3].map(|_| if is_smooth { vector(random, Input::Direction) } else { [0.0; 3] });
    Attribute {
        normal: cross.map(|x| x / length),
        material: body + 1,
        normal0,
        body,
        normal1,
        other,
        normal2,
        uvs: if id.is_multiple_of(3) { NONE } else { 3 * id },
    }
}

fn uv(random: &mut Generator) -> [f32; 2] {
    let [u, v, _] = vector(random, Input::Point);
    [u, v]
}

/// All of them carry the texture.
fn materials() -> Vec<Material> {
    let common = Material {
        texture: TEXTURE.first,
        texture_width: TEXTURE.width,
        texture_height: TEXTURE.height,
        ior: 1.0,
        ..Material::zeroed()
    };
    vec![
        Material { transmission: [1.0; 3], ..common },
        Material {
            ior: 1.5,
            fresnel: 1,
            specular: [0.5; 3],
            shininess: 80.0,
            reflection: [1.0; 3],
            transmission: [1.0, 0.9, 0.8],
            absorption: [0.1, 0.2, 0.0],
            ..common
        },
        Material {
            ior: 1.333,
            diffuse: [0.1; 3],
            reflection: [0.1; 3],
            transmission: [0.9; 3],
            absorption: [0.3, 0.0, 0.05],
            ..common
        },
        Material { ior: 2.5, ambient: [0.2; 3], reflection: [0.3; 3], transmission: [0.5; 3], ..common },
        Material {
            ambient: [0.5; 3],
            diffuse: [0.8, 0.7, 0.6],
            specular: [0.2; 3],
            shininess: 10.0,
            ..common
        },
    ]
}

fn texels(random: &mut Generator) -> Vec<u32> {
    let table = (0..TABLE).map(|value| (value as f32 / 255.0).powf(2.2).to_bits());
    let mut texels: Vec<_> = table.collect();
    for _ in 0..TEXTURE.width * TEXTURE.height {
        texels.extend(random.record(&[Input::Word(1 << 24)], 1));
    }
    for _ in 0..3 * ENVIRONMENT.width * ENVIRONMENT.height {
        texels.extend(random.record(&[Input::Positive], 1));
    }
    texels
}

fn vector(random: &mut Generator, input: Input) -> [f32; 3] {
    let words = random.record(&[input], 3);
    [0, 1, 2].map(|axis| f32::from_bits(words[axis]))
}
