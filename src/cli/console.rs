//! What people read: chatter on standard error, reports on standard output.

use std::fmt::Display;
use std::io::{IsTerminal, Write, stderr};

use super::CliError;
use crate::film::Output;
use crate::scene::Diagnostic;

/// How much is said on standard error, and whether in colour.
#[derive(Debug, Clone, Copy)]
pub(super) struct Console {
    quiet: bool,
    verbose: bool,
    color: bool,
}

impl Console {
    /// Colour only on a terminal, and without `NO_COLOR` (<https://no-color.org>).
    pub(super) fn new(quiet: bool, verbose: bool) -> Self {
        let no_color = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        Self { quiet, verbose, color: stderr().is_terminal() && !no_color }
    }

    /// Whether a progress bar can be drawn.
    pub(super) fn has_terminal(self) -> bool {
        !self.quiet && stderr().is_terminal()
    }

    /// Whether more is wanted.
    pub(super) fn is_verbose(self) -> bool {
        self.verbose
    }

    /// A line that most people want to see.
    pub(super) fn note(self, message: impl Display) {
        if !self.quiet {
            say(message);
        }
    }

    /// A line for those who asked for more.
    pub(super) fn detail(self, message: impl Display) {
        if self.verbose {
            say(message);
        }
    }

    /// Something legal but suspicious, in one sentence.
    pub(super) fn warn(self, message: impl Into<String>) {
        self.warn_of(&Diagnostic {
            severity: crate::scene::Severity::Warning,
            message: message.into(),
            location: None,
            hint: None,
        });
    }

    /// Something legal but suspicious in a user's file.
    pub(super) fn warn_of(self, diagnostic: &Diagnostic) {
        self.note(diagnostic.render(self.color));
    }

    /// An error, once; quiet or not.
    pub(super) fn error(self, error: &CliError) {
        if !error.is_closed_pipe() {
            say(error.render(self.color));
        }
    }
}

/// A line to standard error. If that is closed nobody can be told, and nothing needs to be.
fn say(message: impl Display) {
    let _ = writeln!(stderr(), "{message}");
}

/// A report to standard output, whole.
pub(super) fn print(report: &str) -> Result<(), CliError> {
    Ok(Output::Stdout.write(report.as_bytes())?)
}

/// A report to standard output as one JSON object.
pub(super) fn print_json(report: &impl serde::Serialize) -> Result<(), CliError> {
    let mut text = serde_json::to_string_pretty(report).map_err(CliError::Json)?;
    text.push('\n');
    print(&text)
}
