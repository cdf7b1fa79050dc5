//! A display: the one that there is, or one of our own.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

/// A virtual display that ends with its handle.
pub(super) struct Display {
    name: String,
    server: Child,
}

impl Display {
    /// Start Xvfb on a free number. Where it is missing the test is skipped with a line, but fails in CI.
    pub(super) fn open() -> Option<Self> {
        let server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1920x1200x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let Ok(mut server) = server else {
            assert!(std::env::var("CI").as_deref() != Ok("true"), "no Xvfb: CI installs it, see .ci/run");
            eprintln!("skipped: no Xvfb on this machine");
            return None;
        };
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        Some(Self { name: format!(":{}", number.trim()), server })
    }

    /// For `DISPLAY`.
    pub(super) fn name(&self) -> &str {
        &self.name
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        self.server.kill().unwrap();
        self.server.wait().unwrap();
    }
}
