//! Picture files back to planes.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use exr::prelude::{AnyChannels, FlatSamples, Layer, ReadChannels, ReadLayers, read};
use image::DynamicImage;

use super::{Channel, Picture, Samples, linear_from_srgb};

/// The first four bytes of every EXR (OpenEXR file layout, "Magic number").
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// A picture that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read the picture {}: {reason}", path.display())]
pub struct LoadError {
    /// The file.
    pub path: PathBuf,
    /// Why.
    #[source]
    pub reason: LoadReason,
}

/// Why a picture cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum LoadReason {
    /// From the file system.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// From the EXR decoder.
    #[error("{0}")]
    Exr(#[from] exr::error::Error),
    /// From the PNG or HDR decoder.
    #[error("{0}")]
    Image(#[from] image::ImageError),
    /// Layers of an EXR that do not cover the same pixels.
    #[error("its layers differ in size")]
    Layers,
}

/// Read a picture as linear planes; its first bytes tell the format.
///
/// EXR: every plane of every layer as it is, half floats widened, planes of a named layer called
/// `layer.plane`. HDR: linear R, G, B. PNG and JPEG: R, G, B decoded from sRGB; alpha is left out.
///
/// # Errors
/// [`LoadError`] for a file that is missing, broken or of another format.
pub fn load(path: &Path) -> Result<Picture, LoadError> {
    std::fs::read(path)
        .map_err(LoadReason::from)
        .and_then(|bytes| decode(&bytes))
        .map_err(|reason| LoadError { path: path.to_owned(), reason })
}

fn decode(bytes: &[u8]) -> Result<Picture, LoadReason> {
    if bytes.starts_with(&EXR_MAGIC) {
        decode_exr(bytes)
    } else {
        Ok(decode_rgb(image::load_from_memory(bytes)?))
    }
}

fn decode_exr(bytes: &[u8]) -> Result<Picture, LoadReason> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))?;
    let size = image.layer_data.first().map(|layer| layer.size).unwrap_or_default();
    if image.layer_data.iter().any(|layer| layer.size != size) {
        return Err(LoadReason::Layers);
    }
    let channels = image.layer_data.into_iter().flat_map(layer_channels).collect();
    Ok(Picture::new(size.width() as u32, size.height() as u32, channels))
}

fn layer_channels(layer: Layer<AnyChannels<FlatSamples>>) -> Vec<Channel> {
    let prefix = layer.attributes.layer_name.map(|name| format!("{name}.")).unwrap_or_default();
    let planes = layer.channel_data.list.into_iter().map(|plane| Channel {
        name: format!("{prefix}{}", plane.name),
        samples: match plane.sample_data {
            FlatSamples::F16(values) => Samples::F32(values.into_iter().map(|v| v.to_f32()).collect()),
            FlatSamples::F32(values) => Samples::F32(values),
            FlatSamples::U32(values) => Samples::U32(values),
        },
    });
    planes.collect()
}

fn decode_rgb(image: DynamicImage) -> Picture {
    let (width, height) = (image.width(), image.height());
    let linear: Vec<[f32; 3]> = match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            image.into_rgb32f().pixels().map(|pixel| pixel.0).collect()
        }
        // Widening 8 bits to 16 multiplies by 257, so that code/max is kept exactly.
        _ => {
            let table: Vec<f32> =
                (0..=u16::MAX).map(|code| linear_from_srgb(f64::from(code) / 65535.0) as f32).collect();
            image.into_rgb16().pixels().map(|pixel| pixel.0.map(|code| table[code as usize])).collect()
        }
    };
    Picture::from_rgb(width, height, &linear)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::film::{BitDepth, Metadata, encode_exr, encode_hdr, encode_png};

    #[test]
    fn exr_keeps_every_bit_of_both_types() {
        let values = [0.0, -0.0, 1e-40, f32::MAX, f32::INFINITY, f32::from_bits(0x7fc0_1234)];
        let ids = [0, 1, u32::MAX, 1 << 31, 77, 0x7fc0_0000];
        let picture = Picture::new(
            3,
            2,
            vec![Channel::f32("Z", values.into_iter()), Channel::u32("body", ids.into_iter())],
        );
        let bytes = encode_exr(&picture, &Metadata::new().with("scene", "ice.toml")).unwrap();
        let loaded = decode(&bytes).unwrap();
        for (wrote, read) in picture.channels.iter().zip(&loaded.channels) {
            assert_eq!(wrote.name, read.name);
            assert_eq!(wrote.samples.type_name(), read.samples.type_name());
            for i in 0..6 {
                assert_eq!(wrote.samples.bits(i), read.samples.bits(i), "{} {i}", wrote.name);
            }
        }
        assert_eq!((loaded.width, loaded.height, loaded.channels.len()), (3, 2, 2));
    }

    #[test]
    fn png_comes_back_as_linear_light_to_half_a_level() {
        let display = [[0.0, 0.18, 1.0], [0.001, 0.5, 0.75]];
        let bytes = encode_png(2, 1, &display, BitDepth::Sixteen, &Metadata::new()).unwrap();
        let picture = decode(&bytes).unwrap();
        for (plane, i) in picture.rgb().unwrap().into_iter().zip(0..) {
            for (pixel, want) in display.iter().enumerate() {
                assert!((plane.samples.value(pixel) - f64::from(want[i])).abs() < 2e-5);
            }
        }
    }

    #[test]
    fn hdr_is_linear_to_its_eight_bits() {
        let bytes = encode_hdr(1, 1, &[[4.0, 0.5, 0.0]]).unwrap();
        let picture = decode(&bytes).unwrap();
        let rgb = picture.rgb().unwrap().map(|c| c.samples.value(0));
        for (got, want) in rgb.into_iter().zip([4.0, 0.5, 0.0]) {
            assert!((got - want).abs() <= 4.0 / 128.0, "{rgb:?}");
        }
    }

    #[test]
    fn a_truncated_exr_is_an_error() {
        let bytes = encode_exr(&Picture::from_rgb(2, 2, &[[0.5; 3]; 4]), &Metadata::new()).unwrap();
        assert!(decode(&bytes[..bytes.len() - 8]).is_err());
    }

    #[test]
    fn a_missing_file_is_named() {
        let message = load(Path::new("nowhere/none.png")).unwrap_err().to_string();
        assert!(message.starts_with("cannot read the picture nowhere/none.png: "), "{message}");
    }
}
