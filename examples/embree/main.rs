//! Snellius beside Embree: the same rays through the same mesh in one process, in turn, on the same threads; and the build.
//!
//! `cargo run --release --example embree -- MESH.obj [MESH.obj …]` loads Embree 3 as it runs (Debian: libembree3-3). The rays
//! are those of `snellius bench --rays`, or of `--rays DIR`, a folder of MESH.{P,R,D,S}.rays. Embree is robust, of medium
//! quality, and traces one by one as well as in packets of eight; what Snellius traces has the bits of its scalar kernel, which
//! `snellius bench --rays` holds. The exit code is 1 if rays hit in one engine alone, but for [`ALONE`], if Snellius is slower
//! in what the two promise each other (single rays; P and S as streams), or if a build takes too long.

mod engine;
mod functions;
#[path = "../shared/verdict.rs"]
mod verdict;

use std::convert::Infallible;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use rayon::ThreadPool;
use snellius::bench::rays::{
    Mode, Pinhole, Query, RayAnswer, RayHost, RayRecord, RaySets, RayStage, SIDE, Trees, read_rays,
};
use snellius::bench::{Ratio, median, take_turns};
use snellius::bvh::Preset;
use snellius::cpu::{Cast, thread_pool};
use snellius::layout::Triangle;
use snellius::scene;

use crate::engine::{Embree, Scene};
use crate::verdict::verdict;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Of so many rays one may pass through an edge so narrowly that the engines' arithmetic decides.
const ALONE: usize = 100_000;

/// Compare rays and builds with Embree
#[derive(Debug, Parser)]
struct Arguments {
    /// Meshes of triangles
    #[arg(required = true)]
    meshes: Vec<PathBuf>,
    /// Folder of MESH.{P,R,D,S}.rays
    #[arg(long, value_name = "DIR")]
    rays: Option<PathBuf>,
    /// Embree 3
    #[arg(long, default_value = "libembree3.so.3")]
    library: String,
    /// Times that both engines are measured in turn
    #[arg(long, default_value_t = 7)]
    rounds: usize,
    /// Triangles that are built, the first of each mesh
    #[arg(long, default_value_t = 871_000)]
    first: usize,
    /// Snellius is to trace so many times as fast
    #[arg(long, default_value_t = 1.0)]
    least: f64,
    /// Its fast build may take so many times as long
    #[arg(long, default_value_t = 1.5)]
    most: f64,
}

fn main() -> ExitCode {
    verdict(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<bool> {
    let embree = Embree::load(&arguments.library)?;
    let pools = [thread_pool(1)?, thread_pool(0)?];
    println!("Embree {}, robust, medium quality; medians of {} rounds\n", embree.version(), arguments.rounds);
    let meshes: Vec<Mesh> = arguments.meshes.iter().map(|path| Mesh::load(path)).collect::<Result<_>>()?;
    let rays = trace_all(arguments, &embree, &meshes, &pools)?;
    let builds = build_all(arguments, &embree, &meshes, &pools[1])?;
    Ok(rays && builds)
}

/// Print the rays' table; tells whether all is as promised.
fn trace_all(
    arguments: &Arguments,
    embree: &Embree,
    meshes: &[Mesh],
    pools: &[ThreadPool; 2],
) -> Result<bool> {
    let threads = pools[1].current_num_threads();
    println!(
        "| mesh | rays | of them | mode | Snellius, Mrays/s | Embree, Mrays/s | ratio (95 %) | hits | Embree's | {threads} threads ÷ 1 | Embree's |"
    );
    println!("|---|---|--:|---|--:|--:|--:|--:|--:|--:|--:|");
    let mut holds = true;
    for (path, mesh) in arguments.meshes.iter().zip(meshes) {
        let stage = RayStage::load(path, Preset::Best, Pinhole::default())?;
        let (theirs, _) = Scene::build(embree, &mesh.points, &mesh.triangles)?;
        for (letter, rays, query) in sets(arguments.rays.as_deref(), mesh, &stage)?.by_letter() {
            for mode in [Mode::Single, Mode::Coherent] {
                let duel = Duel { stage: &stage, theirs: &theirs, pools, rays, query, mode };
                let outcome = duel.run(arguments.rounds)?;
                println!("| {} | {letter} {}", mesh.name, outcome.row(rays.len(), mode));
                let promised = mode == Mode::Single || matches!(letter, "P" | "S");
                holds &= outcome.alone <= rays.len() / ALONE;
                holds &= !promised || outcome.ratio.median >= arguments.least;
            }
        }
    }
    Ok(holds)
}

/// Print the builds' table; tells whether all is as promised.
fn build_all(arguments: &Arguments, embree: &Embree, meshes: &[Mesh], pool: &ThreadPool) -> Result<bool> {
    println!("\n| mesh | triangles | Embree, ms | fast, ms | of Embree's | best, ms | of Embree's |");
    println!("|---|--:|--:|--:|--:|--:|--:|");
    let mut holds = true;
    for mesh in meshes {
        let faces = &mesh.triangles[..arguments.first.min(mesh.triangles.len())];
        let times = builds(embree, &mesh.points, faces, pool, arguments.rounds)?;
        let [theirs, fast, best] = [0, 1, 2].map(|side: usize| median(&times[side]).as_secs_f64() * 1e3);
        let [fast_ratio, best_ratio] = [1, 2].map(|side: usize| Ratio::of(&times[side], &times[0]).median);
        let (name, of) = (&mesh.name, faces.len());
        println!(
            "| {name} | {of} | {theirs:.0} | {fast:.0} | {fast_ratio:.2} | {best:.0} | {best_ratio:.2} |"
        );
        holds &= fast_ratio <= arguments.most;
    }
    Ok(holds)
}

/// A mesh as its file has it.
struct Mesh {
    name: String,
    points: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    fn load(path: &Path) -> Result<Self> {
        let scene = scene::Scene::load(path)?;
        let [model] = &*scene.models else {
            return Err(format!("{}: one model is needed", path.display()).into());
        };
        Ok(Self {
            name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            points: model.mesh.positions.iter().map(|point| point.as_vec3().to_array()).collect(),
            triangles: model.mesh.triangles.iter().map(|triangle| triangle.positions).collect(),
        })
    }
}

/// The rays of a folder, or those of the mesh's own view.
fn sets(folder: Option<&Path>, mesh: &Mesh, stage: &RayStage) -> Result<RaySets> {
    let Some(folder) = folder else { return Ok(RaySets::of(stage, SIDE)) };
    let read = |letter: &str| read_rays(&folder.join(format!("{}.{letter}.rays", mesh.name)));
    Ok(RaySets { primary: read("P")?, reflected: read("R")?, diffuse: read("D")?, shadow: read("S")? })
}

/// A set of rays for both engines, on the same threads: one, and all.
struct Duel<'a> {
    stage: &'a RayStage,
    theirs: &'a Scene<'a>,
    pools: &'a [ThreadPool; 2],
    rays: &'a [RayRecord],
    query: Query,
    mode: Mode,
}

/// What came of it, of Snellius and of Embree.
struct Outcome {
    /// With one thread.
    times: [Duration; 2],
    /// Of Embree's time to ours, with one thread.
    ratio: Ratio,
    hits: [usize; 2],
    /// Rays that hit in one engine alone.
    alone: usize,
    /// Of the time with one thread to that with all.
    scaling: [Ratio; 2],
}

impl Duel<'_> {
    fn run(&self, rounds: usize) -> Result<Outcome> {
        let Self { stage, theirs, pools, rays, query, mode } = *self;
        let casts: Vec<Cast> = rays.iter().map(Cast::from).collect();
        let host = |pool| RayHost::new(stage.world(), stage.tree(), &casts, query, mode, pool);
        let mut hosts = pools.each_ref().map(host);
        let mut found = vec![RayAnswer::MISS; rays.len()];
        let times = take_turns(rounds.max(1), 4, |side| {
            Ok::<_, Infallible>(match side {
                0 | 1 => hosts[side].trace(),
                _ => theirs.trace(rays, query, mode, &pools[side - 2], &mut found),
            })
        })?;
        let ours = hosts[0].answers();
        let hits = [ours, &found].map(|answers| answers.iter().filter(|answer| answer.is_hit()).count());
        Ok(Outcome {
            times: [median(&times[0]), median(&times[2])],
            ratio: Ratio::of(&times[2], &times[0]),
            hits,
            alone: ours.iter().zip(&found).filter(|(ours, theirs)| ours.is_hit() != theirs.is_hit()).count(),
            scaling: [Ratio::of(&times[0], &times[1]), Ratio::of(&times[2], &times[3])],
        })
    }
}

impl Outcome {
    /// The end of a row.
    fn row(&self, rays: usize, mode: Mode) -> String {
        let mode = if mode == Mode::Single { "single" } else { "stream, packets" };
        let [ours, theirs] = self.times.map(|time| rays as f64 / time.as_secs_f64() / 1e6);
        let Ratio { median, low, high } = self.ratio;
        let [hits, found] = self.hits;
        let [scaling, other] = self.scaling.map(|ratio| ratio.median);
        format!(
            "| {rays} | {mode} | {ours:.2} | {theirs:.2} | {median:.2} ({low:.2}–{high:.2}) | {hits} | {found} | {scaling:.2} | {other:.2} |"
        )
    }
}

/// Times of Embree's build, and of the fast and the best one, encoding and collapsing included, in turn with all threads.
fn builds(
    embree: &Embree,
    points: &[[f32; 3]],
    faces: &[[u32; 3]],
    pool: &ThreadPool,
    rounds: usize,
) -> Result<Vec<Vec<Duration>>> {
    let triangle = |(face, id): (&[u32; 3], u32)| {
        let [v0, v1, v2] = face.map(|corner| points[corner as usize]);
        Triangle { v0, id, v1, reserved1: 0, v2, reserved2: 0 }
    };
    let triangles: Vec<Triangle> = faces.iter().zip(0..).map(triangle).collect();
    take_turns(rounds.max(1), 3, |side| match side {
        0 => Ok(Scene::build(embree, points, faces)?.1),
        1 => Ok(pool.install(|| Trees::build(&triangles, Preset::Fast))?.time),
        _ => Ok(pool.install(|| Trees::build(&triangles, Preset::Best))?.time),
    })
}
