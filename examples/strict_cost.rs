//! What strict float costs: each scene of `scenes/` on each adapter, strict and fast in turn, medians of the trace
//! time, as a table in Markdown.
//!
//! ```sh
//! cargo run --release --example strict_cost -- [ROUNDS [SCENE…]]
//! ```

use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

use snellius::film::Renderer;
use snellius::flatten;
use snellius::gpu::{GpuOptions, GpuRenderer, adapters};
use snellius::layout::{Float, Settings};
use snellius::scene::Scene;

/// Pixels: so many that one picture takes some milliseconds at least.
const SIZE: [u32; 2] = [96, 72];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rounds: usize = arguments.next().map_or(Ok(5), |argument| argument.parse())?;
    let named: Vec<_> = arguments.map(PathBuf::from).collect();
    println!("| scene | adapter | strict, ms | fast, ms | strict : fast | pixels that differ |");
    println!("|---|---|---|---|---|---|");
    for path in if named.is_empty() { scenes()? } else { named } {
        for adapter in adapters().iter().filter(|adapter| adapter.strict_float) {
            let options = GpuOptions { adapter: Some(adapter.name.clone()), ..GpuOptions::default() };
            let row = measure(&path, &options, rounds)?;
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            println!("| {name} | {} | {row} |", adapter.name.split(" (").next().unwrap_or_default());
        }
    }
    Ok(())
}

/// Every scene file and bare mesh, by name.
fn scenes() -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let entries = std::fs::read_dir(folder)?.collect::<Result<Vec<_>, _>>()?;
    let mut paths: Vec<_> = entries.iter().map(std::fs::DirEntry::path).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "toml" || end == "obj"));
    paths.sort();
    Ok(paths)
}

/// Both medians, their ratio and how many pixels differ. The first picture of each kind compiles and is not counted.
fn measure(path: &std::path::Path, options: &GpuOptions, rounds: usize) -> Result<String, Box<dyn Error>> {
    let scene = Scene::load(path)?;
    let flat = flatten::flatten(&scene)?.scene;
    let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
    let strict = Settings { depth, cutoff, samples: 1, ..Settings::default() };
    let view = flatten::view(&scene.camera, &flat, SIZE, None, &strict);
    let mut renderer = GpuRenderer::new(&flat, options)?;
    let mut trace = |float| -> Result<_, Box<dyn Error>> {
        let frame = renderer.render(&view, &Settings { float, ..strict }, &())?;
        Ok((frame.times.trace, frame.texels))
    };
    let (_, strict_texels) = trace(Float::Strict)?;
    let (_, fast_texels) = trace(Float::Fast)?;
    let differing = strict_texels.iter().zip(&fast_texels).filter(|(a, b)| a.radiance != b.radiance).count();
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..rounds.max(1) {
        times[0].push(trace(Float::Strict)?.0);
        times[1].push(trace(Float::Fast)?.0);
    }
    let [strict, fast] = times.map(median);
    let share = 100.0 * differing as f64 / strict_texels.len() as f64;
    Ok(format!("{:.1} | {:.1} | {:.2} | {share:.0} %", strict * 1e3, fast * 1e3, strict / fast))
}

/// In seconds.
fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    times[times.len() / 2].as_secs_f64()
}
