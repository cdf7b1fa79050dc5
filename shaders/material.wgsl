// Stop 6 of 7: material. Twin of src/kernel/material.rs.

import package::real::{real, vec3r, least, greatest};
import package::math::{dot3, max3, unit3};
import package::surface::{Surface, turn_towards};
import package::bindings::materials;

// Where light goes on from a surface, and with which weights.
struct Scatter {
    reflects: bool,
    @if(reflection) reflected: vec3r,
    @if(reflection) reflection: vec3r,
    @if(transmission) refracted: vec3r,
    @if(transmission) transmission: vec3r,
    @if(transmission) transmits: bool,
}

// Fresnel's answer for unpolarised light.
struct Fresnel {
    reflectance: real,
    bend: real,
    total: bool,
}

// Fresnel reflectance at cosine c >= 0 for eta = n2/n1 (Cook and Torrance 1982, section 4, rearranged).
fn fresnel(c: real, eta: real) -> Fresnel {
    let step = (eta - 1.0) * (eta + 1.0);
    if step == 0.0 {
        return Fresnel(0.0, 0.0, false);
    }
    let g2 = step + c * c;
    if g2 <= 0.0 {
        return Fresnel(1.0, 0.0, true);
    }
    let g = sqrt(g2);
    let sum = g + c;
    let bend = step / sum;
    let ratio = bend / sum;
    let k = (c * sum - 1.0) / (c * bend + 1.0);
    let reflectance = 0.5 * ratio * ratio * (1.0 + k * k);
    return Fresnel(least(reflectance, 1.0), bend, false);
}

// Reflect and refract at an interface between two media, given by their material indices.
fn scatter(surface: Surface, direction: vec3r, before: u32, behind: u32) -> Scatter {
    let kr = vec3r(materials[surface.material].reflection);
    @if(transmission) let kt = vec3r(materials[surface.material].transmission);
    var result: Scatter;
    // Opaque matter has its own index behind the face.
    @if(transmission) let transparent = is_transmissive(surface.material);
    @else let transparent = false;
    if max3(kr) <= 0.0 && !transparent {
        return result;
    }
    let n = surface.normal;
    let c = least(greatest(0.0 - dot3(direction, n), 0.0), 1.0);
    @if(fresnel || transmission) let inner = select(surface.material, behind, transparent);
    @if(fresnel || transmission) let f = fresnel(c, index_of(inner) / index_of(before));
    @if(fresnel) let weighted = materials[surface.material].fresnel != 0u;
    @else let weighted = false;
    @if(transmission) let total = transparent && f.total;
    @else let total = false;
    // Mirror direction, kept on the arriving side of the face.
    @if(reflection) {
        if max3(kr) > 0.0 || (total && !weighted) {
            let mirrored = direction + n * (c + c);
            result.reflects = true;
            result.reflected = turn_towards(mirrored, surface.face_normal);
            result.reflection = kr;
            @if(fresnel) {
                if weighted {
                    result.reflection = kr * f.reflectance;
                }
            }
            @if(transmission) {
                if total && !weighted {
                    result.reflection = kr + kt;
                }
            }
        }
    }
    // Snell: eta t = d - (g - c) n, kept on the other side.
    @if(transmission) {
        if transparent && !total {
            result.transmits = true;
            result.refracted = direction;
            if f.bend != 0.0 {
                let bent = direction - n * f.bend;
                result.refracted = turn_towards(unit3(bent), -surface.face_normal);
            }
            result.transmission = kt;
            @if(fresnel) {
                if weighted {
                    result.transmission = kt * (1.0 - f.reflectance);
                }
            }
        }
    }
    return result;
}

// What an interface lets through to a shadow ray: kt, or kt(1-R) with R taken from the rarer side, never total.
fn shadow_transmission(surface: Surface, direction: vec3r, before: u32, behind: u32) -> vec3r {
    let kt = vec3r(materials[surface.material].transmission);
    @if(!fresnel) return kt;
    @if(fresnel) {
        if materials[surface.material].fresnel == 0u {
            return kt;
        }
        let c = least(abs(dot3(direction, surface.normal)), 1.0);
        let a = index_of(before);
        let b = index_of(behind);
        let eta = greatest(a, b) / least(a, b);
        return kt * (1.0 - fresnel(c, eta).reflectance);
    }
}

// Whether a material lets light through.
fn is_transmissive(material: u32) -> bool {
    return max3(vec3r(materials[material].transmission)) > 0.0;
}

// Refractive index of a medium.
fn index_of(medium: u32) -> real {
    return real(materials[medium].ior);
}
