//! What a picture costs on top of its rays: the time of a frame against that of its own rays, traced again without shading.
//!
//! `cargo run --release --example frame_cost` notes every ray that the kernel sends through the tree in a frame of one
//! sample: primary ones (P), reflected and refracted ones (R), and shadow rays (S), of which one that crosses ice is several.
//! Then the frame and the sets are traced in turn, each on all threads of the CPU, ray by ray. The *ceiling* is the sum over the
//! sets of their rays at their own raw rate. The exit code is 1 if the frame takes more than `--most` times as long.

use std::error::Error;
use std::hint::black_box;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::Parser;
use rayon::prelude::*;
use snellius::bench::{Ratio, median, take_turns};
use snellius::cpu::{CpuRenderer, WideBvh, morton_order, thread_pool};
use snellius::film::Renderer;
use snellius::flatten::{flatten, view};
use snellius::kernel::bvh::{Hit, Ray, far, intersect, make_ray};
use snellius::kernel::whitted::trace_pixel;
use snellius::kernel::{Real, Simulation, Vec3, World};
use snellius::layout::{Aov, Effect, EffectSet, Effects, FlatScene, Intersector, Settings, Texel, View};
use snellius::scene::Scene;

/// Rays that a thread takes at a time.
const CHUNK: usize = 4096;

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
    let sets = Sets::of(&flat, &view, effects);
    let pool = thread_pool(0)?;
    let mut renderer = CpuRenderer::new(&flat, 0)?;
    let replay = |rays: &[Cast]| pool.install(|| trace(&flat, &view, &tree, rays));
    let times =
        take_turns(arguments.rounds.max(1), 1 + sets.all().len(), |side| match side.checked_sub(1) {
            None => renderer.render(&view, &settings, &()).map(|frame| frame.times.trace),
            Some(set) => Ok(replay(sets.all()[set].1)),
        })?;
    let (frames, of_sets) = (&times[0], &times[1..]);
    let alone: Vec<Duration> =
        (0..frames.len()).map(|round| of_sets.iter().map(|times| times[round]).sum()).collect();
    let ratio = Ratio::of(frames, &alone).median;
    println!("| {}, {} threads | rays | ms | Mrays/s |", arguments.scene.display(), renderer.threads());
    println!("|---|--:|--:|--:|");
    let in_ms = |times: &[Duration]| median(times).as_secs_f64() * 1e3;
    for (times, (name, rays)) in of_sets.iter().zip(sets.all()) {
        let ms = in_ms(times);
        println!("| {name} | {} | {ms:.0} | {:.2} |", rays.len(), rays.len() as f64 / ms / 1e3);
    }
    let whole: usize = sets.all().iter().map(|(_, rays)| rays.len()).sum();
    println!("| the frame | {whole} | {:.0} | |", in_ms(frames));
    println!("\nratio, median of {}: {ratio:.2} (≤ {})", frames.len(), arguments.most);
    Ok(ratio <= arguments.most)
}

/// A ray as the kernel asks for it.
#[derive(Debug, Clone, Copy)]
struct Cast {
    origin: [f32; 3],
    direction: [f32; 3],
    limit: f32,
    origin_face: u32,
    any: bool,
}

/// Time the rays, one by one.
fn trace(scene: &FlatScene, view: &View, tree: &WideBvh, rays: &[Cast]) -> Duration {
    let world = World { scene, view, intersector: Intersector::Watertight, effects: EffectSet::NONE };
    let started = Instant::now();
    rays.par_chunks(CHUNK).for_each(|rays| {
        for cast in rays {
            let (origin, direction) = (Vec3::load(cast.origin), Vec3::load(cast.direction));
            let ray = make_ray(&world, origin, direction, cast.origin_face);
            if cast.any {
                black_box(tree.occluded(&ray, cast.limit));
            } else {
                black_box(tree.intersect(&ray, cast.limit));
            }
        }
    });
    started.elapsed()
}

/// The rays of a frame by kind, in the order of its tiles.
#[derive(Debug, Default)]
struct Sets {
    primary: Vec<Cast>,
    bounced: Vec<Cast>,
    shadow: Vec<Cast>,
}

impl Sets {
    fn of(scene: &FlatScene, view: &View, effects: EffectSet) -> Self {
        let log = Mutex::new(Self::default());
        let world = World {
            scene,
            view,
            intersector: Intersector::Watertight,
            effects: Noting { effects, log: &log },
        };
        let mut stack = Vec::new();
        for [column, row] in morton_order(view.width, view.height) {
            let (mut texel, mut aov) = (Texel::default(), Aov::default());
            trace_pixel::<f32>(&world, &mut stack, [column, row], 0..1, &mut texel, &mut aov, None);
        }
        log.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    fn all(&self) -> [(&'static str, &[Cast]); 3] {
        [
            ("P: primary", &self.primary),
            ("R: reflected and refracted", &self.bounced),
            ("S: to lights", &self.shadow),
        ]
    }
}

/// Simulates a frame and notes its rays.
#[derive(Clone, Copy)]
struct Noting<'a> {
    effects: EffectSet,
    log: &'a Mutex<Sets>,
}

impl Noting<'_> {
    fn note<R: Real>(self, view: &View, ray: &Ray<R>, limit: R, any: bool) {
        let three = |v: Vec3<R>| [v.x.to_f32(), v.y.to_f32(), v.z.to_f32()];
        let limit = limit.to_f32();
        let origin = three(ray.origin);
        let cast = Cast { origin, direction: three(ray.direction), limit, origin_face: ray.origin_face, any };
        let mut log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        if limit < far::<f32>() {
            log.shadow.push(cast);
        } else if origin == view.eye {
            log.primary.push(cast);
        } else {
            log.bounced.push(cast);
        }
    }
}

impl Simulation for Noting<'_> {
    fn simulates(self, effect: Effect) -> bool {
        self.effects.has(effect)
    }

    fn intersect<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> Hit<R> {
        self.note(world.view, ray, limit, false);
        intersect(world, ray, limit)
    }

    fn occluded<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> bool {
        self.note(world.view, ray, limit, true);
        snellius::kernel::bvh::occluded(world, ray, limit)
    }
}
