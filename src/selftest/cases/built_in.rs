//! Scenes that lie in the program: they name no other file.

use std::path::Path;

use crate::scene::{Scene, SceneError};

/// Liquid in ice: every kind of ray.
pub(super) const GLASS: (&str, &str) = ("glass", include_str!("glass.toml"));
/// Each with its name.
pub(super) const ALL: [(&str, &str); 3] = [
    GLASS,
    ("mirrors", include_str!("../../../scenes/mirrors.toml")),
    ("opaque", include_str!("../../../scenes/opaque.toml")),
];

/// Read one, as a picture of so many pixels, of one sample.
pub(super) fn read((name, text): (&str, &str), size: [u32; 2]) -> Result<Scene, SceneError> {
    let mut scene = Scene::parse(Path::new(name), text)?;
    (scene.render.size, scene.render.samples) = (size, 1);
    Ok(scene)
}
