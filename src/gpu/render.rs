//! A scene on an adapter, and the pictures that are traced of it.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use serde::Serialize;

use super::adaptive::Sifter;
use super::blocks::Blocks;
use super::buffers::SceneBuffers;
use super::clock::Clock;
use super::context::Context;
use super::film::{FilmBuffer, PixelLayout};
use super::job::Job;
use super::pace::Pace;
use super::pipelines::Pipelines;
use super::{AdapterReport, GpuError, GpuOptions, Portions, SOURCES, SharedDevice, Source, Variant};
use crate::film::{Frame, Progress, RayCounts, Renderer, SampleCounts, TraceTimes};
use crate::layout::constants::BLOCK;
use crate::layout::{FlatScene, Float, Plan, Scan, Settings, Tile, View};

/// Bytes that an invocation takes beside its registers, of which drivers do not tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct InvocationMemory {
    /// Private variables: the sample and the ray in work, the traversal's stack.
    pub private: u64,
    /// In the film: the sample, the ray and the stack of waiting rays, where it may have to rest.
    pub at_rest: u64,
}

/// A scene on an adapter.
pub struct GpuRenderer {
    pub(super) context: Context,
    pub(super) sources: &'static [Source<'static>],
    pub(super) scene: SceneBuffers,
    /// Of the deepest tree so far: its stack serves the others.
    bvh_depth: u32,
    /// What the scene calls for.
    scan: Scan,
    /// What the upload took, until a frame has told it.
    upload: Duration,
    pipelines: Pipelines,
    pub(super) sifters: HashMap<Variant, Sifter>,
    /// Measures its passes, once it is asked to.
    clock: Option<Clock>,
    /// Variants that have been dispatched.
    warm: HashSet<Variant>,
    /// Those that are lent out are not written to.
    pub(super) films: Vec<Arc<FilmBuffer>>,
    /// What the adapter did at the end of the last exposure, and by which pipeline.
    pub(super) pace: Option<(Variant, Pace)>,
    /// See [`Portions::pixels`].
    band_pixels: u64,
}

impl GpuRenderer {
    /// Open an adapter and upload the scene.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::TooLarge`] (checked before anything is uploaded),
    /// [`GpuError::Refused`], [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn new(scene: &FlatScene, options: &GpuOptions) -> Result<Self, GpuError> {
        Self::with_sources(scene, options, SOURCES)
    }

    /// The same with other shader files than the program's own: for tests that plant faults in them.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_sources(
        scene: &FlatScene,
        options: &GpuOptions,
        sources: &'static [Source<'static>],
    ) -> Result<Self, GpuError> {
        Self::in_context(Context::new(options)?, scene, sources)
    }

    /// Upload the scene to a device that others use too.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn on(device: &SharedDevice, scene: &FlatScene) -> Result<Self, GpuError> {
        Self::in_context(device.context.clone(), scene, SOURCES)
    }

    fn in_context(
        context: Context,
        scene: &FlatScene,
        sources: &'static [Source<'static>],
    ) -> Result<Self, GpuError> {
        let start = Instant::now();
        let buffers = SceneBuffers::new(&context, scene)?;
        let pipelines = Pipelines::new(&context, &buffers.layout, sources);
        Ok(Self {
            context,
            sources,
            scene: buffers,
            bvh_depth: scene.bvh_depth,
            scan: Scan::of(scene),
            upload: start.elapsed(),
            pipelines,
            sifters: HashMap::new(),
            clock: None,
            warm: HashSet::new(),
            pace: None,
            films: Vec::new(),
            band_pixels: u64::MAX,
        })
    }

    /// The adapter that traces.
    #[must_use]
    pub fn adapter(&self) -> &AdapterReport {
        &self.context.adapter
    }

    /// How much of a picture is traced at a time: at first, what suits the adapter.
    #[must_use]
    pub fn portions(&self) -> Portions {
        Portions { steps: self.context.step_budget, pixels: self.band_pixels }
    }

    /// Trace that much at a time.
    pub fn set_portions(&mut self, portions: Portions) {
        self.context.step_budget = portions.steps;
        self.band_pixels = portions.pixels;
    }

    /// Put another scene in place of this one. What was compiled is kept, unless the new scene's tree is deeper.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn show(&mut self, scene: &FlatScene) -> Result<(), GpuError> {
        let start = Instant::now();
        self.scene.show(&self.context, scene)?;
        self.bvh_depth = self.bvh_depth.max(scene.bvh_depth);
        self.scan = Scan::of(scene);
        self.upload = start.elapsed();
        Ok(())
    }

    /// The shader files that it traces by.
    #[must_use]
    pub fn sources(&self) -> &'static [Source<'static>] {
        self.sources
    }

    /// Trace by other shader files from now on, once they are compiled for these settings; by those before where they
    /// cannot be.
    ///
    /// # Errors
    /// [`GpuError::Shader`] with file and line, [`GpuError::NoF64`], [`GpuError::Refused`], [`GpuError::DeviceLost`].
    pub fn reassemble(
        &mut self,
        sources: &'static [Source<'static>],
        settings: &Settings,
    ) -> Result<(), GpuError> {
        let pipelines = Pipelines::new(&self.context, &self.scene.layout, sources);
        pipelines.compile(&self.variant(settings))?;
        (self.sources, self.pipelines, self.pace) = (sources, pipelines, None);
        self.sifters.clear();
        self.warm.clear();
        Ok(())
    }

    /// From now on let the adapter measure its passes, if it can: [`device_time`](Self::device_time) tells.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn start_clock(&mut self) -> Result<(), GpuError> {
        self.clock = Clock::new(&self.context)?;
        Ok(())
    }

    /// What the passes of the last picture took by timestamps of the adapter, without the time that the host took to submit
    /// them and to hear of them; none without timestamps, or before [`start_clock`](Self::start_clock).
    ///
    /// # Errors
    /// [`GpuError::DeviceLost`].
    pub fn device_time(&self) -> Result<Option<Duration>, GpuError> {
        self.clock.as_ref().map(|clock| clock.elapsed(&self.context)).transpose()
    }

    /// The memory that an invocation under these settings takes.
    ///
    /// # Errors
    /// As of [`Renderer::render`], where the shader is not compiled yet.
    pub fn invocation_memory(&mut self, settings: &Settings) -> Result<InvocationMemory, GpuError> {
        let variant = self.variant(settings);
        let invocations = u64::from(variant.most_blocks() * BLOCK * BLOCK);
        let compiled = self.pipelines.compile(&variant)?;
        Ok(InvocationMemory { private: compiled.private, at_rest: compiled.texels_at / invocations })
    }

    /// Whether the pipeline that these settings need is compiled.
    #[must_use]
    pub fn is_compiled(&self, settings: &Settings) -> bool {
        self.pipelines.get(&self.variant(settings)).is_some()
    }

    /// Compile the pipeline that these settings need on another thread. Until it is there, a render with
    /// [`EffectChoice::All`](crate::layout::EffectChoice::All) gives the same picture by a pipeline that may be: the general
    /// one serves any scene of that depth.
    pub fn compile_ahead(&self, settings: &Settings) -> JoinHandle<Result<(), GpuError>> {
        let (pipelines, variant) = (self.pipelines.clone(), self.variant(settings));
        thread::spawn(move || pipelines.compile(&variant).map(drop))
    }

    /// What is simulated under these settings.
    pub(super) fn plan(&self, settings: &Settings) -> Plan {
        self.scan.effects(settings).plan(settings)
    }

    /// The variant for these settings: fast where the adapter cannot be strict.
    pub(super) fn variant(&self, settings: &Settings) -> Variant {
        let variant = self.variant_of(settings, &self.plan(settings));
        let float = if self.context.adapter.strict_float { variant.float } else { Float::Fast };
        Variant { float, ..variant }
    }

    /// The variant of a plan, as strict as the settings ask.
    pub(super) fn variant_of(&self, settings: &Settings, plan: &Plan) -> Variant {
        Variant::new(self.bvh_depth, settings, plan)
    }

    /// Compile the variant, make room for the picture and take it in view.
    pub(super) fn prepare(&mut self, view: &View, variant: &Variant) -> Result<Job<'_>, GpuError> {
        let texels_at = self.pipelines.compile(variant)?.texels_at;
        let pixels = u64::from(view.crop[2]) * u64::from(self.film_rows(view, variant)?);
        let film = self.film(texels_at, pixels, PixelLayout::of(variant))?;
        self.prepare_on(film, view, variant)
    }

    /// The same on a film that is made for such pictures.
    pub(super) fn prepare_on(
        &mut self,
        film: Arc<FilmBuffer>,
        view: &View,
        variant: &Variant,
    ) -> Result<Job<'_>, GpuError> {
        let compiled = self.pipelines.compile(variant)?;
        let [_, _, width, height] = view.crop;
        let blocks = Blocks::new(width, height);
        let band_height = self.film_rows(view, variant)?;
        let is_cold = self.warm.insert(*variant);
        self.scene.set_view(&self.context, view);
        let group = self.scene.bind(&self.context, &film.buffer);
        let mut job = Job {
            context: &self.context,
            clock: None,
            pipeline: compiled.pipeline,
            film,
            group,
            blocks,
            band_height,
            tree_at: compiled.tree_at,
        };
        if is_cold {
            // Some drivers compile at the first dispatch: have one outside the picture.
            job.submit(Tile { first_block: blocks.count(), block_count: 1, ..Tile::default() })?;
        }
        job.clock = self.clock.as_ref();
        Ok(job)
    }

    /// Rows of the view's crop that fit one film, in whole blocks; one row of blocks at the least.
    pub(super) fn film_rows(&mut self, view: &View, variant: &Variant) -> Result<u32, GpuError> {
        let [_, _, width, height] = view.crop;
        Ok(Blocks::new(width, height).band_height(self.most_film_pixels(variant)?))
    }

    /// Pixels that fit one film.
    pub(super) fn most_film_pixels(&mut self, variant: &Variant) -> Result<u64, GpuError> {
        let compiled = self.pipelines.compile(variant)?;
        let limit = self.context.largest_binding();
        let most_pixels = FilmBuffer::most_pixels(limit, compiled.texels_at, PixelLayout::of(variant));
        Ok(most_pixels.min(self.band_pixels))
    }

    /// A film of an earlier picture if it is laid out so and nobody looks at it, else a new one.
    fn film(
        &mut self,
        texels_at: u64,
        pixels: u64,
        layout: PixelLayout,
    ) -> Result<Arc<FilmBuffer>, GpuError> {
        let is_free = |film: &Arc<FilmBuffer>| Arc::strong_count(film) == 1;
        let fits = |film: &&Arc<FilmBuffer>| is_free(film) && film.fits(texels_at, pixels, layout);
        if let Some(film) = self.films.iter().find(fits) {
            return Ok(Arc::clone(film));
        }
        // Their memory may be needed.
        self.films.retain(|film| !is_free(film));
        let film = Arc::new(FilmBuffer::new(&self.context, texels_at, pixels, layout)?);
        self.films.push(Arc::clone(&film));
        Ok(film)
    }
}

impl Renderer for GpuRenderer {
    type Error = GpuError;

    /// Trace the view: in bands, one after the other, where the adapter cannot hold the picture in one buffer.
    ///
    /// # Errors
    /// [`GpuError::NoF64`], [`GpuError::Shader`], [`GpuError::Refused`], [`GpuError::TooLarge`] for a picture of
    /// which not even one row of blocks fits, [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`],
    /// [`GpuError::TileLost`], [`GpuError::LoopLimit`].
    fn render(
        &mut self,
        view: &View,
        settings: &Settings,
        progress: &dyn Progress,
    ) -> Result<Frame, GpuError> {
        let start = Instant::now();
        if let Some(clock) = &self.clock {
            clock.reset();
        }
        let upload = std::mem::take(&mut self.upload);
        let variant = self.variant(settings);
        let view = &self.plan(settings).applied_to(view);
        if let Some(threshold) = settings.threshold().filter(|_| variant.adaptive()) {
            let mut frame = self.render_adaptive(view, &variant, threshold, progress)?;
            frame.times.upload = upload;
            return Ok(frame);
        }
        let job = self.prepare(view, &variant)?;
        let blocks = job.blocks;
        let times = TraceTimes { upload, compile: start.elapsed(), ..TraceTimes::default() };
        let mut frame = Frame {
            width: blocks.width,
            height: blocks.height,
            texels: Vec::new(),
            samples: SampleCounts::Same(view.samples),
            aovs: variant.aovs().then(Vec::new),
            float: variant.float,
            rays: RayCounts::default(),
            times,
            complete: false,
        };
        let kind = job.context.adapter.kind;
        let mut pace = Pace::new(blocks.count(), view.samples, variant.most_blocks(), kind);
        job.trace(&mut pace, progress, &mut frame)?;
        frame.complete = pace.finished_blocks() == blocks.count();
        blocks.erase_from(pace.finished_blocks(), &mut frame);
        Ok(frame)
    }
}

mod tests;
