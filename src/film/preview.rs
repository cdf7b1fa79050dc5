//! AOVs as false colours for the eye, with a legend that states the range.

use super::aov::AovKind;
use super::colormap::{grey, palette, viridis};
use super::{Channel, Frame};
use crate::layout::Attribute;

/// A false-colour picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Preview {
    /// 8-bit sRGB codes, row by row from the top left.
    pub pixels: Vec<[u8; 3]>,
    /// What the colours mean, in one line.
    pub legend: String,
}

/// No hit, no weight, nothing to show.
const NOTHING: [u8; 3] = [0; 3];
/// Air: darker than any palette colour, brighter than nothing.
const AIR: [u8; 3] = [40; 3];
/// A value that is not a number.
const NOT_A_NUMBER: [u8; 3] = [255, 0, 255];
/// Logarithmic scales span this factor below the greatest value.
const DECADES: f32 = 6.0;

impl AovKind {
    /// False colours for the eye.
    ///
    /// `None` where the frame was traced without what [`AovKind::needs_aovs`] says.
    #[must_use]
    pub fn preview(self, frame: &Frame) -> Option<Preview> {
        Some(match self {
            Self::Depth => depth(frame)?,
            Self::Normal => normal(frame)?,
            Self::Body => body(frame)?,
            Self::Medium => medium(frame)?,
            Self::Rays => counts(frame.texels.iter().map(|t| t.rays).collect(), "rays"),
            Self::Samples => {
                let samples = (0..frame.texels.len()).map(|pixel| frame.samples.of(pixel));
                counts(samples.collect(), "samples")
            }
            Self::Dropped => decades(frame.texels.iter().map(|t| t.dropped).collect(), "weight"),
            Self::Bound => decades(frame.texels.iter().map(|t| t.bound).collect(), "radiance"),
            Self::PrimitiveHash => hashes(frame.texels.iter().map(|t| t.primitive_hash)),
            Self::BodyHash => hashes(frame.texels.iter().map(|t| t.body_hash)),
        })
    }
}

fn depth(frame: &Frame) -> Option<Preview> {
    let hits = frame.aovs.as_ref()?;
    let depths = || hits.iter().filter(|hit| hit.body != Attribute::NONE).map(|hit| hit.depth);
    let near = depths().fold(f32::MAX, f32::min);
    let far = depths().fold(0.0, f32::max);
    let shade = |depth: f32| grey(1.0 - 0.85 * (depth - near) / (far - near).max(f32::MIN_POSITIVE));
    let pixels =
        hits.iter().map(|hit| if hit.body == Attribute::NONE { NOTHING } else { shade(hit.depth) }).collect();
    let legend = if near <= far {
        format!("{near} scene units (white) to {far} (dark grey), linear; black: nothing met")
    } else {
        "black: nothing met".to_owned()
    };
    Some(Preview { pixels, legend })
}

fn normal(frame: &Frame) -> Option<Preview> {
    let color = |n: [f32; 3]| n.map(|v| ((v * 0.5 + 0.5) * 255.0).round() as u8);
    let pixels = frame
        .aovs
        .as_ref()?
        .iter()
        .map(|hit| if hit.body == Attribute::NONE { NOTHING } else { color(hit.normal) })
        .collect();
    Some(Preview {
        pixels,
        legend: "x, y, z from −1 to 1 as red, green, blue; black: nothing met".to_owned(),
    })
}

fn body(frame: &Frame) -> Option<Preview> {
    let color = |id| if id == Attribute::NONE { NOTHING } else { palette(id) };
    let pixels = frame.aovs.as_ref()?.iter().map(|hit| color(hit.body)).collect();
    Some(Preview { pixels, legend: "one colour for each body; black: nothing met".to_owned() })
}

fn medium(frame: &Frame) -> Option<Preview> {
    let color = |id| match id {
        Attribute::NONE => NOTHING,
        0 => AIR,
        material => palette(material),
    };
    let pixels = frame.aovs.as_ref()?.iter().map(|hit| color(hit.medium)).collect();
    let legend = "one colour for each medium; dark grey: air; black: nothing met".to_owned();
    Some(Preview { pixels, legend })
}

fn counts(counts: Vec<u32>, unit: &str) -> Preview {
    let most = counts.iter().copied().max().unwrap_or(0);
    let scale = 1.0 / (most.max(1) as f32).ln_1p();
    let pixels = counts.iter().map(|&count| viridis((count as f32).ln_1p() * scale)).collect();
    let legend = format!("0 {unit} (dark blue) to {most} (yellow), logarithmic in {unit} + 1");
    Preview { pixels, legend }
}

/// Positive values on a logarithmic scale below the greatest one.
fn decades(values: Vec<f32>, unit: &str) -> Preview {
    let most = values.iter().copied().filter(|v| v.is_finite()).fold(0.0, f32::max);
    let color = |v: f32| {
        if v.is_nan() {
            NOT_A_NUMBER
        } else if v <= 0.0 {
            NOTHING
        } else {
            viridis(1.0 + (v / most).log10() / DECADES)
        }
    };
    let legend = if most > 0.0 {
        let least = most / 10_f32.powf(DECADES);
        format!("{unit} {least:.2e} or less (dark blue) to {most:.2e} (yellow), logarithmic; black: 0")
    } else {
        "black: 0".to_owned()
    };
    Preview { pixels: values.into_iter().map(color).collect(), legend }
}

fn hashes(values: impl Iterator<Item = u32>) -> Preview {
    Preview { pixels: values.map(palette).collect(), legend: "one colour for each hash".to_owned() }
}

/// How far apart the planes of two pictures are, pixel by pixel.
///
/// Black where every bit agrees. Elsewhere the greatest difference of a plane on a logarithmic scale
/// from 1e-7 to 1; a difference in bits alone still shows as dark blue.
#[must_use]
pub fn difference_preview(a: &[Channel], b: &[Channel], pixels: usize) -> Preview {
    let color = |i: usize| {
        let pairs = || a.iter().zip(b);
        if pairs().all(|(a, b)| a.samples.bits(i) == b.samples.bits(i)) {
            return NOTHING;
        }
        let apart = |(a, b): (&Channel, &Channel)| (a.samples.value(i) - b.samples.value(i)).abs();
        if pairs().any(|pair| apart(pair).is_nan()) {
            return NOT_A_NUMBER;
        }
        let most = pairs().map(apart).fold(0.0, f64::max);
        viridis(1.0 + most.max(1e-30).log10() as f32 / 7.0)
    };
    Preview {
        pixels: (0..pixels).map(color).collect(),
        legend: "difference 1e-7 or less (dark blue) to 1 or more (yellow), logarithmic; black: same bits; \
                 magenta: not a number"
            .to_owned(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::film::test_frame;

    #[test]
    fn every_kind_has_a_preview_of_every_pixel() {
        let frame = test_frame(5, 3);
        for kind in AovKind::ALL {
            assert_eq!(kind.preview(&frame).unwrap().pixels.len(), 15, "{}", kind.name());
        }
    }

    #[test]
    fn depth_runs_from_white_to_dark_and_escapes_are_black() {
        let mut frame = test_frame(3, 1);
        let hits = frame.aovs.as_mut().unwrap();
        hits[0].depth = 2.0;
        hits[1].depth = 4.0;
        hits[2].body = Attribute::NONE;
        let preview = AovKind::Depth.preview(&frame).unwrap();
        assert_eq!(preview.pixels, [[255; 3], [38; 3], NOTHING]);
        assert!(preview.legend.starts_with("2 scene units (white) to 4 (dark grey)"), "{}", preview.legend);
    }

    #[test]
    fn a_frame_without_hits_is_black() {
        let mut frame = test_frame(2, 2);
        frame.aovs.as_mut().unwrap().iter_mut().for_each(|hit| hit.body = Attribute::NONE);
        assert_eq!(AovKind::Depth.preview(&frame).unwrap().pixels, [NOTHING; 4]);
    }

    #[test]
    fn no_dropped_weight_is_black_and_the_most_is_yellow() {
        let mut frame = test_frame(3, 1);
        frame.texels[1].dropped = 0.25;
        frame.texels[2].dropped = f32::NAN;
        let pixels = AovKind::Dropped.preview(&frame).unwrap().pixels;
        assert_eq!(pixels, [NOTHING, viridis(1.0), NOT_A_NUMBER]);
    }

    #[test]
    fn a_difference_of_one_bit_shows() {
        let plane = |v: f32| [Channel::f32("R", [v, 0.5].into_iter())];
        let pixels = difference_preview(&plane(1.0), &plane(1.0_f32.next_up()), 2).pixels;
        assert_ne!(pixels[0], NOTHING);
        assert_eq!(pixels[1], NOTHING);
    }
}
