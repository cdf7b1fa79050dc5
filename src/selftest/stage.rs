//! A scene, flattened and in view: what cases put in front of a device.

use super::DeviceError;
use crate::flatten;
use crate::layout::constants::NONE;
use crate::layout::{FlatScene, Settings, View};
use crate::scene::Scene;

/// A scene that every device can trace.
#[derive(Debug, Clone)]
pub struct Stage {
    /// What renderers read.
    pub flat: FlatScene,
    /// Camera and constants.
    pub view: View,
    /// The scene's own depth, cut-off and samples.
    pub settings: Settings,
}

impl Stage {
    /// Flatten a scene and aim its camera.
    ///
    /// # Errors
    /// [`DeviceError::Scene`].
    pub fn new(scene: &Scene) -> Result<Self, DeviceError> {
        let flat = flatten::flatten(scene)?.scene;
        let render = &scene.render;
        let settings = Settings {
            depth: render.depth,
            cutoff: render.cutoff as f32,
            samples: render.samples,
            ..Settings::default()
        };
        let view = flatten::view(&scene.camera, &flat, render.size, None, &settings);
        Ok(Self { flat, view, settings })
    }

    /// At which place each triangle stands, by primitive id, where they stand in this order of
    /// [`FlatScene::triangles`].
    #[must_use]
    pub fn places(&self, order: impl IntoIterator<Item = u32>) -> Vec<u32> {
        let mut places = vec![NONE; self.flat.attributes.len()];
        for (place, index) in (0..).zip(order) {
            places[self.flat.triangles[index as usize].id as usize] = place;
        }
        places
    }

    /// The view for other settings than the scene's own.
    #[must_use]
    pub fn view_for(&self, settings: &Settings) -> View {
        View { depth: settings.depth, cutoff: settings.cutoff, samples: settings.samples, ..self.view }
    }
}
