//! What a row changes, and which picture judges it.

use serde::{Deserialize, Serialize};

/// What a row changes against the baseline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Knob {
    /// The deepest ray that is traced.
    Depth,
    /// The least weight that is traced.
    Cutoff,
    /// Samples per pixel.
    Samples,
    /// The threshold of adaptive antialiasing.
    Adaptive,
    /// f32 or f64.
    Precision,
    /// The ray–triangle test.
    Intersector,
    /// Levels of the built-in solids.
    Tessellation,
    /// What is simulated: everything, or without one of the effects that the scene calls for.
    Effects,
    /// Which device traces, with how many threads, and how strictly.
    Device,
}

impl Knob {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 9] = [
        Self::Depth,
        Self::Cutoff,
        Self::Samples,
        Self::Adaptive,
        Self::Precision,
        Self::Intersector,
        Self::Tessellation,
        Self::Effects,
        Self::Device,
    ];

    /// The name on the command line and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "depth",
            Self::Cutoff => "cutoff",
            Self::Samples => "samples",
            Self::Adaptive => "adaptive",
            Self::Precision => "precision",
            Self::Intersector => "intersector",
            Self::Tessellation => "tessellation",
            Self::Effects => "effects",
            Self::Device => "device",
        }
    }

    /// What is changed, as a heading.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Depth => "Depth of the ray tree",
            Self::Cutoff => "Least weight of a traced ray",
            Self::Samples => "Samples per pixel",
            Self::Adaptive => "Threshold of adaptive antialiasing, up to 64 samples",
            Self::Precision => "Precision",
            Self::Intersector => "Ray–triangle test",
            Self::Tessellation => "Tessellation of the built-in solids",
            Self::Effects => "Effects",
            Self::Device => "Device",
        }
    }

    /// The picture that judges the knob: it differs from the baseline in this knob and in its precision only.
    #[must_use]
    pub fn truth(self) -> Truth {
        match self {
            Self::Depth | Self::Cutoff => Truth::Truncation,
            Self::Samples | Self::Adaptive => Truth::Sampling,
            Self::Precision | Self::Intersector | Self::Effects | Self::Device => Truth::Arithmetic,
            Self::Tessellation => Truth::Tessellation,
        }
    }

    /// Whether the row's picture answers the same question as the whole tree: the same samples of the same
    /// triangles.
    #[must_use]
    pub fn keeps_samples(self) -> bool {
        !matches!(self, Self::Samples | Self::Adaptive | Self::Tessellation)
    }

    /// Whether the certified bound says something about the knob.
    #[must_use]
    pub fn is_truncation(self) -> bool {
        self.truth() == Truth::Truncation
    }
}

/// A reference picture, traced by the CPU and better than the baseline in one respect; in f64, but for
/// [`Truth::Truncation`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Truth {
    /// The whole tree in f64: depth 64, the least cut-off that there is time for.
    Whole,
    /// The same in the baseline's own arithmetic: what differs from it is the truncation alone, without the rays
    /// that f32 sends another way.
    Truncation,
    /// The baseline itself in f64.
    Arithmetic,
    /// Many samples.
    Sampling,
    /// The finest solids that there is time for.
    Tessellation,
}

impl Truth {
    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Whole => "whole",
            Self::Truncation => "truncation",
            Self::Arithmetic => "arithmetic",
            Self::Sampling => "sampling",
            Self::Tessellation => "tessellation",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_in_files_are_those_of_the_command_line() {
        for knob in Knob::ALL {
            assert_eq!(serde_json::to_value(knob).ok(), Some(knob.name().into()));
            let truth = knob.truth();
            assert_eq!(serde_json::to_value(truth).ok(), Some(truth.name().into()));
        }
    }
}
