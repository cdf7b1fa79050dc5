//! Parse, run, exit code: everything is in [`snellius::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    snellius::cli::main()
}
