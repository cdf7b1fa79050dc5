//! A scene on an adapter, and the pictures that are traced of it.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use super::blocks::Blocks;
use super::buffers::SceneBuffers;
use super::context::Context;
use super::film::FilmBuffer;
use super::job::Job;
use super::pace::Pace;
use super::pipeline::Compiled;
use super::{AdapterReport, GpuError, GpuOptions, Portions, SOURCES, Source, Variant, pipeline};
use crate::film::{Frame, Progress, RayCounts, Renderer, TraceTimes};
use crate::layout::{FlatScene, Float, Plan, Scan, Settings, Tile, View};

/// File and name of the entry point.
const ENTRY: (&str, &str) = ("render", "render");

/// A scene on an adapter.
pub struct GpuRenderer {
    context: Context,
    sources: &'static [Source<'static>],
    scene: SceneBuffers,
    /// Of the deepest tree so far: its stack serves the others.
    bvh_depth: u32,
    /// What the scene calls for.
    scan: Scan,
    /// What the upload took, until a frame has told it.
    upload: Duration,
    pipelines: HashMap<Variant, Compiled>,
    film: Option<FilmBuffer>,
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
        let context = Context::new(options)?;
        let start = Instant::now();
        let buffers = SceneBuffers::new(&context, scene)?;
        Ok(Self {
            context,
            sources,
            scene: buffers,
            bvh_depth: scene.bvh_depth,
            scan: Scan::of(scene),
            upload: start.elapsed(),
            pipelines: HashMap::new(),
            film: None,
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
        self.scene = SceneBuffers::new(&self.context, scene)?;
        self.bvh_depth = self.bvh_depth.max(scene.bvh_depth);
        self.scan = Scan::of(scene);
        self.upload = start.elapsed();
        Ok(())
    }

    /// What is simulated under these settings.
    fn plan(&self, settings: &Settings) -> Plan {
        self.scan.effects(settings).plan(settings)
    }

    /// The variant for these settings: fast where the adapter cannot be strict.
    fn variant(&self, settings: &Settings) -> Variant {
        let variant = Variant::new(self.bvh_depth, settings, &self.plan(settings));
        let float = if self.context.adapter.strict_float { variant.float } else { Float::Fast };
        Variant { float, ..variant }
    }

    /// Compile the variant, make room for the picture and take it in view.
    fn prepare(&mut self, view: &View, variant: &Variant) -> Result<Job<'_>, GpuError> {
        let (compiled, is_new) = self.pipeline(variant)?;
        // As many rows as fit one buffer.
        let [_, _, width, height] = view.crop;
        let blocks = Blocks::new(width, height);
        let limit = self.context.largest_binding();
        let most_pixels = FilmBuffer::most_pixels(limit, compiled.texels_at, variant.aovs());
        let band_height = blocks.band_height(most_pixels.min(self.band_pixels));
        let pixels = u64::from(width) * u64::from(band_height);
        let film = self.film(compiled.texels_at, pixels, variant.aovs())?;
        self.scene.set_view(&self.context, view);
        let group = self.scene.bind(&self.context, &film.buffer);
        let job =
            Job { context: &self.context, pipeline: compiled.pipeline, film, group, blocks, band_height };
        if is_new {
            // Some drivers compile at the first dispatch: have one outside the picture.
            job.submit(Tile { first_block: blocks.count(), block_count: 1, ..Tile::default() })?;
        }
        Ok(job)
    }

    /// The film of the last picture if it is laid out so, else a new one.
    fn film(&mut self, texels_at: u64, pixels: u64, aovs: bool) -> Result<FilmBuffer, GpuError> {
        let film = match self.film.take() {
            Some(film) if film.fits(texels_at, pixels, aovs) => film,
            _ => FilmBuffer::new(&self.context, texels_at, pixels, aovs)?,
        };
        Ok(self.film.insert(film).clone())
    }

    /// The variant's pipeline, and whether it is new.
    fn pipeline(&mut self, variant: &Variant) -> Result<(Compiled, bool), GpuError> {
        if let Some(pipeline) = self.pipelines.get(variant) {
            return Ok((pipeline.clone(), false));
        }
        let pipeline = pipeline::compile(&self.context, &self.scene.layout, self.sources, ENTRY, variant)?;
        self.pipelines.insert(*variant, pipeline.clone());
        Ok((pipeline, true))
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
        let upload = std::mem::take(&mut self.upload);
        let variant = self.variant(settings);
        let view = &self.plan(settings).applied_to(view);
        let job = self.prepare(view, &variant)?;
        let blocks = job.blocks;
        let times = TraceTimes { upload, compile: start.elapsed(), ..TraceTimes::default() };
        let mut frame = Frame {
            width: blocks.width,
            height: blocks.height,
            texels: Vec::new(),
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
