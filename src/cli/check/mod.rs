//! `snellius check`: what a scene holds, and what it calls for.

mod report;
mod text;

use std::path::PathBuf;

use super::console::{print, print_json};
use super::prepare::Prepared;
use super::{CliError, Outcome};
use report::Report;

/// Check a scene and list what it holds and calls for
///
/// Reads every file of the scene as a render would, and tells bodies and media, triangles, lights,
/// textures, the sizes of the buffers that renderers read, and which effects it calls for and why.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius check scenes/ice.toml
  snellius check scenes/ice.toml --json

Exit code: 0, also with warnings, or 2 if the scene cannot be rendered.")]
pub(super) struct CheckArgs {
    /// The scene: .toml or .obj
    scene: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &CheckArgs) -> Result<Outcome, CliError> {
    let report = Report::new(&Prepared::new(&args.scene)?);
    if args.json {
        print_json(&report)?
    } else {
        print(&report.to_string())?
    }
    Ok(Outcome::Done)
}
