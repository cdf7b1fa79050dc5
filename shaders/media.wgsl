// Which matter a ray is in. Twin of src/kernel/media.rs.

import package::real::{real, vec3r};
import package::math::exp_neg;
import package::bindings::{attributes, frame, materials};
import package::constants::{AIR, NONE, OPPOSITE};

// Material index of the medium: that of the lowest set bit, the air where none is set.
fn current_medium(mask: u32) -> u32 {
    if mask == 0u {
        return AIR;
    }
    let body = countTrailingZeros(mask);
    return frame.view.media[body >> 2][body & 3];
}

// The mask behind a face, for a ray that meets it from its front or its back.
fn cross_face(mask: u32, id: u32, front: bool) -> u32 {
    let body = attributes[id].body;
    var behind = set_body(mask, body, front);
    @if(nested_media) {
        let other = attributes[id].other;
        if other != NONE {
            let opposite = (other & OPPOSITE) != 0u;
            behind = set_body(behind, other & ~OPPOSITE, front != opposite);
        }
    }
    return behind;
}

// The mask with a body's bit set or cleared; opaque bodies have none.
fn set_body(mask: u32, body: u32, inside: bool) -> u32 {
    if body >= frame.view.transmissive_bodies {
        return mask;
    }
    let bit = 1u << body;
    let others = mask & ~bit;
    if !inside {
        return others;
    }
    @if(nested_media) return mask | bit;
    @else return bit;
}

// What is left of light after a distance in a medium, per channel: exp(-sigma t) (Beer–Lambert).
fn attenuation(medium: u32, t: real) -> vec3r {
    let sigma = materials[medium].absorption;
    return vec3r(attenuate(sigma.x, t), attenuate(sigma.y, t), attenuate(sigma.z, t));
}

// exp(-sigma t), exactly 1 where nothing is absorbed.
fn attenuate(sigma: f32, t: real) -> real {
    if sigma == 0.0 {
        return 1.0;
    }
    return exp_neg(real(sigma) * t);
}
