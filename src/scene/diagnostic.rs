//! A message about a user's file: what is wrong, where, and what to do.

use std::path::PathBuf;

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// Nothing can be rendered.
    Error,
    /// The picture may not be what was meant.
    Warning,
}

/// A place in a text file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Location {
    /// The file.
    pub file: PathBuf,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
    /// How many characters to underline, ≥ 1.
    pub length: usize,
    /// The text of the line, without its end.
    pub text: String,
}

/// A message about a user's file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong, in one sentence.
    pub message: String,
    /// Where; absent when it concerns no single place.
    pub location: Option<Location>,
    /// What to do.
    pub hint: Option<String>,
}
