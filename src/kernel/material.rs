//! Stop 6 of 7: material. Twin of `shaders/material.wgsl`.

use super::math::{dot3, max3, unit3};
use super::surface::{Surface, turn_towards};
use super::{Real, Vec3, World};

/// Where light goes on from a surface, and with which weights.
#[derive(Debug, Clone, Copy)]
pub struct Scatter<R> {
    /// Unit direction of the reflected ray, on the arriving side.
    pub reflected: Vec3<R>,
    /// Its weight.
    pub reflection: Vec3<R>,
    /// Unit direction of the refracted ray, on the other side.
    pub refracted: Vec3<R>,
    /// Its weight.
    pub transmission: Vec3<R>,
    /// Whether the material reflects at all.
    pub reflects: bool,
    /// Whether the material transmits and there is no total internal reflection.
    pub transmits: bool,
}

/// Fresnel's answer for unpolarised light.
#[derive(Debug, Clone, Copy)]
pub struct Fresnel<R> {
    /// Reflectance in [0, 1].
    pub reflectance: R,
    /// g − c, with g² = η² − 1 + c²; exactly 0 for η = 1.
    pub bend: R,
    /// Total internal reflection.
    pub total: bool,
}

/// Fresnel reflectance at cosine c ≥ 0 for η = n₂/n₁ (Cook and Torrance 1982, section 4, with g − c written as
/// (η−1)(η+1)/(g+c), so that nothing cancels and an index match reflects exactly nothing).
pub fn fresnel<R: Real>(c: R, eta: R) -> Fresnel<R> {
    let step = (eta - R::ONE) * (eta + R::ONE);
    if step == R::ZERO {
        return Fresnel { reflectance: R::ZERO, bend: R::ZERO, total: false };
    }
    let g2 = step + c * c;
    if g2 <= R::ZERO {
        return Fresnel { reflectance: R::ONE, bend: R::ZERO, total: true };
    }
    let g = g2.sqrt();
    let sum = g + c;
    let bend = step / sum;
    let ratio = bend / sum;
    let k = (c * sum - R::ONE) / (c * bend + R::ONE);
    let reflectance = R::of(0.5) * ratio * ratio * (R::ONE + k * k);
    Fresnel { reflectance: reflectance.least(R::ONE), bend, total: false }
}

/// Reflect and refract at an interface between two media, given by their material indices.
pub fn scatter<R: Real>(
    world: &World,
    surface: &Surface<R>,
    direction: Vec3<R>,
    before: u32,
    behind: u32,
) -> Scatter<R> {
    let m = &world.scene.materials[surface.material as usize];
    let kr = Vec3::load(m.reflection);
    let kt = Vec3::load(m.transmission);
    let n = surface.normal;
    let c = (R::ZERO - dot3(direction, n)).greatest(R::ZERO).least(R::ONE);
    // Opaque matter has its own index behind the face.
    let transparent = max3(kt) > R::ZERO;
    let inner = if transparent { behind } else { surface.material };
    let eta = index_of::<R>(world, inner) / index_of::<R>(world, before);
    let f = fresnel(c, eta);
    // Mirror direction, kept on the arriving side of the face.
    let mirrored = direction + n * (c + c);
    let reflected = turn_towards(mirrored, surface.face_normal);
    // Snell: η t = d − (g − c) n, kept on the other side.
    let refracted = if f.bend == R::ZERO {
        direction
    } else {
        let bent = direction - n * f.bend;
        turn_towards(unit3(bent), -surface.face_normal)
    };
    let total = transparent && f.total;
    let mut reflection = kr;
    let mut transmission = kt;
    if m.fresnel != 0 {
        reflection = kr * f.reflectance;
        transmission = kt * (R::ONE - f.reflectance);
    } else if total {
        reflection = kr + kt;
    }
    Scatter {
        reflected,
        reflection,
        refracted,
        transmission,
        reflects: max3(kr) > R::ZERO || (total && m.fresnel == 0),
        transmits: transparent && !total,
    }
}

/// What an interface lets through to a shadow ray: kt, or kt(1−R) with R taken from the rarer side, never total.
pub fn shadow_transmission<R: Real>(
    world: &World,
    surface: &Surface<R>,
    direction: Vec3<R>,
    before: u32,
    behind: u32,
) -> Vec3<R> {
    let m = &world.scene.materials[surface.material as usize];
    let kt = Vec3::load(m.transmission);
    if m.fresnel == 0 {
        return kt;
    }
    let c = dot3(direction, surface.normal).abs().least(R::ONE);
    let (a, b) = (index_of::<R>(world, before), index_of::<R>(world, behind));
    let eta = a.greatest(b) / a.least(b);
    kt * (R::ONE - fresnel(c, eta).reflectance)
}

/// Refractive index of a medium.
pub fn index_of<R: Real>(world: &World, medium: u32) -> R {
    R::real(world.scene.materials[medium as usize].ior)
}
