// Stop 6 of 7: material. Twin of src/kernel/material.rs.

import package::real::{real, vec3r, least, greatest};
import package::math::{dot3, max3, unit3};
import package::surface::{Surface, turn_towards};
import package::bindings::materials;

// Where light goes on from a surface, and with which weights.
struct Scatter {
    reflected: vec3r,
    reflection: vec3r,
    refracted: vec3r,
    transmission: vec3r,
    reflects: bool,
    transmits: bool,
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
    let kt = vec3r(materials[surface.material].transmission);
    let weighted = materials[surface.material].fresnel != 0u;
    let n = surface.normal;
    let c = least(greatest(0.0 - dot3(direction, n), 0.0), 1.0);
    // Opaque matter has its own index behind the face.
    let transparent = max3(kt) > 0.0;
    let inner = select(surface.material, behind, transparent);
    let eta = index_of(inner) / index_of(before);
    let f = fresnel(c, eta);
    // Mirror direction, kept on the arriving side of the face.
    let mirrored = direction + n * (c + c);
    let reflected = turn_towards(mirrored, surface.face_normal);
    // Snell: eta t = d - (g - c) n, kept on the other side.
    var refracted = direction;
    if f.bend != 0.0 {
        let bent = direction - n * f.bend;
        refracted = turn_towards(unit3(bent), -surface.face_normal);
    }
    let total = transparent && f.total;
    var reflection = kr;
    var transmission = kt;
    if weighted {
        reflection = kr * f.reflectance;
        transmission = kt * (1.0 - f.reflectance);
    } else if total {
        reflection = kr + kt;
    }
    return Scatter(
        reflected,
        reflection,
        refracted,
        transmission,
        max3(kr) > 0.0 || (total && !weighted),
        transparent && !total,
    );
}

// What an interface lets through to a shadow ray: kt, or kt(1-R) with R taken from the rarer side, never total.
fn shadow_transmission(surface: Surface, direction: vec3r, before: u32, behind: u32) -> vec3r {
    let kt = vec3r(materials[surface.material].transmission);
    if materials[surface.material].fresnel == 0u {
        return kt;
    }
    let c = least(abs(dot3(direction, surface.normal)), 1.0);
    let a = index_of(before);
    let b = index_of(behind);
    let eta = greatest(a, b) / least(a, b);
    return kt * (1.0 - fresnel(c, eta).reflectance);
}

// Refractive index of a medium.
fn index_of(medium: u32) -> real {
    return real(materials[medium].ior);
}
