//! The uniform record of a frame.

use std::array;

use super::number::narrow3;
use super::winding::start_media;
use crate::layout::{Attribute, FlatScene, FlatTexture, Settings, View};
use crate::scene::Camera;

/// What a camera sees of a flat scene, as a picture of `size` pixels, or the part `crop` of it (left, top,
/// width, height in pixels). The basis and the media at the eye are computed in f64 and rounded once.
#[must_use]
pub fn view(
    camera: &Camera,
    scene: &FlatScene,
    size: [u32; 2],
    crop: Option<[u32; 4]>,
    settings: &Settings,
) -> View {
    let [width, height] = size;
    let eye = narrow3(camera.eye);
    let half_height = (camera.fov_y.to_radians() / 2.0).tan();
    let half_width = half_height * f64::from(width) / f64::from(height);
    let absent = (FlatTexture { first: Attribute::NONE, width: 0, height: 0 }, 0.0, 0.0);
    let (environment, environment_turn, environment_intensity) = scene.environment.unwrap_or(absent);
    let bound = |level: usize| scene.radiance_bound.get(level).copied().unwrap_or(0.0);
    View {
        eye,
        width,
        forward: narrow3(camera.forward),
        height,
        right: narrow3(camera.right * half_width),
        // Where rays start: the rounded eye.
        start_media: start_media(scene, eye.map(f64::from)),
        up: narrow3(camera.up * half_height),
        depth: settings.depth,
        ambient: scene.ambient,
        cutoff: settings.cutoff,
        horizon: scene.horizon,
        samples: settings.samples,
        zenith: scene.zenith,
        lights: scene.lights.len() as u32,
        scene_lo: scene.bounds[0],
        transmissive_bodies: scene.transmissive_bodies,
        scene_hi: scene.bounds[1],
        environment: environment.first,
        environment_width: environment.width,
        environment_height: environment.height,
        environment_turn,
        environment_intensity,
        crop: crop.unwrap_or([0, 0, width, height]),
        media: array::from_fn(|row| array::from_fn(|column| medium(scene, row * 4 + column))),
        radiance_bound: array::from_fn(|row| array::from_fn(|column| bound(row * 4 + column))),
    }
}

/// The material of a transmissive body; the air's beyond the last.
fn medium(scene: &FlatScene, body: usize) -> u32 {
    scene.bodies[..scene.transmissive_bodies as usize].get(body).map_or(0, |body| body.material)
}
