//! Tracing a view on an adapter: tile after tile into the film, then the film to the host.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use super::buffers::SceneBuffers;
use super::context::Context;
use super::film::FilmBuffer;
use super::job::{Blocks, Job};
use super::pace::Pace;
use super::pipeline::Compiled;
use super::{AdapterReport, GpuError, GpuOptions, SOURCES, Variant, pipeline};
use crate::film::{Frame, Progress, Renderer, TraceTimes};
use crate::layout::{FlatScene, Float, Settings, Tile, View};

/// File and name of the entry point.
const ENTRY: (&str, &str) = ("render", "render");

/// A scene on an adapter.
pub struct GpuRenderer {
    context: Context,
    scene: SceneBuffers,
    bvh_depth: u32,
    /// What the upload took, until a frame has told it.
    upload: Duration,
    pipelines: HashMap<Variant, Compiled>,
    film: Option<FilmBuffer>,
}

impl GpuRenderer {
    /// Open an adapter and upload the scene.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::TooLarge`] (checked before anything is uploaded),
    /// [`GpuError::Refused`], [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn new(scene: &FlatScene, options: &GpuOptions) -> Result<Self, GpuError> {
        let context = Context::new(options)?;
        let start = Instant::now();
        let buffers = SceneBuffers::new(&context, scene)?;
        Ok(Self {
            context,
            scene: buffers,
            bvh_depth: scene.bvh_depth,
            upload: start.elapsed(),
            pipelines: HashMap::new(),
            film: None,
        })
    }

    /// The adapter that traces.
    #[must_use]
    pub fn adapter(&self) -> &AdapterReport {
        &self.context.adapter
    }

    /// The variant for these settings: fast where the adapter cannot be strict.
    fn variant(&self, settings: &Settings) -> Variant {
        let variant = Variant::new(self.bvh_depth, settings);
        let float = if self.context.adapter.strict_float { variant.float } else { Float::Fast };
        Variant { float, ..variant }
    }

    /// The film of the last picture if it has the right size, else a new one.
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
        let pipeline = pipeline::compile(&self.context, &self.scene.layout, SOURCES, ENTRY, variant)?;
        self.pipelines.insert(*variant, pipeline.clone());
        Ok((pipeline, true))
    }
}

impl Renderer for GpuRenderer {
    type Error = GpuError;

    /// Trace the view.
    ///
    /// # Errors
    /// [`GpuError::NoF64`], [`GpuError::Shader`], [`GpuError::Refused`], [`GpuError::TooLarge`] for the picture,
    /// [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`], [`GpuError::TileLost`].
    fn render(
        &mut self,
        view: &View,
        settings: &Settings,
        progress: &dyn Progress,
    ) -> Result<Frame, GpuError> {
        let start = Instant::now();
        let [_, _, width, height] = view.crop;
        let blocks = Blocks::new(width, height);
        let variant = self.variant(settings);
        // Compile, and make room.
        let (pipeline, is_new) = self.pipeline(&variant)?;
        let film = self.film(pipeline.texels_at, u64::from(width) * u64::from(height), settings.aovs)?;
        film.clear(&self.context);
        self.scene.set_view(&self.context, view);
        let group = self.scene.bind(&self.context, &film.buffer);
        let job = Job { context: &self.context, pipeline: &pipeline.pipeline, film: &film, group };
        if is_new {
            // Some drivers compile at the first dispatch: have one outside the picture.
            job.submit(Tile { first_block: blocks.count(), block_count: 1, ..Tile::default() })?;
        }
        let compiled = Instant::now();
        // Trace.
        let mut pace =
            Pace::new(blocks.count(), view.samples, variant.most_blocks(), self.context.adapter.kind);
        let rays = job.trace(&mut pace, progress)?;
        let traced = Instant::now();
        // Bring the picture home.
        let (texels, aovs) = film.read(&self.context)?;
        let times = TraceTimes {
            upload: std::mem::take(&mut self.upload),
            compile: compiled - start,
            trace: traced - compiled,
            readback: traced.elapsed(),
        };
        let complete = pace.finished_blocks() == blocks.count();
        let mut frame = Frame { width, height, texels, aovs, float: variant.float, rays, times, complete };
        blocks.erase_from(pace.finished_blocks(), &mut frame);
        Ok(frame)
    }
}
