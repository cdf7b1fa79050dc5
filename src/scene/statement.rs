//! The statements of an OBJ or MTL file: lines of words, with comments and continued lines.

use super::source::Source;
use super::{Diagnostic, Location, SceneError, number};

/// A statement: a keyword and what follows it. Its parts are slices of the source's text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Statement<'a> {
    /// The first word.
    pub(super) keyword: &'a str,
    /// What follows, trimmed: a name may hold spaces and hashes. A continued line still has its backslash and
    /// line break here.
    pub(super) rest: &'a str,
    source: &'a Source,
}

impl<'a> Statement<'a> {
    /// The words after the keyword, up to a comment.
    pub(super) fn words(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        let text = self.rest.split('#').next().unwrap_or_default();
        text.split(|c: char| c.is_ascii_whitespace() || c == '\\').filter(|word| !word.is_empty())
    }

    /// The place of a part of this statement.
    pub(super) fn locate(&self, part: &str) -> Location {
        self.source.locate_str(part)
    }

    /// A fault in a part of this statement.
    pub(super) fn fault(&self, part: &str, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(message).at(self.locate(part))
    }

    /// Read the name after the keyword; it may hold spaces.
    pub(super) fn reference(&self) -> Result<Reference, SceneError> {
        if self.rest.is_empty() {
            let message = format!("`{}` needs a name", self.keyword);
            return Err(self.fault(self.keyword, message).into());
        }
        Ok(Reference { name: self.rest.to_owned(), location: self.locate(self.rest) })
    }

    /// Read one word as a finite number.
    pub(super) fn number(&self, word: &str) -> Result<f64, SceneError> {
        let value: f64 = word.parse().map_err(|_| self.fault(word, format!("`{word}` is not a number")))?;
        Ok(number::check_finite(value).map_err(|reason| self.fault(word, reason.to_string()))?)
    }

    /// Read the first `N` words as finite numbers; the others must be numbers too, and are left out.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N], SceneError> {
        let mut numbers = [0.0; N];
        let mut count = 0;
        for word in self.words() {
            let value = self.number(word)?;
            if let Some(slot) = numbers.get_mut(count) {
                *slot = value;
            }
            count += 1;
        }
        if count < N {
            let message = format!("`{}` needs {N} numbers, found {count}", self.keyword);
            return Err(self.fault(self.keyword, message).into());
        }
        Ok(numbers)
    }
}

/// A name that stands for something in another file.
#[derive(Debug, Clone)]
pub(super) struct Reference {
    /// The name.
    pub(super) name: String,
    /// Where it is written.
    pub(super) location: Location,
}

/// Iterates over the statements of a source.
#[derive(Debug)]
pub(super) struct Statements<'a> {
    source: &'a Source,
    rest: &'a str,
}

impl<'a> Statements<'a> {
    pub(super) fn new(source: &'a Source) -> Self {
        Self { source, rest: source.text.trim_start_matches('\u{feff}') }
    }

    /// Cut the next line off, with the lines that continue it.
    fn next_line(&mut self) -> Option<&'a str> {
        let ends = self.rest.match_indices('\n').map(|(newline, _)| newline + 1);
        let mut ends = ends.chain(std::iter::once(self.rest.len()));
        let is_whole = |end: &usize| {
            let line = &self.rest[..*end];
            let line = line.strip_suffix('\n').unwrap_or(line);
            !line.strip_suffix('\r').unwrap_or(line).ends_with('\\')
        };
        let end = ends.find(is_whole).unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        (!line.is_empty()).then_some(line)
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = Statement<'a>;

    fn next(&mut self) -> Option<Statement<'a>> {
        loop {
            let line = self.next_line()?;
            let text = line.trim_ascii();
            match text.split_ascii_whitespace().next() {
                None => {}
                Some(keyword) if keyword.starts_with('#') => {}
                Some(keyword) => {
                    let rest = text[keyword.len()..].trim_ascii();
                    return Some(Statement { keyword, rest, source: self.source });
                }
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;

    fn source(text: &str) -> Source {
        Source::new(Path::new("a.obj"), text.into())
    }

    #[test]
    fn comments_blank_lines_and_the_byte_order_mark_are_skipped() {
        let source = source("\u{feff}# a\r\n\r\n  v 1 2 # b\n\tusemtl old glass #2 \n#");
        let statements: Vec<_> = Statements::new(&source).collect();
        assert_eq!(statements.len(), 2);
        assert_eq!(statements[0].words().collect::<Vec<_>>(), ["1", "2"]);
        assert_eq!((statements[1].keyword, statements[1].rest), ("usemtl", "old glass #2"));
    }

    #[test]
    fn a_backslash_continues_a_line() {
        let source = source("f 1 2 \\\n 3 4\\\r\n5\nv 1");
        let statements: Vec<_> = Statements::new(&source).collect();
        assert_eq!(statements[0].words().collect::<Vec<_>>(), ["1", "2", "3", "4", "5"]);
        let fourth = statements[0].words().nth(3).unwrap();
        let place = statements[0].locate(fourth);
        assert_eq!((place.line, place.column), (2, 4));
        assert_eq!(statements[1].locate(statements[1].rest).line, 4);
    }

    #[test]
    fn a_backslash_at_the_very_end_is_harmless() {
        assert_eq!(Statements::new(&source("f 1 \\")).count(), 1);
        assert_eq!(Statements::new(&source("f 1 \\\n")).count(), 1);
        assert_eq!(Statements::new(&source("f 1 \\\n\nv 1")).count(), 2);
    }

    #[test]
    fn numbers_are_finite_and_enough() {
        let source = source("v 1 2 3 4\nv 1 x 3\nv 1 2\nv nan 0 0\nv 0 1e39 0");
        let results: Vec<_> = Statements::new(&source).map(|s| s.numbers::<3>()).collect();
        assert_eq!(results[0], Ok([1.0, 2.0, 3.0]));
        let places: Vec<_> = results[1..]
            .iter()
            .map(|result| result.clone().unwrap_err().diagnostics()[0].location.clone().unwrap())
            .map(|place| (place.line, place.column))
            .collect();
        assert_eq!(places, [(2, 5), (3, 1), (4, 3), (5, 5)]);
    }
}
