//! The finished picture: film, tone mapping, PNG/EXR/HDR files, difference metrics.
//!
//! Renderers return a [`Frame`]. It is written as it is ([`Picture`] to EXR), developed for a display
//! ([`Development`] to PNG) or shown as false colours ([`AovKind::preview`]). [`Output`] puts files in
//! place whole or not at all; [`load`] and [`Difference`] read them back and compare them.

mod aov;
mod colormap;
mod difference;
mod encode;
mod flip;
mod frame;
mod load;
mod metadata;
mod output;
mod picture;
mod preview;
mod summary;
mod tone;
mod transfer;

pub use aov::AovKind;
pub use difference::{Difference, DifferenceError, Metric};
pub use encode::{BitDepth, EncodeError, encode_exr, encode_hdr, encode_png, encode_preview};
pub use flip::flip;
pub use frame::{Frame, Progress, RayCounts, Renderer, SampleCounts, TraceTimes};
pub use load::{LoadError, LoadReason, load};
pub use metadata::Metadata;
pub use output::{Format, Output, OutputError, numbered, write_whole};
pub use picture::{Channel, Picture, Samples};
pub use preview::{Preview, difference_preview};
pub use summary::{MeanMax, Summary};
pub use tone::{Development, Tone, luminance};
pub use transfer::{linear_from_srgb, srgb_code, srgb_from_linear};

/// A black frame with everything in it, for tests.
#[cfg(test)]
pub(crate) fn test_frame(width: u32, height: u32) -> Frame {
    let pixels = width as usize * height as usize;
    Frame {
        width,
        height,
        texels: vec![crate::layout::Texel::default(); pixels],
        samples: SampleCounts::Same(1),
        aovs: Some(vec![crate::layout::Aov::default(); pixels]),
        float: crate::layout::Float::Strict,
        rays: RayCounts::default(),
        times: TraceTimes::default(),
        complete: true,
    }
}
