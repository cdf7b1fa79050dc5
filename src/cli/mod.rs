//! The command line: raw arguments, then a typed configuration, then the run; one file a command.
//!
//! Errors travel up as values and are printed here, once. Exit codes: 0 done; 1 a comparison or case failed;
//! 2 usage, scene or file error; 3 no such device; 4 device lost; 130 interrupted by Ctrl-C.

mod bench;
mod check;
mod console;
mod device;
mod devices;
mod diff;
mod error;
mod prepare;
mod progress;
mod render;
mod selftest;
mod study;
mod trace;
mod values;
mod view;

use std::ffi::OsString;
use std::io;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use tracing_subscriber::EnvFilter;

use console::Console;
use error::{CliError, Outcome};

/// A ray tracer for ice, glass, liquids and mirrors, on the GPU and the CPU
#[derive(Debug, Parser)]
#[command(
    name = "snellius",
    version,
    override_usage = "snellius <COMMAND> [OPTIONS]\n       snellius <SCENE>",
    after_help = "\
A scene is a .toml file (docs/scenes.md describes it) or a bare .obj mesh. `snellius SCENE` opens it in a
window, as `snellius view SCENE` does, unless the program was built without the viewer.

Examples:
  snellius scenes/ice.toml
  snellius render scenes/ice.toml -o ice.png
  snellius check scenes/ice.toml
  snellius help render

Exit codes: 0 done; 1 a comparison or case failed; 2 usage, scene or file error; 3 no such device;
4 device lost; 130 interrupted by Ctrl-C.
Environment: WGPU_BACKEND, WGPU_ADAPTER_NAME, RAYON_NUM_THREADS, NO_COLOR, RUST_LOG."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Say nothing on standard error but errors
    #[arg(short, long, global = true, conflicts_with = "verbose", help_heading = "Messages")]
    quiet: bool,
    /// Say more; twice: log what the libraries do
    #[arg(short, long, global = true, action = clap::ArgAction::Count, help_heading = "Messages")]
    verbose: u8,
}

#[derive(Debug, Subcommand)]
enum Command {
    Render(Box<render::RenderArgs>),
    Check(check::CheckArgs),
    Bench(Box<bench::BenchArgs>),
    Devices(devices::DevicesArgs),
    Diff(diff::DiffArgs),
    Study(study::StudyArgs),
    Trace(trace::TraceArgs),
    Selftest(selftest::SelftestArgs),
    #[cfg(feature = "viewer")]
    View(Box<view::ViewArgs>),
    /// A scene, or a mistake.
    #[command(external_subcommand)]
    Scene(Vec<OsString>),
}

/// Parse the process's arguments and run the command; returns the exit code.
#[must_use]
pub fn main() -> ExitCode {
    // clap prints help and usage errors, and exits with 0 and 2.
    let cli = Cli::parse();
    let console = Console::new(cli.quiet, cli.verbose > 0);
    log_to_stderr(cli.verbose);
    let code = match run(cli, console) {
        Ok(outcome) => outcome.exit_code(),
        Err(error) => {
            console.error(&error);
            error.exit_code()
        }
    };
    ExitCode::from(code)
}

fn run(cli: Cli, console: Console) -> Result<Outcome, CliError> {
    match cli.command {
        Some(Command::Render(args)) => render::run(*args, console),
        Some(Command::Check(args)) => check::run(&args),
        Some(Command::Bench(args)) => bench::run(&args, console),
        Some(Command::Devices(args)) => devices::run(&args, console),
        Some(Command::Diff(args)) => diff::run(args, console),
        Some(Command::Study(args)) => study::run(args, console),
        Some(Command::Trace(args)) => trace::run(&args, console),
        Some(Command::Selftest(args)) => selftest::run(&args, console),
        #[cfg(feature = "viewer")]
        Some(Command::View(args)) => view::run(*args, console),
        Some(Command::Scene(words)) => view::open_words(&words, console),
        None => {
            console::print(&Cli::command().render_help().to_string())?;
            Ok(Outcome::Done)
        }
    }
}

/// Log to standard error what `RUST_LOG` asks for, else what `-v` does.
fn log_to_stderr(verbose: u8) {
    let default = match verbose {
        0 => "error",
        1 => "snellius=info,warn",
        _ => "snellius=debug,info",
    };
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(default));
    tracing_subscriber::fmt().with_env_filter(filter).with_writer(io::stderr).init();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Cli::command().debug_assert();
    }
}
