//! Scenes, to be traced with one choice of effects and with another.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use snellius::cpu::CpuRenderer;
use snellius::film::{Frame, Renderer};
use snellius::flatten;
use snellius::gpu::{GpuOptions, GpuRenderer};
use snellius::layout::{Effect, EffectChoice, EffectSet, Effects, FlatScene, Settings, View};
use snellius::scene::Scene;

/// A scene, and how it is seen.
pub(super) struct Subject {
    pub(super) name: String,
    scene: Arc<Scene>,
    pub(super) flat: Arc<FlatScene>,
    pub(super) view: View,
    pub(super) settings: Settings,
}

/// A scene as it was read and flattened.
type Loaded = (Arc<Scene>, Arc<FlatScene>);

/// The scenes of `scenes/` that were read, by name: each once for all tests.
static READ: LazyLock<Mutex<HashMap<String, Loaded>>> = LazyLock::new(Mutex::default);

impl Subject {
    /// A scene of `scenes/`, at two samples a pixel.
    pub(super) fn file(name: &str, size: [u32; 2]) -> Self {
        let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
        let loaded = read.entry(name.to_owned()).or_insert_with(|| load(&folder().join(name))).clone();
        drop(read);
        Self::new(name, loaded, size, 2)
    }

    /// A scene that is written down here.
    pub(super) fn text(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, text).unwrap();
        let loaded = load(&path);
        let size = loaded.0.render.size;
        Self::new("the scene", loaded, size, 1)
    }

    fn new(name: &str, (scene, flat): Loaded, size: [u32; 2], samples: u32) -> Self {
        let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
        let settings = Settings { depth, cutoff, samples, ..Settings::default() };
        let view = flatten::view(&scene.camera, &flat, size, None, &settings);
        Self { name: name.to_owned(), scene, flat, view, settings }
    }

    /// The same under other settings.
    pub(super) fn under(self, settings: Settings) -> Self {
        let size = [self.view.width, self.view.height];
        let view = flatten::view(&self.scene.camera, &self.flat, size, None, &settings);
        Self { view, settings, ..self }
    }

    /// What is called for.
    pub(super) fn called_for(&self) -> EffectSet {
        Effects::of(&self.flat, &self.settings).set()
    }

    pub(super) fn on_cpu(&self, effects: EffectChoice) -> Frame {
        let settings = self.choosing(effects);
        CpuRenderer::new(&self.flat, 1).unwrap().render(&self.view, &settings, &()).unwrap()
    }

    pub(super) fn renderer(&self, options: &GpuOptions) -> GpuRenderer {
        GpuRenderer::new(&self.flat, options).unwrap()
    }

    pub(super) fn on_gpu(&self, renderer: &mut GpuRenderer, effects: EffectChoice) -> Frame {
        renderer.render(&self.view, &self.choosing(effects), &()).unwrap()
    }

    /// The settings with a choice of effects: auxiliary pictures are made only where they are asked for.
    fn choosing(&self, effects: EffectChoice) -> Settings {
        let chosen = matches!(effects, EffectChoice::Only(set) if set.has(Effect::Aovs));
        Settings { effects, aovs: self.settings.aovs || chosen, ..self.settings }
    }
}

fn load(path: &Path) -> Loaded {
    let scene = Scene::load(path).unwrap_or_else(|error| panic!("{error}"));
    let flat = flatten::flatten(&scene).unwrap_or_else(|error| panic!("{error}")).scene;
    (Arc::new(scene), Arc::new(flat))
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
