//! Frames to files, with what the files say about themselves.

use super::super::CliError;
use super::super::console::Console;
use crate::film::{
    AovKind, BitDepth, Development, Format, Frame, Metadata, Output, Picture, encode_exr, encode_hdr,
    encode_png, encode_preview,
};

/// How PNG files are developed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct PngOptions {
    pub(super) development: Development,
    pub(super) bits: BitDepth,
}

/// Write radiance: developed to PNG, as it is to EXR and HDR.
pub(super) fn write_radiance(
    frame: &Frame,
    output: &Output,
    png: PngOptions,
    metadata: &Metadata,
) -> Result<(), CliError> {
    let radiance = frame.radiance();
    let (width, height) = (frame.width, frame.height);
    let bytes = match output.format() {
        Format::Png => {
            let Development { tone, exposure } = png.development;
            let metadata =
                metadata.clone().with("tone curve", tone.name()).with("exposure", format!("{exposure} EV"));
            encode_png(width, height, &png.development.apply(&radiance), png.bits, &metadata)?
        }
        Format::Exr => encode_exr(&Picture::from_rgb(width, height, &radiance), metadata)?,
        Format::Hdr => encode_hdr(width, height, &radiance)?,
    };
    Ok(output.write(&bytes)?)
}

/// Write an AOV: exact to EXR, in false colours to PNG.
pub(super) fn write_aov(
    frame: &Frame,
    kind: AovKind,
    output: &Output,
    metadata: &Metadata,
    console: Console,
) -> Result<(), CliError> {
    let absent = || CliError::usage(format!("the device gave no {}", kind.name()));
    let metadata = metadata.clone().with("aov", kind.name());
    let bytes = if output.format() == Format::Exr {
        encode_exr(&kind.picture(frame).ok_or_else(absent)?, &metadata)?
    } else {
        let preview = kind.preview(frame).ok_or_else(absent)?;
        console.note(format!("{output}: {}: {}", kind.name(), preview.legend));
        encode_preview(frame.width, frame.height, &preview, &metadata)?
    };
    Ok(output.write(&bytes)?)
}
