//! A text file in memory, which turns byte ranges into places for messages.

use std::fs::{self, File};
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::{Diagnostic, Location};

/// The longest text file that is read, in bytes: offsets and indices in it fit 32 bits.
const MAX_BYTES: u64 = 1 << 31;
/// The longest beginning of a line that a message shows, in characters.
const MAX_SHOWN: usize = 2000;

/// A text file in memory.
#[derive(Debug)]
pub(super) struct Source {
    /// Its path, as given.
    pub(super) path: PathBuf,
    /// Its text.
    pub(super) text: String,
}

impl Source {
    /// Read a UTF-8 file.
    pub(super) fn read(path: &Path) -> Result<Self, Diagnostic> {
        let bytes = read_bytes(path)?;
        String::from_utf8(bytes).map(|text| Self { path: path.into(), text }).map_err(|error| {
            let start = error.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
            let source = Self { path: path.into(), text };
            let place = source.locate(start..start + 1);
            Diagnostic::error("the file is not UTF-8 text").at(place)
        })
    }

    /// Read a file in any superset of ASCII; other bytes stand in names and comments only.
    pub(super) fn read_lossy(path: &Path) -> Result<Self, Diagnostic> {
        let bytes = read_bytes(path)?;
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
        Ok(Self { path: path.into(), text })
    }

    /// The place of a byte range: of its part in the first line.
    pub(super) fn locate(&self, span: Range<usize>) -> Location {
        self.locate_after(LineStart::FIRST, span)
    }

    /// The place of a byte range at or after the start of a line, in time that does not depend on what
    /// comes before.
    pub(super) fn locate_after(&self, known: LineStart, span: Range<usize>) -> Location {
        let start = floor_char(&self.text, span.start);
        let before = &self.text[known.offset.min(start)..start];
        let line_start = before.rfind('\n').map_or(start - before.len(), |at| start - before.len() + at + 1);
        let line = self.text[line_start..].lines().next().unwrap_or_default();
        let end = floor_char(&self.text, span.end).clamp(start, (line_start + line.len()).max(start));
        Location {
            file: self.path.clone(),
            line: known.number + before.matches('\n').count(),
            column: self.text[line_start..start].chars().count() + 1,
            length: self.text[start..end].chars().count().max(1),
            text: line.chars().take(MAX_SHOWN).collect(),
        }
    }
}

/// Where a line begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LineStart {
    /// The line's number, from 1.
    pub(super) number: usize,
    /// Byte offset of its first character.
    pub(super) offset: usize,
}

impl LineStart {
    /// The first line of any text.
    pub(super) const FIRST: Self = Self { number: 1, offset: 0 };
}

/// The last character boundary at or before a byte offset.
fn floor_char(text: &str, offset: usize) -> usize {
    let offset = offset.min(text.len());
    (0..=offset).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

/// Read a regular file of bearable size.
fn read_bytes(path: &Path) -> Result<Vec<u8>, Diagnostic> {
    check_regular(path)?;
    let cannot_read =
        |error: std::io::Error| Diagnostic::error(format!("cannot read {}: {error}", path.display()));
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(cannot_read)?;
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(cannot_read)?;
    if bytes.len() as u64 > MAX_BYTES {
        let message = format!("{} is larger than {} MiB", path.display(), MAX_BYTES >> 20);
        return Err(Diagnostic::error(message));
    }
    Ok(bytes)
}

/// Accept a path that names a file: not a directory, nor a device or pipe that might never end.
pub(super) fn check_regular(path: &Path) -> Result<(), Diagnostic> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_file() => Ok(()),
        Ok(_) => Err(Diagnostic::error(format!("{} is not a file", path.display()))),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            Err(Diagnostic::error(format!("there is no file {}", path.display())))
        }
        Err(error) => Err(Diagnostic::error(format!("cannot open {}: {error}", path.display()))),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn source(text: &str) -> Source {
        Source { path: "a.toml".into(), text: text.into() }
    }

    #[test]
    fn places_count_lines_and_characters_from_one() {
        let source = source("one\r\nzwö three\n");
        let place = source.locate(10..15);
        assert_eq!((place.line, place.column, place.length), (2, 5, 5));
        assert_eq!(place.text, "zwö three");
    }

    #[test]
    fn ranges_over_several_lines_or_beyond_the_end_are_cut() {
        let source = source("abc\ndef");
        let place = source.locate(1..7);
        assert_eq!((place.line, place.column, place.length), (1, 2, 2));
        let place = source.locate(50..60);
        assert_eq!((place.line, place.column, place.length), (2, 4, 1));
    }

    #[test]
    fn a_known_line_gives_the_same_place() {
        let source = source("one\ntwo\nthree four\n");
        let known = LineStart { number: 2, offset: 4 };
        assert_eq!(source.locate_after(known, 14..18), source.locate(14..18));
        assert_eq!(source.locate_after(known, 4..5), source.locate(4..5));
    }

    #[test]
    fn ranges_inside_a_character_do_not_panic() {
        assert_eq!(source("é").locate(1..1).column, 1);
    }

    #[test]
    fn files_that_are_not_text_are_located() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.toml");
        std::fs::write(&path, b"a = 1\nb = \xff").unwrap();
        let place = Source::read(&path).unwrap_err().location.unwrap();
        assert_eq!((place.line, place.column), (2, 5));
        assert_eq!(Source::read_lossy(&path).unwrap().text, "a = 1\nb = \u{fffd}");
    }

    #[test]
    fn directories_devices_and_missing_files_are_refused() {
        let directory = tempfile::tempdir().unwrap();
        assert!(Source::read(directory.path()).unwrap_err().message.contains("is not a file"));
        let missing = directory.path().join("none.toml");
        assert!(Source::read(&missing).unwrap_err().message.contains("there is no file"));
        assert!(Source::read(Path::new("/dev/zero")).is_err());
    }
}
