//! The tree of a pixel: it is that of the picture, on every device.

#![allow(clippy::unwrap_used)]

use std::path::Path;

use snellius::cpu::CpuRenderer;
use snellius::film::Renderer;
use snellius::flatten;
use snellius::gpu::GpuRenderer;
use snellius::layout::{FlatScene, Precision, Settings, View};
use snellius::scene::Scene;
use snellius::trace::{Tree, on_cpu, part};

use crate::lockstep::devices::on_each;

fn subject(name: &str, size: [u32; 2]) -> (FlatScene, View, Settings) {
    let scene = Scene::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)).unwrap();
    view_of(&scene, size)
}

fn view_of(scene: &Scene, size: [u32; 2]) -> (FlatScene, View, Settings) {
    let flat = flatten::flatten(scene).unwrap().scene;
    let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
    let settings = Settings { depth, cutoff, ..Settings::default() };
    let view = flatten::view(&scene.camera, &flat, size, None, &settings);
    (flat, view, settings)
}

/// A cube of ice with one of water in it, seen straight from below, off the diagonals of its faces.
fn hollow_cube(cutoff: f64) -> Scene {
    let text = format!(
        "[camera]\neye = [0.1, -5, 0.05]\ntarget = [0.1, 0, 0.05]\nup = [0, 0, 1]\nfov_y = 1\n\
         [render]\nsize = [1, 1]\ndepth = 16\ncutoff = {cutoff:?}\nsamples = 1\n\
         [background]\nzenith = [1.0, 1.0, 1.0]\nhorizon = [0.0, 0.0, 0.0]\n\
         [material.ice]\nreflection = 1.0\ntransmission = 1.0\nfresnel = true\nior = 1.31\n\
         [material.water]\nreflection = 1.0\ntransmission = 1.0\nfresnel = true\nior = 1.333\n\
         [[model]]\nshape = {{ box = {{ size = [2, 2, 2] }} }}\nmaterial = \"ice\"\n\
         [[model]]\nshape = {{ box = {{ size = [1.2, 1.2, 1.2] }} }}\nmaterial = \"water\"\npriority = 1\n"
    );
    Scene::parse("hollow_cube.toml".as_ref(), &text).unwrap()
}

#[test]
fn the_tree_of_the_hollow_cube_has_the_known_size() {
    for (cutoff, expected) in [(0.0, 5167), (1e-6, 36), (1e-4, 14), (1.0 / 255.0, 10)] {
        let (flat, view, settings) = view_of(&hollow_cube(cutoff), [1, 1]);
        for precision in [Precision::F32, Precision::F64] {
            let settings = Settings { precision, ..settings };
            let recorded = on_cpu(&flat, &view, &settings, [0, 0]);
            assert_eq!(Tree::new(&recorded.nodes, &flat, &view).rays(), expected, "cutoff {cutoff}");
        }
    }
}

#[test]
fn the_tree_is_that_of_the_picture() {
    let size = [32, 24];
    let (flat, view, settings) = subject("goblet.toml", size);
    let frame = CpuRenderer::new(&flat, 0).unwrap().render(&view, &settings, &()).unwrap();
    for pixel in [[16, 12], [10, 8], [16, 20], [0, 0]] {
        let recorded = on_cpu(&flat, &view, &settings, pixel);
        let texel = frame.texels[(pixel[1] * size[0] + pixel[0]) as usize];
        assert_eq!(recorded.texel, texel, "{pixel:?}");
        let tree = Tree::new(&recorded.nodes, &flat, &view);
        assert_eq!(tree.rays() as u64 + tree.shadow_rays(), u64::from(texel.rays));
        for (sum, value) in tree.radiance().into_iter().zip(texel.radiance) {
            assert!((sum - f64::from(value)).abs() <= 1e-5 * sum.max(1e-3), "{pixel:?}: {sum} {value}");
        }
    }
}

#[test]
fn an_adapter_records_the_same_tree_bit_for_bit() {
    let (flat, view, settings) = subject("goblet.toml", [32, 24]);
    let pixels = [[16, 12], [10, 8], [16, 20], [0, 0]];
    on_each(|options| {
        let mut renderer = GpuRenderer::new(&flat, options).unwrap();
        for pixel in pixels {
            let traced = renderer.trace_tree(&view, &settings, pixel).unwrap();
            let expected = on_cpu(&flat, &view, &settings, pixel);
            assert_eq!(part(&expected.nodes, &traced.nodes, true), None, "{pixel:?}");
            assert_eq!(traced.texel, expected.texel);
            assert!(!traced.nodes.is_empty() && traced.recorded as usize == traced.nodes.len());
        }
    });
}
