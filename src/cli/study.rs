//! `snellius study`: what accuracy costs in time.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::console::{Console, print, print_json};
use super::device::cpu_name;
use super::progress::StudyProgress;
use super::values::{ProgressStyle, Size, number_in, whole_in};
use super::{CliError, Outcome};
use crate::gpu::{AdapterReport, GpuError, adapters};
use crate::layout::constants::MAX_DEPTH;
use crate::study::{self, Config, Knob, Report, StudyError, write_outputs};

/// Measure what accuracy costs in time
///
/// From a baseline (the scene's depth and cut-off, one sample, f32, all threads of the CPU) one setting after the
/// other is changed. Each row tells its time with an interval, and its errors against a reference in f64, whose own
/// uncertainty is stated. The folder gets study.json, study.csv, report.md, report.html, plots as SVG and PNG, and
/// false-colour errors.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius study scenes/ice.toml --size 320x240
  snellius study scenes/whitted.toml -o whitted-study --knobs depth,cutoff --budget 60

A study that is stopped (Ctrl-C) keeps what is finished; the same command goes on from there.")]
pub(super) struct StudyArgs {
    /// The scene: .toml or .obj
    scene: PathBuf,
    /// The folder of the results; made if it is not there [default: the scene's name with -study]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Width and height of the pictures in pixels [default: the scene's]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
    /// The baseline's depth, 0 to 64 [default: the scene's]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, 0, MAX_DEPTH))]
    depth: Option<u32>,
    /// The baseline's least weight of a traced ray, 0 to 1 [default: the scene's]
    #[arg(long, value_name = "W", value_parser = |text: &str| number_in(text, 0.0, 1.0))]
    cutoff: Option<f64>,
    /// What to change: depth, cutoff, samples, adaptive, precision, intersector, tessellation, effects,
    /// device [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = knob)]
    knobs: Vec<Knob>,
    /// About how long it may take, in seconds: what does not fit is left out, and said to be
    #[arg(long, value_name = "SECONDS", default_value = "270", value_parser = |text: &str| whole_in(text, 1, 1_000_000))]
    budget: u32,
    /// Compare only with adapters of which this is part of the name [default: all]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Begin anew even if the folder holds an unfinished study
    #[arg(long)]
    fresh: bool,
    /// Print the report as one JSON object
    #[arg(long, help_heading = "Messages")]
    json: bool,
    /// Progress on standard error
    #[arg(long, value_name = "STYLE", default_value = "auto", help_heading = "Messages")]
    progress: ProgressStyle,
}

fn knob(text: &str) -> Result<Knob, String> {
    let names = Knob::ALL.map(Knob::name).join(", ");
    Knob::ALL.into_iter().find(|knob| knob.name() == text).ok_or_else(|| format!("there are {names}"))
}

pub(super) fn run(args: StudyArgs, console: Console) -> Result<Outcome, CliError> {
    let folder = args.output.clone().unwrap_or_else(|| default_folder(&args.scene));
    let knobs = if args.knobs.is_empty() { Knob::ALL.to_vec() } else { args.knobs };
    let config = Config {
        scene: args.scene,
        folder: folder.clone(),
        size: args.size.map(|size| size.0),
        depth: args.depth,
        cutoff: args.cutoff.map(|cutoff| cutoff as f32),
        adapters: if knobs.contains(&Knob::Device) { named(args.adapter)? } else { Vec::new() },
        knobs,
        budget: Duration::from_secs(args.budget.into()),
        fresh: args.fresh,
        cpu: cpu_name(),
    };
    let report = {
        let progress = StudyProgress::start(args.progress, console);
        match study::run(&config, &progress) {
            Err(StudyError::Interrupted) => {
                drop(progress);
                console
                    .warn("interrupted: what is finished is kept, and the same command goes on from there");
                return Ok(Outcome::Interrupted);
            }
            result => result?,
        }
    };
    write_outputs(&report, &folder)?;
    if args.json {
        print_json(&report)?;
    } else {
        print(&summary(&report))?;
    }
    for row in &report.left_out {
        console.note(format!("left out: {}: {}", row.id, row.reason));
    }
    console.note(format!("{}: report.html, report.md, study.csv, study.json, plots", folder.display()));
    Ok(outcome(&report))
}

/// The adapters of that name, or all.
fn named(name: Option<String>) -> Result<Vec<AdapterReport>, CliError> {
    let (found, others): (Vec<_>, Vec<_>) =
        adapters().into_iter().partition(|adapter| name.as_ref().is_none_or(|part| adapter.is_called(part)));
    if found.is_empty() && name.is_some() {
        let found = others.into_iter().map(|adapter| adapter.name).collect();
        return Err(GpuError::NoAdapter { wanted: name, found }.into());
    }
    Ok(found)
}

/// `ice-study` for `scenes/ice.toml`, in the current folder.
fn default_folder(scene: &Path) -> PathBuf {
    let stem = scene.file_stem().unwrap_or(scene.as_os_str()).to_string_lossy();
    PathBuf::from(format!("{stem}-study"))
}

/// One line a row.
fn summary(report: &Report) -> String {
    let line = |row: &study::RowRecord| {
        let own = row.knob.map_or(study::Truth::Whole, Knob::truth);
        let rmse =
            row.errors.get(&own).map_or_else(String::new, |errors| format!("rmse {:.2e}", errors.rmse));
        format!("{:10.1} ms  {:6.2}×  {rmse:14}  {}\n", row.time(), row.ratio.unwrap_or(f64::NAN), row.id)
    };
    report.rows.iter().map(line).collect()
}

/// Failed if a certified bound is broken: then the program is wrong.
fn outcome(report: &Report) -> Outcome {
    let broken = report.rows.iter().filter_map(|row| row.certificate).any(|c| c.broken > 0);
    if broken { Outcome::Failed } else { Outcome::Done }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_study_without_a_folder_gets_one_named_after_its_scene() {
        assert_eq!(default_folder(Path::new("scenes/ice.toml")), Path::new("ice-study"));
    }

    #[test]
    fn knobs_go_by_their_names() {
        assert_eq!(knob("cutoff"), Ok(Knob::Cutoff));
        assert!(knob("cut").is_err_and(|message| message.contains("depth, cutoff, samples")));
    }
}
