//! `snellius bench`: measured comparisons, each row with its proof.

mod devices;
mod effects;
mod machine;
mod rays;
mod scale;

use std::path::{Path, PathBuf};

use super::console::Console;
use super::values::{Size, whole_in};
use super::{CliError, Outcome};
use crate::bench::{Ratio, Target};
use crate::film::write_whole;
use crate::gpu::{GpuError, adapters};
use crate::layout::Backend;

/// Rounds where none are asked for and no budget decides.
const ROUNDS: u32 = 11;

/// Measure what tracing costs on this machine's devices
///
/// Each scene on the CPU, with one thread and with all, and on every adapter, all in turn after a warm-up: the trace alone,
/// the way from file to picture by its parts, and of how many pictures an adapter's start is won back. A device has figures
/// only where each of its pictures is the CPU's, bit for bit. What the size of the pictures and the rounds may take
/// follows from the budget, unless they are given. MESA_SHADER_CACHE_DISABLE=true in the environment makes cold compile
/// times of Mesa's drivers those of a first run.
///
/// With --effects: each scene traced with the effects that it calls for, and with all; then each effect switched on
/// alone in a scene that does not need it. Time is that of the trace alone.
///
/// With --rays: rays against one mesh, without shading, on the CPU and on every adapter: primary ones (P), mirrored (R) and scattered (D) off
/// what those hit, and shadow rays (S). A rate is printed only where every hit has the bits of the scalar kernel's.
///
/// With --scale: how the time of a trace grows with triangles, depth, lights, pixels, samples and threads, in scenes made
/// for that, as fitted powers; on all threads of the CPU and on graphics cards; on software adapters where they are named.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius bench
  snellius bench scenes/ice.toml --svg ice.svg
  snellius bench --json > before.json
  snellius bench --baseline before.json --fail-above 5%
  snellius bench --scale --svg scale.svg
  snellius bench --effects scenes/opaque.toml --adapter llvmpipe --rounds 25
  snellius bench --rays bunny.obj --eye 0,1,3 --target 0,0.5,0 --fov 40 --dump rays
  snellius bench --rays bunny.obj --ray-file rays/bunny.S.rays --any --json

Exit code: 0, or 1 if two sides traced different pictures or hits, if a trace takes longer than --fail-above
allows, or if time grows faster with triangles than their fourth root.")]
pub(super) struct BenchArgs {
    /// Scenes [default: all of the folder scenes]
    #[arg(conflicts_with_all = ["mesh", "scale"])]
    scenes: Vec<PathBuf>,
    /// Compare the effects that scenes call for with all effects, and with each other one alone
    #[arg(long, conflicts_with_all = ["mesh", "scale"])]
    effects: bool,
    #[command(flatten)]
    devices: devices::DeviceBenchArgs,
    #[command(flatten)]
    scale: scale::ScaleArgs,
    #[command(flatten)]
    rays: rays::RayArgs,
    /// Width and height of the pictures in pixels [default: by the budget; with --effects 320x240]
    #[arg(long, value_name = "WxH", conflicts_with_all = ["mesh", "scale"])]
    size: Option<Size>,
    /// Rounds in which all sides are traced, 6 to 1000 [default: by the budget; with --effects and --rays 11]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, Ratio::LEAST_ROUNDS as u32, 1000))]
    rounds: Option<u32>,
    /// Draw the figures into this file
    #[arg(long, value_name = "FILE", conflicts_with_all = ["mesh", "effects"])]
    svg: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Only the CPU, or only Vulkan adapters (beside all threads of the CPU, which judge them)
    #[arg(long, value_name = "DEVICE", help_heading = "Device")]
    backend: Option<Backend>,
    /// Only adapters of which this is part of the name, as `snellius devices` lists them
    #[arg(long, value_name = "NAME", help_heading = "Device")]
    adapter: Option<String>,
}

impl BenchArgs {
    /// Rounds where no budget decides.
    fn rounds_or_default(&self) -> u32 {
        self.rounds.unwrap_or(ROUNDS)
    }
}

pub(super) fn run(args: &BenchArgs, console: Console) -> Result<Outcome, CliError> {
    match &args.rays.mesh {
        Some(mesh) => rays::run(mesh, args, console),
        None if args.effects => effects::run(args, console),
        None if args.scale.scale => scale::run(args, console),
        None => devices::run(args, console),
    }
}

/// Each adapter that the flags leave.
fn adapters_of(args: &BenchArgs) -> Result<Vec<Target>, CliError> {
    if args.backend == Some(Backend::Cpu) {
        return Ok(Vec::new());
    }
    let found = adapters();
    let wanted = args.adapter.clone().or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok());
    let chosen = found.iter().filter(|adapter| wanted.as_ref().is_none_or(|part| adapter.is_called(part)));
    let targets: Vec<_> = chosen.map(|adapter| Target::Adapter(Box::new(adapter.clone()))).collect();
    if targets.is_empty() && (wanted.is_some() || args.backend == Some(Backend::Gpu)) {
        let found = found.into_iter().map(|adapter| adapter.name).collect();
        return Err(GpuError::NoAdapter { wanted, found }.into());
    }
    Ok(targets)
}

/// The scenes that are named, or every scene of the folder `scenes`.
fn scenes_of(args: &BenchArgs) -> Result<Vec<PathBuf>, CliError> {
    if !args.scenes.is_empty() {
        return Ok(args.scenes.clone());
    }
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

/// Write a drawing, if one is asked for.
fn draw(args: &BenchArgs, console: Console, svg: impl FnOnce() -> String) -> Result<(), CliError> {
    if let Some(path) = &args.svg {
        write_whole(path, svg().as_bytes())
            .map_err(|error| CliError::usage(format!("cannot write {}: {error}", path.display())))?;
        console.detail(path.display());
    }
    Ok(())
}

/// Colours of devices in drawings, the first first.
fn color_of(index: usize) -> &'static str {
    use crate::plot::{BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILLION};
    let colors = [BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY, BLACK];
    colors[index % colors.len()]
}

/// A device's name without what its driver adds in brackets; software stays marked.
fn short_name(device: &str) -> String {
    const SOFTWARE: &str = " (software)";
    let name = device.split(" (").next().unwrap_or(device);
    if device.ends_with(SOFTWARE) { format!("{name}{SOFTWARE}") } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_names_keep_the_mark_of_software() {
        assert_eq!(short_name("llvmpipe (LLVM 15.0.6, 256 bits) (software)"), "llvmpipe (software)");
        assert_eq!(short_name("AMD Radeon RX 6800 (RADV NAVI21)"), "AMD Radeon RX 6800");
        assert_eq!(short_name("CPU, all threads"), "CPU, all threads");
    }
}
