//! A picture as named planes: what EXR files hold, what differences are taken of.

use super::Frame;

/// Samples of one channel, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// Linear values.
    F32(Vec<f32>),
    /// Ids, counts, hashes.
    U32(Vec<u32>),
}

impl Samples {
    /// The value of one sample; every u32 and f32 is exact in f64.
    #[must_use]
    pub fn value(&self, index: usize) -> f64 {
        match self {
            Self::F32(values) => f64::from(values[index]),
            Self::U32(values) => f64::from(values[index]),
        }
    }

    /// The bits of one sample.
    #[must_use]
    pub fn bits(&self, index: usize) -> u32 {
        match self {
            Self::F32(values) => values[index].to_bits(),
            Self::U32(values) => values[index],
        }
    }

    /// "f32" or "u32".
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::F32(_) => "f32",
            Self::U32(_) => "u32",
        }
    }
}

/// One plane of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Unique in its picture: "R", "Z", "body", ….
    pub name: String,
    /// `width · height` samples.
    pub samples: Samples,
}

impl Channel {
    /// A channel of linear values.
    #[must_use]
    pub fn f32(name: &str, values: impl Iterator<Item = f32>) -> Self {
        Self { name: name.to_owned(), samples: Samples::F32(values.collect()) }
    }

    /// A channel of ids, counts or hashes.
    #[must_use]
    pub fn u32(name: &str, values: impl Iterator<Item = u32>) -> Self {
        Self { name: name.to_owned(), samples: Samples::U32(values.collect()) }
    }
}

/// A picture as named planes, ordered by name.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Planes, ordered by name.
    pub channels: Vec<Channel>,
}

impl Picture {
    /// A picture of these planes, which each hold `width · height` samples.
    #[must_use]
    pub fn new(width: u32, height: u32, mut channels: Vec<Channel>) -> Self {
        channels.sort_by(|a, b| a.name.cmp(&b.name));
        Self { width, height, channels }
    }

    /// A linear RGB picture: planes R, G and B.
    #[must_use]
    pub fn from_rgb(width: u32, height: u32, pixels: &[[f32; 3]]) -> Self {
        let plane = |name, i: usize| Channel::f32(name, pixels.iter().map(move |pixel| pixel[i]));
        Self::new(width, height, vec![plane("R", 0), plane("G", 1), plane("B", 2)])
    }

    /// The plane of this name.
    #[must_use]
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|channel| channel.name == name)
    }

    /// The planes R, G and B, if the picture has all three.
    #[must_use]
    pub fn rgb(&self) -> Option<[&Channel; 3]> {
        Some([self.channel("R")?, self.channel("G")?, self.channel("B")?])
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl Frame {
    /// Linear radiance, pixel by pixel.
    #[must_use]
    pub fn radiance(&self) -> Vec<[f32; 3]> {
        self.texels.iter().map(|texel| texel.radiance).collect()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn planes_are_ordered_by_name_and_found_by_it() {
        let picture = Picture::from_rgb(2, 1, &[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        let names: Vec<_> = picture.channels.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["B", "G", "R"]);
        let [r, g, b] = picture.rgb().unwrap();
        assert_eq!([r, g, b].map(|c| c.samples.value(1)), [4.0, 5.0, 6.0]);
    }

    #[test]
    fn a_picture_without_all_three_colours_is_not_rgb() {
        let picture = Picture::new(1, 1, vec![Channel::u32("R", std::iter::once(1))]);
        assert!(picture.rgb().is_none());
    }
}
