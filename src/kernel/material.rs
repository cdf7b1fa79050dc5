//! Stop 6 of 7: material. Twin of `shaders/material.wgsl`.

use crate::layout::Effect;

use super::math::{dot3, max3, unit3};
use super::surface::{Surface, turn_towards};
use super::{Real, Simulation, Vec3, World};

/// Where light goes on from a surface, and with which weights.
#[derive(Debug, Clone, Copy, Default)]
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
    world: &World<impl Simulation>,
    surface: &Surface<R>,
    direction: Vec3<R>,
    before: u32,
    behind: u32,
) -> Scatter<R> {
    let m = &world.scene.materials[surface.material as usize];
    let kr = Vec3::load(m.reflection);
    let kt = Vec3::load(m.transmission);
    let mut result = Scatter::default();
    // Opaque matter has its own index behind the face.
    let transparent = is_transmissive(world, surface.material);
    if max3(kr) <= R::ZERO && !transparent {
        return result;
    }
    let n = surface.normal;
    let c = (R::ZERO - dot3(direction, n)).greatest(R::ZERO).least(R::ONE);
    let inner = if transparent { behind } else { surface.material };
    let eta = index_of::<R>(world, inner) / index_of::<R>(world, before);
    let f = fresnel(c, eta);
    let weighted = m.fresnel != 0 && world.simulates(Effect::Fresnel);
    let total = transparent && f.total;
    // Mirror direction, kept on the arriving side of the face.
    if (max3(kr) > R::ZERO || (total && !weighted)) && world.simulates(Effect::Reflection) {
        let mirrored = direction + n * (c + c);
        result.reflects = true;
        result.reflected = turn_towards(mirrored, surface.face_normal);
        result.reflection = kr;
        if weighted {
            result.reflection = kr * f.reflectance;
        } else if total {
            result.reflection = kr + kt;
        }
    }
    // Snell: η t = d − (g − c) n, kept on the other side.
    if transparent && !total {
        result.transmits = true;
        result.refracted = direction;
        if f.bend != R::ZERO {
            let bent = direction - n * f.bend;
            result.refracted = turn_towards(unit3(bent), -surface.face_normal);
        }
        result.transmission = kt;
        if weighted {
            result.transmission = kt * (R::ONE - f.reflectance);
        }
    }
    result
}

/// What an interface lets through to a shadow ray: kt, or kt(1−R) with R taken from the rarer side, never total.
pub fn shadow_transmission<R: Real>(
    world: &World<impl Simulation>,
    surface: &Surface<R>,
    direction: Vec3<R>,
    before: u32,
    behind: u32,
) -> Vec3<R> {
    let m = &world.scene.materials[surface.material as usize];
    let kt = Vec3::load(m.transmission);
    if m.fresnel == 0 || !world.simulates(Effect::Fresnel) {
        return kt;
    }
    let c = dot3(direction, surface.normal).abs().least(R::ONE);
    let (a, b) = (index_of::<R>(world, before), index_of::<R>(world, behind));
    let eta = a.greatest(b) / a.least(b);
    kt * (R::ONE - fresnel(c, eta).reflectance)
}

/// Whether a material lets light through.
pub fn is_transmissive(world: &World<impl Simulation>, material: u32) -> bool {
    let kt = world.scene.materials[material as usize].transmission;
    max3(Vec3::<f32>::load(kt)) > 0.0 && world.simulates(Effect::Transmission)
}

/// Refractive index of a medium.
pub fn index_of<R: Real>(world: &World<impl Simulation>, medium: u32) -> R {
    R::real(world.scene.materials[medium as usize].ior)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ICE: f64 = 1.31;
    const WATER: f64 = 1.333;

    /// Both polarisations by the textbook's formulae (Born and Wolf, section 1.5.2).
    fn textbook(c: f64, eta: f64) -> f64 {
        let ct = (1.0 - (1.0 - c * c) / (eta * eta)).sqrt();
        let rs = (c - eta * ct) / (c + eta * ct);
        let rp = (eta * c - ct) / (eta * c + ct);
        0.5 * (rs * rs + rp * rp)
    }

    #[test]
    fn normal_incidence_reflects_the_known_fractions() {
        for (eta, expected) in [(ICE, 0.018_009_4), (WATER, 0.020_373_2), (WATER / ICE, 7.573e-5)] {
            let r = fresnel(1.0f64, eta).reflectance;
            assert!((r - expected).abs() < 1e-7, "{eta}: {r}");
        }
    }

    #[test]
    fn fresnel_equals_the_textbook_at_every_angle() {
        for eta in [ICE, WATER, 1.0 / ICE, WATER / ICE, 2.4] {
            for i in 1..=1000 {
                let c = f64::from(i) / 1000.0;
                if eta * eta < 1.0 - c * c {
                    assert!(fresnel(c, eta).total && fresnel(c, eta).reflectance == 1.0);
                } else {
                    assert!((fresnel(c, eta).reflectance - textbook(c, eta)).abs() < 1e-12, "{eta} {c}");
                }
            }
        }
    }

    #[test]
    fn an_index_match_reflects_exactly_nothing_at_any_angle() {
        for c in [1.0f32, 1e-3, 1e-7, 0.0] {
            let f = fresnel(c, 1.0);
            assert_eq!((f.reflectance, f.bend, f.total), (0.0, 0.0, false));
        }
    }

    #[test]
    fn total_reflection_sets_in_at_the_critical_angles() {
        for (eta, degrees) in [(1.0 / ICE, 49.761f64), (1.0 / WATER, 48.607), (ICE / WATER, 79.341)] {
            let total = |angle: f64| fresnel(angle.to_radians().cos(), eta).total;
            assert!(!total(degrees - 2e-3) && total(degrees + 2e-3), "{eta}");
        }
    }

    #[test]
    fn grazing_light_is_reflected_as_the_expansion_says() {
        for n in [ICE, WATER] {
            for c in [1e-3f32, 1e-5, 1e-7] {
                let r = f64::from(fresnel(c, n as f32).reflectance);
                let c = f64::from(c);
                let expansion = 1.0 - 2.0 * c * (1.0 + n * n) / (n * n - 1.0).sqrt();
                assert!((r - expansion).abs() <= 25.0 * c * c + 5e-7, "{n} {c}: {r}");
            }
        }
    }
}
