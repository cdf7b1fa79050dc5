//! Micro-benchmarks of the CPU side: `cargo bench`.

use std::path::Path;

use divan::Bencher;
use snellius::bvh::{self, Preset};
use snellius::cpu::CpuRenderer;
use snellius::film::Renderer;
use snellius::flatten;
use snellius::layout::{FlatScene, Precision, Settings, View};
use snellius::scene::Scene;

fn main() {
    divan::main();
}

/// A scene of `scenes/`, flattened, with a small view of it.
fn load(name: &str) -> (FlatScene, View, Settings) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let flat = flatten::flatten(&scene).unwrap_or_else(|error| panic!("{error}")).scene;
    let settings =
        Settings { depth: scene.render.depth, cutoff: scene.render.cutoff as f32, ..Settings::default() };
    let view = flatten::view(&scene.camera, &flat, [160, 120], None, &settings);
    (flat, view, settings)
}

/// The BVH of the flagship's triangles, encoding included.
#[divan::bench(args = [Preset::Fast, Preset::Best])]
fn build_bvh(bencher: Bencher, preset: Preset) {
    let (flat, ..) = load("ice.toml");
    bencher.bench(|| bvh::build(&flat.triangles, preset));
}

/// Reading, checking and flattening a scene.
#[divan::bench(args = ["opaque.toml", "goblet.toml", "ice.toml"])]
fn load_scene(bencher: Bencher, name: &str) {
    bencher.bench(|| load(name));
}

/// A picture of 160×120 pixels at one sample, on one thread.
#[divan::bench(args = ["opaque.toml", "mirrors.toml", "goblet.toml", "ice.toml"], sample_count = 10)]
fn trace_f32(bencher: Bencher, name: &str) {
    trace(bencher, name, Precision::F32);
}

/// The same in f64.
#[divan::bench(args = ["opaque.toml", "mirrors.toml", "goblet.toml", "ice.toml"], sample_count = 10)]
fn trace_f64(bencher: Bencher, name: &str) {
    trace(bencher, name, Precision::F64);
}

fn trace(bencher: Bencher, name: &str, precision: Precision) {
    let (flat, view, settings) = load(name);
    let mut renderer = CpuRenderer::new(&flat, 1).unwrap_or_else(|error| panic!("{error}"));
    bencher.bench_local(|| renderer.render(&view, &Settings { precision, ..settings }, &()));
}
