//! Whole pictures: the same bits from the CPU and from each strict adapter.

use std::ops::ControlFlow;

use snellius::cpu::CpuRenderer;
use snellius::film::{Frame, Progress, Renderer};
use snellius::gpu::{GpuError, GpuOptions, GpuRenderer};
use snellius::layout::{EffectChoice, FlatScene, Float, Intersector, Precision, Settings, Texel, View};

use super::devices::{find, on_each};
use super::scene;

fn settings(view: &View) -> Settings {
    Settings {
        depth: view.depth,
        cutoff: view.cutoff,
        samples: view.samples,
        adaptive: None,
        precision: Precision::F32,
        float: Float::Strict,
        intersector: Intersector::Watertight,
        aovs: true,
        effects: EffectChoice::Auto,
    }
}

/// The same view on the CPU and on an adapter.
fn both(scene: &FlatScene, view: &View, settings: &Settings, options: &GpuOptions) -> (Frame, Frame) {
    let cpu = CpuRenderer::new(scene, 1).unwrap().render(view, settings, &()).unwrap();
    let gpu = GpuRenderer::new(scene, options).unwrap().render(view, settings, &()).unwrap();
    (cpu, gpu)
}

/// Fail unless every pixel, AOV and ray count is the same.
fn assert_same(cpu: &Frame, gpu: &Frame) {
    assert_eq!((cpu.width, cpu.height), (gpu.width, gpu.height));
    let differing = cpu.texels.iter().zip(&gpu.texels).filter(|(a, b)| a != b).count();
    assert_eq!(differing, 0, "of {} pixels; the first: {:?}", cpu.texels.len(), first_difference(cpu, gpu));
    assert_eq!(cpu.aovs, gpu.aovs);
    assert_eq!(cpu.rays, gpu.rays);
}

fn first_difference(cpu: &Frame, gpu: &Frame) -> Option<(usize, Texel, Texel)> {
    let pairs = cpu.texels.iter().zip(&gpu.texels).enumerate();
    pairs.map(|(index, (a, b))| (index, *a, *b)).find(|(_, a, b)| a != b)
}

#[test]
fn a_triangle_has_the_same_bits_on_every_device() {
    on_each(|options| {
        let scene = scene::triangle();
        let view = scene::view(&scene, 53, 41, 3);
        for intersector in [Intersector::Watertight, Intersector::MollerTrumbore] {
            let (cpu, gpu) = both(&scene, &view, &Settings { intersector, ..settings(&view) }, options);
            assert_same(&cpu, &gpu);
            assert!(gpu.complete && gpu.float == Float::Strict);
            assert_eq!(gpu.rays.primary, 53 * 41 * 3);
            assert!(gpu.rays.shadow > 0 && gpu.texels.iter().any(|texel| texel.radiance != scene.horizon));
        }
    });
}

#[test]
fn a_crop_is_a_part_of_the_whole() {
    find("llvmpipe").iter().for_each(|options| {
        let scene = scene::triangle();
        let whole = scene::view(&scene, 40, 30, 2);
        let mut renderer = GpuRenderer::new(&scene, options).unwrap();
        let picture = renderer.render(&whole, &settings(&whole), &()).unwrap();
        let part = View { crop: [11, 7, 17, 9], ..whole };
        let cropped = renderer.render(&part, &settings(&part), &()).unwrap();
        assert_eq!((cropped.width, cropped.height), (17, 9));
        for (y, row) in cropped.texels.chunks(17).enumerate() {
            let first = (y + 7) * 40 + 11;
            assert_eq!(row, &picture.texels[first..first + 17]);
        }
    });
}

/// Stops at the first call.
struct Stop;

impl Progress for Stop {
    fn advance(&self, _done: u64, _total: u64) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

#[test]
fn a_stop_keeps_what_is_finished() {
    find("llvmpipe").iter().for_each(|options| {
        let scene = scene::triangle();
        let view = scene::view(&scene, 640, 480, 1);
        let mut renderer = GpuRenderer::new(&scene, options).unwrap();
        let stopped = renderer.render(&view, &settings(&view), &Stop).unwrap();
        let whole = renderer.render(&view, &settings(&view), &()).unwrap();
        assert!(!stopped.complete && whole.complete);
        let finished = stopped.texels.iter().zip(&whole.texels).filter(|(a, b)| a == b).count();
        let missing = stopped.texels.iter().filter(|texel| **texel == Texel::default()).count();
        assert!(finished > 0 && finished + missing == whole.texels.len(), "{finished} + {missing}");
    });
}

#[test]
fn double_precision_is_close_to_the_cpu_or_refused() {
    on_each(|options| {
        let scene = scene::triangle();
        let view = scene::view(&scene, 32, 24, 2);
        let settings = Settings { precision: Precision::F64, ..settings(&view) };
        let cpu = CpuRenderer::new(&scene, 1).unwrap().render(&view, &settings, &()).unwrap();
        let mut renderer = GpuRenderer::new(&scene, options).unwrap();
        match renderer.render(&view, &settings, &()) {
            Ok(gpu) => assert_same(&cpu, &gpu),
            Err(error) => {
                assert!(matches!(error, GpuError::NoF64 { .. }) && !renderer.adapter().f64, "{error}");
                assert_eq!(error.exit_code(), 3);
            }
        }
    });
}
