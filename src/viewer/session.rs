//! What the user has set: everything that the panels show and change, without a window.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::Backend;
use super::cost::Cost;
use super::inspection::Inspection;
use super::look::Look;
use super::orbit::Orbit;
use super::present::Ranges;
use super::stage::Stage;
use super::tracer::{Kind, Resolution, Wanted};
use super::turntable::Turning;
use crate::film::{Metadata, RayCounts, TraceTimes};
use crate::gpu::{AdapterReport, SOURCES, Source};
use crate::layout::{EffectChoice, EffectSet, Effects, Settings};
use crate::scene::Scene;

/// How long a message stays.
const TOAST: Duration = Duration::from_secs(6);

/// What the user has set, and what is known of the picture.
pub struct Session {
    /// The scene.
    pub stage: Arc<Stage>,
    /// Where it is seen from.
    pub orbit: Orbit,
    /// How it is traced, but for the effects that are switched off.
    pub settings: Settings,
    /// What the command line asks for.
    pub effects: EffectChoice,
    /// Effects that are switched off by hand.
    pub off: EffectSet,
    /// How many pixels are traced.
    pub resolution: Resolution,
    /// Which device traces.
    pub backend: Backend,
    /// Threads of the CPU; 0 for one each core.
    pub threads: usize,
    /// The window's adapter.
    pub adapter: AdapterReport,
    /// All adapters of this machine.
    pub adapters: Vec<AdapterReport>,
    /// What is shown.
    pub look: Look,
    /// Greatest values of the finished picture, where a view needs them.
    pub ranges: Option<Ranges>,
    /// Whether the panel is open.
    pub is_panel_open: bool,
    /// Whether the list of shortcuts is open.
    pub is_help_open: bool,
    /// What is known of the picture.
    pub status: Status,
    /// What a pixel is made of, once one was clicked.
    pub inspection: Option<Inspection>,
    /// What the last change of a setting cost.
    pub cost: Option<Cost>,
    /// Messages that fade.
    pub toasts: Vec<Toast>,
    /// The shader files that adapters trace by.
    pub shaders: &'static [Source<'static>],
    /// Pictures of the next turntable.
    pub turntable_pictures: u32,
    /// The turntable in work.
    pub turning: Option<Turning>,
    /// What is left for the window to do.
    pub orders: Vec<Order>,
}

/// What is known of the picture.
#[derive(Debug, Clone, Default)]
pub struct Status {
    /// A pipeline is awaited.
    pub is_compiling: bool,
    /// Of the last picture that came.
    pub kind: Option<Kind>,
    /// Its size.
    pub size: [u32; 2],
    /// Samples that each of its pixels has, and is to have.
    pub samples: [u32; 2],
    /// The part of its work that is done.
    pub done: f32,
    /// Rays traced for it.
    pub rays: RayCounts,
    /// Where its time went.
    pub times: TraceTimes,
    /// Size of the last picture in motion.
    pub motion_size: [u32; 2],
    /// What that took.
    pub motion_time: Duration,
    /// Why there is no picture.
    pub failure: Option<String>,
}

/// A message that fades.
#[derive(Debug, Clone, PartialEq)]
pub struct Toast {
    /// What it says.
    pub text: String,
    /// Whether something went wrong.
    pub is_error: bool,
    /// When it goes.
    pub until: Instant,
}

/// What is left for the window to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Order {
    /// Put text on the clipboard.
    Copy(String),
    /// Write the picture to a new file beside the scene.
    Screenshot,
    /// Write a copy of the scene file with this camera.
    SaveScene,
    /// Write so many pictures from round the pivot.
    Turntable(u32),
    /// Open another scene.
    Open(PathBuf),
    /// Trace by another adapter.
    UseAdapter(String),
    /// Turn about what is under this pixel of the picture.
    SetPivot([u32; 2]),
    /// Trace the tree of the inspected pixel on the adapter too.
    Compare([u32; 2]),
    /// Show what this pixel of the picture is made of.
    Inspect([u32; 2]),
    /// Close the window.
    Quit,
}

impl Session {
    /// A session with a scene, as the command line asks for it.
    #[must_use]
    pub fn new(
        stage: Arc<Stage>,
        settings: Settings,
        backend: Backend,
        threads: usize,
        adapter: AdapterReport,
        adapters: Vec<AdapterReport>,
    ) -> Self {
        let orbit = Orbit::new(&stage.scene.camera, stage.flat.scene.bounds);
        Self {
            stage,
            orbit,
            effects: settings.effects,
            settings,
            off: EffectSet::NONE,
            resolution: Resolution::default(),
            backend,
            threads,
            adapter,
            adapters,
            look: Look { wipe: 0.5, ..Look::default() },
            ranges: None,
            is_panel_open: true,
            is_help_open: false,
            status: Status::default(),
            inspection: None,
            cost: None,
            toasts: Vec::new(),
            shaders: SOURCES,
            turntable_pictures: 36,
            turning: None,
            orders: Vec::new(),
        }
    }

    /// What the scene calls for, and why.
    #[must_use]
    pub fn found(&self) -> Effects {
        self.stage.scan.effects(&self.settings)
    }

    /// How to trace, all told.
    #[must_use]
    pub fn traced_settings(&self) -> Settings {
        let asked = Settings { effects: self.effects, aovs: self.look.needs_aovs(), ..self.settings };
        if self.off == EffectSet::NONE {
            return asked;
        }
        let set = self.stage.scan.effects(&asked).plan(&asked).effects.minus(self.off).pruned();
        Settings { effects: EffectChoice::Only(set), ..asked }
    }

    /// What is to be traced for a picture of this size.
    #[must_use]
    pub fn wanted(&self, size: [u32; 2]) -> Wanted {
        Wanted {
            stage: Arc::clone(&self.stage),
            camera: self.orbit.camera.clone(),
            size,
            settings: self.traced_settings(),
            backend: self.backend,
            resolution: self.resolution,
            threads: self.threads,
            compares: self.look.needs_reference(),
            shaders: self.shaders,
        }
    }

    /// Put another scene in place of this one: a new version of the same file keeps the camera unless its own changed.
    pub fn put(&mut self, stage: Arc<Stage>) {
        let is_same = self.stage.path == stage.path && self.stage.scene.camera == stage.scene.camera;
        let orbit = Orbit::new(&stage.scene.camera, stage.flat.scene.bounds);
        self.orbit = if is_same { self.orbit.within(orbit) } else { orbit };
        if self.stage.path != stage.path {
            self.off = EffectSet::NONE;
            self.look.fine = None;
            self.look.coarse = None;
            self.look.reference = None;
        }
        self.inspection = None;
        self.stage = stage;
    }

    /// Put a scene with other lights or materials in place of this one.
    pub fn revise(&mut self, scene: Scene) {
        match self.stage.revised(scene) {
            Ok(stage) => self.stage = Arc::new(stage),
            Err(error) => self.complain(error.to_string()),
        }
    }

    /// Whether the picture that is shown is complete.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.status.kind == Some(Kind::Complete)
    }

    /// The scene's name without its extension.
    #[must_use]
    pub fn stem(&self) -> String {
        self.stage.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// What a picture file says about the picture.
    #[must_use]
    pub fn metadata(&self) -> Metadata {
        let Settings { depth, cutoff, samples, .. } = self.settings;
        let [width, height] = self.status.size;
        let device = match self.backend {
            Backend::Gpu => self.adapter.name.clone(),
            Backend::Cpu { .. } => "CPU".to_owned(),
        };
        let settings = self.traced_settings();
        Metadata::new()
            .with("scene", self.stage.path.display().to_string())
            .with("settings", format!("{width}x{height}, depth {depth}, cutoff {cutoff}, samples {samples}"))
            .with("device", device)
            .with("effects", self.stage.scan.effects(&settings).plan(&settings).effects.to_string())
            .with("camera", self.orbit.table())
            .with("seconds", format!("{:.3}", self.status.times.trace.as_secs_f64()))
    }

    /// Say how something went.
    pub fn tell(&mut self, result: Result<String, String>) {
        match result {
            Ok(text) => self.say(text),
            Err(text) => self.complain(text),
        }
    }

    /// Say something that fades.
    pub fn say(&mut self, text: impl Into<String>) {
        self.toast(text.into(), false);
    }

    /// Say that something went wrong.
    pub fn complain(&mut self, text: impl Into<String>) {
        self.toast(text.into(), true);
    }

    fn toast(&mut self, text: String, is_error: bool) {
        let stay = if is_error { 3 * TOAST } else { TOAST };
        self.toasts.retain(|toast| toast.text != text);
        self.toasts.push(Toast { text, is_error, until: Instant::now() + stay });
    }
}
