//! What a frame holds besides radiance: the one list that the command line and the viewer offer.

use super::{Channel, Frame, Picture};
use crate::layout::{Aov, Texel};

/// An arbitrary output variable: one thing known about every pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AovKind {
    /// Distance along the primary ray of sample 0, in scene units.
    Depth,
    /// Unit shading normal that faces the primary ray of sample 0, world space.
    Normal,
    /// Body id at the primary hit of sample 0.
    Body,
    /// Material index of the medium behind the primary hit of sample 0; 0 is air.
    Medium,
    /// Rays traced, of all kinds and samples.
    Rays,
    /// Samples that the pixel is the mean of.
    Samples,
    /// Largest weight channel of every cut ray, summed; the mean of the samples.
    Dropped,
    /// Certified bound on the truncation error, as linear radiance; the mean of the samples.
    Bound,
    /// Hash over primitive ids, branches and visibilities of sample 0's tree.
    PrimitiveHash,
    /// Hash over bodies, sides, branches and visibilities of sample 0's tree.
    BodyHash,
}

impl AovKind {
    /// All kinds, in the order of menus and help texts.
    pub const ALL: [Self; 10] = [
        Self::Depth,
        Self::Normal,
        Self::Body,
        Self::Medium,
        Self::Rays,
        Self::Samples,
        Self::Dropped,
        Self::Bound,
        Self::PrimitiveHash,
        Self::BodyHash,
    ];

    /// The name on the command line, in menus and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Body => "body",
            Self::Medium => "medium",
            Self::Rays => "rays",
            Self::Samples => "samples",
            Self::Dropped => "dropped",
            Self::Bound => "bound",
            Self::PrimitiveHash => "primitive-hash",
            Self::BodyHash => "body-hash",
        }
    }

    /// One line for help texts.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::Depth => "distance along the primary ray, in scene units",
            Self::Normal => "shading normal facing the primary ray, world space",
            Self::Body => "body that the primary ray meets first",
            Self::Medium => "medium behind that surface, as a material index; 0 is air",
            Self::Rays => "rays traced for the pixel",
            Self::Samples => "samples taken of the pixel",
            Self::Dropped => "weight of the rays that --depth and --cutoff left out",
            Self::Bound => "certified bound on the error this causes, as radiance",
            Self::PrimitiveHash => "fingerprint of the ray tree, by triangles",
            Self::BodyHash => "fingerprint of the ray tree, by bodies",
        }
    }

    /// Whether it needs `Settings::aovs`; the others are part of every frame.
    #[must_use]
    pub fn needs_aovs(self) -> bool {
        matches!(self, Self::Depth | Self::Normal | Self::Body | Self::Medium)
    }

    /// The exact values as planes: f32 for depth (`Z`), normal (`N.X`, `N.Y`, `N.Z`), dropped and bound;
    /// u32 for ids, counts and hashes, named after the kind.
    ///
    /// `None` where the frame was traced without what [`AovKind::needs_aovs`] says.
    #[must_use]
    pub fn picture(self, frame: &Frame) -> Option<Picture> {
        let channels = match self {
            Self::Depth => vec![Channel::f32("Z", first_hits(frame)?.iter().map(|a| a.depth))],
            Self::Normal => {
                let hits = first_hits(frame)?;
                let plane = |name, axis: usize| Channel::f32(name, hits.iter().map(move |a| a.normal[axis]));
                vec![plane("N.X", 0), plane("N.Y", 1), plane("N.Z", 2)]
            }
            Self::Body => vec![Channel::u32(self.name(), first_hits(frame)?.iter().map(|a| a.body))],
            Self::Medium => vec![Channel::u32(self.name(), first_hits(frame)?.iter().map(|a| a.medium))],
            Self::Rays => vec![Channel::u32(self.name(), texels(frame).map(|t| t.rays))],
            Self::Samples => {
                let count = frame.texels.len();
                vec![Channel::u32(self.name(), (0..count).map(|pixel| frame.samples.of(pixel)))]
            }
            Self::Dropped => vec![Channel::f32(self.name(), texels(frame).map(|t| t.dropped))],
            Self::Bound => vec![Channel::f32(self.name(), texels(frame).map(|t| t.bound))],
            Self::PrimitiveHash => {
                vec![Channel::u32(self.name(), texels(frame).map(|t| t.primitive_hash))]
            }
            Self::BodyHash => vec![Channel::u32(self.name(), texels(frame).map(|t| t.body_hash))],
        };
        Some(Picture::new(frame.width, frame.height, channels))
    }
}

fn first_hits(frame: &Frame) -> Option<&[Aov]> {
    frame.aovs.as_deref()
}

fn texels(frame: &Frame) -> impl Iterator<Item = &Texel> {
    frame.texels.iter()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::film::{Samples, test_frame};

    #[test]
    fn names_are_unique() {
        let mut names = AovKind::ALL.map(AovKind::name).to_vec();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), AovKind::ALL.len());
    }

    #[test]
    fn hashes_keep_all_32_bits() {
        let mut frame = test_frame(2, 1);
        frame.texels[0].body_hash = u32::MAX;
        frame.texels[1].body_hash = u32::MAX - 1;
        let picture = AovKind::BodyHash.picture(&frame).unwrap();
        assert_eq!(picture.channels[0].samples, Samples::U32(vec![u32::MAX, u32::MAX - 1]));
    }

    #[test]
    fn first_hit_kinds_are_absent_from_a_frame_traced_without_them() {
        let mut frame = test_frame(2, 1);
        frame.aovs = None;
        for kind in AovKind::ALL {
            assert_eq!(kind.picture(&frame).is_none(), kind.needs_aovs(), "{}", kind.name());
        }
    }

    #[test]
    fn every_kind_covers_every_pixel() {
        let frame = test_frame(3, 2);
        for kind in AovKind::ALL {
            for channel in kind.picture(&frame).unwrap().channels {
                let samples = match channel.samples {
                    Samples::F32(values) => values.len(),
                    Samples::U32(values) => values.len(),
                };
                assert_eq!(samples, 6, "{}", kind.name());
            }
        }
    }
}
