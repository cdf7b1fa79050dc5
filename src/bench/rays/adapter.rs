//! A scene on a Vulkan adapter, for rays.

use std::time::Duration;

use super::{Query, RayAnswer, RayStage};
use crate::bench::BenchError;
use crate::cpu::Cast;
use crate::gpu::{AdapterReport, GpuOptions, Prober, Records, SOURCES, Source, Variant};
use crate::layout::{FlatScene, Float, Plan, Settings, View};

/// Words of a ray, then of its answer.
const RAY: usize = size_of::<Cast>() / 4;
const STRIDE: usize = RAY + size_of::<RayAnswer>() / 4;

/// A scene on a Vulkan adapter: one invocation a ray. In strict float where the adapter has it.
pub struct RayAdapter {
    prober: Prober,
    variant: Variant,
}

impl RayAdapter {
    /// Open an adapter and put a mesh there.
    ///
    /// # Errors
    /// [`BenchError::Gpu`].
    pub fn new(adapter: &AdapterReport, stage: &RayStage) -> Result<Self, BenchError> {
        Self::with_sources(adapter, stage.scene(), stage.view(), SOURCES)
    }

    /// The same with other shader files, whose entry points `rays_nearest` and `rays_any` stand in the file `rays`, and a
    /// scene as they want it.
    ///
    /// # Errors
    /// [`BenchError::Gpu`].
    pub fn with_sources(
        adapter: &AdapterReport,
        scene: &FlatScene,
        view: &View,
        sources: &'static [Source<'static>],
    ) -> Result<Self, BenchError> {
        let options = GpuOptions { adapter: Some(adapter.name.clone()), ..GpuOptions::default() };
        let float = if adapter.strict_float { Float::Strict } else { Float::Fast };
        let settings = Settings { float, ..Settings::default() };
        Ok(Self {
            prober: Prober::new(scene, view, &options, sources)?,
            variant: Variant::new(scene.bvh_depth, &settings, &Plan::general(0)),
        })
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.prober.adapter().name
    }

    /// Put rays there.
    ///
    /// # Errors
    /// [`BenchError::Gpu`].
    pub fn load(&self, rays: &[Cast]) -> Result<Records, BenchError> {
        let mut words = vec![0; rays.len() * STRIDE];
        for (words, ray) in words.chunks_exact_mut(STRIDE).zip(rays) {
            words[..RAY].copy_from_slice(bytemuck::cast_slice(std::slice::from_ref(ray)));
        }
        Ok(self.prober.load(STRIDE, &words)?)
    }

    /// Trace them, and tell how long that took.
    ///
    /// # Errors
    /// [`BenchError::Gpu`].
    pub fn trace(&mut self, records: &Records, query: Query) -> Result<Duration, BenchError> {
        let entry = match query {
            Query::Nearest => "rays_nearest",
            Query::Any => "rays_any",
        };
        Ok(self.prober.dispatch(records, ("rays", entry), &self.variant)?)
    }

    /// What was found for `count` rays.
    ///
    /// # Errors
    /// [`BenchError::Gpu`].
    pub fn answers(&self, records: &Records, count: usize) -> Result<Vec<RayAnswer>, BenchError> {
        let mut words = vec![0; count * STRIDE];
        self.prober.read(records, &mut words)?;
        let answer = |words: &[u32]| RayAnswer { t: f32::from_bits(words[RAY]), face: words[RAY + 1] };
        Ok(words.chunks_exact(STRIDE).map(answer).collect())
    }
}
