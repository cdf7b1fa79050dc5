//! A Vulkan adapter as a device of the self-test.

use super::lockstep::{Difference, Lockstep};
use super::paths::BEND_WORDS;
use super::{Answered, Bend, Bent, Device, DeviceError, Escape, Leave, Left, Stage, Walk, Walked};
use crate::film::{Frame, Renderer};
use crate::gpu::{AdapterReport, GpuError, GpuOptions, GpuRenderer, Portions, Prober, Source, Variant};
use crate::layout::constants::{MAX_BVH_DEPTH, MAX_DEPTH};
use crate::layout::{EffectChoice, FlatScene, Float, Intersector, Plan, Precision, Settings, Tile, View};
use crate::scene::Scene;

/// File and name of the entry points, and words of their records.
const WALK: ((&str, &str), usize) = (("probe_rays", "probe_walk"), 11);
const LEAVE: ((&str, &str), usize) = (("probe_rays", "probe_leave"), 12);
const BEND: ((&str, &str), usize) = (("probe_paths", "probe_bend"), BEND_WORDS);
const FRESNEL: ((&str, &str), usize) = (("probe_plain", "probe_fresnel"), 3);
/// Records that are on the adapter at a time: tens of megabytes.
const BATCH: usize = 1 << 20;
/// Rounds of the loop by which a single ray shows that loops are not ended before their time.
const CANARY_ROUNDS: u32 = 8;

/// A Vulkan adapter in f32, in one kind of float. Its shaders are compiled once for all scenes.
pub struct GpuDevice {
    name: String,
    options: GpuOptions,
    variant: Variant,
    sources: &'static [Source<'static>],
    prober: Prober,
    /// Opened with the first picture.
    renderer: Option<GpuRenderer>,
}

impl GpuDevice {
    /// Open an adapter, with the program's own shader files ([`SOURCES`](crate::gpu::SOURCES)) or changed ones. Where
    /// it cannot be strict it is fast.
    ///
    /// # Errors
    /// As [`GpuRenderer::new`].
    pub fn new(
        options: &GpuOptions,
        float: Float,
        intersector: Intersector,
        sources: &'static [Source<'static>],
    ) -> Result<Self, DeviceError> {
        let nothing = Stage::new(&Scene::of(Vec::new(), Vec::new()))?;
        let prober = Prober::new(&nothing.flat, &nothing.view, options, sources)?;
        let adapter = prober.adapter();
        let float = if adapter.strict_float { float } else { Float::Fast };
        // A stack that serves every scene.
        let settings = Settings { float, intersector, ..Settings::default() };
        let variant = Variant::new(MAX_BVH_DEPTH, &settings, &Plan::general(MAX_DEPTH));
        let name = column_name(adapter, float);
        Ok(Self { name, options: options.clone(), variant, sources, prober, renderer: None })
    }

    /// The adapter that answers.
    #[must_use]
    pub fn adapter(&self) -> &AdapterReport {
        self.prober.adapter()
    }

    /// Run an entry point in one kind of float, strict where the adapter can be.
    pub(super) fn probe(
        &mut self,
        entry: (&str, &str),
        float: Float,
        stride: usize,
        records: &mut [u32],
    ) -> Result<(), DeviceError> {
        let float = if self.adapter().strict_float { float } else { Float::Fast };
        let variant = Variant { float, ..self.variant };
        Ok(self.prober.run(entry, &variant, stride, records)?)
    }

    /// Ask the entry point for each record: `inputs` go in, and what it wrote comes out.
    fn ask<T>(
        &mut self,
        ((file, entry), stride): ((&str, &str), usize),
        queries: &[T],
        inputs: impl Fn(&T, &mut Vec<u32>),
        mut take: impl FnMut(&T, &[u32]) -> Result<(), DeviceError>,
    ) -> Result<(), DeviceError> {
        for batch in queries.chunks(BATCH) {
            let mut records = Vec::with_capacity(batch.len() * stride);
            for (index, query) in batch.iter().enumerate() {
                inputs(query, &mut records);
                records.resize((index + 1) * stride, 0);
            }
            self.probe((file, entry), self.variant.float, stride, &mut records)?;
            for (query, record) in batch.iter().zip(records.chunks_exact(stride)) {
                take(query, record)?;
            }
        }
        Ok(())
    }

    /// The error of a driver that ends loops early, if the canary did not live.
    fn check_canary(adapter: &str, found: u32, rounds: u32) -> Result<(), DeviceError> {
        if found == Tile::canary_result(rounds) {
            return Ok(());
        }
        Err(GpuError::LoopLimit { adapter: adapter.to_owned() }.into())
    }
}

impl Device for GpuDevice {
    fn name(&self) -> &str {
        &self.name
    }

    fn precision(&self) -> Precision {
        Precision::F32
    }

    fn is_exact(&self) -> bool {
        self.variant.float == Float::Strict
    }

    fn roundoff(&self) -> f64 {
        if self.is_exact() { 2f64.powi(-24) } else { 2f64.powi(-23) }
    }

    fn walk(&mut self, stage: &Stage, rays: &[Walk]) -> Answered<Walked> {
        self.prober.show(&stage.flat, &stage.view)?;
        let mut answers = Vec::with_capacity(rays.len());
        let name = self.adapter().name.clone();
        let inputs = |ray: &Walk, words: &mut Vec<u32>| {
            words.extend(ray.origin.map(f32::to_bits));
            words.extend(ray.direction.map(f32::to_bits));
            words.extend([ray.media, ray.limit]);
        };
        self.ask(WALK, rays, inputs, |ray, words| {
            Self::check_canary(&name, words[10], ray.limit)?;
            answers.push(Walked {
                escape: if words[0] == 1 { Escape::Free } else { Escape::Limit },
                faces: words[1],
                idle: words[2],
                media: words[3],
                hash: words[4],
                first: words[5],
                distance: f32::from_bits(words[6]),
                point: [7, 8, 9].map(|index: usize| f32::from_bits(words[index])),
            });
            Ok(())
        })?;
        Ok(answers)
    }

    fn leave(&mut self, stage: &Stage, rays: &[Leave]) -> Answered<Left> {
        self.prober.show(&stage.flat, &stage.view)?;
        let mut answers = Vec::with_capacity(rays.len());
        let name = self.adapter().name.clone();
        let places = stage.places(self.prober.order().iter().copied());
        let inputs = |ray: &Leave, words: &mut Vec<u32>| {
            words.extend([places[ray.id as usize], ray.id]);
            words.extend(ray.barycentrics.map(f32::to_bits));
            words.extend(ray.arriving.map(f32::to_bits));
            words.extend(ray.leaving.map(f32::to_bits));
            words.extend([u32::from(ray.behind), CANARY_ROUNDS]);
        };
        self.ask(LEAVE, rays, inputs, |_, words| {
            Self::check_canary(&name, words[5], CANARY_ROUNDS)?;
            answers.push(Left {
                origin: [0, 1, 2].map(|index: usize| f32::from_bits(words[index])),
                met: words[3],
                distance: f32::from_bits(words[4]),
            });
            Ok(())
        })?;
        Ok(answers)
    }

    fn bend(&mut self, stage: &Stage, rays: &[Bend]) -> Answered<Bent> {
        self.prober.show(&stage.flat, &stage.view)?;
        let mut answers = Vec::with_capacity(rays.len());
        let name = self.adapter().name.clone();
        self.ask(BEND, rays, Bend::write, |ray, words| {
            Self::check_canary(&name, words[BEND_WORDS - 1], ray.limit)?;
            answers.push(Bent::read(words));
            Ok(())
        })?;
        Ok(answers)
    }

    fn fresnel(&mut self, inputs: &[[f32; 2]]) -> Answered<Option<f32>> {
        let mut answers = Vec::with_capacity(inputs.len());
        let words_of = |input: &[f32; 2], words: &mut Vec<u32>| words.extend(input.map(f32::to_bits));
        self.ask(FRESNEL, inputs, words_of, |_, words| {
            answers.push((words[2] == 0).then(|| f32::from_bits(words[0])));
            Ok(())
        })?;
        Ok(answers)
    }

    fn differences(&mut self, records: usize) -> Answered<Difference> {
        let mut lockstep = Lockstep::new(&self.options, self.variant.float, self.sources)?;
        Ok(lockstep.compare_all(records)?)
    }

    fn picture(&mut self, stage: &Stage, settings: &Settings) -> Result<Frame, DeviceError> {
        let (view, settings) = self.aim(stage, settings);
        Ok(self.show(stage)?.render(&view, &settings, &())?)
    }

    fn shared_out(&mut self, stage: &Stage, settings: &Settings) -> Answered<(String, Frame)> {
        let (view, settings) = self.aim(stage, settings);
        let renderer = self.show(stage)?;
        let usual = renderer.portions();
        let ways = [
            ("as usual", usual),
            ("as usual, again", usual),
            ("a rest now and then", Portions { steps: usual.steps.min(997), ..usual }),
            ("bands of one row of blocks", Portions { pixels: 1, ..usual }),
            ("a rest after every ray, in bands", Portions { steps: 1, pixels: 1 }),
        ];
        let frames = ways.map(|(way, portions)| {
            renderer.set_portions(portions);
            renderer.render(&view, &settings, &()).map(|frame| (way.to_owned(), frame))
        });
        renderer.set_portions(usual);
        Ok(frames.into_iter().collect::<Result<_, _>>()?)
    }
}

impl GpuDevice {
    /// The stage's view for these settings, and how it is traced here.
    fn aim(&self, stage: &Stage, settings: &Settings) -> (View, Settings) {
        let Variant { float, intersector, .. } = self.variant;
        let settings = Settings { precision: Precision::F32, float, intersector, ..*settings };
        // The stack of the deepest tree of rays serves every depth, and the code of all effects every scene.
        (stage.view_for(&settings), Settings { depth: MAX_DEPTH, effects: EffectChoice::All, ..settings })
    }

    /// The renderer, with this scene on the adapter.
    fn show(&mut self, stage: &Stage) -> Result<&mut GpuRenderer, DeviceError> {
        match &mut self.renderer {
            Some(renderer) => {
                renderer.show(&stage.flat)?;
                Ok(renderer)
            }
            none => {
                // The deepest tree comes first, so that its stack serves every scene.
                let scene = FlatScene { bvh_depth: MAX_BVH_DEPTH, ..stage.flat.clone() };
                Ok(none.insert(GpuRenderer::with_sources(&scene, &self.options, self.sources)?))
            }
        }
    }
}

/// The adapter's name without its details, and its kind of float.
fn column_name(adapter: &AdapterReport, float: Float) -> String {
    let short = adapter.name.split(" (").next().unwrap_or(&adapter.name);
    let float = match float {
        Float::Strict => "strict",
        Float::Fast => "fast",
    };
    format!("{short} {float}")
}
