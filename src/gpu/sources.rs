//! The shader files, embedded in the binary.

use std::path::Path;
use std::{fs, io};

use super::assemble::Source;

macro_rules! sources {
    ($($stem:literal)*) => { &[$(($stem, include_str!(concat!("../../shaders/", $stem, ".wgsl")))),*] };
}

/// Every file of `shaders/` that traces, by stem. One object: who holds it is known by its address.
pub static SOURCES: &[Source<'static>] = sources! {
    "adaptive"
    "background"
    "bindings"
    "blocks"
    "bvh"
    "camera"
    "film"
    "hash"
    "light"
    "material"
    "math"
    "media"
    "probe"
    "probe_arithmetic"
    "probe_paths"
    "probe_plain"
    "probe_rays"
    "probe_scene"
    "rays"
    "real"
    "record"
    "records"
    "render"
    "sift"
    "surface"
    "texture"
    "triangle"
    "whitted"
    "wide"
};

/// The same files out of a folder, in place of those in the binary: for work on them. Their text is kept until the program
/// ends, some 100 kB each time, so that pipelines of every version may refer to it.
///
/// # Errors
/// The first file that cannot be read, with its path.
pub fn sources_in(folder: &Path) -> io::Result<&'static [Source<'static>]> {
    let read = |&(stem, _): &Source<'static>| {
        let path = folder.join(stem).with_extension("wgsl");
        let text = fs::read_to_string(&path)
            .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", path.display())))?;
        Ok((stem, &*text.leak()))
    };
    let sources: Vec<Source<'static>> = SOURCES.iter().map(read).collect::<io::Result<_>>()?;
    Ok(sources.leak())
}
