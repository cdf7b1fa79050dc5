// The records in the buffers: src/layout says what they mean.

import package::constants::{BOUND_ROWS, LANES, MEDIA_ROWS, STACK_SIZE, TREE_NODES};
import package::film::Sample;
import package::whitted::Branch;

struct WideNode {
    origin: vec3f, scales: u32,
    first_child: u32, first_triangle: u32, leaves: vec2u,
    planes: array<vec4u, 3>,
}

struct Triangle {
    v0: vec3f, id: u32,
    v1: vec3f, reserved1: u32,
    v2: vec3f, reserved2: u32,
}

struct Attribute {
    normal: vec3f, material: u32,
    normal0: vec3f, body: u32,
    normal1: vec3f, other: u32,
    normal2: vec3f, uvs: u32,
}

struct Material {
    ambient: vec3f, ior: f32,
    diffuse: vec3f, shininess: f32,
    specular: vec3f, fresnel: u32,
    reflection: vec3f, texture: u32,
    transmission: vec3f, texture_width: u32,
    absorption: vec3f, texture_height: u32,
}

struct Light {
    position: vec3f, inverse_square: u32,
    intensity: vec3f, reserved: u32,
}

struct Texel {
    radiance: vec3f, dropped: f32,
    bound: f32, rays: u32, primitive_hash: u32, body_hash: u32,
}

struct Aov {
    normal: vec3f, depth: f32,
    body: u32, medium: u32, reserved: vec2u,
}

struct Statistics {
    sum: vec3f, squares: f32,
    samples: u32, body: u32, start: u32, listed: u32,
}

struct View {
    eye: vec3f, width: u32,
    forward: vec3f, height: u32,
    right: vec3f, start_media: u32,
    up: vec3f, depth: u32,
    ambient: vec3f, cutoff: f32,
    horizon: vec3f, samples: u32,
    zenith: vec3f, lights: u32,
    scene_lo: vec3f, transmissive_bodies: u32,
    scene_hi: vec3f, environment: u32,
    environment_width: u32, environment_height: u32,
    environment_turn: f32, environment_intensity: f32,
    crop: vec4u,
    media: array<vec4u, MEDIA_ROWS>,
    radiance_bound: array<vec4f, BOUND_ROWS>,
}

// What changes from frame to frame.
struct Frame {
    view: View,
    lights: array<Light>,
}

// Which blocks and samples a dispatch traces, and how far.
struct Tile {
    first_block: u32, block_count: u32, first_sample: u32, sample_count: u32, first_row: u32,
    step_budget: u32, resume: u32, canary_rounds: u32, canary_result: u32,
    listed: u32, round: u32, threshold: f32,
}

// A pixel as the film keeps it.
struct FilmTexel {
    texel: Texel,
    @if(aovs) aov: Aov,
    @if(adaptive) statistics: Statistics,
}

// An invocation at rest: which sample it goes on with, and the tree in work.
@if(rests) struct Lane {
    sample_index: u32,
    @if(bounces) sample: Sample,
    @if(bounces) branch: Branch,
    @if(branches) stack_size: u32,
    @if(branches) stack: array<Branch, STACK_SIZE>,
}

// What a dispatch is told, and what it reports.
struct FilmHead {
    tile: Tile,
    done: atomic<u32>, paused: atomic<u32>, cut_short: atomic<u32>,
    primary: atomic<u32>, reflection: atomic<u32>, refraction: atomic<u32>, shadow: atomic<u32>,
    listed: atomic<u32>,
}

// One ray of a pixel's tree.
struct TreeNode {
    origin: vec3f, kind: u32,
    direction: vec3f, depth: u32,
    weight: vec3f, end: u32,
    light: vec3f, media: u32,
    point: vec3f, id: u32,
    normal: vec3f, body: u32,
    arriving: vec3f, media_behind: u32,
    distance: f32, front: u32, children: u32, seen: u32,
    shadow_rays: u32, reserved: array<u32, 3>,
}

// The tree of the one pixel that is traced.
@if(tree) struct Tree {
    count: u32,
    nodes: array<TreeNode, TREE_NODES>,
}

// The film, with the invocations of one dispatch.
struct Film {
    head: FilmHead,
    @if(rests) lanes: array<Lane, LANES>,
    @if(tree) tree: Tree,
    texels: array<FilmTexel>,
}
