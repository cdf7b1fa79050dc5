//! Lights and background.

use glam::DVec3;

use super::number::{MAX_COORDINATE, narrow, narrow3};
use super::texels::Texels;
use crate::layout::{FlatTexture, Light};
use crate::scene::{self, Background, Diagnostic, Falloff, Scene, SceneError};

/// A light's record, by its place in the file and what the file says.
pub(super) fn light((index, light): (usize, &scene::Light)) -> Result<Light, SceneError> {
    check_range(&format!("light {}", index + 1), light.position)?;
    Ok(Light {
        position: narrow3(light.position),
        inverse_square: u32::from(light.falloff == Falloff::InverseSquare),
        intensity: narrow3(light.intensity),
        reserved: 0,
    })
}

/// Refuse a place beyond [`MAX_COORDINATE`].
pub(super) fn check_range(what: &str, place: DVec3) -> Result<(), SceneError> {
    if place.abs().max_element() <= MAX_COORDINATE {
        return Ok(());
    }
    let message = format!("{what} stands beyond ±{MAX_COORDINATE:.2e}");
    Err(Diagnostic::error(message).hint("bring it nearer").into())
}

/// A background picture, its turn and its intensity.
pub(super) type Environment = (FlatTexture, f32, f32);

/// Radiance at the horizon and at the zenith (black behind a picture), and the picture.
pub(super) fn background(scene: &Scene, texels: &mut Texels) -> ([f32; 3], [f32; 3], Option<Environment>) {
    match scene.background {
        Background::Color(color) => (narrow3(color), narrow3(color), None),
        Background::Gradient { zenith, horizon } => (narrow3(horizon), narrow3(zenith), None),
        Background::Image { texture, rotation_y, intensity } => {
            let turn = narrow((rotation_y / 360.0).rem_euclid(1.0));
            // Rounding may reach 1, which is no turn at all.
            let turn = if turn < 1.0 { turn } else { 0.0 };
            let picture = texels.environment(scene, texture);
            ([0.0; 3], [0.0; 3], Some((picture, turn, narrow(intensity))))
        }
    }
}
