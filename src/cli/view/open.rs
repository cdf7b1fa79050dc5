//! `snellius view`: a window on a scene.

use std::fs;
use std::path::PathBuf;

use super::super::console::{Console, print_json};
use super::super::device::{Choice, DeviceArgs, pipeline_folder};
use super::super::prepare::Prepared;
use super::super::render::ArithmeticArgs;
use super::super::values::{Size, effect_choice, number_in, whole_in};
use super::super::{CliError, Outcome};
use crate::film::{Format, Output};
use crate::gpu::GpuOptions;
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{EffectChoice, Scan, Settings};
use crate::viewer::{
    Backend, Options, Screenshot, Script, ScriptError, Stage, parse_script, run as open_window,
};

/// Open a scene in a window
///
/// The mouse turns the scene; H lists the shortcuts. Few pixels are traced while something moves, all of them when it
/// rests, then sample by sample: the finished picture is that of `render`, bit for bit.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius scenes/ice.toml
  snellius view scenes/ice.toml --size 960x540 --backend cpu
  snellius view scenes/ice.toml --adapter lavapipe --screenshot window.png

The window needs a display and a Vulkan driver that can show pictures there, also with --backend cpu.")]
pub(in crate::cli) struct ViewArgs {
    /// The scene: .toml or .obj
    scene: PathBuf,
    /// Width and height of the picture beside the panel in pixels [default: the scene's, else 1280x720]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
    /// Deepest ray that is traced, 0 to 64 [default: the scene's, else 16]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, 0, MAX_DEPTH))]
    depth: Option<u32>,
    /// Least weight of a ray that is traced, 0 to 1 [default: the scene's, else 0.0001]
    #[arg(long, value_name = "W", value_parser = |text: &str| number_in(text, 0.0, 1.0))]
    cutoff: Option<f64>,
    /// Samples per pixel at rest, 1 to 65536 [default: the scene's, else 4]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, 1, 65536))]
    samples: Option<u32>,
    /// Give a pixel more samples only where they are worth it, 0 to 1: see `snellius help render`
    #[arg(long, value_name = "T", value_parser = |text: &str| number_in(text, 0.0, 1.0))]
    adaptive: Option<f64>,
    /// Effects to simulate: auto, all, none, or a list of names with commas
    #[arg(long, value_name = "LIST", default_value = "auto", value_parser = effect_choice)]
    effects: EffectChoice,
    /// Write the window, panel included, to a PNG file once its picture is complete, and quit
    #[arg(long, value_name = "PATH", help_heading = "Without a hand")]
    screenshot: Option<PathBuf>,
    /// Frames of the window to be shown before --screenshot
    #[arg(long, value_name = "N", default_value = "1", requires = "screenshot", help_heading = "Without a hand",
        value_parser = |text: &str| whole_in(text, 1, 100_000))]
    frames: u32,
    /// Trace by the shader files of this folder, and compile them again when they change: for work on shaders
    #[arg(long, value_name = "DIR")]
    shaders: Option<PathBuf>,
    /// Play events from a file, and print what the session took as JSON: docs/viewer.md lists the events
    #[arg(long, value_name = "FILE", conflicts_with = "screenshot", help_heading = "Without a hand")]
    script: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceArgs,
    #[command(flatten)]
    arithmetic: ArithmeticArgs,
}

pub(in crate::cli) fn run(args: ViewArgs, console: Console) -> Result<Outcome, CliError> {
    let screenshot = screenshot(args.screenshot, args.frames)?;
    let script = args.script.map(script).transpose()?;
    let threads = args.device.threads();
    let choice = args.device.choice()?;
    let Prepared { scene, flat, .. } = Prepared::new(&args.scene)?;
    scene.warnings.iter().chain(&flat.warnings).for_each(|warning| console.warn_of(warning));
    let settings = Settings {
        depth: args.depth.unwrap_or(scene.render.depth),
        cutoff: args.cutoff.unwrap_or(scene.render.cutoff) as f32,
        samples: args.samples.unwrap_or(scene.render.samples),
        adaptive: args.adaptive.or(scene.render.adaptive).map(|threshold| threshold as f32),
        precision: args.arithmetic.precision,
        float: args.arithmetic.float,
        intersector: args.arithmetic.intersector,
        aovs: false,
        effects: args.effects,
    };
    let (backend, adapter) = match choice.settle(settings.precision, console) {
        Choice::Gpu { adapter } => (Backend::Gpu, adapter),
        Choice::Cpu { threads } | Choice::Auto { threads } => (Backend::Cpu { threads }, None),
    };
    let size = args.size.map_or(scene.render.size, |size| size.0);
    let scan = Scan::of(&flat.scene);
    let timings = open_window(Options {
        stage: Stage { path: args.scene, scene, flat, scan },
        settings,
        backend,
        threads,
        gpu: GpuOptions { adapter, pipeline_cache: pipeline_folder() },
        shaders: args.shaders,
        size,
        screenshot,
        script,
    })?;
    timings.iter().try_for_each(print_json)?;
    Ok(Outcome::Done)
}

/// Read a script; its faults are told before a window opens.
fn script(path: PathBuf) -> Result<Script, CliError> {
    let text =
        fs::read_to_string(&path).map_err(|error| CliError::usage(format!("{}: {error}", path.display())))?;
    let events = parse_script(&text).map_err(|ScriptError { line, message }| {
        CliError::usage(format!("{}:{line}: {message}", path.display()))
            .hint("docs/viewer.md lists the events of scripts")
    })?;
    Ok(Script { path, events })
}

/// A window is written to PNG files.
fn screenshot(path: Option<PathBuf>, frames: u32) -> Result<Option<Screenshot>, CliError> {
    let Some(path) = path else { return Ok(None) };
    match Output::new(&path)? {
        output @ Output::File { .. } if output.format() == Format::Png => {
            Ok(Some(Screenshot { path, frames }))
        }
        output => Err(CliError::usage(format!("--screenshot {output}: a window is written to a .png file"))),
    }
}
