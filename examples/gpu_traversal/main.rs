//! What the adapters' traversal gains over the plain one: two children a node in 64 bytes, while-while, with the same
//! watertight test over the same binary tree.
//!
//! `cargo run --release --example gpu_traversal -- [SCENE …]` notes the rays of a frame of each scene, and traces them both ways on
//! one adapter, in turn, after every answer of both was compared; it prints Markdown. The exit code is 1 if two answers differ
//! in a bit, or the rays of a frame are traced less than `--least` times as fast.

#[path = "../shared/verdict.rs"]
mod verdict;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use snellius::bench::rays::{FrameRays, RayAdapter};
use snellius::bench::{Ratio, median, take_turns};
use snellius::bvh::pack;
use snellius::flatten::{flatten, view};
use snellius::gpu::{AdapterReport, SOURCES, Source, adapters, sources_in};
use snellius::layout::{Effects, FlatScene, Node, Settings, View};
use snellius::scene::Scene;

use crate::verdict::verdict;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Compare the kept traversal with the plain one
#[derive(Debug, Parser)]
struct Arguments {
    /// Scenes
    #[arg(default_value = "scenes/ice.toml")]
    scenes: Vec<PathBuf>,
    /// Part of the adapter's name
    #[arg(long, default_value = "llvmpipe")]
    adapter: String,
    /// Width of the pictures in pixels
    #[arg(long, default_value_t = 320)]
    width: u32,
    /// Their height
    #[arg(long, default_value_t = 180)]
    height: u32,
    /// Depth of the ray tree
    #[arg(long, default_value_t = 16)]
    depth: u32,
    /// Times that both ways are measured in turn
    #[arg(long, default_value_t = 7, value_parser = clap::value_parser!(u16).range(1..))]
    rounds: u16,
    /// Compare with the shader files of this folder, not with the plain way: for work on them
    #[arg(long, value_name = "FOLDER")]
    against: Option<PathBuf>,
    /// The kept way is to be so many times as fast
    #[arg(long, default_value_t = 1.5)]
    least: f64,
}

fn main() -> ExitCode {
    verdict(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<bool> {
    let found = adapters().into_iter().find(|adapter| adapter.is_called(&arguments.adapter));
    let adapter = found.ok_or_else(|| format!("there is no adapter called {}", arguments.adapter))?;
    let rounds = usize::from(arguments.rounds);
    println!("{}, {}\n", adapter.name, adapter.driver_info);
    let other = if arguments.against.is_some() { "other" } else { "plain" };
    println!("| scene | rays | of them | {other}, Mrays/s | kept, Mrays/s | ratio (95 %) |");
    println!("|---|---|--:|--:|--:|--:|");
    let mut holds = true;
    for path in &arguments.scenes {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let scene = Scene::load(path)?;
        let flat = flatten(&scene)?.scene;
        let cutoff = scene.render.cutoff as f32;
        let settings = Settings { depth: arguments.depth, cutoff, samples: 1, ..Settings::default() };
        let view = view(&scene.camera, &flat, [arguments.width, arguments.height], None, &settings);
        let rays = FrameRays::of(&flat, &view, Effects::of(&flat, &settings).plan(&settings).effects);
        let other = match &arguments.against {
            None => plain(&adapter, &flat, &view)?,
            Some(folder) => RayAdapter::with_sources(&adapter, &flat, &view, sources_in(folder)?)?,
        };
        let mut ways = [other, RayAdapter::with_sources(&adapter, &flat, &view, SOURCES)?];
        let mut whole = [vec![Duration::ZERO; rounds], vec![Duration::ZERO; rounds]];
        let mut count = 0;
        for (kind, rays, query) in rays.by_kind() {
            if rays.is_empty() {
                continue;
            }
            let records = [ways[0].load(rays)?, ways[1].load(rays)?];
            let times = take_turns(rounds, ways.len(), |way| ways[way].trace(&records[way], query))?;
            if ways[0].answers(&records[0], rays.len())? != ways[1].answers(&records[1], rays.len())? {
                println!("{name}, {kind}: the answers differ");
                return Ok(false);
            }
            println!("| {name} | {kind} {}", row(rays.len(), &times[0], &times[1]));
            count += rays.len();
            for (whole, times) in whole.iter_mut().zip(&times) {
                whole.iter_mut().zip(times).for_each(|(whole, &time)| *whole += time);
            }
        }
        println!("| {name} | **all** {}", row(count, &whole[0], &whole[1]));
        holds &= Ratio::of(&whole[0], &whole[1]).median >= arguments.least;
    }
    Ok(holds)
}

/// The end of a row: rays, rates, ratio.
fn row(rays: usize, plain: &[Duration], kept: &[Duration]) -> String {
    let Ratio { median: ratio, low, high } = Ratio::of(plain, kept);
    let [plain, kept] = [plain, kept].map(|times| rays as f64 / median(times).as_secs_f64() / 1e6);
    format!("| {rays} | {plain:.2} | {kept:.2} | {ratio:.2} ({low:.2}–{high:.2}) |")
}

/// The plain way: its nodes lie where the texture coordinates of a scene are.
fn plain(adapter: &AdapterReport, scene: &FlatScene, view: &View) -> Result<RayAdapter> {
    let two_child: Source<'static> = ("rays", include_str!("two_child.wgsl"));
    let others = SOURCES.iter().filter(|(stem, _)| *stem != "rays").copied();
    let sources: Vec<Source<'static>> = others.chain([two_child]).collect();
    let nodes = nodes(scene);
    let scene = FlatScene { uvs: bytemuck::cast_slice::<Node, [f32; 2]>(&nodes).into(), ..scene.clone() };
    Ok(RayAdapter::with_sources(adapter, &scene, view, sources.leak())?)
}

/// The binary nodes, over triangles in the order that adapters have them: each leaf's stay in a row.
fn nodes(scene: &FlatScene) -> Vec<Node> {
    let order = pack(&scene.nodes, &scene.triangles).order;
    let mut places = vec![0; order.len()];
    order.iter().zip(0..).for_each(|(&triangle, place)| places[triangle as usize] = place);
    let mut nodes = scene.nodes.to_vec();
    for node in &mut nodes {
        for (first, count) in [(&mut node.a_first, node.a_count), (&mut node.b_first, node.b_count)] {
            if count > 0 {
                *first = places[*first as usize];
            }
        }
    }
    nodes
}
