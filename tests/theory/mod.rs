//! The scenes with an answer on paper show it, as their headers promise.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use snellius::cpu::CpuRenderer;
use snellius::film::Renderer;
use snellius::flatten;
use snellius::layout::{Precision, Settings};
use snellius::scene::Scene;

#[path = "../../examples/accuracy/expected.rs"]
mod expected;

use expected::{Expected, expected};

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/theory");
    std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

/// Every pixel of a scene.
fn pixels(scene: &Scene, precision: Precision) -> Vec<[f32; 3]> {
    let flat = flatten::flatten(scene).unwrap().scene;
    let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
    let settings = Settings { depth, cutoff, precision, ..Settings::default() };
    let view = flatten::view(&scene.camera, &flat, scene.render.size, None, &settings);
    CpuRenderer::new(&flat, 0).unwrap().render(&view, &settings, &()).unwrap().radiance()
}

#[test]
fn scenes_show_what_their_headers_derive() {
    let files = files();
    assert!(files.len() >= 8);
    for file in files {
        let promise = expected(&std::fs::read_to_string(&file).unwrap()).unwrap();
        let scene = Scene::load(&file).unwrap();
        for precision in [Precision::F32, Precision::F64] {
            let distance = promise.distance(&pixels(&scene, precision));
            assert!(distance <= promise.within, "{}, {precision:?}: {distance:e}", file.display());
        }
    }
}

#[test]
fn another_index_is_noticed() {
    let file = files().into_iter().find(|file| file.ends_with("slab_of_ice.toml")).unwrap();
    let text = std::fs::read_to_string(&file).unwrap();
    let promise = expected(&text).unwrap();
    let other = Scene::parse(&file, &text.replace("ior = 1.31", "ior = 1.3101")).unwrap();
    assert!(promise.distance(&pixels(&other, Precision::F32)) > promise.within);
}

#[test]
fn a_promise_is_read_whole_or_not_at_all() {
    let read = |line: &str| expected(&format!("# A scene.\n{line}\n[camera]"));
    let grey = Expected { radiance: [0.5; 3], within: 1e-6 };
    assert_eq!(read("# Expected: radiance 0.5 within 1e-6."), Some(grey));
    assert_eq!(read("# Expected: radiance 0.5 0.5 0.5 within 1e-6."), Some(grey));
    for wrong in
        ["# Expected: radiance 0.5.", "# Expected: radiance 1 2 within 1.", "# Expected: x within 1."]
    {
        assert_eq!(read(wrong), None, "{wrong}");
    }
}
