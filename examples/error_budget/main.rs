//! Whether `render --error` keeps its word, and at what price.
//!
//! `cargo run --release --example error_budget` takes each scene twice. With one given sample: the settings that the
//! budget chooses, the RMSE of their picture against the whole tree in f64, that one's own uncertainty as its certified
//! bounds prove it, and the time against that of the cheapest row of a study (depth, cut-off or precision changed from
//! what the scene asks for) that keeps the error too. Then with samples to be chosen: the RMSE against many more of them
//! in f64, which takes a quarter of an hour. Tables are Markdown; the exit code is 1 where an error is not kept, or takes
//! more than half as long again as the row, 2 where a scene cannot be traced.

mod rows;
mod stage;
#[path = "../shared/verdict.rs"]
mod verdict;

use std::error::Error;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use snellius::film::Metric;
use snellius::layout::{Precision, Settings};
use snellius::study::{Choice, Goal, Request, choose};

use stage::Stage;
use verdict::verdict;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Times that a budget may take of the cheapest row that keeps it.
const MOST_RATIO: f64 = 1.5;
/// Samples of the truth for each of the picture's.
const TRUER: u32 = 4;

/// Hold error budgets against the truth
#[derive(Debug, Parser)]
struct Arguments {
    /// The error to keep, as RMSE
    #[arg(long, default_value_t = 0.002)]
    error: f64,
    /// Scenes of scenes/
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "city.toml,goblet.toml,ice.toml,mirrors.toml,opaque.toml,prism.toml,still_life.obj,whitted.toml"
    )]
    scenes: Vec<String>,
    /// Width and height of pictures of one sample
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values_t = [200, 150])]
    size: Vec<u32>,
    /// Width and height of pictures of which the samples are chosen; 0 0 leaves them out
    #[arg(long, num_args = 2, value_names = ["W", "H"], default_values_t = [16, 12])]
    sampled_size: Vec<u32>,
    /// Runs of each timed picture
    #[arg(long, default_value_t = 5)]
    runs: usize,
}

fn main() -> ExitCode {
    verdict(run(&Arguments::parse()))
}

/// Print both tables row by row; returns whether every budget is kept.
fn run(arguments: &Arguments) -> Result<bool> {
    let limit = arguments.error;
    let mut holds = true;
    println!("One sample, error {limit}\n");
    println!("| scene | chosen | RMSE | truth proven within | ms | cheapest row | its ms | ratio |");
    println!("|---|---|--:|--:|--:|---|--:|--:|");
    for name in &arguments.scenes {
        holds &= one_sample(&Stage::load(name, &arguments.size)?, arguments)?;
    }
    if arguments.sampled_size.contains(&0) {
        return Ok(holds);
    }
    println!("\nSamples chosen, error {limit}\n");
    println!("| scene | chosen | samples a pixel | estimated | RMSE | against samples |");
    println!("|---|---|--:|--:|--:|--:|");
    for name in &arguments.scenes {
        holds &= many_samples(&Stage::load(name, &arguments.sampled_size)?, limit)?;
    }
    Ok(holds)
}

/// What the budget chooses on the CPU.
fn chosen(stage: &Stage, limit: f64, keeps_samples: bool) -> Result<Choice> {
    let request = Request {
        scene: &stage.flat,
        camera: &stage.scene.camera,
        size: stage.size,
        base: Settings::default(),
        keeps_samples,
        precisions: &[Precision::F32, Precision::F64],
    };
    let goal = Goal::Error { limit, metric: Metric::Rmse };
    let mut clock = |_: [u32; 2], _: &Settings| Ok::<_, Box<dyn Error>>(Duration::ZERO);
    choose(&request, goal, &mut clock)
}

/// A line of the first table.
fn one_sample(stage: &Stage, arguments: &Arguments) -> Result<bool> {
    let choice = chosen(stage, arguments.error, true)?;
    let truth = stage.truth(1)?;
    let picture = stage.shoot(&choice.settings)?;
    let error = picture.rmse(&truth);
    let proven = truth.proven();
    let row = rows::cheapest(stage, &truth, arguments.error, &choice.settings, arguments.runs)?;
    let keeps = error <= arguments.error;
    let is_cheap = row.as_ref().is_none_or(|row| row.ratio() <= MOST_RATIO);
    let (label, row_ms, ratio) = row
        .map_or(("none keeps it".to_owned(), "–".to_owned(), "–".to_owned()), |row| {
            (row.label.clone(), format!("{:.1}", row.row_ms), format!("{:.2}", row.ratio()))
        });
    println!(
        "| `{}` | {} | {error:.2e}{} | {proven:.1e} | {:.1} | {label} | {row_ms} | {ratio}{} |",
        stage.name,
        words(&choice.settings),
        mark(keeps),
        picture.ms,
        mark(is_cheap)
    );
    Ok(keeps && is_cheap)
}

/// A line of the second table.
///
/// The picture's samples are the first of the truth's: were they independent, they would be nearer to it than to the
/// infinite ones by the square root of (N − n)/N, which is put right.
fn many_samples(stage: &Stage, limit: f64) -> Result<bool> {
    let choice = chosen(stage, limit, false)?;
    let settings = choice.settings;
    if !choice.meets {
        println!(
            "| `{}` | none keeps it | {} | {:.2e} | – | – |",
            stage.name, settings.samples, choice.figure[1]
        );
        return Ok(true);
    }
    let all = settings.samples * TRUER;
    let apart = stage.shoot(&settings)?.rmse(&stage.truth(all)?);
    let error = apart * (f64::from(TRUER) / f64::from(TRUER - 1)).sqrt();
    let keeps = error <= limit;
    println!(
        "| `{}` | {} | {:.0} | {:.2e} | {error:.2e}{} | {all} |",
        stage.name,
        words(&settings),
        choice.samples,
        choice.figure[0],
        mark(keeps)
    );
    Ok(keeps)
}

fn mark(holds: bool) -> &'static str {
    if holds { "" } else { " **missed**" }
}

fn words(settings: &Settings) -> String {
    let Settings { depth, cutoff, samples, adaptive, precision, .. } = settings;
    let bits = if *precision == Precision::F64 { "f64" } else { "f32" };
    let adaptive = adaptive.map_or_else(String::new, |threshold| format!(", adaptive {threshold:.1e}"));
    format!("depth {depth}, cut-off 2^{:.0}, samples {samples}{adaptive}, {bits}", cutoff.log2())
}
