//! The viewer as a person runs it: a window on a virtual display, lavapipe, a scripted hand.

#![allow(clippy::unwrap_used)]

mod display;
mod session;
mod shader;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use display::Display;

/// Longest a run of the program may take.
const PATIENCE: Duration = Duration::from_secs(400);

/// What a run of the program left behind.
#[derive(Debug)]
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

/// The program with these words as arguments, on a display, with lavapipe for its window.
fn snellius(display: &Display, folder: &Path, words: &[&str]) -> Run {
    run(Command::new(env!("CARGO_BIN_EXE_snellius"))
        .args(words)
        .current_dir(folder)
        .env("DISPLAY", display.name()))
}

fn run(command: &mut Command) -> Run {
    for name in ["RUST_LOG", "NO_COLOR", "RAYON_NUM_THREADS", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(name);
    }
    command
        .env("WGPU_ADAPTER_NAME", "llvmpipe")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let start = Instant::now();
    // What it prints fits the pipes.
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > PATIENCE {
            child.kill().unwrap();
            break;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let Output { status, stdout, stderr } = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Run { code: status.code(), stdout: text(stdout), stderr: text(stderr) }
}

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

/// The 8-bit pixels of a PNG file.
fn pixels(path: &Path) -> image::RgbImage {
    image::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).to_rgb8()
}

/// Pixels of the upper left part of `window`, as large as `picture`, that differ from it.
fn differing(window: &image::RgbImage, picture: &image::RgbImage) -> usize {
    assert!(window.width() > picture.width() && window.height() == picture.height());
    picture.enumerate_pixels().filter(|(x, y, pixel)| window.get_pixel(*x, *y) != *pixel).count()
}
