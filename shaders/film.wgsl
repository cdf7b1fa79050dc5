// Stop 7 of 7: film. Twin of src/kernel/film.rs.

import package::real::{real, vec3r};
import package::records::{Aov, Texel};
import package::constants::LEAST_NORMAL;

// What one sample gives the film.
struct Sample {
    radiance: vec3r,
    @if(bounces) dropped: real,
    @if(bounces) bound: real,
    rays: u32,
    rays_by_kind: vec4u,
    primitive_hash: u32,
    body_hash: u32,
    @if(aovs) aov: Aov,
    @if(adaptive) first_body: u32,
}

// Add sample `index` to a pixel's running sums.
fn add(before: Texel, sample: Sample, index: u32) -> Texel {
    var texel = before;
    texel.radiance = texel.radiance + flush3(sample.radiance);
    @if(bounces) texel.dropped = texel.dropped + flush(sample.dropped);
    @if(bounces) texel.bound = texel.bound + flush(sample.bound);
    texel.rays = texel.rays + sample.rays;
    if index == 0u {
        texel.primitive_hash = sample.primitive_hash;
        texel.body_hash = sample.body_hash;
    }
    return texel;
}

// Divide a pixel's sums by its number of samples, once.
fn settle(sums: Texel, samples: u32) -> Texel {
    var texel = sums;
    let n = f32(i32(samples));
    texel.radiance.x = flush(real(texel.radiance.x / n));
    texel.radiance.y = flush(real(texel.radiance.y / n));
    texel.radiance.z = flush(real(texel.radiance.z / n));
    @if(bounces) texel.dropped = flush(real(texel.dropped / n));
    @if(bounces) texel.bound = flush(real(texel.bound / n));
    return texel;
}

// To f32, with subnormals as 0: devices differ on them.
//
// A select, for this is called from dozens of places: an early return becomes a loop of one round wherever it is inlined,
// and SwiftShader took minutes to compile those of `record`.
fn flush(x: real) -> f32 {
    let f = f32(x);
    return select(f, 0.0, abs(f) < LEAST_NORMAL);
}

// A vector through `flush`.
fn flush3(v: vec3r) -> vec3f {
    return vec3f(flush(v.x), flush(v.y), flush(v.z));
}
