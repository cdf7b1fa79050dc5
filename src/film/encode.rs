//! Pictures to the bytes of PNG, EXR and HDR files.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    LineOrder, Text, WritableImage,
};
use image::codecs::hdr::HdrEncoder;
use png::{ColorType, SrgbRenderingIntent};

use super::{Development, Metadata, Picture, Preview, Samples, srgb_code};

/// Bits of a PNG channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BitDepth {
    /// 256 levels.
    #[default]
    Eight,
    /// 65536 levels.
    Sixteen,
}

/// A picture that a file format cannot hold.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// From the PNG encoder.
    #[error("PNG: {0}")]
    Png(#[from] png::EncodingError),
    /// From the EXR encoder.
    #[error("EXR: {0}")]
    Exr(#[from] exr::error::Error),
    /// From the HDR encoder.
    #[error("HDR: {0}")]
    Hdr(#[from] image::ImageError),
}

/// A PNG with the sRGB transfer function, from linear display values in [0, 1].
///
/// # Errors
/// [`EncodeError::Png`] for a picture without pixels.
pub fn encode_png(
    width: u32,
    height: u32,
    display: &[[f32; 3]],
    depth: BitDepth,
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    let channels = display.iter().flatten();
    let (depth, bytes) = match depth {
        BitDepth::Eight => (png::BitDepth::Eight, channels.map(|&v| srgb_code(v, 255) as u8).collect()),
        BitDepth::Sixteen => {
            let codes = channels.flat_map(|&v| srgb_code(v, 65535).to_be_bytes());
            (png::BitDepth::Sixteen, codes.collect::<Vec<u8>>())
        }
    };
    png_bytes(width, height, depth, &bytes, metadata)
}

/// An 8-bit PNG of false colours; the legend goes with the metadata.
///
/// # Errors
/// [`EncodeError::Png`] for a picture without pixels.
pub fn encode_preview(
    width: u32,
    height: u32,
    preview: &Preview,
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    let metadata = metadata.clone().with("legend", preview.legend.as_str());
    png_bytes(width, height, png::BitDepth::Eight, preview.pixels.as_flattened(), &metadata)
}

fn png_bytes(
    width: u32,
    height: u32,
    depth: png::BitDepth,
    bytes: &[u8],
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(depth);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    for (key, value) in metadata.iter() {
        encoder.add_itxt_chunk(key.to_owned(), value.to_owned())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    Ok(file)
}

/// An EXR that holds every bit of the picture: f32 and u32 planes, compressed without loss.
///
/// # Errors
/// [`EncodeError::Exr`] for a picture without pixels or with a plane of the wrong length.
pub fn encode_exr(picture: &Picture, metadata: &Metadata) -> Result<Vec<u8>, EncodeError> {
    let channels = picture.channels.iter().map(|channel| {
        let samples = match &channel.samples {
            Samples::F32(values) => FlatSamples::F32(values.clone()),
            Samples::U32(values) => FlatSamples::U32(values.clone()),
        };
        AnyChannel::new(latin(&channel.name), samples)
    });
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let size = (picture.width as usize, picture.height as usize);
    let layer = Layer::new(size, exr_attributes(metadata), encoding, AnyChannels::sort(channels.collect()));
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut file)?;
    Ok(file.into_inner())
}

fn exr_attributes(metadata: &Metadata) -> LayerAttributes {
    let mut attributes = LayerAttributes::default();
    for (key, value) in metadata.iter() {
        if key == Metadata::SOFTWARE {
            attributes.software_name = Some(latin(value));
        } else {
            attributes.other.insert(latin(key), exr::prelude::AttributeValue::Text(latin(value)));
        }
    }
    attributes
}

/// EXR texts hold Latin-1 only; other characters become '?'.
fn latin(text: &str) -> Text {
    let bytes: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap_or(b'?')).collect();
    Text::from_slice_unchecked(&bytes)
}

/// A Radiance HDR (RGBE, 8 bits of mantissa): linear, but neither exact nor signed, and without metadata.
///
/// Pixels that are not finite become [`Development::NON_FINITE`]; negative channels become 0.
///
/// # Errors
/// [`EncodeError::Hdr`] as the encoder reports.
pub fn encode_hdr(width: u32, height: u32, radiance: &[[f32; 3]]) -> Result<Vec<u8>, EncodeError> {
    let representable = |pixel: &[f32; 3]| {
        if pixel.iter().all(|v| v.is_finite()) { pixel.map(|v| v.max(0.0)) } else { Development::NON_FINITE }
    };
    let pixels: Vec<_> = radiance.iter().map(|pixel| image::Rgb(representable(pixel))).collect();
    let mut file = Vec::new();
    HdrEncoder::new(&mut file).encode(&pixels, width as usize, height as usize)?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn metadata() -> Metadata {
        Metadata::new().with("scene", "glaçon 氷.toml").with("seconds", "1.5")
    }

    #[test]
    fn a_png_declares_srgb_and_tells_its_origin_in_unicode() {
        let bytes = encode_png(1, 1, &[[1.0, 0.0, 0.18]], BitDepth::Eight, &metadata()).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = [0; 3];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, [255, 0, 118]);
        assert_eq!(reader.info().srgb, Some(SrgbRenderingIntent::Perceptual));
        let texts: Vec<_> =
            reader.info().utf8_text.iter().map(|t| (&*t.keyword, t.get_text().unwrap())).collect();
        assert_eq!(texts[1], ("scene", "glaçon 氷.toml".to_owned()));
        assert_eq!(texts[2], ("seconds", "1.5".to_owned()));
    }

    #[test]
    fn a_16_bit_png_is_big_endian() {
        let bytes = encode_png(1, 1, &[[1.0, 0.0, 0.5]], BitDepth::Sixteen, &metadata()).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = [0; 6];
        reader.next_frame(&mut pixels).unwrap();
        // 0.5 is 0.735357 after the transfer function.
        assert_eq!(pixels[..4], [255, 255, 0, 0]);
        assert_eq!(u16::from_be_bytes([pixels[4], pixels[5]]), 48192);
    }

    #[test]
    fn exr_texts_replace_what_latin_1_cannot_hold() {
        assert_eq!(latin("glaçon 氷").to_string(), "glaçon ?");
    }

    #[test]
    fn a_picture_without_pixels_is_refused() {
        assert!(encode_png(0, 0, &[], BitDepth::Eight, &metadata()).is_err());
    }
}
