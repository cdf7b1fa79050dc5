//! A scene, its pictures and the truth about them.

use std::path::{Path, PathBuf};

use snellius::cpu::CpuRenderer;
use snellius::film::{Difference, Frame, Picture, Renderer};
use snellius::flatten;
use snellius::layout::{FlatScene, Precision, Settings};
use snellius::scene::Scene;

use super::Result;

/// Cut-offs of the truth: of one sample, and of many, for which there is less time.
const TRUEST: [f32; 2] = [1e-7, 1e-5];
/// Side of the tiles of the truth in pixels: pictures of many samples are small, and all threads are to have some.
const TILE: u32 = 4;

/// A scene, ready to be traced at a size.
pub(super) struct Stage {
    pub(super) name: String,
    pub(super) scene: Scene,
    pub(super) flat: FlatScene,
    pub(super) size: [u32; 2],
}

/// A traced picture.
pub(super) struct Shot {
    picture: Picture,
    bounds: Vec<f64>,
    /// Milliseconds of tracing.
    pub(super) ms: f64,
}

impl Stage {
    pub(super) fn load(name: &str, size: &[u32]) -> Result<Self> {
        let scene = Scene::load(&PathBuf::from("scenes").join(Path::new(name)))?;
        let flat = flatten::flatten(&scene)?.scene;
        Ok(Self { name: name.to_owned(), scene, flat, size: size.try_into()? })
    }

    /// Trace a picture on all threads of the CPU.
    pub(super) fn shoot(&self, settings: &Settings) -> Result<Shot> {
        self.trace(CpuRenderer::new(&self.flat, 0)?, settings)
    }

    /// The whole tree in f64, of so many samples.
    pub(super) fn truth(&self, samples: u32) -> Result<Shot> {
        let cutoff = TRUEST[usize::from(samples > 1)];
        let settings =
            Settings { depth: 64, cutoff, samples, precision: Precision::F64, ..Settings::default() };
        self.trace(CpuRenderer::with_tile(&self.flat, 0, TILE)?, &settings)
    }

    fn trace(&self, mut renderer: CpuRenderer<'_>, settings: &Settings) -> Result<Shot> {
        let view = flatten::view(&self.scene.camera, &self.flat, self.size, None, settings);
        Ok(Shot::of(&renderer.render(&view, settings, &())?))
    }
}

impl Shot {
    fn of(frame: &Frame) -> Self {
        let pixels: Vec<_> =
            frame.texels.iter().map(|texel| texel.radiance.map(|v| v.clamp(0.0, 1.0))).collect();
        Self {
            picture: Picture::from_rgb(frame.width, frame.height, &pixels),
            bounds: frame.texels.iter().map(|texel| f64::from(texel.bound).min(1.0)).collect(),
            ms: frame.times.trace.as_secs_f64() * 1e3,
        }
    }

    /// How far it is from another of the same size, in linear RGB clamped to [0, 1].
    pub(super) fn rmse(&self, truth: &Self) -> f64 {
        Difference::between(&self.picture, &truth.picture).map_or(f64::INFINITY, |difference| difference.rmse)
    }

    /// The root mean square of the certified bounds: it is no farther from the uncut tree of depth 64.
    pub(super) fn proven(&self) -> f64 {
        let squares: f64 = self.bounds.iter().map(|bound| bound * bound).sum();
        (squares / self.bounds.len().max(1) as f64).sqrt()
    }
}
