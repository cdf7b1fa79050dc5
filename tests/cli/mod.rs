//! The program as a person runs it: output, exit codes, files.

mod bench;
mod broken;
mod diff;
mod render;
mod usage;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// What a run of the program left on its streams.
struct Run {
    code: i32,
    stdout: Vec<u8>,
    stderr: String,
}

impl Run {
    fn json(&self) -> serde_json::Value {
        serde_json::from_slice(&self.stdout).expect("standard output is one JSON object")
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.stdout).into_owned()
    }
}

/// The program with these words as arguments, in a folder, without the caller's preferences.
fn command(folder: &Path, line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snellius"));
    command.args(line.split_whitespace()).current_dir(folder);
    for name in ["RUST_LOG", "NO_COLOR", "WGPU_ADAPTER_NAME", "RAYON_NUM_THREADS"] {
        command.env_remove(name);
    }
    command
}

fn snellius(folder: &Path, line: &str) -> Run {
    let Output { status, stdout, stderr } = command(folder, line).output().expect("the program starts");
    Run {
        code: status.code().expect("the program ends by itself"),
        stdout,
        stderr: String::from_utf8_lossy(&stderr).into_owned(),
    }
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Names of the files in a folder, in order.
fn files_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort_unstable();
    names
}
