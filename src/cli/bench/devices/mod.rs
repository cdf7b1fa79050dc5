//! `snellius bench`: scenes on every device.

mod baseline;
mod markdown;
mod plot;

use std::path::{Path, PathBuf};
use std::time::Duration;

use serde::Serialize;

use super::super::console::{Console, print, print_json};
use super::super::values::whole_in;
use super::super::{CliError, Outcome};
use super::machine::Machine;
use super::{BenchArgs, adapters_of, draw, scenes_of};
use crate::bench::{Change, Compared, Comparison, SceneRow, Target, Verdict, compare_devices, compare_with};
use crate::cpu::thread_pool;
use crate::layout::{Backend, Float};
use baseline::{Baseline, share};

/// How devices are compared, and with what.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Scenes on devices")]
pub(super) struct DeviceBenchArgs {
    /// About how many seconds a scene may take, or an axis of --scale on a device: size and rounds are chosen to fit
    #[arg(long, value_name = "SECONDS", default_value = "25", conflicts_with_all = ["mesh", "effects"], value_parser = |text: &str| whole_in(text, 0, 100_000))]
    pub(super) budget: u32,
    /// Arithmetic of the adapters: strict, or as the driver likes
    #[arg(long, value_name = "HOW", default_value = "strict", conflicts_with_all = ["mesh", "effects", "scale"])]
    float: Float,
    /// Compare with what `snellius bench --json` printed before; pictures have the sizes that they had there
    #[arg(long, value_name = "FILE", conflicts_with_all = ["mesh", "effects", "scale"])]
    baseline: Option<PathBuf>,
    /// Fail if a trace takes longer by more than this, beyond the intervals of both times
    #[arg(long, value_name = "PERCENT", requires = "baseline", value_parser = share)]
    fail_above: Option<f64>,
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report {
    machine: Machine,
    /// "strict" or "fast": what adapters were asked for.
    float: String,
    scenes: Vec<SceneRow>,
    /// Devices without figures, and why.
    faults: Vec<String>,
    /// Against the baseline, if there is one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    changes: Vec<Change>,
}

pub(super) fn run(args: &BenchArgs, console: Console) -> Result<Outcome, CliError> {
    let scenes = scenes_of(args)?;
    let baseline = args.devices.baseline.as_deref().map(Baseline::read).transpose()?;
    let others = others(args)?;
    let mut report = Report {
        machine: Machine::new(&others),
        float: super::super::values::name_of(args.devices.float),
        scenes: Vec::new(),
        faults: Vec::new(),
        changes: Vec::new(),
    };
    for path in &scenes {
        console.note(format!("{} …", path.display()));
        let Compared { row, faults } =
            compare_devices(path, &others, &comparison(args, path, baseline.as_ref()))?;
        for fault in faults {
            let fault = format!("{}: {fault}", row.scene);
            console.warn(fault.clone());
            report.faults.push(fault);
        }
        report.scenes.push(row);
    }
    if let Some(baseline) = &baseline {
        if baseline.machine.cpu != report.machine.cpu {
            console.warn(format!("the baseline was measured on another processor: {}", baseline.machine.cpu));
        }
        let allowed = args.devices.fail_above.unwrap_or(0.0);
        report.changes = compare_with(&baseline.scenes, &report.scenes, allowed);
    }
    if args.json {
        print_json(&report)?;
    } else {
        print(&markdown::page(&report))?;
    }
    draw(args, console, || plot::dots(&report).svg())?;
    let slower = args.devices.fail_above.is_some() && has_grown(&report.changes, console);
    Ok(if slower || !report.faults.is_empty() { Outcome::Failed } else { Outcome::Done })
}

/// Sizes of a baseline hold where none is given.
fn comparison(args: &BenchArgs, path: &Path, baseline: Option<&Baseline>) -> Comparison {
    let before = || baseline.and_then(|baseline| baseline.size_of(path));
    Comparison {
        size: args.size.map(|size| size.0).or_else(before),
        rounds: args.rounds.map(|rounds| rounds as usize),
        budget: Duration::from_secs(args.devices.budget.into()),
        float: args.devices.float,
    }
}

/// What is measured beside all threads of the CPU: fewer of them, and adapters.
fn others(args: &BenchArgs) -> Result<Vec<Target>, CliError> {
    let all = thread_pool(0)?.current_num_threads();
    let fewer = (0..).map(|power| 1 << power).take_while(|&threads| threads < all);
    let fewer = fewer.map(|threads| Target::Cpu { threads });
    let mut others: Vec<_> = if args.backend == Some(Backend::Gpu) { Vec::new() } else { fewer.collect() };
    others.extend(adapters_of(args)?);
    Ok(others)
}

/// Whether a trace takes longer than is allowed, or nothing could be compared; says so.
fn has_grown(changes: &[Change], console: Console) -> bool {
    for Change { scene, device, .. } in changes.iter().filter(|change| change.verdict == Verdict::Grown) {
        console.warn(format!("{scene} takes longer than allowed on {device}"));
    }
    let nothing = changes.iter().all(|change| change.verdict == Verdict::New);
    if nothing {
        console.warn("the baseline has none of these pictures on these devices: nothing was compared");
    }
    nothing || changes.iter().any(|change| change.verdict == Verdict::Grown)
}
