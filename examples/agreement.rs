//! How far the devices agree: the table of the README.
//!
//! `cargo run --release --example agreement [WxH] [SCENE.toml…]` renders each scene (all of `scenes/` by default) at one
//! sample on the CPU in f32 and f64 and on every Vulkan adapter, strict and fast, and prints a Markdown table. Choose
//! the adapters with `VK_DRIVER_FILES`, as `tests/run` does.

use std::error::Error;
use std::path::{Path, PathBuf};

use snellius::cpu::CpuRenderer;
use snellius::film::{Frame, Renderer};
use snellius::flatten;
use snellius::gpu::{self, GpuOptions, GpuRenderer};
use snellius::layout::{FlatScene, Float, Precision, Settings, Texel, View};
use snellius::scene::Scene;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut size = [640, 480];
    if let Some(given) = arguments.first().and_then(|first| parse_size(first)) {
        size = given;
        arguments.remove(0);
    }
    let scenes =
        if arguments.is_empty() { all_scenes()? } else { arguments.iter().map(PathBuf::from).collect() };
    let adapters = gpu::adapters();
    print_head(size, &adapters.iter().map(|a| a.name.clone()).collect::<Vec<_>>());
    for path in scenes {
        println!("{}", row(&path, size, &adapters.iter().map(|a| a.name.clone()).collect::<Vec<_>>())?);
    }
    Ok(())
}

fn parse_size(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once('x')?;
    Some([width.parse().ok()?, height.parse().ok()?])
}

fn all_scenes() -> Result<Vec<PathBuf>> {
    let mut scenes = Vec::new();
    for entry in std::fs::read_dir("scenes")? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == "toml" || e == "obj") {
            scenes.push(path);
        }
    }
    scenes.sort();
    Ok(scenes)
}

fn print_head(size: [u32; 2], adapters: &[String]) {
    print!("| {}×{}, 1 sample | rays |", size[0], size[1]);
    for adapter in adapters {
        print!(" {adapter}, strict: differing pixels | {adapter}, fast: equal primitive hash |");
    }
    println!(" f64: equal body hash | f64: p99 of abs(ΔRGB) there |");
    println!("|---|---|{}---|---|", "---|---|".repeat(adapters.len()));
}

/// One scene's row.
fn row(path: &Path, size: [u32; 2], adapters: &[String]) -> Result<String> {
    let scene = Scene::load(path)?;
    let flat = flatten::flatten(&scene)?.scene;
    let settings = Settings {
        depth: scene.render.depth,
        cutoff: scene.render.cutoff as f32,
        samples: 1,
        ..Settings::default()
    };
    let view = flatten::view(&scene.camera, &flat, size, None, &settings);
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let single = trace_cpu(&flat, &view, &settings)?;
    let double = trace_cpu(&flat, &view, &Settings { precision: Precision::F64, ..settings })?;
    let rays = single.rays.primary + single.rays.reflection + single.rays.refraction + single.rays.shadow;
    let mut row = format!("| {name} | {rays} |");
    for adapter in adapters {
        let strict = trace_gpu(&flat, &view, &settings, adapter)?;
        let fast = trace_gpu(&flat, &view, &Settings { float: Float::Fast, ..settings }, adapter)?;
        let rays_differ = if strict.rays == single.rays { "" } else { " (ray counts differ)" };
        let differing = percent(&single, &strict, |a, b| radiance_bits(a) == radiance_bits(b)).0;
        let equal = percent(&single, &fast, |a, b| a.primitive_hash == b.primitive_hash).1;
        row += &format!(" {differing}{rays_differ} | {equal:.3} % |");
    }
    let equal = percent(&single, &double, |a, b| a.body_hash == b.body_hash).1;
    row += &format!(" {equal:.2} % | {:.1e} |", p99_where_paths_agree(&single, &double));
    Ok(row)
}

fn trace_cpu(flat: &FlatScene, view: &View, settings: &Settings) -> Result<Frame> {
    Ok(CpuRenderer::new(flat, 0)?.render(view, settings, &())?)
}

fn trace_gpu(flat: &FlatScene, view: &View, settings: &Settings, adapter: &str) -> Result<Frame> {
    let options = GpuOptions { adapter: Some(adapter.to_owned()) };
    Ok(GpuRenderer::new(flat, &options)?.render(view, settings, &())?)
}

fn radiance_bits(texel: &Texel) -> [u32; 3] {
    texel.radiance.map(f32::to_bits)
}

/// How many pixels fail, and the percentage that pass.
fn percent(a: &Frame, b: &Frame, same: impl Fn(&Texel, &Texel) -> bool) -> (usize, f64) {
    let passing = a.texels.iter().zip(&b.texels).filter(|(a, b)| same(a, b)).count();
    (a.texels.len() - passing, 100.0 * passing as f64 / a.texels.len() as f64)
}

/// The 99th percentile of the largest channel's difference, over pixels with the same body hash.
fn p99_where_paths_agree(a: &Frame, b: &Frame) -> f32 {
    let same = a.texels.iter().zip(&b.texels).filter(|(a, b)| a.body_hash == b.body_hash);
    let mut differences: Vec<f32> = same
        .map(|(a, b)| (0..3).map(|c| (a.radiance[c] - b.radiance[c]).abs()).fold(0.0, f32::max))
        .collect();
    differences.sort_by(f32::total_cmp);
    differences.get(differences.len() * 99 / 100).copied().unwrap_or(0.0)
}
