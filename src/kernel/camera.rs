//! Stop 1 of 7: camera. Twin of `shaders/camera.wgsl`.

use super::math::unit3;
use super::{Real, Simulation, Vec3, World};

/// Unit direction from the eye through the point (x, y) of the picture, in pixels from its top left corner.
pub fn primary_ray<R: Real>(world: &World<impl Simulation>, x: R, y: R) -> Vec3<R> {
    let view = world.view;
    let sx = (x + x) / R::from_i32(view.width as i32) - R::ONE;
    let sy = R::ONE - (y + y) / R::from_i32(view.height as i32);
    let forward = Vec3::load(view.forward);
    unit3(forward + Vec3::load(view.right) * sx + Vec3::load(view.up) * sy)
}
