//! `snellius bench --scale`: how time grows.

mod markdown;
mod plot;

use std::time::Duration;

use serde::Serialize;

use super::super::console::{Console, print, print_json};
use super::super::{CliError, Outcome};
use super::machine::Machine;
use super::{BenchArgs, adapters_of, draw};
use crate::bench::{Axis, BenchError, Growth, Target, grow};
use crate::cpu::thread_pool;
use crate::layout::Backend;

/// What grows, and how far.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Growth")]
pub(super) struct ScaleArgs {
    /// Measure how time grows with triangles, depth, lights, pixels, samples and threads
    #[arg(long, conflicts_with = "mesh")]
    pub(super) scale: bool,
    /// Only with these [default: all]
    #[arg(long, value_name = "NAMES", requires = "scale", value_delimiter = ',', value_parser = axis)]
    axes: Vec<Axis>,
    /// No amount above this: a quick look
    #[arg(long, value_name = "N", requires = "scale")]
    up_to: Option<u32>,
}

fn axis(text: &str) -> Result<Axis, String> {
    let names = Axis::ALL.map(Axis::name).join(", ");
    Axis::ALL.into_iter().find(|axis| axis.name() == text).ok_or_else(|| format!("there are {names}"))
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report {
    machine: Machine,
    axes: Vec<Growth>,
    /// What has no figures, and why.
    faults: Vec<String>,
}

pub(super) fn run(args: &BenchArgs, console: Console) -> Result<Outcome, CliError> {
    let targets = targets(args)?;
    let threads = thread_pool(0)?.current_num_threads() as u32;
    let axes = if args.scale.axes.is_empty() { &Axis::ALL[..] } else { &args.scale.axes };
    let budget = Duration::from_secs(args.devices.budget.into());
    let rounds = args.rounds.map(|rounds| rounds as usize);
    let mut report = Report { machine: Machine::new(&targets), axes: Vec::new(), faults: Vec::new() };
    for &axis in axes {
        let mut amounts = axis.values(threads);
        amounts.retain(|&amount| args.scale.up_to.is_none_or(|most| amount <= most));
        if amounts.len() < 2 {
            console.note(format!("{}: no two amounts to compare", axis.name()));
            continue;
        }
        let on = if axis == Axis::Threads { &targets[..1] } else { &targets };
        for target in on {
            console.note(format!("{} on {} …", axis.name(), target.name()));
            let fault = match grow(axis, &amounts, target, rounds, budget) {
                Ok(Ok(growth)) => {
                    report.axes.push(growth);
                    continue;
                }
                Ok(Err(fault)) => fault,
                Err(BenchError::Gpu(error)) => format!("{}: {}: {error}", axis.name(), target.name()),
                Err(error) => return Err(error.into()),
            };
            console.warn(fault.clone());
            report.faults.push(fault);
        }
    }
    if args.json {
        print_json(&report)?;
    } else {
        print(&markdown::page(&report))?;
    }
    draw(args, console, || plot::figure(&report.axes).svg_in_columns(3))?;
    let mut holds = report.faults.is_empty();
    for growth in report.axes.iter().filter(|growth| !growth.holds()) {
        holds = false;
        console.warn(format!("{}: time grows faster with {} than is accepted", growth.device, growth.axis));
    }
    Ok(if holds { Outcome::Done } else { Outcome::Failed })
}

/// All threads of the CPU, and graphics cards; software adapters only where they are asked for.
fn targets(args: &BenchArgs) -> Result<Vec<Target>, CliError> {
    let asked = args.adapter.is_some() || args.backend == Some(Backend::Gpu);
    let is_taken =
        |target: &Target| asked || matches!(target, Target::Adapter(report) if report.kind.is_real());
    let mut targets = vec![Target::Cpu { threads: 0 }];
    targets.extend(adapters_of(args)?.into_iter().filter(is_taken));
    Ok(targets)
}
