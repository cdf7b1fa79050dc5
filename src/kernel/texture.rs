//! Texture lookups by hand, from texels in a buffer: samplers round as they like. Twin of `shaders/texture.wgsl`.

use super::{Real, Simulation, Vec3, World};

/// The four texels around a point, and the weights of the right and lower ones.
#[derive(Debug, Clone, Copy)]
pub struct Footprint<R> {
    /// Columns.
    pub x: [u32; 2],
    /// Rows.
    pub y: [u32; 2],
    /// Weight of the second column.
    pub fx: R,
    /// Weight of the second row.
    pub fy: R,
}

/// A repeating 8-bit sRGB texture at (u, v), v upwards, bilinear in linear light.
pub fn texture_color<R: Real>(world: &World<impl Simulation>, material: u32, uv: [R; 2]) -> Vec3<R> {
    let m = &world.scene.materials[material as usize];
    let [x, fx] = wrap(uv[0], m.texture_width);
    let [y, fy] = wrap(R::ZERO - uv[1], m.texture_height);
    let f = footprint(x, fx, y, fy, m.texture_width, m.texture_height);
    let texel = |column: u32, row: u32| srgb_texel(world, m.texture + row * m.texture_width + column);
    blend(
        texel(f.x[0], f.y[0]),
        texel(f.x[1], f.y[0]),
        texel(f.x[0], f.y[1]),
        texel(f.x[1], f.y[1]),
        f.fx,
        f.fy,
    )
}

/// The texel left of a repeating coordinate, from −1, and the weight of its right neighbour.
pub fn wrap<R: Real>(u: R, size: u32) -> [R; 2] {
    let x = (u - u.floor()) * R::from_i32(size as i32) - R::of(0.5);
    [x.floor(), x - x.floor()]
}

/// The texels around (x, y), wrapped in both directions.
pub fn footprint<R: Real>(x: R, fx: R, y: R, fy: R, width: u32, height: u32) -> Footprint<R> {
    Footprint {
        x: [wrap_index(x.to_i32(), width), wrap_index(x.to_i32() + 1, width)],
        y: [wrap_index(y.to_i32(), height), wrap_index(y.to_i32() + 1, height)],
        fx,
        fy,
    }
}

/// An index in [−1, size] into [0, size).
pub fn wrap_index(i: i32, size: u32) -> u32 {
    if i < 0 {
        size - 1
    } else if i >= size as i32 {
        0
    } else {
        i as u32
    }
}

/// Bilinear interpolation, rows last.
pub fn blend<R: Real>(a: Vec3<R>, b: Vec3<R>, c: Vec3<R>, d: Vec3<R>, fx: R, fy: R) -> Vec3<R> {
    let upper = a + (b - a) * fx;
    let lower = c + (d - c) * fx;
    upper + (lower - upper) * fy
}

/// An 8-bit texel through the table at the head of the texels.
pub fn srgb_texel<R: Real>(world: &World<impl Simulation>, index: u32) -> Vec3<R> {
    let word = world.scene.texels[index as usize];
    Vec3::new(
        float_word(world, word & 255),
        float_word(world, (word >> 8) & 255),
        float_word(world, (word >> 16) & 255),
    )
}

/// A word of the texels as a float.
pub fn float_word<R: Real>(world: &World<impl Simulation>, index: u32) -> R {
    R::real(f32::from_bits(world.scene.texels[index as usize]))
}
