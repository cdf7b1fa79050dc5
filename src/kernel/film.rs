//! Stop 7 of 7: film. Twin of `shaders/film.wgsl`.

use crate::layout::constants::LEAST_NORMAL;
use crate::layout::{Aov, Texel};

use super::{Real, Vec3};

/// What one sample gives the film.
#[derive(Debug, Clone, Copy)]
pub struct Sample<R> {
    /// Radiance.
    pub radiance: Vec3<R>,
    /// Summed largest weight channels of cut rays.
    pub dropped: R,
    /// Certified bound on what cutting them changed.
    pub bound: R,
    /// Traced rays of all kinds.
    pub rays: u32,
    /// Traced rays by kind: primary, reflection, refraction, shadow.
    pub rays_by_kind: [u32; 4],
    /// Over primitive ids, branches and light visibilities.
    pub primitive_hash: u32,
    /// Over bodies, sides, branches and light visibilities.
    pub body_hash: u32,
    /// What the primary ray met.
    pub aov: Aov,
    /// Body that the primary ray met, or [`Attribute::NONE`](crate::layout::Attribute::NONE).
    pub first_body: u32,
}

/// Add sample `index` to a pixel's running sums.
pub fn add<R: Real>(texel: &mut Texel, sample: &Sample<R>, index: u32) {
    let r = sample.radiance;
    texel.radiance[0] += flush(r.x);
    texel.radiance[1] += flush(r.y);
    texel.radiance[2] += flush(r.z);
    texel.dropped += flush(sample.dropped);
    texel.bound += flush(sample.bound);
    texel.rays += sample.rays;
    if index == 0 {
        texel.primitive_hash = sample.primitive_hash;
        texel.body_hash = sample.body_hash;
    }
}

/// Divide a pixel's sums by its number of samples, once.
pub fn settle(texel: &mut Texel, samples: u32) {
    let n = samples as i32 as f32;
    texel.radiance[0] = flush(texel.radiance[0] / n);
    texel.radiance[1] = flush(texel.radiance[1] / n);
    texel.radiance[2] = flush(texel.radiance[2] / n);
    texel.dropped = flush(texel.dropped / n);
    texel.bound = flush(texel.bound / n);
}

/// To f32, with subnormals as 0: devices differ on them.
pub fn flush<R: Real>(x: R) -> f32 {
    let f = x.to_f32();
    if f.abs() < LEAST_NORMAL { 0.0 } else { f }
}

/// A vector through [`flush`].
pub fn flush3<R: Real>(v: Vec3<R>) -> [f32; 3] {
    [flush(v.x), flush(v.y), flush(v.z)]
}
