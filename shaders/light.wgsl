// Stop 5 of 7: light. Twin of src/kernel/light.rs.

import package::real::{real, vec3r, least};
import package::bvh::{intersect, make_ray, occluded, steps};
import package::material::{is_transmissive, shadow_transmission};
import package::math::{dot3, length3, max3, power};
import package::media::{attenuation, cross_face, current_medium};
import package::surface::{Surface, resolve, spawn_behind};
import package::texture::texture_color;
import package::bindings::{attributes, frame, materials};
import package::constants::{LOOP_STEPS, MAX_PASSES, NONE};

// What the point lights and the ambient light give a surface.
struct Direct {
    radiance: vec3r,
    seen: u32,
    shadow_rays: u32,
}

// The local terms ka·Ia + Σj Tj·Ij·[kd·(n·lj) + ks·(s·rj)^β], lights in order.
fn direct(surface: Surface, direction: vec3r, @if(tinted_shadows) media: u32) -> Direct {
    let m = materials[surface.material];
    var tint = vec3r(1.0);
    @if(textures) {
        if m.texture != NONE {
            tint = texture_color(surface.material, surface.uv);
        }
    }
    let ambient = vec3r(m.ambient) * tint;
    var result = Direct(ambient * vec3r(frame.view.ambient), 0u, 0u);
    @if(lights) {
        let diffuse = vec3r(m.diffuse) * tint;
        let specular = vec3r(m.specular);
        let shines = max3(specular) > 0.0;
        if max3(diffuse) <= 0.0 && !shines {
            return result;
        }
        let origin = surface.shadow_point + surface.face_normal * surface.offset;
        @if(one_light) let lights = 1u;
        @else let lights = frame.view.lights;
        for (var j = 0u; j < lights; j++) {
            steps += LOOP_STEPS;
            let position = vec3r(frame.lights[j].position);
            let to_light = position - origin;
            let distance = length3(to_light);
            let l = vec3r(to_light.x / distance, to_light.y / distance, to_light.z / distance);
            // A light behind the shading surface gives nothing, and one at the very point has no direction.
            let cosine = dot3(surface.normal, l);
            let lit = cosine > 0.0;
            if !lit {
                continue;
            }
            var t = vec3r(1.0);
            @if(shadows) {
                result.shadow_rays++;
                // From above its plane a ray that goes up does not meet the face; one that goes down may.
                let upwards = dot3(surface.face_normal, l) > 0.0;
                let origin_face = select(NONE, surface.id, upwards);
                @if(tinted_shadows) t = transmittance(origin, l, distance, position, origin_face, media);
                @else t = transmittance(origin, l, distance, position, origin_face);
                if max3(t) <= 0.0 {
                    continue;
                }
            }
            result.seen ^= 1u << (j & 31u);
            var intensity = vec3r(frame.lights[j].intensity);
            @if(falloff) {
                if frame.lights[j].inverse_square != 0u {
                    let d2 = distance * distance;
                    intensity = vec3r(intensity.x / d2, intensity.y / d2, intensity.z / d2);
                }
            }
            var local = diffuse * cosine;
            @if(specular) {
                if shines {
                    local = local + phong(surface.normal, l, direction, cosine, real(m.shininess), specular);
                }
            }
            result.radiance = result.radiance + t * intensity * local;
        }
    }
    return result;
}

// ks·(s·r)^β with r = 2(n·l)n − l and s = −direction (Phong 1975).
fn phong(n: vec3r, l: vec3r, direction: vec3r, cosine: real, shininess: real, specular: vec3r) -> vec3r {
    let r = n * (cosine + cosine) - l;
    let s = 0.0 - dot3(direction, r);
    if s <= 0.0 {
        return vec3r(0.0);
    }
    return specular * power(least(s, 1.0), shininess);
}

// Tj: what comes straight, unrefracted, from a light to a point in the given media, per channel.
fn transmittance(
    origin: vec3r, l: vec3r, distance: real, light: vec3r, origin_face: u32, @if(tinted_shadows) media: u32,
) -> vec3r {
    // Where every body is opaque one blocker decides, whichever it is.
    @if(!tinted_shadows) return select(vec3r(1.0), vec3r(0.0), occluded(make_ray(origin, l, origin_face), distance));
    @if(tinted_shadows) {
        var result = vec3r(1.0);
        var mask = media;
        var start = origin;
        var face = origin_face;
        var left = distance;
        for (var i = 0u; i < MAX_PASSES; i++) {
            steps += LOOP_STEPS;
            let ray = make_ray(start, l, face);
            let hit = intersect(ray, left);
            let medium = current_medium(mask);
            if hit.id == NONE {
                @if(absorption) result = result * attenuation(medium, left);
                return result;
            }
            if !is_transmissive(attributes[hit.id].material) {
                return vec3r(0.0);
            }
            @if(absorption) result = result * attenuation(medium, hit.t);
            let surface = resolve(ray, hit);
            let next = cross_face(mask, hit.id, hit.front);
            let behind = current_medium(next);
            if behind != medium {
                result = result * shadow_transmission(surface, l, medium, behind);
            }
            if max3(result) <= 0.0 {
                return vec3r(0.0);
            }
            mask = next;
            start = spawn_behind(surface);
            face = surface.id;
            left = length3(light - start);
        }
        return vec3r(0.0);
    }
}
