//! What of the films is shown, and how.

use std::fmt;

use crate::film::AovKind;
use crate::gpu::Exposure;

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
}
