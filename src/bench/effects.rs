//! What code for effects costs that a scene does not need.

use std::path::Path;
use std::time::Duration;

use serde::Serialize;

use super::{BenchError, Ratio, Target, Tracer, median, take_turns};
use crate::film::{Frame, Renderer};
use crate::flatten::{flatten, view};
use crate::gpu::InvocationMemory;
use crate::layout::{Effect, EffectChoice, EffectSet, FlatScene, Scan, Settings, View};
use crate::scene::{Camera, Scene};

/// Fresh renderers that each side compiles in, for a median.
const COMPILES: usize = 3;
/// Width and height of the picture for which they do.
const GLANCE: [u32; 2] = [8, 8];

/// A scene, flattened, and the view of it that is traced at one sample a pixel.
pub struct Stage {
    /// Its file's name.
    pub name: String,
    pub(super) scene: FlatScene,
    camera: Camera,
    view: View,
    /// The same of a few pixels.
    pub(super) glance: View,
    pub(super) settings: Settings,
}

/// A figure of the special side and of the general one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sides<T> {
    /// With the effects that the scene calls for.
    pub special: T,
    /// With those that it does not need.
    pub general: T,
}

/// One scene on one device, traced by what it calls for and by more. Both pictures were the same, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EffectRow {
    /// The scene.
    pub scene: String,
    /// The device.
    pub device: String,
    /// Effects of the general side that the scene does not call for.
    pub added: Vec<&'static str>,
    /// Rays of a picture.
    pub rays: u64,
    /// Median times of the trace, in milliseconds.
    pub trace_ms: Sides<f64>,
    /// How many times as long the general side takes.
    pub ratio: Ratio,
    /// Assembly and pipeline creation, first dispatch included: median time of fresh renderers, in milliseconds; none on
    /// the CPU. Cold only where the driver keeps nothing on disk.
    pub compile_ms: Option<Sides<f64>>,
    /// What an invocation takes; none on the CPU.
    pub memory: Option<Sides<InvocationMemory>>,
}

impl Stage {
    /// Read and flatten a scene.
    ///
    /// # Errors
    /// [`BenchError::Scene`].
    pub fn load(path: &Path, size: [u32; 2]) -> Result<Self, BenchError> {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        Self::of(name, &Scene::load(path)?, size)
    }

    /// Flatten a scene of that name.
    ///
    /// # Errors
    /// [`BenchError::Scene`].
    pub(super) fn of(name: String, scene: &Scene, size: [u32; 2]) -> Result<Self, BenchError> {
        let flat = flatten(scene)?.scene;
        let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
        let settings = Settings { depth, cutoff, samples: 1, ..Settings::default() };
        let [view, glance] = [size, GLANCE].map(|size| view(&scene.camera, &flat, size, None, &settings));
        Ok(Self { name, scene: flat, camera: scene.camera.clone(), view, glance, settings })
    }

    /// A view of it of another size, under other settings.
    pub(super) fn view_of(&self, size: [u32; 2], settings: &Settings) -> View {
        view(&self.camera, &self.scene, size, None, settings)
    }

    /// The effects that it calls for.
    #[must_use]
    pub fn effects(&self) -> EffectSet {
        effects(self, &self.settings)
    }
}

/// Each effect that a scene can do without, with all that it needs, as a set that holds what the scene calls for.
///
/// What settings decide is not among them.
pub fn idle_effects(stage: &Stage) -> impl Iterator<Item = (Effect, EffectSet)> + use<> {
    let found = stage.effects();
    let by_settings = EffectSet::of(&[Effect::Antialiasing, Effect::Adaptive, Effect::Aovs]);
    EffectSet::ALL
        .minus(found)
        .minus(by_settings)
        .iter()
        .map(move |effect| (effect, found.with(effect).closed()))
}

/// Trace a scene with its own effects and with those of `general`, in turn; none where the pictures differ.
///
/// # Errors
/// What the device reports.
pub fn compare_effects(
    stage: &Stage,
    target: &Target,
    general: EffectChoice,
    rounds: usize,
) -> Result<Option<EffectRow>, BenchError> {
    let sides = [EffectChoice::Auto, general].map(|effects| Settings { effects, ..stage.settings });
    // One renderer for both, so that scene and film lie where they lie.
    let mut tracer = target.open(&stage.scene)?;
    let first = tracer.render(&stage.view, &sides[0], &())?;
    if !is_same(&first, &tracer.render(&stage.view, &sides[1], &())?) {
        return Ok(None);
    }
    let [special, general] = sides.map(|settings| effects(stage, &settings));
    let trace = |side: usize| -> Result<Duration, BenchError> {
        Ok(tracer.render(&stage.view, &sides[side], &())?.times.trace)
    };
    let times = take_turns(rounds, sides.len(), trace)?;
    let [special_ms, general_ms] = [0, 1].map(|side| milliseconds(median(&times[side])));
    Ok(Some(EffectRow {
        scene: stage.name.clone(),
        device: target.name(),
        added: general.minus(special).iter().map(Effect::name).collect(),
        rays: first.rays.total(),
        trace_ms: Sides { special: special_ms, general: general_ms },
        ratio: Ratio::of(&times[1], &times[0]),
        compile_ms: match target {
            Target::Cpu { .. } => None,
            Target::Adapter(_) => Some(compile_times(stage, target, sides)?),
        },
        memory: memory(&mut tracer, sides)?,
    }))
}

/// Median times in milliseconds until fresh renderers can trace, in turn. What a driver does once in a process is done.
fn compile_times(stage: &Stage, target: &Target, sides: [Settings; 2]) -> Result<Sides<f64>, BenchError> {
    let mut times = [const { Vec::new() }; 2];
    for _ in 0..COMPILES {
        for (settings, times) in sides.iter().zip(&mut times) {
            let first = target.open(&stage.scene)?.render(&stage.glance, settings, &())?;
            times.push(first.times.compile);
        }
    }
    let [special, general] = times.map(|times| milliseconds(median(&times)));
    Ok(Sides { special, general })
}

/// What an invocation of either side takes; none on the CPU.
fn memory(
    tracer: &mut Tracer<'_>,
    [special, general]: [Settings; 2],
) -> Result<Option<Sides<InvocationMemory>>, BenchError> {
    let Tracer::Gpu(renderer) = tracer else { return Ok(None) };
    Ok(Some(Sides {
        special: renderer.invocation_memory(&special)?,
        general: renderer.invocation_memory(&general)?,
    }))
}

/// What is simulated under these settings.
fn effects(stage: &Stage, settings: &Settings) -> EffectSet {
    Scan::of(&stage.scene).effects(settings).plan(settings).effects
}

/// Whether both frames show the same, bit for bit, after as many rays of each kind.
pub(super) fn is_same(a: &Frame, b: &Frame) -> bool {
    a.rays == b.rays && bytemuck::cast_slice::<_, u32>(&a.texels) == bytemuck::cast_slice::<_, u32>(&b.texels)
}

pub(super) fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn stage(file: &str) -> Stage {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(file);
        Stage::load(&path, [40, 30]).unwrap()
    }

    const CPU: Target = Target::Cpu { threads: 1 };

    #[test]
    fn a_row_names_what_the_general_side_adds() {
        let row = compare_effects(&stage("opaque.toml"), &CPU, EffectChoice::All, 2).unwrap().unwrap();
        assert!(row.added.contains(&"transmission") && row.added.contains(&"absorption"), "{row:?}");
        assert!(row.rays > 40 * 30 && row.trace_ms.special > 0.0 && row.ratio.median > 0.0);
        assert_eq!((row.scene.as_str(), row.compile_ms), ("opaque.toml", None));
    }

    #[test]
    fn other_pictures_are_no_row() {
        let lacking = EffectChoice::Only(EffectSet::NONE);
        assert_eq!(compare_effects(&stage("opaque.toml"), &CPU, lacking, 2).unwrap(), None);
    }

    #[test]
    fn idle_effects_come_with_what_they_need_and_leave_the_picture_alone() {
        let stage = stage("opaque.toml");
        let idle: Vec<_> = idle_effects(&stage).collect();
        let (_, absorption) = idle.iter().find(|one| one.0 == Effect::Absorption).unwrap();
        assert!(absorption.has(Effect::Transmission) && absorption.has_all(stage.effects()));
        assert!(idle.iter().all(|one| !stage.effects().has(one.0) && one.0 != Effect::Aovs));
        assert!(compare_effects(&stage, &CPU, EffectChoice::Only(*absorption), 1).unwrap().is_some());
    }
}
