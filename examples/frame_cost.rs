//! What a picture costs on top of its rays: the time of a frame against that of its own rays, traced again without shading.
//!
//! `cargo run --release --example frame_cost` notes every ray that the kernel sends through the tree in a frame of one sample,
//! by kind. Then the frame and the kinds are traced in turn, each on all threads of the CPU, ray by ray. The *ceiling* is the
//! sum over the kinds of their rays at their own raw rate. The exit code is 1 if the frame takes more than `--most` times as
//! long.

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
use snellius::layout::{EffectSet, Effects, Intersector, Settings};
use snellius::scene::Scene;

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
    #[arg(long, default_value_t = 720)]
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
    match run(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let scene = Scene::load(&arguments.scene)?;
    let flat = flatten(&scene)?.scene;
    let cutoff = scene.render.cutoff as f32;
    let settings = Settings { depth: arguments.depth, cutoff, samples: 1, ..Settings::default() };
    let view = view(&scene.camera, &flat, [arguments.width, arguments.height], None, &settings);
    let tree = WideBvh::new(&flat.nodes, &flat.triangles);
    let effects = Effects::of(&flat, &settings).plan(&settings).effects;
    let noted = FrameRays::of(&flat, &view, effects);
    let kinds: Vec<_> = noted.by_kind().into_iter().filter(|(_, rays, _)| !rays.is_empty()).collect();
    let pool = thread_pool(0)?;
    let world =
        World { scene: &flat, view: &view, intersector: Intersector::Watertight, effects: EffectSet::NONE };
    let host = |&(_, rays, query): &_| RayHost::new(world, &tree, rays, query, Mode::Single, &pool);
    let mut hosts: Vec<RayHost<'_>> = kinds.iter().map(host).collect();
    let mut renderer = CpuRenderer::new(&flat, 0)?;
    let times = take_turns(arguments.rounds.max(1), 1 + kinds.len(), |side| match side.checked_sub(1) {
        None => renderer.render(&view, &settings, &()).map(|frame| frame.times.trace),
        Some(kind) => Ok(hosts[kind].trace()),
    })?;
    let (frames, of_kinds) = (&times[0], &times[1..]);
    let alone: Vec<Duration> =
        (0..frames.len()).map(|round| of_kinds.iter().map(|times| times[round]).sum()).collect();
    let ratio = Ratio::of(frames, &alone).median;
    println!("| {}, {} threads | rays | ms | Mrays/s |", arguments.scene.display(), renderer.threads());
    println!("|---|--:|--:|--:|");
    let in_ms = |times: &[Duration]| median(times).as_secs_f64() * 1e3;
    for (times, (name, rays, _)) in of_kinds.iter().zip(&kinds) {
        let ms = in_ms(times);
        println!("| {name} | {} | {ms:.0} | {:.2} |", rays.len(), rays.len() as f64 / ms / 1e3);
    }
    let whole: usize = kinds.iter().map(|(_, rays, _)| rays.len()).sum();
    println!("| the frame | {whole} | {:.0} | |", in_ms(frames));
    println!("\nratio, median of {}: {ratio:.2} (≤ {})", frames.len(), arguments.most);
    Ok(ratio <= arguments.most)
}
