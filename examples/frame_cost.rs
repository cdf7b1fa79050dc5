//! What a picture costs on top of its rays: the time of a frame against that which its rays would take without shading.
//!
//! `cargo run --release --example frame_cost` renders a scene at one sample on all threads of the CPU and, in turn, traces the
//! sets of rays that `snellius bench --rays` makes for the scene's camera: P, R and S. The *ceiling* is the sum over the
//! kinds of the frame's rays, each at the raw rate of its set: primary rays at P's, reflected and refracted ones at R's, shadow
//! rays at S's. The exit code is 1 if the frame takes more than `--most` times as long.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use snellius::bench::rays::{Pinhole, RaySets, RayStage, SIDE, measure};
use snellius::bvh::Preset;
use snellius::cpu::CpuRenderer;
use snellius::film::{RayCounts, Renderer};
use snellius::flatten::{flatten, view};
use snellius::layout::Settings;
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
    /// Times that both are measured in turn
    #[arg(long, default_value_t = 5)]
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

/// Millions of rays a second of P, R and S, by all threads.
type Rates = [f64; 3];

fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let scene = Scene::load(&arguments.scene)?;
    let flat = flatten(&scene)?.scene;
    let settings = Settings {
        depth: arguments.depth,
        cutoff: scene.render.cutoff as f32,
        samples: 1,
        ..Settings::default()
    };
    let view = view(&scene.camera, &flat, [arguments.width, arguments.height], None, &settings);
    let mut renderer = CpuRenderer::new(&flat, 0)?;
    let stage = RayStage::load(&arguments.scene, Preset::Best, Pinhole::default())?;
    let sets = RaySets::of(&stage, SIDE);
    let warm_up = renderer.render(&view, &settings, &())?;
    let rays = warm_up.rays;
    let (mut frames, mut ceilings, mut ratios, mut rates) = (vec![], vec![], vec![], vec![]);
    for _ in 0..arguments.rounds.max(1) {
        let frame = renderer.render(&view, &settings, &())?.times.trace.as_secs_f64() * 1e3;
        let raw = raw_rates(&stage, &sets)?;
        let ceiling = ceiling(&rays, raw);
        frames.push(frame);
        ceilings.push(ceiling);
        ratios.push(frame / ceiling);
        rates.push(raw);
    }
    let [p, r, s] = std::array::from_fn(|set| median(rates.iter().map(|rates| rates[set]).collect()));
    println!("| | |\n|---|--:|");
    println!(
        "| rays: primary, reflected and refracted, shadow | {}, {}, {} |",
        rays.primary,
        rays.reflection + rays.refraction,
        rays.shadow
    );
    println!("| raw rates P, R, S in Mrays/s, {} threads | {p:.2}, {r:.2}, {s:.2} |", renderer.threads());
    println!("| the rays alone | {:.0} ms |", median(ceilings));
    println!("| the frame | {:.0} ms |", median(frames));
    let ratio = median(ratios);
    println!("| ratio, median of {} | {ratio:.2} (≤ {}) |", arguments.rounds.max(1), arguments.most);
    Ok(ratio <= arguments.most)
}

/// The better of single rays and streams.
fn raw_rates(stage: &RayStage, sets: &RaySets) -> Result<Rates, Box<dyn Error>> {
    let mut rates = [0.0; 3];
    for (letter, rays, query) in sets.by_letter() {
        let Some(set) = ["P", "R", "S"].iter().position(|set| *set == letter) else { continue };
        let measured = measure(stage, &mut [], letter, rays, query, 1)?;
        if let Some(fault) = measured.faults.first() {
            return Err(fault.clone().into());
        }
        rates[set] = measured.runs.iter().map(|run| run.mrays_per_s).fold(0.0, f64::max);
    }
    Ok(rates)
}

/// What the rays alone would take, in milliseconds.
fn ceiling(rays: &RayCounts, [p, r, s]: Rates) -> f64 {
    (rays.primary as f64 / p + (rays.reflection + rays.refraction) as f64 / r + rays.shadow as f64 / s) / 1e3
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
