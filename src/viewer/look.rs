//! What of the films is shown, and how.

use std::fmt;

use crate::film::AovKind;
use crate::gpu::Exposure;
use crate::layout::constants::BLOCK;

/// What is shown of a picture: what the command line can write of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ViewKind {
    /// What the camera sees.
    #[default]
    Beauty,
    /// An auxiliary picture, in false colours.
    Aov(AovKind),
    /// Where the picture's bits are not the CPU's.
    Difference,
}

impl ViewKind {
    /// All of them, in the order of menus.
    pub fn all() -> impl Iterator<Item = Self> {
        std::iter::once(Self::Beauty).chain(AovKind::ALL.map(Self::Aov)).chain([Self::Difference])
    }

    /// Its number in the shader.
    #[must_use]
    pub fn index(self) -> u32 {
        Self::all().position(|kind| kind == self).unwrap_or_default() as u32
    }

    /// Its name in menus.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Beauty => "beauty",
            Self::Aov(kind) => kind.name(),
            Self::Difference => "difference",
        }
    }

    /// What it shows, in one line.
    #[must_use]
    pub fn description(self) -> &'static str {
        match self {
            Self::Beauty => "what the camera sees",
            Self::Aov(kind) => kind.description(),
            Self::Difference => "how far the finished picture is from the CPU's, which is traced for it",
        }
    }

    /// Whether the picture is to be traced with AOVs.
    #[must_use]
    pub fn needs_aovs(self) -> bool {
        matches!(self, Self::Aov(kind) if kind.needs_aovs())
    }
}

impl fmt::Display for ViewKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What is shown, and how.
#[derive(Clone, Default)]
pub struct Look {
    /// The picture in work, on top of the other where it has something.
    pub fine: Option<Exposure>,
    /// The last finished picture.
    pub coarse: Option<Exposure>,
    /// The CPU's picture of the last finished one, where that is shown.
    pub reference: Option<Exposure>,
    /// Left of the wipe bar, or everywhere.
    pub first: ViewKind,
    /// Right of it, if there is one.
    pub second: Option<ViewKind>,
    /// Where the bar stands, as a part of the picture's width.
    pub wipe: f32,
    /// Stops: radiance is multiplied by 2^exposure.
    pub exposure: f32,
}

impl Look {
    /// Whether the picture is to be traced with AOVs.
    #[must_use]
    pub fn needs_aovs(&self) -> bool {
        self.first.needs_aovs() || self.second.is_some_and(ViewKind::needs_aovs)
    }

    /// Whether the CPU is to trace the picture too.
    #[must_use]
    pub fn needs_reference(&self) -> bool {
        self.first == ViewKind::Difference || self.second == Some(ViewKind::Difference)
    }

    /// Whether the ranges of the finished picture are needed.
    #[must_use]
    pub fn needs_ranges(&self) -> bool {
        self.first != ViewKind::Beauty || self.second.is_some_and(|kind| kind != ViewKind::Beauty)
    }

    /// What is drawn for a picture in the part `area` of a target (left, top, width and height in pixels), one over the
    /// other: the last finished film where the one in work has nothing yet; left and right of the bar if there is one.
    pub(super) fn layers(&self, area: [u32; 4]) -> Vec<Layer<'_>> {
        let [left, top, width, height] = area;
        let bar = self.second.map_or(width, |_| ((self.wipe * width as f32).round() as u32).min(width));
        let mut layers = Vec::new();
        for (kind, first, end) in [(self.first, 0, bar), (self.second.unwrap_or(self.first), bar, width)] {
            let fine = self.fine.as_ref().map(|fine| (fine, rows_of(fine, height)));
            let is_covered = fine.is_some_and(|(_, rows)| rows == height);
            let coarse = self.coarse.as_ref().filter(|_| !is_covered).map(|coarse| (coarse, height));
            for (exposure, rows) in [coarse, fine].into_iter().flatten() {
                layers.push(Layer { exposure, kind, part: [left + first, top, end - first, rows] });
            }
        }
        layers
    }
}

/// A film, or its upper part, as it is drawn over others.
pub(super) struct Layer<'a> {
    pub(super) exposure: &'a Exposure,
    pub(super) kind: ViewKind,
    /// Left, top, width and height in pixels of the target.
    pub(super) part: [u32; 4],
}

/// Rows of a picture of so many on a target that a film in work has: whole rows of blocks, until each pixel has a sample.
fn rows_of(exposure: &Exposure, height: u32) -> u32 {
    let rows = exposure.blocks / exposure.columns().max(1) * BLOCK;
    if exposure.passes > 0 || rows >= exposure.film.height {
        return height;
    }
    let scale = f64::from(height) / f64::from(exposure.film.height.max(1));
    // Between two rows one would show the one that is not there.
    let sure = if scale == 1.0 { f64::from(rows) } else { f64::from(rows) - 0.5 };
    (sure.max(0.0) * scale) as u32
}
