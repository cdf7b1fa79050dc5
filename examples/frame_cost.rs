//! What a picture costs on top of its rays: the time of a frame against that of its own rays, traced again without shading.
//!
//! `cargo run --release --example frame_cost` notes every ray that the kernel sends through the tree in a frame of one sample,
//! by kind. Then frame and kinds are traced in turn, band by band of the picture, on all threads of the CPU, ray by ray. The
//! *ceiling* is the sum over the kinds of their rays at their own raw rate. The exit code is 1 if the frame takes more than
//! `--most` times as long.

#[path = "shared/verdict.rs"]
mod verdict;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use snellius::bench::rays::{FrameRays, Mode, RayHost};
use snellius::bench::{Ratio, median, take_turns};
use snellius::cpu::{CpuRenderer, WideBvh, thread_pool};
use snellius::film::Renderer;
use snellius::flatten::{flatten, view};
use snellius::kernel::World;
use snellius::layout::{EffectSet, Effects, Intersector, Settings, View};
use snellius::scene::Scene;

use crate::verdict::verdict;

/// Rows that are traced at a time: half a second, in which the machine hardly changes, and few ends at which a thread waits.
const BAND: u32 = 144;

/// Kinds of rays.
const KINDS: usize = 4;

/// Compare the time of a frame with that of its rays alone
#[derive(Debug, Parser)]
struct Arguments {
    /// The scene
    #[arg(default_value = "scenes/ice.toml")]
    scene: PathBuf,
    /// Width of the picture in pixels
    #[arg(long, default_value_t = 1280)]
    width: u32,
    /// Its height
    #[arg(long, default_value_t = 720, value_parser = clap::value_parser!(u32).range(1..))]
    height: u32,
    /// Depth of the ray tree
    #[arg(long, default_value_t = 16)]
    depth: u32,
    /// Times that frame and rays are traced in turn
    #[arg(long, default_value_t = 7)]
    rounds: usize,
    /// The frame may take so many times as long as its rays alone
    #[arg(long, default_value_t = 1.6)]
    most: f64,
}

fn main() -> ExitCode {
    verdict(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let Arguments { width, height, depth, .. } = *arguments;
    let scene = Scene::load(&arguments.scene)?;
    let flat = flatten(&scene)?.scene;
    let cutoff = scene.render.cutoff as f32;
    let settings = Settings { depth, cutoff, samples: 1, ..Settings::default() };
    let effects = Effects::of(&flat, &settings).plan(&settings).effects;
    let tree = WideBvh::new(&flat.nodes, &flat.triangles);
    let band = |top: u32| {
        let crop = [0, top, width, BAND.min(height - top)];
        let view = view(&scene.camera, &flat, [width, height], Some(crop), &settings);
        let rays = FrameRays::of(&flat, &view, effects);
        (view, rays)
    };
    let bands: Vec<(View, FrameRays)> = (0..height).step_by(BAND as usize).map(band).collect();
    let pool = thread_pool(0)?;
    let mut renderer = CpuRenderer::new(&flat, 0)?;
    let mut sides = Vec::new();
    for (view, rays) in &bands {
        let world =
            World { scene: &flat, view, intersector: Intersector::Watertight, effects: EffectSet::NONE };
        sides.push(Side::Frame(view));
        sides.extend(rays.by_kind().map(|(_, rays, query)| {
            Side::Rays(RayHost::new(world, &tree, rays, query, Mode::Single, &pool))
        }));
    }
    let times = take_turns(arguments.rounds.max(1), sides.len(), |side| match &mut sides[side] {
        Side::Frame(view) => renderer.render(view, &settings, &()).map(|frame| frame.times.trace),
        Side::Rays(host) => Ok(host.trace()),
    })?;
    // Of all bands: the frame, then its kinds.
    let part = |part: usize| of_all_bands(&times, part);
    let frames = part(0);
    let alone: Vec<Duration> =
        (0..frames.len()).map(|round| (1..=KINDS).map(|kind| part(kind)[round]).sum()).collect();
    let in_ms = |times: &[Duration]| median(times).as_secs_f64() * 1e3;
    println!("| {}, {} threads | rays | ms | Mrays/s |", arguments.scene.display(), renderer.threads());
    println!("|---|--:|--:|--:|");
    let mut whole = 0;
    for kind in 0..KINDS {
        let count: usize = bands.iter().map(|(_, rays)| rays.by_kind()[kind].1.len()).sum();
        let (name, ms) = (bands[0].1.by_kind()[kind].0, in_ms(&part(1 + kind)));
        if count > 0 {
            println!("| {name} | {count} | {ms:.0} | {:.2} |", count as f64 / ms / 1e3);
        }
        whole += count;
    }
    println!("| the frame | {whole} | {:.0} | |", in_ms(&frames));
    let Ratio { median: ratio, low, high } = Ratio::of(&frames, &alone);
    println!("\nratio, median of {}: {ratio:.2} ({low:.2}–{high:.2}; ≤ {})", frames.len(), arguments.most);
    Ok(ratio <= arguments.most)
}

/// What is traced in turn.
enum Side<'a> {
    Frame(&'a View),
    Rays(RayHost<'a>),
}

/// The times of a part of each band, summed round by round.
fn of_all_bands(times: &[Vec<Duration>], part: usize) -> Vec<Duration> {
    let parts: Vec<_> = times.iter().skip(part).step_by(1 + KINDS).collect();
    (0..parts[0].len()).map(|round| parts.iter().map(|times| times[round]).sum()).collect()
}
