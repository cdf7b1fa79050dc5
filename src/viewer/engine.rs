//! What traces for the window: an adapter, or the CPU.

use std::ops::ControlFlow;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::TraceError;
use super::scale::scaled;
use crate::cpu::CpuRenderer;
use crate::film::{Progress, Renderer};
use crate::gpu::{Exposure, Film, GpuError, GpuRenderer, Rolling, SharedDevice, Source};
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{EffectChoice, FlatScene, Float, Settings, TreeNode, View};

/// What traces one scene for the window.
pub(super) trait Engine {
    /// Whether a picture can be traced at once.
    fn is_ready(&self, settings: &Settings) -> bool;

    /// Whether that is done by what is made for these settings.
    fn is_special(&self, settings: &Settings) -> bool;

    /// Make ready without waiting; whether that is done.
    fn prepare(&mut self, settings: &Settings) -> Result<bool, TraceError>;

    /// Nothing is to be done: make ready for settings that may come.
    fn prepare_for_changes(&mut self, settings: &Settings);

    /// The largest size of that shape, up to `size`, that can be traced at once.
    fn fitting(&mut self, size: [u32; 2], settings: &Settings) -> Result<[u32; 2], TraceError>;

    /// Trace a picture that stays on the window's device; none where it was broken off.
    fn expose(
        &mut self,
        view: &View,
        settings: &Settings,
        listen: Listen<'_>,
    ) -> Result<Option<Exposure>, TraceError>;

    /// Trace a picture in motion, of one sample a pixel: over the last one, from where that was broken off.
    fn follow(
        &mut self,
        view: &View,
        settings: &Settings,
        listen: Listen<'_>,
    ) -> Result<Followed, TraceError>;

    /// The next picture in motion begins anew.
    fn rest(&mut self);

    /// Whether pictures are traced by these shader files, or by none.
    fn has_shaders(&self, shaders: &'static [Source<'static>]) -> bool;

    /// Trace by these shader files from now on, if they can be compiled for the settings.
    fn take_shaders(
        &mut self,
        shaders: &'static [Source<'static>],
        settings: &Settings,
    ) -> Result<(), GpuError>;

    /// The tree of a pixel, and whether it is to be the CPU's bit for bit; none on the CPU itself.
    fn tree(
        &mut self,
        view: &View,
        settings: &Settings,
        pixel: [u32; 2],
    ) -> Result<Option<(Vec<TreeNode>, bool)>, TraceError>;
}

/// What became of a picture in motion.
pub(super) struct Followed {
    /// The part of it that was traced, 0 to 1.
    pub(super) share: f64,
    /// What that took.
    pub(super) time: Duration,
    /// The picture, if it was not broken off.
    pub(super) whole: Option<Exposure>,
}

/// Hears again and again what there is of the picture, if anything, and may break off.
pub(super) type Listen<'a> = &'a (dyn Fn(Option<&Exposure>) -> ControlFlow<()> + Sync);

/// A size of the same shape with at most so many pixels.
fn within(size: [u32; 2], most: u64) -> [u32; 2] {
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    // Rounding is to stay on the safe side.
    if pixels <= most { size } else { scaled(size, (most as f64 / pixels as f64).sqrt() * 0.98) }
}

/// An adapter. Until the pipeline for a scene's effects is compiled, the general one serves if that is.
pub(super) struct GpuEngine {
    renderer: GpuRenderer,
    /// The picture in motion.
    rolling: Option<Rolling>,
    /// Pipelines in work, with what they are for.
    compiling: Vec<(Settings, JoinHandle<Result<(), GpuError>>)>,
}

impl GpuEngine {
    pub(super) fn new(renderer: GpuRenderer) -> Self {
        Self { renderer, rolling: None, compiling: Vec::new() }
    }

    /// The renderer with all that is compiled.
    pub(super) fn into_renderer(self) -> GpuRenderer {
        self.renderer
    }

    /// Settings of the same picture, by the pipeline that serves every scene at every depth.
    fn general(settings: &Settings) -> Option<Settings> {
        let general = Settings { effects: EffectChoice::All, depth: MAX_DEPTH, ..*settings };
        // A picture that lacks something has no other pipeline.
        (!matches!(settings.effects, EffectChoice::Only(_))).then_some(general)
    }

    /// Those of the settings whose pipeline is there.
    fn usable(&self, settings: &Settings) -> Option<Settings> {
        let is_compiled = |settings: &Settings| self.renderer.is_compiled(settings);
        Some(*settings).filter(is_compiled).or_else(|| Self::general(settings).filter(is_compiled))
    }

    /// Those of the settings whose pipeline is there; another is compiled meanwhile.
    fn serve(&mut self, settings: &Settings) -> Settings {
        if !self.is_special(settings) {
            self.compile(*settings);
        }
        self.usable(settings).unwrap_or(*settings)
    }

    fn compile(&mut self, settings: Settings) {
        let is_there = self.renderer.is_compiled(&settings);
        if !is_there && !self.compiling.iter().any(|(of, _)| *of == settings) {
            self.compiling.push((settings, self.renderer.compile_ahead(&settings)));
        }
    }

    /// Forget what is compiled by now.
    fn collect(&mut self) -> Result<(), TraceError> {
        let (done, rest) = self.compiling.drain(..).partition(|(_, thread)| thread.is_finished());
        self.compiling = rest;
        let done: Vec<(Settings, JoinHandle<_>)> = done;
        for (_, thread) in done {
            // A panic there was printed there; the next render compiles again, and tells.
            thread.join().unwrap_or(Ok(())).map_err(TraceError::Gpu)?;
        }
        Ok(())
    }
}

impl Engine for GpuEngine {
    fn is_ready(&self, settings: &Settings) -> bool {
        self.usable(settings).is_some()
    }

    fn is_special(&self, settings: &Settings) -> bool {
        self.renderer.is_compiled(settings)
    }

    fn prepare(&mut self, settings: &Settings) -> Result<bool, TraceError> {
        self.collect()?;
        self.compile(*settings);
        Ok(self.is_ready(settings))
    }

    fn prepare_for_changes(&mut self, settings: &Settings) {
        self.compile(*settings);
        if let Some(general) = Self::general(settings) {
            self.compile(general);
        }
    }

    fn fitting(&mut self, size: [u32; 2], settings: &Settings) -> Result<[u32; 2], TraceError> {
        let usable = self.usable(settings).unwrap_or(*settings);
        Ok(within(size, self.renderer.most_pixels(&usable)?))
    }

    fn expose(
        &mut self,
        view: &View,
        settings: &Settings,
        listen: Listen<'_>,
    ) -> Result<Option<Exposure>, TraceError> {
        let usable = self.serve(settings);
        let exposure = self.renderer.expose(view, &usable, &|exposure| listen(Some(exposure)))?;
        Ok(Some(exposure).filter(Exposure::is_complete))
    }

    fn follow(
        &mut self,
        view: &View,
        settings: &Settings,
        listen: Listen<'_>,
    ) -> Result<Followed, TraceError> {
        let usable = self.serve(settings);
        let last = self.rolling.take();
        let rolling = self.renderer.roll(last, view, &usable, &|exposure| listen(Some(exposure)))?;
        let Rolling { share, exposure, .. } = &rolling;
        let whole = (*share == 1.0).then(|| exposure.clone());
        let followed = Followed { share: *share, time: exposure.times.trace, whole };
        self.rolling = Some(rolling);
        Ok(followed)
    }

    fn rest(&mut self) {
        self.rolling = None;
    }

    fn has_shaders(&self, shaders: &'static [Source<'static>]) -> bool {
        std::ptr::eq(self.renderer.sources(), shaders)
    }

    fn take_shaders(
        &mut self,
        shaders: &'static [Source<'static>],
        settings: &Settings,
    ) -> Result<(), GpuError> {
        self.renderer.reassemble(shaders, settings)?;
        // They are for the files before.
        self.compiling.clear();
        Ok(())
    }

    fn tree(
        &mut self,
        view: &View,
        settings: &Settings,
        pixel: [u32; 2],
    ) -> Result<Option<(Vec<TreeNode>, bool)>, TraceError> {
        let tree = self.renderer.trace_tree(view, settings, pixel)?;
        Ok(Some((tree.nodes, tree.float == Float::Strict)))
    }
}

/// The CPU; its pictures are brought to the window's device.
pub(super) struct CpuEngine<'a> {
    renderer: CpuRenderer<'a>,
    device: SharedDevice,
}

impl<'a> CpuEngine<'a> {
    pub(super) fn new(
        scene: &'a FlatScene,
        threads: usize,
        device: &SharedDevice,
    ) -> Result<Self, TraceError> {
        Ok(Self { renderer: CpuRenderer::new(scene, threads)?, device: device.clone() })
    }
}

/// Hears of nothing but whether to go on.
struct Heard<'a>(Listen<'a>);

impl Progress for Heard<'_> {
    fn advance(&self, _done: u64, _total: u64) -> ControlFlow<()> {
        (self.0)(None)
    }
}

impl Engine for CpuEngine<'_> {
    fn is_ready(&self, _settings: &Settings) -> bool {
        true
    }

    fn is_special(&self, _settings: &Settings) -> bool {
        true
    }

    fn prepare(&mut self, _settings: &Settings) -> Result<bool, TraceError> {
        Ok(true)
    }

    fn prepare_for_changes(&mut self, _settings: &Settings) {}

    fn fitting(&mut self, size: [u32; 2], settings: &Settings) -> Result<[u32; 2], TraceError> {
        Ok(within(size, Film::most_pixels(&self.device, settings.aovs)))
    }

    /// A first sample of every pixel, for something to see, then all of them: the renderer gives whole pictures only.
    fn expose(
        &mut self,
        view: &View,
        settings: &Settings,
        listen: Listen<'_>,
    ) -> Result<Option<Exposure>, TraceError> {
        let mut trace = |samples, adaptive| {
            let settings = Settings { samples, adaptive, ..*settings };
            let frame = self.renderer.render(&View { samples, ..*view }, &settings, &Heard(listen))?;
            if !frame.complete {
                return Ok(None);
            }
            Exposure::of_frame(&self.device, &frame).map(Some).map_err(TraceError::Gpu)
        };
        if view.samples > 1 {
            match trace(1, None)? {
                Some(first) if listen(Some(&first)) == ControlFlow::Continue(()) => {}
                _ => return Ok(None),
            }
        }
        trace(view.samples, settings.adaptive)
    }

    fn follow(
        &mut self,
        view: &View,
        settings: &Settings,
        _listen: Listen<'_>,
    ) -> Result<Followed, TraceError> {
        let start = Instant::now();
        // What is broken off leaves nothing.
        let whole = self.expose(view, settings, &|_| ControlFlow::Continue(()))?;
        Ok(Followed { share: 1.0, time: start.elapsed(), whole })
    }

    fn rest(&mut self) {}

    fn has_shaders(&self, _shaders: &'static [Source<'static>]) -> bool {
        true
    }

    fn take_shaders(
        &mut self,
        _shaders: &'static [Source<'static>],
        _settings: &Settings,
    ) -> Result<(), GpuError> {
        Ok(())
    }

    fn tree(
        &mut self,
        _view: &View,
        _settings: &Settings,
        _pixel: [u32; 2],
    ) -> Result<Option<(Vec<TreeNode>, bool)>, TraceError> {
        Ok(None)
    }
}
