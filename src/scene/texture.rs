//! Pictures: decoded once for each file, checked, and bounded in size.

use std::collections::HashMap;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use image::{ColorType, DynamicImage, ImageDecoder, ImageReader};

use super::source::check_regular;
use super::{Diagnostic, Limits, Pixels, Texture, TextureId};

/// The most pixels in a row or column.
const MAX_SIDE: u32 = 16384;
/// What a decoder may allocate for a pixel, in bytes: two copies in f32 RGBA.
const MAX_ALLOCATION: u64 = 2 * 16;

/// What a picture is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    /// Multiplies a surface colour, so that only sRGB is accepted: no channel exceeds 1.
    Surface,
    /// Shines from all around.
    Background,
}

/// The pictures read so far.
#[derive(Debug, Default)]
pub(super) struct Textures {
    /// Indexed by [`TextureId`].
    pub(super) list: Vec<Texture>,
    ids: HashMap<PathBuf, TextureId>,
    pixels: u64,
    limits: Limits,
}

impl Textures {
    /// None yet.
    pub(super) fn within(limits: Limits) -> Self {
        Self { limits, ..Self::default() }
    }

    /// Read a picture, or find it among those already read.
    pub(super) fn load(&mut self, path: &Path, purpose: Purpose) -> Result<TextureId, Diagnostic> {
        let id = match self.ids.get(path) {
            Some(&id) => id,
            None => {
                let texture = read(path, self.limits.pixels)?;
                self.count(&texture)?;
                let id = TextureId(self.list.len());
                self.list.push(texture);
                self.ids.insert(path.into(), id);
                id
            }
        };
        if purpose == Purpose::Surface && matches!(self.list[id.0].pixels, Pixels::Linear(_)) {
            let message = format!("{} holds linear radiance, not a surface colour", path.display());
            return Err(Diagnostic::error(message).hint("use a PNG or JPEG; HDR and EXR are for backgrounds"));
        }
        Ok(id)
    }

    /// Count a picture's pixels; refuse more than memory should hold.
    fn count(&mut self, texture: &Texture) -> Result<(), Diagnostic> {
        self.pixels += u64::from(texture.width) * u64::from(texture.height);
        let most = self.limits.pixels.saturating_mul(4);
        if self.pixels > most {
            let message = format!("the pictures have {} pixels; the most is {most}", self.pixels);
            return Err(Diagnostic::error(message).hint("use smaller pictures"));
        }
        Ok(())
    }
}

/// Read a picture of at most `most` pixels: PNG and JPEG as sRGB, HDR and EXR as linear radiance.
fn read(path: &Path, most: u64) -> Result<Texture, Diagnostic> {
    check_regular(path)?;
    let broken = |error: image::ImageError| {
        Diagnostic::error(format!("cannot decode {}: {error}", path.display()))
            .hint("pictures are PNG, JPEG, Radiance HDR or OpenEXR")
    };
    let file = File::open(path)
        .map_err(|error| Diagnostic::error(format!("cannot open {}: {error}", path.display())))?;
    let reader = ImageReader::new(BufReader::new(file));
    let mut reader = reader.with_guessed_format().map_err(|error| broken(error.into()))?;
    reader.limits(limits(most));
    let decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 || u64::from(width) * u64::from(height) > most {
        let message = format!("{} has {width} × {height} pixels; the most is {most}", path.display());
        return Err(Diagnostic::error(message));
    }
    let decoded = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let pixels = match decoded.color() {
        ColorType::Rgb32F | ColorType::Rgba32F => Pixels::Linear(radiance(decoded, path)?),
        _ => Pixels::Srgb8(decoded.into_rgb8().pixels().map(|pixel| pixel.0).collect()),
    };
    Ok(Texture { path: path.into(), width, height, pixels })
}

fn limits(most: u64) -> image::Limits {
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_ALLOCATION.saturating_mul(most));
    limits
}

/// Take the pixels of a linear picture, every one finite and ≥ 0.
fn radiance(decoded: DynamicImage, path: &Path) -> Result<Vec<[f32; 3]>, Diagnostic> {
    let decoded = decoded.into_rgb32f();
    let is_usable = |channel: &f32| channel.is_finite() && *channel >= 0.0;
    if let Some((x, y, pixel)) =
        decoded.enumerate_pixels().find(|(_, _, pixel)| !pixel.0.iter().all(is_usable))
    {
        let [r, g, b] = pixel.0;
        let message = format!("{} holds ({r}, {g}, {b}) at pixel {x},{y}", path.display());
        return Err(Diagnostic::error(message).hint("radiance is finite and at least 0"));
    }
    Ok(decoded.pixels().map(|pixel| pixel.0).collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(path: &Path) -> Result<Texture, Diagnostic> {
        super::read(path, Limits::default().pixels)
    }

    fn picture(name: &str, image: &DynamicImage) -> (tempfile::TempDir, PathBuf) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(name);
        image.save(&path).unwrap();
        (directory, path)
    }

    fn linear(pixels: Vec<f32>) -> DynamicImage {
        DynamicImage::ImageRgb32F(image::ImageBuffer::from_raw(1, pixels.len() as u32 / 3, pixels).unwrap())
    }

    #[test]
    fn png_keeps_its_bytes_row_by_row_from_the_top_left() {
        let bytes = vec![1, 2, 3, 250, 128, 0];
        let image = DynamicImage::ImageRgb8(image::ImageBuffer::from_raw(2, 1, bytes).unwrap());
        let (_directory, path) = picture("a.png", &image);
        let texture = read(&path).unwrap();
        assert_eq!((texture.width, texture.height), (2, 1));
        assert_eq!(texture.pixels, Pixels::Srgb8(vec![[1, 2, 3], [250, 128, 0]]));
    }

    #[test]
    fn sixteen_bits_and_alpha_are_reduced_to_srgb8() {
        let image =
            DynamicImage::ImageRgba16(image::ImageBuffer::from_raw(1, 1, vec![65535, 0, 32896, 0]).unwrap());
        let (_directory, path) = picture("a.png", &image);
        assert_eq!(read(&path).unwrap().pixels, Pixels::Srgb8(vec![[255, 0, 128]]));
    }

    #[test]
    fn jpeg_is_srgb8() {
        let grey = DynamicImage::ImageRgb8(image::ImageBuffer::from_pixel(8, 8, image::Rgb([128; 3])));
        let (_directory, path) = picture("a.jpg", &grey);
        assert_eq!(read(&path).unwrap().pixels, Pixels::Srgb8(vec![[128; 3]; 64]));
    }

    #[test]
    fn exr_and_hdr_are_linear() {
        for name in ["a.exr", "a.hdr"] {
            let (_directory, path) = picture(name, &linear(vec![4.0, 0.5, 0.0]));
            assert_eq!(read(&path).unwrap().pixels, Pixels::Linear(vec![[4.0, 0.5, 0.0]]), "{name}");
        }
    }

    #[test]
    fn unusable_radiance_names_file_and_pixel() {
        for bad in [f32::NAN, f32::INFINITY, -0.5] {
            let (_directory, path) = picture("a.exr", &linear(vec![1.0, 1.0, 1.0, 1.0, bad, 1.0]));
            let message = read(&path).unwrap_err().message;
            assert!(message.contains("a.exr") && message.ends_with("at pixel 0,1"), "{message}");
        }
    }

    #[test]
    fn radiance_is_no_surface_colour() {
        let (_directory, path) = picture("a.exr", &linear(vec![4.0, 0.5, 0.0]));
        let mut textures = Textures::default();
        assert!(textures.load(&path, Purpose::Surface).is_err());
        assert!(textures.load(&path, Purpose::Background).is_ok());
    }

    #[test]
    fn a_file_is_decoded_once() {
        let (_directory, path) = picture("a.exr", &linear(vec![1.0; 3]));
        let mut textures = Textures::default();
        let first = textures.load(&path, Purpose::Background).unwrap();
        assert_eq!(textures.load(&path, Purpose::Background), Ok(first));
        assert_eq!(textures.list.len(), 1);
    }

    #[test]
    fn pictures_are_bounded_together() {
        let texture =
            Texture { path: PathBuf::new(), width: 8192, height: 4096, pixels: Pixels::Srgb8(Vec::new()) };
        let mut textures = Textures::default();
        assert!((0..4).all(|_| textures.count(&texture).is_ok()));
        assert!(textures.count(&texture).unwrap_err().message.contains("the most is 134217728"));
    }

    #[test]
    fn broken_and_truncated_pictures_are_refused() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.png");
        let (_whole, whole) = picture("a.png", &DynamicImage::new_rgb8(64, 64));
        let bytes = std::fs::read(whole).unwrap();
        for content in [&b""[..], b"no picture", &bytes[..bytes.len() / 2], &bytes[..20]] {
            std::fs::write(&path, content).unwrap();
            assert!(read(&path).unwrap_err().message.contains("cannot decode"));
        }
    }

    #[test]
    fn a_header_that_asks_for_gigabytes_is_refused() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.hdr");
        for size in ["-Y 60000 +X 60000", "-Y 16000 +X 16000"] {
            std::fs::write(&path, format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n")).unwrap();
            assert!(read(&path).is_err(), "{size}");
        }
    }
}
