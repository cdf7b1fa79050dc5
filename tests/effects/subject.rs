//! Scenes, to be traced with one choice of effects and with another.

use std::path::{Path, PathBuf};

use snellius::cpu::CpuRenderer;
use snellius::film::{Frame, Renderer};
use snellius::flatten;
use snellius::gpu::{GpuOptions, GpuRenderer};
use snellius::layout::{EffectChoice, EffectSet, Effects, FlatScene, Settings, View};
use snellius::scene::Scene;

/// A scene, and how it is seen.
pub(super) struct Subject {
    pub(super) name: String,
    pub(super) flat: FlatScene,
    pub(super) view: View,
    pub(super) settings: Settings,
}

impl Subject {
    /// A scene of `scenes/`, at two samples a pixel.
    pub(super) fn file(name: &str, size: [u32; 2]) -> Self {
        Self::load(&folder().join(name), Some(size), 2)
    }

    /// A scene that is written down here.
    pub(super) fn text(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, text).unwrap();
        Self::load(&path, None, 1)
    }

    fn load(path: &Path, size: Option<[u32; 2]>, samples: u32) -> Self {
        let scene = Scene::load(path).unwrap_or_else(|error| panic!("{error}"));
        let flat = flatten::flatten(&scene).unwrap_or_else(|error| panic!("{error}")).scene;
        let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
        let settings = Settings { depth, cutoff, samples, ..Settings::default() };
        let view = flatten::view(&scene.camera, &flat, size.unwrap_or(scene.render.size), None, &settings);
        Self { name: path.display().to_string(), flat, view, settings }
    }

    /// What is called for.
    pub(super) fn called_for(&self) -> EffectSet {
        Effects::of(&self.flat, &self.settings).set()
    }

    pub(super) fn on_cpu(&self, effects: EffectChoice) -> Frame {
        let settings = Settings { effects, ..self.settings };
        CpuRenderer::new(&self.flat, 1).unwrap().render(&self.view, &settings, &()).unwrap()
    }

    pub(super) fn renderer(&self, options: &GpuOptions) -> GpuRenderer {
        GpuRenderer::new(&self.flat, options).unwrap()
    }

    pub(super) fn on_gpu(&self, renderer: &mut GpuRenderer, effects: EffectChoice) -> Frame {
        renderer.render(&self.view, &Settings { effects, ..self.settings }, &()).unwrap()
    }
}

/// The scenes that come with the program.
pub(super) fn files() -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let mut scenes: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    scenes.sort();
    assert!(scenes.len() >= 7, "{scenes:?}");
    scenes
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// Fail unless every bit of every pixel and every ray count is the same.
pub(super) fn assert_same(a: &Frame, b: &Frame, what: &str) {
    let differing = a.texels.iter().zip(&b.texels).filter(|(a, b)| a != b).count();
    assert_eq!((a.texels.len(), differing), (b.texels.len(), 0), "{what}");
    assert_eq!(a.rays, b.rays, "{what}");
}
