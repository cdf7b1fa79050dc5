//! What the adapters' traversal gains over the plain one: two children a node in 64 bytes, while-while, with the same
//! watertight test over the same binary tree.
//!
//! `cargo run --release --example gpu_traversal -- MESH.obj [MESH.obj …]` traces the sets of rays of `snellius bench --rays` both
//! ways on one adapter, in turn, after every answer of both was compared, and prints Markdown. The exit code is 1 if two answers
//! differ in a bit, or the median of all ratios is below `--least`.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use snellius::bench::rays::{Pinhole, RayAdapter, RaySets, RayStage};
use snellius::bench::{Ratio, Spread, median, take_turns};
use snellius::bvh::{Preset, pack};
use snellius::gpu::{AdapterReport, SOURCES, Source, adapters, sources_in};
use snellius::layout::{Corner, FlatScene, Node};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Compare the kept traversal with the plain one
#[derive(Debug, Parser)]
struct Arguments {
    /// Meshes
    #[arg(required = true)]
    meshes: Vec<PathBuf>,
    /// Part of the adapter's name
    #[arg(long, default_value = "llvmpipe")]
    adapter: String,
    /// Width and height of the picture that the rays are of
    #[arg(long, default_value_t = 512)]
    side: u32,
    /// Times that both ways are measured in turn
    #[arg(long, default_value_t = 7)]
    rounds: usize,
    /// Take the kept way's shader files from this folder: for work on them
    #[arg(long, value_name = "FOLDER")]
    shaders: Option<PathBuf>,
    /// The kept way is to be so many times as fast
    #[arg(long, default_value_t = 1.5)]
    least: f64,
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

fn run(arguments: &Arguments) -> Result<bool> {
    let found = adapters().into_iter().find(|adapter| adapter.is_called(&arguments.adapter));
    let adapter = found.ok_or_else(|| format!("there is no adapter called {}", arguments.adapter))?;
    println!("{}, {}\n", adapter.name, adapter.driver_info);
    println!("| mesh | rays | of them | plain, Mrays/s | kept, Mrays/s | ratio |\n|---|---|--:|--:|--:|--:|");
    let mut ratios = Vec::new();
    for mesh in &arguments.meshes {
        let stage = RayStage::load(mesh, Preset::Best, Pinhole::default())?;
        let sources = arguments.shaders.as_deref().map_or(Ok(SOURCES), sources_in)?;
        let kept = RayAdapter::with_sources(&adapter, stage.scene(), stage.view(), sources)?;
        let mut ways = [plain(&adapter, &stage)?, kept];
        let sets = RaySets::of(&stage, arguments.side);
        for (letter, rays, query) in sets.by_letter() {
            let records = [ways[0].load(rays)?, ways[1].load(rays)?];
            let times =
                take_turns(arguments.rounds.max(1), ways.len(), |way| ways[way].trace(&records[way], query))?;
            if ways[0].answers(&records[0], rays.len())? != ways[1].answers(&records[1], rays.len())? {
                println!("{}, {letter}: the answers differ", mesh.display());
                return Ok(false);
            }
            let (plain, kept) = (&times[0], &times[1]);
            let ratio = Ratio::of(plain, kept).median;
            let rate = |times: &[Duration]| rays.len() as f64 / median(times).as_secs_f64() / 1e6;
            let name = mesh.file_stem().unwrap_or_default().to_string_lossy();
            let (count, plain, kept) = (rays.len(), rate(plain), rate(kept));
            println!("| {name} | {letter} | {count} | {plain:.2} | {kept:.2} | {ratio:.2} |");
            ratios.push(ratio);
        }
    }
    let ratio = Spread::of(ratios).median;
    println!("\nmedian ratio {ratio:.2} (≥ {})", arguments.least);
    Ok(ratio >= arguments.least)
}

/// The plain way: its nodes lie where the shading corners of a scene are.
fn plain(adapter: &AdapterReport, stage: &RayStage) -> Result<RayAdapter> {
    let two_child: Source<'static> = ("rays", include_str!("two_child.wgsl"));
    let others = SOURCES.iter().filter(|(stem, _)| *stem != "rays").copied();
    let sources: Vec<Source<'static>> = others.chain([two_child]).collect();
    let nodes = nodes(stage.scene());
    let scene =
        FlatScene { corners: bytemuck::cast_slice::<Node, Corner>(&nodes).into(), ..stage.scene().clone() };
    Ok(RayAdapter::with_sources(adapter, &scene, stage.view(), sources.leak())?)
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
