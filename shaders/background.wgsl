// What a ray that meets nothing sees. Twin of src/kernel/background.rs.

import package::real::{real, vec3r, least, greatest};
import package::math::arctangent;
import package::texture::{blend, float_word, footprint};
import package::bindings::frame;
import package::constants::{INV_PI, NONE};

// Radiance from infinity along a unit direction.
fn background(direction: vec3r) -> vec3r {
    @if(environment) {
        if frame.view.environment != NONE {
            return environment(direction);
        }
    }
    let horizon = vec3r(frame.view.horizon);
    let zenith = vec3r(frame.view.zenith);
    let t = least(greatest(direction.y, 0.0), 1.0);
    return horizon + (zenith - horizon) * t;
}

// The equirectangular picture: its centre towards -Z, +X to the right of it, +Y up; bilinear.
fn environment(d: vec3r) -> vec3r {
    let azimuth = arctangent(d.x, -d.z);
    let polar = arctangent(sqrt(d.x * d.x + d.z * d.z), d.y);
    // Turns from the left edge, and from the top.
    let u = azimuth * INV_PI * 0.5 + 0.5 + real(frame.view.environment_turn);
    let v = polar * INV_PI;
    let width = frame.view.environment_width;
    let x = (u - floor(u)) * real(i32(width)) - 0.5;
    let rows = real(i32(frame.view.environment_height));
    let y = least(greatest(v * rows - 0.5, 0.0), rows - 1.0);
    let x0 = floor(x);
    let y0 = floor(y);
    let f = footprint(x0, x - x0, y0, y - y0, width, frame.view.environment_height);
    let color = blend(
        linear_texel(f.y.x * width + f.x.x),
        linear_texel(f.y.x * width + f.x.y),
        linear_texel(f.y.y * width + f.x.x),
        linear_texel(f.y.y * width + f.x.y),
        f.fx,
        f.fy,
    );
    return color * real(frame.view.environment_intensity);
}

// Texel `i` of the picture.
fn linear_texel(i: u32) -> vec3r {
    let first = frame.view.environment + i * 3u;
    return vec3r(float_word(first), float_word(first + 1u), float_word(first + 2u));
}
