//! What the tests of this folder share.

#![cfg(test)]
#![allow(clippy::unwrap_used)]

#[path = "../../tests/lockstep/devices.rs"]
mod devices;

use std::path::Path;

use super::{GpuOptions, GpuRenderer, Variant};
use crate::cpu::CpuRenderer;
use crate::film::{Frame, Renderer};
use crate::flatten::{flatten, view};
use crate::gpu;
use crate::layout::{Effect, EffectSet, FlatScene, Float, Intersector, Lights, Precision, Settings, View};
use crate::scene::Scene;

pub(super) use devices::{find, on_each};

/// The variant of the default settings.
pub(super) const PLAIN: Variant = Variant {
    precision: Precision::F32,
    float: Float::Strict,
    intersector: Intersector::Watertight,
    effects: EffectSet::ALL.without(Effect::Aovs).without(Effect::Adaptive),
    lights: Lights::Many,
    stack_size: 16,
    bvh_stack: 24,
    tree: false,
};

/// A scene of `scenes/`, to be traced in f32 with AOVs.
pub(super) struct Subject {
    pub(super) scene: FlatScene,
    pub(super) view: View,
    pub(super) settings: Settings,
}

impl Subject {
    pub(super) fn new(file: &str, size: [u32; 2], samples: u32) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(file);
        let scene = Scene::load(&path).unwrap();
        let flat = flatten(&scene).unwrap().scene;
        let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
        let settings = Settings { depth, cutoff, samples, aovs: true, ..Settings::default() };
        let view = view(&scene.camera, &flat, size, None, &settings);
        Self { scene: flat, view, settings }
    }

    pub(super) fn with(self, precision: Precision) -> Self {
        Self { settings: Settings { precision, ..self.settings }, ..self }
    }

    /// With at most so many samples, refined to the threshold.
    pub(super) fn adaptive(mut self, samples: u32, threshold: f32) -> Self {
        self.view.samples = samples;
        self.settings = Settings { samples, adaptive: Some(threshold), ..self.settings };
        self
    }

    pub(super) fn on_cpu(&self) -> Frame {
        CpuRenderer::new(&self.scene, 0).unwrap().render(&self.view, &self.settings, &()).unwrap()
    }

    pub(super) fn renderer(&self, options: &GpuOptions) -> GpuRenderer {
        GpuRenderer::new(&self.scene, options).unwrap()
    }
}

/// Fail unless every pixel, AOV and ray count is the same.
pub(super) fn assert_same(a: &Frame, b: &Frame) {
    let differing = a.texels.iter().zip(&b.texels).filter(|(a, b)| a != b).count();
    assert_eq!((a.width, a.height, a.texels.len(), differing), (b.width, b.height, b.texels.len(), 0));
    assert_eq!(a.aovs, b.aovs);
    assert_eq!(a.samples, b.samples);
    assert_eq!(a.rays, b.rays);
    assert!(a.complete && b.complete);
}
