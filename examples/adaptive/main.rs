//! What adaptive antialiasing saves: rays at equal error, against uniform sampling.
//!
//! `cargo run --release --example adaptive` traces a scene on the CPU: once in f64 with 256 samples a pixel, which is
//! taken for the truth, then in f32 with growing numbers of samples for all pixels, then refined to a few thresholds. The
//! error is the root mean square over linear RGB clamped to [0, 1]; the rays that uniform sampling needs for the same
//! error are interpolated between the two measured pictures around it, as a power law. The table is Markdown; the exit
//! code is 1 where a threshold saves less than half of the rays, 2 where a scene cannot be traced.

mod curve;
#[path = "../shared/verdict.rs"]
mod verdict;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use snellius::cpu::CpuRenderer;
use snellius::film::{Difference, Frame, Picture, Renderer, Summary};
use snellius::flatten;
use snellius::layout::{FlatScene, Precision, Settings};
use snellius::scene::Scene;

use curve::{Point, rays_for};
use verdict::verdict;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Uniform rays per adaptive ray that every threshold must reach.
const REQUIRED: f64 = 2.0;

/// Compare adaptive antialiasing with uniform sampling at equal error
#[derive(Debug, Parser)]
struct Arguments {
    /// The scene
    #[arg(default_value = "scenes/ice.toml")]
    scene: PathBuf,
    /// Width and height in pixels
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values_t = [384, 216])]
    size: Vec<u32>,
    /// Samples of a pixel of the picture that is taken for the truth
    #[arg(long, default_value_t = 256)]
    reference: u32,
    /// Samples of a pixel in uniform pictures
    #[arg(long, value_delimiter = ',', default_values_t = [2, 4, 8, 16, 32, 64])]
    uniform: Vec<u32>,
    /// Thresholds of adaptive pictures
    #[arg(long, value_delimiter = ',', default_values_t = [0.02, 0.01])]
    thresholds: Vec<f32>,
    /// Most samples of a pixel in adaptive pictures
    #[arg(long, default_value_t = 64)]
    samples: u32,
}

fn main() -> ExitCode {
    verdict(run(&Arguments::parse()))
}

/// Print the table row by row; returns whether every threshold saves what it must.
fn run(arguments: &Arguments) -> Result<bool> {
    let stage = Stage::load(arguments)?;
    let truth = stage.trace(arguments.reference, None, Precision::F64)?;
    println!(
        "| sampling | samples a pixel | rays a pixel | RMSE | FLIP | uniform rays for that error | saved |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|");
    let mut curve = Vec::new();
    for &samples in &arguments.uniform {
        let shot = Shot::new(&stage.trace(samples, None, Precision::F32)?, &truth)?;
        println!("| uniform | {samples} | {:.1} | {:.5} | {:.4} | | |", shot.rays, shot.rmse, shot.flip);
        curve.push(Point { error: shot.rmse, rays: shot.rays });
    }
    let mut holds = true;
    for &threshold in &arguments.thresholds {
        let frame = stage.trace(arguments.samples, Some(threshold), Precision::F32)?;
        let shot = Shot::new(&frame, &truth)?;
        let uniform =
            rays_for(&curve, shot.rmse).ok_or("no uniform picture has that error: give more counts")?;
        let ratio = uniform / shot.rays;
        println!(
            "| adaptive {threshold}, at most {} | {:.2} | {:.1} | {:.5} | {:.4} | {uniform:.1} | {ratio:.2}× |",
            arguments.samples, shot.samples, shot.rays, shot.rmse, shot.flip
        );
        holds &= ratio >= REQUIRED;
    }
    let [width, height] = stage.size;
    println!("\n`{}` at {width}×{height}.", arguments.scene.display());
    Ok(holds)
}

/// The scene, ready to be traced.
struct Stage {
    scene: Scene,
    flat: FlatScene,
    size: [u32; 2],
}

impl Stage {
    fn load(arguments: &Arguments) -> Result<Self> {
        let scene = Scene::load(&arguments.scene)?;
        let flat = flatten::flatten(&scene)?.scene;
        let size = arguments.size.as_slice().try_into()?;
        Ok(Self { scene, flat, size })
    }

    fn trace(&self, samples: u32, adaptive: Option<f32>, precision: Precision) -> Result<Frame> {
        let render = &self.scene.render;
        let (depth, cutoff) = (render.depth, render.cutoff as f32);
        let settings = Settings { depth, cutoff, samples, adaptive, precision, ..Settings::default() };
        let view = flatten::view(&self.scene.camera, &self.flat, self.size, None, &settings);
        Ok(CpuRenderer::new(&self.flat, 0)?.render(&view, &settings, &())?)
    }
}

/// What a picture cost, and how far it is from the truth.
struct Shot {
    /// Samples a pixel, the mean.
    samples: f64,
    /// Rays a pixel, the mean.
    rays: f64,
    rmse: f64,
    flip: f64,
}

impl Shot {
    fn new(frame: &Frame, truth: &Frame) -> Result<Self> {
        let difference = Difference::between(&clamped(frame), &clamped(truth))?;
        Ok(Self {
            samples: Summary::of(frame).samples.mean,
            rays: frame.rays.total() as f64 / frame.texels.len() as f64,
            rmse: difference.rmse,
            flip: difference.flip.unwrap_or(f64::NAN),
        })
    }
}

/// Linear RGB cut to what a display shows.
fn clamped(frame: &Frame) -> Picture {
    let pixels: Vec<[f32; 3]> =
        frame.texels.iter().map(|texel| texel.radiance.map(|x| x.clamp(0.0, 1.0))).collect();
    Picture::from_rgb(frame.width, frame.height, &pixels)
}
