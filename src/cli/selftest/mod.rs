//! `snellius selftest`: the hard cases on this machine's devices.

mod arithmetic;
mod devices;
mod markdown;
mod progress;
mod report;
mod text;

use std::time::Instant;

use super::console::{Console, print, print_json};
use super::{CliError, Outcome};
use crate::layout::{Backend, Float, Intersector};
use crate::selftest::{CASES, Case, Effort, Verdict};
use devices::Devices;
use progress::CaseProgress;
use report::Report;

/// Put this machine's devices through the hard cases
///
/// Every case runs on the CPU in f32 and f64 and on each Vulkan adapter, and gives figures with the bounds
/// that they must keep. The table shows the most telling figure of each; -v lists all of them.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius selftest
  snellius selftest --adapter llvmpipe --case T1 --case T5 -v
  snellius selftest --case T1 --intersector moller-trumbore

Exit code: 0, or 1 if a figure is beyond its bound.")]
pub(super) struct SelftestArgs {
    /// Only this case, as T5; may be repeated
    #[arg(long, value_name = "CASE", value_parser = case)]
    case: Vec<&'static Case>,
    /// Ten times as many rays: minutes instead of one
    #[arg(long)]
    long: bool,
    /// Print one JSON object
    #[arg(long, conflicts_with = "markdown")]
    json: bool,
    /// Print a page in Markdown; -v adds every figure
    #[arg(long)]
    markdown: bool,
    /// Only the CPU, or only Vulkan adapters
    #[arg(long, value_name = "DEVICE", help_heading = "Device")]
    backend: Option<Backend>,
    /// Only adapters of which this is part of the name, as `snellius devices` lists them
    #[arg(long, value_name = "NAME", help_heading = "Device")]
    adapter: Option<String>,
    /// Only this kind of arithmetic on adapters [default: strict where an adapter can, else fast]
    #[arg(long, value_name = "FLOAT", help_heading = "Device")]
    float: Option<Float>,
    /// The ray–triangle test
    #[arg(long, value_name = "TEST", default_value = "watertight", help_heading = "Device")]
    intersector: Intersector,
}

/// The case of that name.
fn case(name: &str) -> Result<&'static Case, String> {
    let found = CASES.iter().find(|case| case.id.eq_ignore_ascii_case(name));
    found.ok_or_else(|| {
        format!("there are {}", CASES.iter().map(|case| case.id).collect::<Vec<_>>().join(", "))
    })
}

pub(super) fn run(args: &SelftestArgs, console: Console) -> Result<Outcome, CliError> {
    let started = Instant::now();
    let cases: Vec<_> = CASES
        .iter()
        .filter(|case| args.case.is_empty() || args.case.iter().any(|one| one.id == case.id))
        .collect();
    let effort = if args.long { Effort::Long } else { Effort::Short };
    let mut devices = Devices::open(args)?;
    let mut report = Report::new(&devices, args.intersector, effort);
    let progress = CaseProgress::start(cases.len() * devices.list.len(), console);
    for case in cases {
        let mut results = Vec::new();
        for device in &mut devices.list {
            progress.begin(case.id, device.name());
            results.push(report::run(case, device.as_mut(), effort)?);
        }
        report.add(case, results);
    }
    progress.finish();
    if args.json {
        print_json(&report)?;
    } else if args.markdown {
        print(&markdown::page(&report, console.is_verbose()))?;
    } else {
        print(&text::tables(&report, console.is_verbose()))?;
    }
    let fallen = report.fallen();
    let seconds = started.elapsed().as_secs_f64();
    let outcome = if fallen == 0 {
        "every bound is kept".to_owned()
    } else {
        format!("{fallen} figures are beyond their bounds")
    };
    console.note(format!("{outcome}; {seconds:.0} s"));
    Ok(if report.verdict() == Verdict::Holds { Outcome::Done } else { Outcome::Failed })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_named_in_any_spelling_and_a_wrong_one_is_told_which_there_are() {
        assert!(case("t1").is_ok_and(|case| case.id == "T1"));
        assert!(case("T99").is_err_and(|message| message.contains("T1, T2")));
    }
}
