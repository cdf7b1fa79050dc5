// Texture lookups by hand, from texels in a buffer. Twin of src/kernel/texture.rs.

import package::real::{real, vec3r};
import package::bindings::{materials, texels};

// The four texels around a point, and the weights of the right and lower ones.
struct Footprint {
    x: vec2u,
    y: vec2u,
    fx: real,
    fy: real,
}

// A repeating 8-bit sRGB texture at (u, v), v upwards, bilinear in linear light.
fn texture_color(material: u32, uv: array<real, 2>) -> vec3r {
    let first = materials[material].texture;
    let width = materials[material].texture_width;
    let height = materials[material].texture_height;
    let x = wrap(uv[0], width);
    let y = wrap(0.0 - uv[1], height);
    let f = footprint(x[0], x[1], y[0], y[1], width, height);
    return blend(
        srgb_texel(first + f.y.x * width + f.x.x),
        srgb_texel(first + f.y.x * width + f.x.y),
        srgb_texel(first + f.y.y * width + f.x.x),
        srgb_texel(first + f.y.y * width + f.x.y),
        f.fx,
        f.fy,
    );
}

// The texel left of a repeating coordinate, from -1, and the weight of its right neighbour.
fn wrap(u: real, size: u32) -> array<real, 2> {
    let x = (u - floor(u)) * real(i32(size)) - 0.5;
    return array<real, 2>(floor(x), x - floor(x));
}

// The texels around (x, y), wrapped in both directions.
fn footprint(x: real, fx: real, y: real, fy: real, width: u32, height: u32) -> Footprint {
    return Footprint(
        vec2u(wrap_index(i32(x), width), wrap_index(i32(x) + 1, width)),
        vec2u(wrap_index(i32(y), height), wrap_index(i32(y) + 1, height)),
        fx,
        fy,
    );
}

// An index in [-1, size] into [0, size).
fn wrap_index(i: i32, size: u32) -> u32 {
    if i < 0 {
        return size - 1u;
    }
    if i >= i32(size) {
        return 0u;
    }
    return u32(i);
}

// Bilinear interpolation, rows last.
fn blend(a: vec3r, b: vec3r, c: vec3r, d: vec3r, fx: real, fy: real) -> vec3r {
    let above = a + (b - a) * fx;
    let below = c + (d - c) * fx;
    return above + (below - above) * fy;
}

// An 8-bit texel through the table at the head of the texels.
fn srgb_texel(index: u32) -> vec3r {
    let word = texels[index];
    return vec3r(float_word(word & 255u), float_word((word >> 8) & 255u), float_word((word >> 16) & 255u));
}

// A word of the texels as a float.
fn float_word(index: u32) -> real {
    return real(bitcast<f32>(texels[index]));
}
