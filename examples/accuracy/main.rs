//! What accuracy costs in time, and how far the closed forms are met: makes `docs/accuracy.md`.
//!
//! `cargo run --release --example accuracy` studies two scenes on the CPU and on every Vulkan adapter (list the drivers
//! in `VK_DRIVER_FILES`, as `tests/run` does), puts all devices through the closed forms of the self-test, and writes
//! the page with its plots and tables beside it. Studies lie in `target/accuracy`: one that is stopped is taken up again,
//! one that is there is taken. About ten minutes on two cores that have nothing else to do. The exit code is 1 where a
//! device misses a closed form.

mod expected;
mod theory;
#[path = "../shared/verdict.rs"]
mod verdict;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;

use snellius::gpu::{AdapterReport, adapters};
use snellius::study::{Config, Knob, Watch, run, write_outputs};

use crate::verdict::verdict;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Make docs/accuracy.md
#[derive(Debug, Parser)]
struct Arguments {
    /// Seconds for each study
    #[arg(long, default_value_t = 270)]
    budget: u64,
    /// Scenes of scenes/ to study
    #[arg(long, value_delimiter = ',', default_value = "ice,whitted")]
    scenes: Vec<String>,
    /// The processor's name for the page
    #[arg(long, default_value = "two cores")]
    cpu: String,
    /// Part of the name of the adapters to compare with [default: all]
    #[arg(long, default_value = "")]
    adapter: String,
}

/// Files of a study that the page shows or links.
const SHOWN: [&str; 4] = ["pareto.svg", "truncation.svg", "sampling.svg", "study.csv"];

fn main() -> ExitCode {
    verdict(make(&Arguments::parse()))
}

/// Write the page; returns whether every closed form is met.
fn make(arguments: &Arguments) -> Result<bool> {
    let adapters: Vec<_> =
        adapters().into_iter().filter(|adapter| adapter.is_called(&arguments.adapter)).collect();
    let mut page = vec![INTRODUCTION.trim().to_owned()];
    for name in &arguments.scenes {
        page.push(study(name, arguments, &adapters)?);
    }
    let (theory, holds) = theory::section(&adapters)?;
    page.push(theory);
    std::fs::write("docs/accuracy.md", page.join("\n\n") + "\n")?;
    Ok(holds)
}

const INTRODUCTION: &str = "
<!-- Made by `cargo run --release --example accuracy`. -->

# What accuracy costs in time

`snellius study SCENE` changes one setting after the other from a stated baseline, and says what each buys and costs:
its time with an interval, its errors against a reference in f64, and how uncertain that reference is itself. This page
is such a study of two scenes, and then the closed forms of optics, measured.
";

/// Study a scene, keep what the page shows, and return its part of the page.
fn study(name: &str, arguments: &Arguments, adapters: &[AdapterReport]) -> Result<String> {
    let folder = Path::new("target/accuracy").join(name);
    let config = Config {
        scene: PathBuf::from(format!("scenes/{name}.toml")),
        folder: folder.clone(),
        size: Some([320, 240]),
        depth: None,
        cutoff: None,
        knobs: Knob::ALL.to_vec(),
        adapters: adapters.to_vec(),
        budget: Duration::from_secs(arguments.budget),
        fresh: false,
        cpu: arguments.cpu.clone(),
    };
    let report = run(&config, &Lines)?;
    write_outputs(&report, &folder)?;
    let shown = Path::new("docs/accuracy").join(name);
    std::fs::create_dir_all(&shown)?;
    for file in SHOWN {
        if folder.join(file).exists() {
            std::fs::copy(folder.join(file), shown.join(file))?;
        }
    }
    let page = std::fs::read_to_string(folder.join("report.md"))?;
    let page =
        page.trim_end().replace("\n## ", "\n### ").replacen("# What accuracy costs in time: ", "## ", 1);
    Ok(page.replace("](", &format!("](accuracy/{name}/")))
}

/// A line for each thing that is begun.
struct Lines;

impl Watch for Lines {
    fn stage(&self, words: &str, share: f64) {
        eprintln!("{:3.0} %  {words}", share * 100.0);
    }

    fn tick(&self) {}

    fn is_interrupted(&self) -> bool {
        false
    }
}
