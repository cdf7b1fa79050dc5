//! A text file in memory, which turns byte ranges into places for messages.

use std::cell::OnceCell;
use std::fs::{self, File};
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::{Diagnostic, Location};

/// The longest scene file that is read, in bytes.
const MAX_SCENE_BYTES: u64 = 1 << 24;
/// The longest mesh or material file that is read, in bytes: offsets in it fit 32 bits, even where each byte
/// is replaced by the three of U+FFFD.
const MAX_MESH_BYTES: u64 = 1 << 30;
/// The longest beginning of a line that a message shows, in characters.
const MAX_SHOWN: usize = 2000;

/// A text file in memory.
#[derive(Debug)]
pub(super) struct Source {
    /// Its path, as given.
    pub(super) path: PathBuf,
    /// Its text.
    pub(super) text: String,
    /// Byte offset of the start of every line; found when the first place is asked for.
    lines: OnceCell<Vec<u32>>,
}

impl Source {
    /// A text that is already in memory, of less than 4 GiB.
    pub(super) fn new(path: &Path, text: String) -> Self {
        Self { path: path.into(), text, lines: OnceCell::new() }
    }

    /// Read a scene file: UTF-8.
    pub(super) fn read(path: &Path) -> Result<Self, Diagnostic> {
        let bytes = read_bytes(path, MAX_SCENE_BYTES)?;
        String::from_utf8(bytes).map(|text| Self::new(path, text)).map_err(|error| {
            let start = error.utf8_error().valid_up_to();
            let source = Self::new(path, String::from_utf8_lossy(error.as_bytes()).into_owned());
            Diagnostic::error("the file is not UTF-8 text").at(source.locate(start..start + 1))
        })
    }

    /// Read a mesh or material file, in any superset of ASCII: other bytes stand in names and comments only.
    pub(super) fn read_lossy(path: &Path) -> Result<Self, Diagnostic> {
        let bytes = read_bytes(path, MAX_MESH_BYTES)?;
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
        Ok(Self::new(path, text))
    }

    /// The place of a byte range: of its part in the first line.
    pub(super) fn locate(&self, span: Range<usize>) -> Location {
        let start = self.text.floor_char_boundary(span.start);
        let lines = self.lines.get_or_init(|| line_starts(&self.text));
        let number = lines.partition_point(|&line| line as usize <= start).max(1);
        let line_start = lines[number - 1] as usize;
        let line = self.text[line_start..].lines().next().unwrap_or_default();
        let line_end = (line_start + line.len()).max(start);
        let end = self.text.floor_char_boundary(span.end).clamp(start, line_end);
        Location {
            file: self.path.clone(),
            line: number as u32,
            column: self.text[line_start..start].chars().count() as u32 + 1,
            length: (self.text[start..end].chars().count() as u32).max(1),
            text: line.chars().take(MAX_SHOWN).collect(),
        }
    }

    /// The place of a slice of this text.
    pub(super) fn locate_str(&self, part: &str) -> Location {
        let start = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        self.locate(start..start + part.len())
    }
}

/// Byte offset of the start of every line, at least of one.
fn line_starts(text: &str) -> Vec<u32> {
    std::iter::once(0).chain(text.match_indices('\n').map(|(newline, _)| newline as u32 + 1)).collect()
}

/// Read a regular file of bearable size.
fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, Diagnostic> {
    check_regular(path)?;
    let cannot_read =
        |error: std::io::Error| Diagnostic::error(format!("cannot read {}: {error}", path.display()));
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(cannot_read)?;
    file.take(most + 1).read_to_end(&mut bytes).map_err(cannot_read)?;
    if bytes.len() as u64 > most {
        let message = format!("{} is larger than {} MiB", path.display(), most >> 20);
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
        Source::new(Path::new("a.toml"), text.into())
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
    fn a_slice_is_found_by_its_address() {
        let source = source("one\ntwo one\n");
        assert_eq!(source.locate_str(&source.text[8..11]), source.locate(8..11));
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
