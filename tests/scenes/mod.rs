//! Every scene of `scenes/`, small: the devices agree as the README's table says, and its own header is kept.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use snellius::cpu::CpuRenderer;
use snellius::film::{Frame, Renderer};
use snellius::flatten;
use snellius::gpu::{GpuOptions, GpuRenderer};
use snellius::layout::{FlatScene, Float, Precision, Settings, View};
use snellius::scene::Scene;
use snellius::selftest::{Agreement, LEAST_EQUAL_F64, greatest_difference};

use crate::lockstep::devices::on_each;

const SIZE: [u32; 2] = [80, 60];

/// A scene, ready to be traced at one sample.
struct Subject {
    name: String,
    flat: FlatScene,
    view: View,
    settings: Settings,
}

impl Subject {
    fn load(path: &Path) -> Self {
        let scene = Scene::load(path).unwrap_or_else(|error| panic!("{error}"));
        let flat = flatten::flatten(&scene).unwrap_or_else(|error| panic!("{error}")).scene;
        let settings = Settings {
            depth: scene.render.depth,
            cutoff: scene.render.cutoff as f32,
            samples: 1,
            ..Settings::default()
        };
        let view = flatten::view(&scene.camera, &flat, SIZE, None, &settings);
        Self { name: path.display().to_string(), flat, view, settings }
    }

    fn on_cpu(&self, precision: Precision, threads: usize) -> Frame {
        let settings = Settings { precision, ..self.settings };
        CpuRenderer::new(&self.flat, threads).unwrap().render(&self.view, &settings, &()).unwrap()
    }

    fn on_gpu(&self, float: Float, options: &GpuOptions) -> Frame {
        let settings = Settings { float, ..self.settings };
        GpuRenderer::new(&self.flat, options).unwrap().render(&self.view, &settings, &()).unwrap()
    }
}

fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut scenes: Vec<_> =
        files.filter(|path| path.extension().is_some_and(|e| e == "toml" || e == "obj")).collect();
    scenes.sort();
    assert!(scenes.len() >= 8, "{scenes:?}");
    scenes
}

#[test]
fn strict_adapters_give_the_bits_and_ray_counts_of_the_cpu_on_every_scene() {
    for path in scenes() {
        let subject = Subject::load(&path);
        let cpu = subject.on_cpu(Precision::F32, 0);
        on_each(|options| {
            let gpu = subject.on_gpu(Float::Strict, options);
            assert_eq!(gpu.float, Float::Strict);
            let agreement = Agreement::between(&cpu, &gpu);
            assert!(agreement.is_exact(), "{} on {options:?}: {agreement:?}", subject.name);
        });
    }
}

#[test]
fn f64_takes_the_same_paths_on_every_scene() {
    for path in scenes() {
        let subject = Subject::load(&path);
        let (single, double) = (subject.on_cpu(Precision::F32, 0), subject.on_cpu(Precision::F64, 0));
        let agreement = Agreement::between(&single, &double);
        let most = greatest_difference(subject.flat.radiance_bound.last().copied().unwrap());
        let holds = agreement.same_bodies >= LEAST_EQUAL_F64 && agreement.p99 <= most;
        assert!(holds, "{}: {agreement:?}, at most {most}", subject.name);
    }
}

#[test]
fn no_pixel_of_any_scene_is_negative_or_not_finite() {
    for path in scenes() {
        let subject = Subject::load(&path);
        let frame = subject.on_cpu(Precision::F32, 0);
        let sound = |x: f32| x.is_finite() && x >= 0.0;
        assert!(
            frame.texels.iter().all(|t| t.radiance.iter().all(|&x| sound(x)) && sound(t.bound)),
            "{path:?}"
        );
    }
}

#[test]
fn the_number_of_threads_never_shows() {
    for path in scenes().into_iter().filter(|path| !path.ends_with("city.toml")) {
        let subject = Subject::load(&path);
        let (one, three) = (subject.on_cpu(Precision::F32, 1), subject.on_cpu(Precision::F32, 3));
        assert!(Agreement::between(&one, &three).is_exact(), "{path:?}");
    }
}

#[test]
fn the_flagship_has_its_fifty_thousand_triangles() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/ice.toml");
    assert!(Subject::load(&scene).flat.triangles.len() >= 50_000);
}
