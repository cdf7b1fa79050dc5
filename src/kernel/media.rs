//! Which matter a ray is in. Twin of `shaders/media.wgsl`.
//!
//! A mask holds one bit for each transmissive body, in order of priority (Schmidt and Budge 2002). Setting and
//! clearing are idempotent, so an edge that gives two events, or none, heals at the next face. Where no bodies meet the
//! mask holds one bit at most, that of the body that was entered last.

use crate::layout::Effect;
use crate::layout::constants::{AIR, NONE, OPPOSITE};

use super::{Real, Simulation, Vec3, World};

/// Material index of the medium: that of the lowest set bit, the air where none is set.
pub fn current_medium(world: &World<impl Simulation>, mask: u32) -> u32 {
    if mask == 0 {
        return AIR;
    }
    let body = mask.trailing_zeros();
    world.view.media[(body >> 2) as usize][(body & 3) as usize]
}

/// The mask behind a face, for a ray that meets it from its `front` or its back.
pub fn cross_face(world: &World<impl Simulation>, mask: u32, id: u32, front: bool) -> u32 {
    let face = &world.scene.attributes[id as usize];
    let mut behind = set_body(world, mask, face.body, front);
    if face.other != NONE && world.simulates(Effect::NestedMedia) {
        let opposite = (face.other & OPPOSITE) != 0;
        behind = set_body(world, behind, face.other & !OPPOSITE, front != opposite);
    }
    behind
}

/// The mask with a body's bit set or cleared; opaque bodies have none.
pub fn set_body(world: &World<impl Simulation>, mask: u32, body: u32, inside: bool) -> u32 {
    if body >= world.view.transmissive_bodies || !world.simulates(Effect::Transmission) {
        return mask;
    }
    let bit = 1u32 << body;
    let others = mask & !bit;
    if !inside {
        return others;
    }
    if others != 0 && world.simulates(Effect::NestedMedia) { mask | bit } else { bit }
}

/// What is left of light after a distance in a medium, per channel: exp(−σ·t) (Beer–Lambert).
pub fn attenuation<R: Real>(world: &World<impl Simulation>, medium: u32, t: R) -> Vec3<R> {
    let sigma = world.scene.materials[medium as usize].absorption;
    if sigma == [0.0; 3] || !world.simulates(Effect::Absorption) {
        return Vec3::one();
    }
    Vec3::new(attenuate(sigma[0], t), attenuate(sigma[1], t), attenuate(sigma[2], t))
}

/// exp(−σ·t), exactly 1 where nothing is absorbed.
pub fn attenuate<R: Real>(sigma: f32, t: R) -> R {
    if sigma == 0.0 { R::ONE } else { R::exp_neg(R::real(sigma) * t) }
}
