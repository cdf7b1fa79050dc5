//! How far a render is, on standard error; and Ctrl-C, which stops it.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle as BarStyle};

use super::console::Console;
use super::error::Outcome;
use super::values::ProgressStyle;
use crate::film::Progress;
use crate::study::Watch;

/// Plain lines are at least this far apart.
const LINE_INTERVAL: Duration = Duration::from_secs(1);

/// Shows progress, and stops the render after Ctrl-C.
pub(super) struct RenderProgress {
    display: Display,
    console: Console,
    interrupted: Arc<AtomicBool>,
}

enum Display {
    Bar(ProgressBar),
    Plain { started: Instant, last: Mutex<Duration> },
    None,
}

impl RenderProgress {
    /// Show progress in this style until it is dropped; from now on the first Ctrl-C (or SIGTERM) asks the render
    /// to stop, the second ends the process.
    pub(super) fn start(style: ProgressStyle, console: Console) -> Self {
        let display = match style {
            ProgressStyle::Auto if console.has_terminal() => Display::Bar(bar()),
            ProgressStyle::Plain => Display::Plain { started: Instant::now(), last: Mutex::default() },
            _ => Display::None,
        };
        Self { display, console, interrupted: listen_for_interrupt(console) }
    }
}

impl Progress for RenderProgress {
    fn advance(&self, done: u64, total: u64) -> ControlFlow<()> {
        match &self.display {
            Display::Bar(bar) => {
                bar.set_length(total);
                bar.set_position(done);
            }
            Display::Plain { started, last } => {
                let elapsed = started.elapsed();
                let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
                if elapsed >= *last + LINE_INTERVAL {
                    *last = elapsed;
                    self.console.note(plain_line(done, total, elapsed));
                }
            }
            Display::None => {}
        }
        if self.interrupted.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

/// Shows how far a study is and what it does, and stops it after Ctrl-C.
pub(super) struct StudyProgress(RenderProgress);

impl StudyProgress {
    /// As [`RenderProgress::start`].
    pub(super) fn start(style: ProgressStyle, console: Console) -> Self {
        Self(RenderProgress::start(style, console))
    }
}

/// Parts of a study's time that a bar shows.
const STUDY_PARTS: f64 = 1000.0;

impl Watch for StudyProgress {
    fn stage(&self, words: &str, share: f64) {
        match &self.0.display {
            Display::Bar(bar) => {
                bar.set_length(STUDY_PARTS as u64);
                bar.set_position((share * STUDY_PARTS) as u64);
                bar.set_message(words.to_owned());
            }
            Display::Plain { started, last } => {
                *last.lock().unwrap_or_else(PoisonError::into_inner) = started.elapsed();
                self.0.console.note(format!("{:3.0} %  {words}", share * 100.0));
            }
            Display::None => {}
        }
    }

    fn tick(&self) {
        if let Display::Bar(bar) = &self.0.display {
            bar.tick();
        }
    }

    fn is_interrupted(&self) -> bool {
        self.0.interrupted.load(Ordering::Relaxed)
    }
}

impl Drop for RenderProgress {
    fn drop(&mut self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let style = BarStyle::with_template("{elapsed:>4} [{bar:40}] {percent:>3} %, {eta} left  {msg}")
        .unwrap_or_else(|_| BarStyle::default_bar())
        .progress_chars("=> ");
    ProgressBar::new(0).with_style(style)
}

fn plain_line(done: u64, total: u64, elapsed: Duration) -> String {
    let share = done as f64 / total.max(1) as f64;
    let left = elapsed.as_secs_f64() * (1.0 - share) / share.max(f64::MIN_POSITIVE);
    if done == 0 {
        "0 % traced".to_owned()
    } else {
        format!("{:.0} % traced, about {left:.0} s left", share * 100.0)
    }
}

fn listen_for_interrupt(console: Console) -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    let handler = move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(Outcome::Interrupted.exit_code().into());
        }
        console.note("stopping; what is finished will be written (Ctrl-C again to end at once)");
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        console.warn(format!("Ctrl-C will lose the unfinished picture: {error}"));
    }
    interrupted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn progress(interrupted: bool) -> RenderProgress {
        RenderProgress {
            display: Display::None,
            console: Console::new(true, false),
            interrupted: Arc::new(AtomicBool::new(interrupted)),
        }
    }

    #[test]
    fn an_interrupt_breaks_off() {
        assert_eq!(progress(false).advance(1, 2), ControlFlow::Continue(()));
        assert_eq!(progress(true).advance(1, 2), ControlFlow::Break(()));
    }

    #[test]
    fn plain_lines_tell_the_share_and_the_time_left() {
        assert_eq!(plain_line(0, 0, Duration::ZERO), "0 % traced");
        assert_eq!(plain_line(1, 4, Duration::from_secs(2)), "25 % traced, about 6 s left");
    }
}
