//! Which case runs on which device, on standard error.

use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::console::Console;

/// A line that tells what is running, on a terminal.
pub(super) struct CaseProgress {
    bar: Option<ProgressBar>,
}

impl CaseProgress {
    /// Begin with so many runs to come.
    pub(super) fn start(runs: usize, console: Console) -> Self {
        let style = ProgressStyle::with_template("{elapsed:>4} [{bar:30}] {pos}/{len} {msg}")
            .unwrap_or_else(|_| ProgressStyle::default_bar())
            .progress_chars("=> ");
        let bar = console.has_terminal().then(|| ProgressBar::new(runs as u64).with_style(style));
        Self { bar }
    }

    /// A case begins on a device.
    pub(super) fn begin(&self, case: &str, device: &str) {
        if let Some(bar) = &self.bar {
            bar.inc(u64::from(!bar.message().is_empty()));
            bar.set_message(format!("{case} on {device}"));
        }
    }

    /// All is done.
    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
