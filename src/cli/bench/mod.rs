//! `snellius bench`: measured comparisons, each row with its proof.

mod markdown;
mod rays;
mod report;

use std::path::{Path, PathBuf};

use super::console::{Console, print, print_json};
use super::device::cpu_name;
use super::values::{Size, whole_in};
use super::{CliError, Outcome};
use crate::bench::{EffectRow, Ratio, Stage, Target, compare_effects, idle_effects};
use crate::gpu::{GpuError, adapters};
use crate::layout::{Backend, EffectChoice};
use report::{Machine, Report};

/// Measure what tracing costs on this machine's devices
///
/// With --effects: each scene traced with the effects that it calls for, and with all; then each effect switched on
/// alone in a scene that does not need it. Both sides run in turn after a warm-up. A row is printed only where both
/// sides traced the same picture, bit for bit. Time is that of the trace alone; MESA_SHADER_CACHE_DISABLE=true in the
/// environment makes compile times of Mesa's drivers those of a first run.
///
/// With --rays: rays against one mesh, without shading, on the CPU: primary ones (P), mirrored (R) and scattered (D) off
/// what those hit, and shadow rays (S). A rate is printed only where every hit has the bits of the scalar kernel's.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius bench --effects
  snellius bench --effects scenes/opaque.toml --adapter llvmpipe --rounds 25
  snellius bench --effects --backend cpu --json > effects.json
  snellius bench --rays bunny.obj --eye 0,1,3 --target 0,0.5,0 --fov 40 --dump rays
  snellius bench --rays bunny.obj --ray-file rays/bunny.S.rays --any --json

Exit code: 0, or 1 if two sides traced different pictures or hits.")]
pub(super) struct BenchArgs {
    /// Scenes [default: all of the folder scenes]
    #[arg(conflicts_with = "mesh")]
    scenes: Vec<PathBuf>,
    /// Compare the effects that scenes call for with all effects, and with each other one alone
    #[arg(long, required_unless_present = "mesh", conflicts_with = "mesh")]
    effects: bool,
    #[command(flatten)]
    rays: rays::RayArgs,
    /// Width and height of the pictures in pixels
    #[arg(long, value_name = "WxH", default_value = "320x240", conflicts_with = "mesh")]
    size: Size,
    /// Rounds in which all sides are traced, 6 to 1000
    #[arg(long, value_name = "N", default_value = "11", value_parser = |text: &str| whole_in(text, Ratio::LEAST_ROUNDS as u32, 1000))]
    rounds: u32,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Only the CPU, or only Vulkan adapters
    #[arg(long, value_name = "DEVICE", help_heading = "Device", conflicts_with = "mesh")]
    backend: Option<Backend>,
    /// Only adapters of which this is part of the name, as `snellius devices` lists them
    #[arg(long, value_name = "NAME", help_heading = "Device", conflicts_with = "mesh")]
    adapter: Option<String>,
}

pub(super) fn run(args: &BenchArgs, console: Console) -> Result<Outcome, CliError> {
    if let Some(mesh) = &args.rays.mesh {
        return rays::run(mesh, args, console);
    }
    let scenes = if args.scenes.is_empty() { all_scenes()? } else { args.scenes.clone() };
    let targets = targets(args)?;
    let mut bench =
        Bench { args, console, targets: &targets, rows: Vec::new(), alone: Vec::new(), failed: 0 };
    let mut stages =
        scenes.iter().map(|path| Stage::load(path, args.size.0)).collect::<Result<Vec<_>, _>>()?;
    for stage in &stages {
        bench.whole(stage)?;
    }
    // A scene that calls for little shows most of what one effect more costs.
    stages.sort_by_key(|stage| stage.effects().iter().count());
    let mut met = Vec::new();
    for stage in &stages {
        bench.one_by_one(stage, &mut met)?;
    }
    let Bench { rows, alone, failed, .. } = bench;
    let machine = Machine::new(cpu_name(), &targets);
    let report = Report { machine, size: args.size.0, rounds: args.rounds, scenes: rows, alone, failed };
    if args.json {
        print_json(&report)?
    } else {
        print(&markdown::page(&report))?
    }
    Ok(if failed == 0 { Outcome::Done } else { Outcome::Failed })
}

/// The comparison of effects, in work.
struct Bench<'a> {
    args: &'a BenchArgs,
    console: Console,
    targets: &'a [Target],
    rows: Vec<EffectRow>,
    /// Rows of one effect that a scene does not need.
    alone: Vec<EffectRow>,
    /// Pairs of pictures that differ.
    failed: usize,
}

impl Bench<'_> {
    /// A scene's own effects against all of them, on every device.
    fn whole(&mut self, stage: &Stage) -> Result<(), CliError> {
        for target in self.targets {
            let row = self.measure(stage, target, EffectChoice::All, "all effects")?;
            self.rows.extend(row);
        }
        Ok(())
    }

    /// Each effect that no scene before could do without, switched on in this one if it can.
    fn one_by_one(&mut self, stage: &Stage, met: &mut Vec<&'static str>) -> Result<(), CliError> {
        for (effect, set) in idle_effects(stage) {
            if met.contains(&effect.name()) {
                continue;
            }
            met.push(effect.name());
            for target in self.targets {
                let row = self.measure(stage, target, EffectChoice::Only(set), effect.name())?;
                self.alone.extend(row);
            }
        }
        Ok(())
    }

    fn measure(
        &mut self,
        stage: &Stage,
        target: &Target,
        general: EffectChoice,
        what: &str,
    ) -> Result<Option<EffectRow>, CliError> {
        self.console.detail(format!("{}: {what} on {}", stage.name, target.name()));
        let row = compare_effects(stage, target, general, self.args.rounds as usize)?;
        if row.is_none() {
            self.failed += 1;
            let device = target.name();
            self.console.warn(format!("{}: the picture with {what} is another one on {device}", stage.name));
        }
        Ok(row)
    }
}

/// What the flags leave of this machine: all threads of the CPU unless an adapter is named, then each adapter.
fn targets(args: &BenchArgs) -> Result<Vec<Target>, CliError> {
    let mut targets = Vec::new();
    if args.backend.map_or(args.adapter.is_none(), |backend| backend == Backend::Cpu) {
        targets.push(Target::Cpu { threads: 0 });
    }
    if args.backend == Some(Backend::Cpu) {
        return Ok(targets);
    }
    let found = adapters();
    let wanted = args.adapter.clone().or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok());
    let chosen = found.iter().filter(|adapter| wanted.as_ref().is_none_or(|part| adapter.is_called(part)));
    let before = targets.len();
    targets.extend(chosen.map(|adapter| Target::Adapter(Box::new(adapter.clone()))));
    if targets.len() == before && (wanted.is_some() || args.backend == Some(Backend::Gpu)) {
        let found = found.into_iter().map(|adapter| adapter.name).collect();
        return Err(GpuError::NoAdapter { wanted, found }.into());
    }
    Ok(targets)
}

/// Every scene of the folder `scenes`.
fn all_scenes() -> Result<Vec<PathBuf>, CliError> {
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|end| end == "toml" || end == "obj");
    let files = Path::new("scenes").read_dir().into_iter().flatten().flatten();
    let mut scenes: Vec<_> = files.map(|entry| entry.path()).filter(is_scene).collect();
    scenes.sort();
    if scenes.is_empty() {
        return Err(
            CliError::usage("there is no folder scenes with scenes here").hint("name the scenes to measure")
        );
    }
    Ok(scenes)
}
