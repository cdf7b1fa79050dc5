//! A message about a user's file: what is wrong, where, and what to do.

use std::path::PathBuf;

use annotate_snippets::renderer::Renderer;
use annotate_snippets::{AnnotationKind, Group, Level, Snippet};

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
    pub line: u32,
    /// From 1, in characters.
    pub column: u32,
    /// How many characters to underline, ≥ 1.
    pub length: u32,
    /// The text of the line, without its end; of a very long line only the beginning.
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

impl Diagnostic {
    /// A fault: nothing can be rendered.
    #[must_use]
    pub fn error(message: impl Into<String>) -> Self {
        Self { severity: Severity::Error, message: message.into(), location: None, hint: None }
    }

    /// A suspicion: the picture may not be what was meant.
    #[must_use]
    pub fn warning(message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(message) }
    }

    /// The same at a place.
    #[must_use]
    pub fn at(self, location: Location) -> Self {
        Self { location: Some(location), ..self }
    }

    /// The same with advice.
    #[must_use]
    pub fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }

    /// The message as a compiler would print it: file, line and column, the line with a caret, the hint.
    /// Several lines without a last line break; `color` adds ANSI escapes.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        let level = match self.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let title = level.primary_title(&self.message);
        let mut group = match &self.location {
            Some(location) => title.element(location.snippet()),
            None => Group::with_title(title),
        };
        if let Some(hint) = &self.hint {
            group = group.element(Level::HELP.message(hint));
        }
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group])
    }
}

impl Location {
    /// The line with a caret under the place.
    fn snippet(&self) -> Snippet<'_, annotate_snippets::Annotation<'_>> {
        let start = byte_of_char(&self.text, self.column.saturating_sub(1));
        let end = byte_of_char(&self.text, self.column.saturating_sub(1).saturating_add(self.length));
        Snippet::source(&self.text)
            .path(self.file.to_string_lossy())
            .line_start(self.line as usize)
            .annotation(AnnotationKind::Primary.span(start..end))
    }
}

/// Where the character number `count` starts; the end of the text if it is shorter.
fn byte_of_char(text: &str, count: u32) -> usize {
    text.char_indices().nth(count as usize).map_or(text.len(), |(byte, _)| byte)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn location(text: &str, column: u32, length: u32) -> Location {
        Location { file: "glass.toml".into(), line: 12, column, length, text: text.into() }
    }

    #[test]
    fn shows_place_caret_and_hint() {
        let rendered = Diagnostic::error("unknown key `fov`")
            .at(location("fov = 35", 1, 3))
            .hint("did you mean `fov_y`?")
            .render(false);
        assert_eq!(
            rendered,
            "error: unknown key `fov`\n  --> glass.toml:12:1\n   |\n12 | fov = 35\n   | ^^^\n   |\n   = help: did you mean `fov_y`?"
        );
    }

    #[test]
    fn columns_count_characters_not_bytes() {
        let rendered = Diagnostic::warning("odd").at(location("é é = 1", 3, 1)).render(false);
        assert!(rendered.contains("glass.toml:12:3"), "{rendered}");
    }

    #[test]
    fn places_beyond_the_line_do_not_panic() {
        for (text, column, length) in [("", 1, 1), ("abc", 4, 1), ("abc", 900, u32::MAX)] {
            let rendered = Diagnostic::error("odd").at(location(text, column, length)).render(true);
            assert!(rendered.contains("glass.toml"), "{rendered}");
        }
    }

    #[test]
    fn escape_sequences_of_a_file_do_not_reach_the_terminal() {
        let rendered = Diagnostic::error("odd \u{1b}[2J").at(location("\u{1b}[2J", 1, 1)).render(false);
        assert!(!rendered.contains('\u{1b}'), "{rendered:?}");
    }

    #[test]
    fn color_adds_escapes() {
        let diagnostic = Diagnostic::error("odd");
        assert!(diagnostic.render(true).contains('\u{1b}'));
        assert_eq!(diagnostic.render(false), "error: odd");
    }
}
