//! What a ray that meets nothing sees. Twin of `shaders/background.wgsl`.

use crate::layout::Effect;
use crate::layout::constants::{INV_PI, NONE};

use super::texture::{blend, float_word, footprint};
use super::{Real, Simulation, Vec3, World};

/// Radiance from infinity along a unit direction.
pub fn background<R: Real>(world: &World<impl Simulation>, direction: Vec3<R>) -> Vec3<R> {
    if world.view.environment != NONE && world.simulates(Effect::Environment) {
        return environment(world, direction);
    }
    let horizon = Vec3::load(world.view.horizon);
    let zenith = Vec3::load(world.view.zenith);
    let t = direction.y.greatest(R::ZERO).least(R::ONE);
    horizon + (zenith - horizon) * t
}

/// The equirectangular picture: its centre towards −Z, +X to the right of it, +Y up; bilinear.
pub fn environment<R: Real>(world: &World<impl Simulation>, direction: Vec3<R>) -> Vec3<R> {
    let view = world.view;
    let d = direction;
    let azimuth = R::arctangent(d.x, -d.z);
    let polar = R::arctangent((d.x * d.x + d.z * d.z).sqrt(), d.y);
    // Turns from the left edge, and from the top.
    let u = azimuth * R::of(INV_PI) * R::of(0.5) + R::of(0.5) + R::real(view.environment_turn);
    let v = polar * R::of(INV_PI);
    let x = (u - u.floor()) * R::from_i32(view.environment_width as i32) - R::of(0.5);
    let rows = R::from_i32(view.environment_height as i32);
    let y = (v * rows - R::of(0.5)).greatest(R::ZERO).least(rows - R::ONE);
    let (x0, y0) = (x.floor(), y.floor());
    let f = footprint(x0, x - x0, y0, y - y0, view.environment_width, view.environment_height);
    let texel = |column: u32, row: u32| linear_texel(world, row * view.environment_width + column);
    let color = blend(
        texel(f.x[0], f.y[0]),
        texel(f.x[1], f.y[0]),
        texel(f.x[0], f.y[1]),
        texel(f.x[1], f.y[1]),
        f.fx,
        f.fy,
    );
    color * R::real(view.environment_intensity)
}

/// Texel `i` of the picture.
pub fn linear_texel<R: Real>(world: &World<impl Simulation>, i: u32) -> Vec3<R> {
    let first = world.view.environment + i * 3;
    Vec3::new(float_word(world, first), float_word(world, first + 1), float_word(world, first + 2))
}
