//! How far the devices agree: makes the table of the README, and fails where a required figure does not hold.
//!
//! `cargo run --release --example agreement` renders every scene of `scenes/` at one sample a pixel: on the CPU in f32
//! and f64, on one Vulkan adapter strictly and fast, and on a second one strictly, at a smaller size. It prints Markdown
//! and exits with 1 if a figure fails, with 2 if a scene or an adapter is missing. List the drivers in
//! `VK_DRIVER_FILES`, as `tests/run` does.

mod measure;
mod table;
#[path = "../shared/verdict.rs"]
mod verdict;

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

use measure::{Row, Target};
use verdict::verdict;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Compare the pictures of the CPU and of two Vulkan adapters
#[derive(Debug, Parser)]
struct Arguments {
    /// Scenes [default: all of scenes/]
    scenes: Vec<PathBuf>,
    /// Part of the name of the adapter that traces strictly and fast
    #[arg(long, default_value = "lavapipe")]
    adapter: String,
    /// Size of its pictures, and of those in f64
    #[arg(long, default_value = "640x480", value_parser = size)]
    size: [u32; 2],
    /// Part of the name of a second adapter, which traces strictly
    #[arg(long, default_value = "SwiftShader")]
    second: String,
    /// Size of its pictures
    #[arg(long, default_value = "160x120", value_parser = size)]
    second_size: [u32; 2],
}

fn main() -> ExitCode {
    verdict(run(Arguments::parse()))
}

/// Print the table row by row; returns whether every required figure holds.
fn run(arguments: Arguments) -> Result<bool> {
    let first = Target::find(arguments.adapter, arguments.size)?;
    let second = Target::find(arguments.second, arguments.second_size)?;
    let scenes = if arguments.scenes.is_empty() { all_scenes()? } else { arguments.scenes };
    println!("{}", table::head(&first, &second));
    let mut rows = Vec::new();
    for path in scenes {
        let row = Row::measure(&path, &first, &second)?;
        println!("{}", table::row(&row));
        rows.push(row);
    }
    println!("\n{}", table::caption(&first, &second, &rows));
    let mut holds = true;
    for row in &rows {
        for figure in row.failures() {
            eprintln!("{}: {figure} does not hold", row.scene);
            holds = false;
        }
    }
    Ok(holds)
}

fn all_scenes() -> Result<Vec<PathBuf>> {
    let mut scenes = Vec::new();
    for entry in std::fs::read_dir("scenes")? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "toml" || extension == "obj") {
            scenes.push(path);
        }
    }
    scenes.sort();
    Ok(scenes)
}

fn size(text: &str) -> std::result::Result<[u32; 2], String> {
    text.split_once('x')
        .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]))
        .filter(|sides| !sides.contains(&0))
        .ok_or_else(|| "expected WIDTHxHEIGHT in pixels, as in 640x480".to_owned())
}
