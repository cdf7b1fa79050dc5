//! What a case is, and what it finds.

use super::{Device, DeviceError};

/// One hard case.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Its number, as on the command line: `T1`.
    pub id: &'static str,
    /// A few words for tables.
    pub title: &'static str,
    /// What must hold, as a sentence.
    pub claim: &'static str,
    /// Ask a device.
    pub run: fn(&mut dyn Device, Effort) -> Result<Vec<Finding>, DeviceError>,
}

/// How many rays a case may spend.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Effort {
    /// The least that still catches the planted faults: for continuous integration.
    Quick,
    /// A minute for all cases on two cores with a software adapter.
    #[default]
    Short,
    /// Ten times as many rays.
    Long,
}

impl Effort {
    /// So many rays of which `short` are asked for in the short run.
    #[must_use]
    pub fn rays(self, short: usize) -> usize {
        match self {
            Self::Quick => short / 4,
            Self::Short => short,
            Self::Long => short * 10,
        }
    }
}

/// A figure with its bound.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What was measured: "leaks of the jittered sphere".
    pub what: String,
    /// The figure.
    pub figure: f64,
    /// What it must keep.
    pub bound: Bound,
    /// Out of how many rays, pixels or inputs; 0 is a fault of the case.
    pub trials: u64,
}

/// What a figure must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    /// Not above.
    AtMost(f64),
    /// Not below.
    AtLeast(f64),
    /// As theory says, to within a tolerance.
    Near {
        /// The value on paper.
        expected: f64,
        /// How far rounding and tessellation may put the figure off it.
        within: f64,
    },
    /// Reported only: it explains other figures.
    Reported,
}

/// Whether a figure keeps its bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It does, or has none.
    Holds,
    /// It does not, is not a number, or comes from no trial.
    Falls,
}

impl Finding {
    /// A figure that must not be above `most`.
    #[must_use]
    pub fn at_most(what: impl Into<String>, figure: f64, most: f64, trials: usize) -> Self {
        Self { what: what.into(), figure, bound: Bound::AtMost(most), trials: trials as u64 }
    }

    /// A figure that must not be below `least`.
    #[must_use]
    pub fn at_least(what: impl Into<String>, figure: f64, least: f64, trials: usize) -> Self {
        Self { what: what.into(), figure, bound: Bound::AtLeast(least), trials: trials as u64 }
    }

    /// A figure that theory gives as `expected`.
    #[must_use]
    pub fn near(what: impl Into<String>, figure: f64, expected: f64, within: f64, trials: usize) -> Self {
        Self { what: what.into(), figure, bound: Bound::Near { expected, within }, trials: trials as u64 }
    }

    /// A figure that explains others.
    #[must_use]
    pub fn reported(what: impl Into<String>, figure: f64, trials: usize) -> Self {
        Self { what: what.into(), figure, bound: Bound::Reported, trials: trials as u64 }
    }

    /// Judge the figure.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let keeps = match self.bound {
            Bound::AtMost(most) => self.figure <= most,
            Bound::AtLeast(least) => self.figure >= least,
            Bound::Near { expected, within } => (self.figure - expected).abs() <= within,
            Bound::Reported => self.figure.is_finite(),
        };
        if keeps && self.trials > 0 { Verdict::Holds } else { Verdict::Falls }
    }
}
