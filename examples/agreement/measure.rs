//! The figures of one scene.

use std::path::Path;

use snellius::cpu::CpuRenderer;
use snellius::film::{Frame, Renderer};
use snellius::flatten;
use snellius::gpu::{self, AdapterReport, GpuOptions, GpuRenderer};
use snellius::layout::{FlatScene, Float, Precision, Settings};
use snellius::scene::Scene;
use snellius::selftest::{Agreement, LEAST_EQUAL_F64, LEAST_EQUAL_FAST, greatest_difference};

use super::Result;

/// An adapter, and the size at which it is compared with the CPU.
pub(super) struct Target {
    /// The name that it was asked for by.
    pub(super) name: String,
    pub(super) report: AdapterReport,
    pub(super) size: [u32; 2],
}

impl Target {
    pub(super) fn find(name: String, size: [u32; 2]) -> Result<Self> {
        let adapters = gpu::adapters();
        let Some(report) = adapters.iter().find(|report| report.is_called(&name)).cloned() else {
            let names: Vec<_> = adapters.into_iter().map(|report| report.name).collect();
            return Err(format!("no adapter is called {name:?}; there are {names:?}").into());
        };
        Ok(Self { name, report, size })
    }
}

/// What one scene shows.
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) triangles: usize,
    /// Rays of the CPU in f32 at the first target's size, shadow rays among them.
    pub(super) rays: u64,
    pub(super) strict: Agreement,
    /// Percentage of pixels with the same primitive hash, `--float fast`.
    pub(super) fast: f64,
    pub(super) second_strict: Agreement,
    /// Percentage of pixels with the same body hash, f32 against f64.
    pub(super) bodies: f64,
    /// 99th percentile of the largest channel's difference between f32 and f64, over these pixels.
    pub(super) p99: f32,
    /// What it may be.
    pub(super) allowed: f32,
    /// The largest channel of the picture in f64.
    pub(super) brightest: f32,
}

impl Row {
    /// Trace the scene on every device.
    pub(super) fn measure(path: &Path, first: &Target, second: &Target) -> Result<Self> {
        let bench = Bench::load(path)?;
        let single = bench.cpu(first.size, Precision::F32)?;
        let double = bench.cpu(first.size, Precision::F64)?;
        let fast = Agreement::between(&single, &bench.gpu(first, Float::Fast)?);
        let precise = Agreement::between(&single, &double);
        let second_single = bench.cpu(second.size, Precision::F32)?;
        Ok(Self {
            scene: path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            triangles: bench.flat.triangles.len(),
            rays: single.rays.primary + single.rays.reflection + single.rays.refraction + single.rays.shadow,
            strict: Agreement::between(&single, &bench.gpu(first, Float::Strict)?),
            fast: fast.same_primitives,
            second_strict: Agreement::between(&second_single, &bench.gpu(second, Float::Strict)?),
            bodies: precise.same_bodies,
            p99: precise.p99,
            allowed: greatest_difference(bench.flat.radiance_bound.last().copied().unwrap_or(0.0)),
            brightest: brightest(&double),
        })
    }

    /// The required figures that do not hold.
    pub(super) fn failures(&self) -> impl Iterator<Item = &'static str> {
        [
            (self.strict.is_exact(), "the strict picture of the first adapter"),
            (self.fast >= LEAST_EQUAL_FAST, "the fast picture of the first adapter"),
            (self.second_strict.is_exact(), "the strict picture of the second adapter"),
            (self.bodies >= LEAST_EQUAL_F64, "equal body hashes in f32 and f64"),
            (self.p99 <= self.allowed, "the difference of f32 and f64"),
        ]
        .into_iter()
        .filter_map(|(holds, figure)| (!holds).then_some(figure))
    }
}

/// A scene that every device can trace.
struct Bench {
    scene: Scene,
    flat: FlatScene,
}

impl Bench {
    fn load(path: &Path) -> Result<Self> {
        let scene = Scene::load(path)?;
        let flat = flatten::flatten(&scene)?.scene;
        Ok(Self { scene, flat })
    }

    fn cpu(&self, size: [u32; 2], precision: Precision) -> Result<Frame> {
        let settings = Settings { precision, ..self.settings() };
        self.trace(&mut CpuRenderer::new(&self.flat, 0)?, size, &settings)
    }

    fn gpu(&self, target: &Target, float: Float) -> Result<Frame> {
        let options = GpuOptions { adapter: Some(target.report.name.clone()), ..GpuOptions::default() };
        let settings = Settings { float, ..self.settings() };
        let frame = self.trace(&mut GpuRenderer::new(&self.flat, &options)?, target.size, &settings)?;
        if frame.float != float {
            return Err(format!("{} does not trace with --float strict", target.report.name).into());
        }
        Ok(frame)
    }

    fn trace<R: Renderer>(&self, renderer: &mut R, size: [u32; 2], settings: &Settings) -> Result<Frame>
    where
        R::Error: std::error::Error + 'static,
    {
        let view = flatten::view(&self.scene.camera, &self.flat, size, None, settings);
        Ok(renderer.render(&view, settings, &())?)
    }

    fn settings(&self) -> Settings {
        let render = &self.scene.render;
        Settings { depth: render.depth, cutoff: render.cutoff as f32, samples: 1, ..Settings::default() }
    }
}

fn brightest(frame: &Frame) -> f32 {
    frame.texels.iter().flat_map(|texel| texel.radiance).fold(0.0, f32::max)
}
