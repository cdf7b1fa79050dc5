//! Stop 5 of 7: light. Twin of `shaders/light.wgsl`.

use crate::layout::Effect;
use crate::layout::constants::{MAX_PASSES, NONE};

use super::bvh::make_ray;
use super::material::{is_transmissive, shadow_transmission};
use super::math::{dot3, length3, max3};
use super::media::{attenuation, cross_face, current_medium};
use super::surface::{Surface, resolve, spawn_behind};
use super::texture::texture_color;
use super::{Real, Simulation, Vec3, World};

/// What the point lights and the ambient light give a surface.
#[derive(Debug, Clone, Copy)]
pub struct Direct<R> {
    /// Radiance towards the arriving ray.
    pub radiance: Vec3<R>,
    /// Bit j mod 32 is flipped for every light j that is seen.
    pub seen: u32,
    /// Shadow rays traced.
    pub shadow_rays: u32,
}

/// The local terms ka·Ia + Σj Tj·Ij·[kd·(n·lj) + ks·(s·rj)^β], lights in order.
pub fn direct<R: Real>(
    world: &World<impl Simulation>,
    surface: &Surface<R>,
    direction: Vec3<R>,
    media: u32,
) -> Direct<R> {
    let m = &world.scene.materials[surface.material as usize];
    let mut tint = Vec3::one();
    if m.texture != NONE && world.simulates(Effect::Textures) {
        tint = texture_color(world, surface.material, surface.uv);
    }
    let ambient = Vec3::load(m.ambient) * tint;
    let diffuse = Vec3::load(m.diffuse) * tint;
    let specular = Vec3::load(m.specular);
    let shines = max3(specular) > R::ZERO;
    let mut result = Direct { radiance: ambient * Vec3::load(world.view.ambient), seen: 0, shadow_rays: 0 };
    if max3(diffuse) <= R::ZERO && !shines {
        return result;
    }
    let origin = surface.shadow_point + surface.face_normal * surface.offset;
    for j in 0..world.view.lights {
        let light = &world.scene.lights[j as usize];
        let to_light = Vec3::load(light.position) - origin;
        let distance = length3(to_light);
        let l = Vec3::new(to_light.x / distance, to_light.y / distance, to_light.z / distance);
        // A light behind the shading surface gives nothing, and one at the very point has no direction.
        let cosine = dot3(surface.normal, l);
        let lit = cosine > R::ZERO;
        if !lit {
            continue;
        }
        let mut t = Vec3::one();
        if world.simulates(Effect::Shadows) {
            result.shadow_rays += 1;
            // From above its plane a ray that goes up does not meet the face; one that goes down may.
            let upwards = dot3(surface.face_normal, l) > R::ZERO;
            let origin_face = if upwards { surface.id } else { NONE };
            t = transmittance(world, origin, l, distance, Vec3::load(light.position), origin_face, media);
            if max3(t) <= R::ZERO {
                continue;
            }
        }
        result.seen ^= 1 << (j & 31);
        let mut intensity = Vec3::load(light.intensity);
        if light.inverse_square != 0 && world.simulates(Effect::Falloff) {
            let d2 = distance * distance;
            intensity = Vec3::new(intensity.x / d2, intensity.y / d2, intensity.z / d2);
        }
        let mut local = diffuse * cosine;
        if shines && world.simulates(Effect::Specular) {
            let lobe = phong(surface.normal, l, direction, cosine, R::real(m.shininess), specular);
            local = local + lobe;
        }
        result.radiance = result.radiance + t * intensity * local;
    }
    result
}

/// ks·(s·r)^β with r = 2(n·l)n − l and s = −direction (Phong 1975).
pub fn phong<R: Real>(
    n: Vec3<R>,
    l: Vec3<R>,
    direction: Vec3<R>,
    cosine: R,
    shininess: R,
    specular: Vec3<R>,
) -> Vec3<R> {
    let r = n * (cosine + cosine) - l;
    let s = R::ZERO - dot3(direction, r);
    if s <= R::ZERO {
        return Vec3::zero();
    }
    specular * R::power(s.least(R::ONE), shininess)
}

/// Tj: what comes straight, unrefracted, from a light to a point in the given media, per channel.
pub fn transmittance<R: Real>(
    world: &World<impl Simulation>,
    origin: Vec3<R>,
    l: Vec3<R>,
    distance: R,
    light: Vec3<R>,
    origin_face: u32,
    media: u32,
) -> Vec3<R> {
    // Where every body is opaque one blocker decides, whichever it is.
    if world.view.transmissive_bodies == 0 || !world.simulates(Effect::TintedShadows) {
        let ray = make_ray(world, origin, l, origin_face);
        let blocked = world.effects.occluded(world, &ray, distance);
        return if blocked { Vec3::zero() } else { Vec3::one() };
    }
    let mut result = Vec3::one();
    let mut mask = media;
    let mut start = origin;
    let mut face = origin_face;
    let mut left = distance;
    for _ in 0..MAX_PASSES {
        let ray = make_ray(world, start, l, face);
        let hit = world.effects.intersect(world, &ray, left);
        let medium = current_medium(world, mask);
        if hit.id == NONE {
            return result * attenuation(world, medium, left);
        }
        if !is_transmissive(world, world.scene.attributes[hit.id as usize].material) {
            return Vec3::zero();
        }
        let surface = resolve(world, &ray, &hit);
        result = result * attenuation(world, medium, hit.t);
        let next = cross_face(world, mask, hit.id, hit.front);
        let behind = current_medium(world, next);
        if behind != medium {
            result = result * shadow_transmission(world, &surface, l, medium, behind);
        }
        if max3(result) <= R::ZERO {
            return Vec3::zero();
        }
        mask = next;
        start = spawn_behind(&surface);
        face = surface.id;
        left = length3(light - start);
    }
    Vec3::zero()
}
