//! Files that appear whole or not at all.

use std::ffi::OsStr;
use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A picture file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Developed for a display, sRGB, 8 or 16 bits a channel.
    Png,
    /// Linear, exact.
    Exr,
    /// Linear, 8 bits of mantissa.
    Hdr,
}

impl Format {
    /// The format that a path's extension names, upper or lower case.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            "hdr" => Some(Self::Hdr),
            _ => None,
        }
    }
}

/// Where a picture goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Output {
    /// Standard output, as PNG.
    Stdout,
    /// A file; its folder exists.
    File {
        /// The file.
        path: PathBuf,
        /// From its extension.
        format: Format,
    },
}

/// A file that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// No extension, or one of another format.
    #[error("{}: cannot tell the picture format; end the name with .png, .exr or .hdr", .0.display())]
    Format(PathBuf),
    /// The folder does not exist.
    #[error("{}: no such folder: {}", path.display(), folder.display())]
    Folder {
        /// The file.
        path: PathBuf,
        /// Where it should go.
        folder: PathBuf,
    },
    /// The path names a folder.
    #[error("{}: is a folder, not a file", .0.display())]
    IsFolder(PathBuf),
    /// From the file system.
    #[error("cannot write {output}: {error}")]
    Io {
        /// Where it should go.
        output: Output,
        /// Why not.
        #[source]
        error: io::Error,
    },
}

impl Output {
    /// Where a path on the command line points; `-` is standard output.
    ///
    /// # Errors
    /// An unknown extension, a missing folder, a folder in place of a file: told before any work is done.
    pub fn new(path: &Path) -> Result<Self, OutputError> {
        if path == Path::new("-") {
            return Ok(Self::Stdout);
        }
        if path.is_dir() {
            return Err(OutputError::IsFolder(path.to_owned()));
        }
        let format = Format::of(path).ok_or_else(|| OutputError::Format(path.to_owned()))?;
        let folder = folder_of(path);
        if !folder.is_dir() {
            return Err(OutputError::Folder { path: path.to_owned(), folder: folder.to_owned() });
        }
        Ok(Self::File { path: path.to_owned(), format })
    }

    /// The format of what is written.
    #[must_use]
    pub fn format(&self) -> Format {
        match self {
            Self::Stdout => Format::Png,
            Self::File { format, .. } => *format,
        }
    }

    /// Write the whole file, or leave what was there before.
    ///
    /// # Errors
    /// [`OutputError::Io`]; no temporary file is left behind.
    pub fn write(&self, bytes: &[u8]) -> Result<(), OutputError> {
        let written = match self {
            Self::Stdout => write_stdout(bytes),
            Self::File { path, .. } => write_whole(path, bytes),
        };
        written.map_err(|error| OutputError::Io { output: self.clone(), error })
    }
}

impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stdout => f.write_str("standard output"),
            Self::File { path, .. } => write!(f, "{}", path.display()),
        }
    }
}

fn write_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(bytes)?;
    stdout.flush()
}

/// Write a file of any kind, whole, or leave what was there before: to a temporary file of the same folder, hence
/// of the same file system, which is then renamed.
///
/// # Errors
/// As the file system's; no temporary file is left behind.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut builder = tempfile::Builder::new();
    let prefix = [OsStr::new("."), path.file_name().unwrap_or_default(), OsStr::new(".")];
    let prefix: std::ffi::OsString = prefix.into_iter().collect();
    builder.prefix(&prefix);
    // A temporary file is private by default; the picture gets what the umask grants to any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder_of(path))?;
    file.write_all(bytes)?;
    file.persist(path).map_err(|failed| failed.error)?;
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// The name of one of many pictures: `ice.png` becomes `ice-007.png`.
#[must_use]
pub fn numbered(path: &Path, number: u32) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{number:03}.{extension}"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn the_extension_names_the_format_in_either_case() {
        assert_eq!(Output::new(Path::new("a.PNG")).unwrap().format(), Format::Png);
        assert_eq!(Output::new(Path::new("a.exr")).unwrap().format(), Format::Exr);
        assert_eq!(Output::new(Path::new("a.hdr")).unwrap().format(), Format::Hdr);
        assert_eq!(Output::new(Path::new("-")).unwrap(), Output::Stdout);
    }

    #[test]
    fn an_unknown_extension_is_refused_with_a_hint() {
        for path in ["ice.jpg", "ice", ".png"] {
            let message = Output::new(Path::new(path)).unwrap_err().to_string();
            assert!(message.starts_with(path) && message.contains(".png, .exr or .hdr"), "{message}");
        }
    }

    #[test]
    fn a_missing_folder_is_told_before_any_work_is_done() {
        let message = Output::new(Path::new("nowhere/ice.png")).unwrap_err().to_string();
        assert_eq!(message, "nowhere/ice.png: no such folder: nowhere");
    }

    #[test]
    fn a_file_is_replaced_and_no_other_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ice.png");
        std::fs::write(&path, "old").unwrap();
        Output::new(&path).unwrap().write(b"new").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(names_in(folder.path()), ["ice.png"]);
    }

    #[test]
    fn a_failed_write_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ice.png");
        let output = Output::new(&path).unwrap();
        // A folder in the way makes the final rename fail.
        std::fs::create_dir(&path).unwrap();
        let message = output.write(b"new").unwrap_err().to_string();
        assert!(message.starts_with(&format!("cannot write {}: ", path.display())), "{message}");
        assert_eq!(names_in(folder.path()), ["ice.png"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_new_file_is_as_readable_as_any_other() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("a.png"), folder.path().join("b.png"));
        Output::new(&ours).unwrap().write(b"a").unwrap();
        std::fs::write(&plain, "b").unwrap();
        let mode = |path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }

    #[test]
    fn pictures_are_numbered_before_their_extension() {
        assert_eq!(numbered(Path::new("a/ice.v2.png"), 7), Path::new("a/ice.v2-007.png"));
    }
}
