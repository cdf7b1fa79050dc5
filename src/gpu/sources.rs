//! The shader files, embedded in the binary.

use super::assemble::Source;

macro_rules! sources {
    ($($stem:literal)*) => { &[$(($stem, include_str!(concat!("../../shaders/", $stem, ".wgsl")))),*] };
}

/// Every file of `shaders/` that traces, by stem.
pub const SOURCES: &[Source<'static>] = sources! {
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
