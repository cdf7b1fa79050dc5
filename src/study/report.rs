//! What a study found: the contents of `study.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Certificate, Errors, Knob, Timing, Truth, Uncertainty};
use crate::film::RayCounts;

/// A whole study, or what is finished of one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// The program's version.
    pub version: String,
    /// What the figures hold for: a hash of the flattened scene, the baseline and the machine's devices.
    pub key: String,
    /// The scene's path as it was given.
    pub scene: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Triangles of the scene.
    pub triangles: usize,
    /// L(D*): the greatest radiance that any pixel could have.
    pub max_radiance: f64,
    /// The processor.
    pub cpu: String,
    /// Its threads.
    pub threads: usize,
    /// Seconds that the study was given.
    pub budget_s: f64,
    /// Seconds that it took, stops not counted.
    pub spent_s: f64,
    /// What every row differs from in one knob, in words.
    pub baseline: String,
    /// The baseline's value of each knob that is a number.
    pub baseline_values: BTreeMap<Knob, f64>,
    /// The references, by what they are the truth of.
    pub references: BTreeMap<Truth, ReferenceRecord>,
    /// The rows, the baseline first.
    pub rows: Vec<RowRecord>,
    /// What there was no time or no device for.
    pub left_out: Vec<LeftOut>,
    /// Whether nothing is missing but what was left out.
    pub complete: bool,
}

/// A reference picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReferenceRecord {
    /// How it was traced, in words.
    pub setup: String,
    /// How far it may be from the truth.
    pub uncertainty: Uncertainty,
    /// Milliseconds that it took.
    pub time_ms: f64,
    /// Rays traced.
    pub rays: Rays,
    /// The least weight that was traced, of the whole tree.
    pub cutoff: Option<f32>,
}

/// One measured setting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowRecord {
    /// A name that no other row has.
    pub id: String,
    /// What it changes; `None` for the baseline.
    pub knob: Option<Knob>,
    /// The knob's value in words.
    pub label: String,
    /// The knob's value where it is a number.
    pub value: Option<f64>,
    /// Rays traced.
    pub rays: Rays,
    /// Errors against each reference that can judge it.
    pub errors: BTreeMap<Truth, Errors>,
    /// The certified bound held against the true error; for depth, cut-off and the baseline.
    pub certificate: Option<Certificate>,
    /// The first run, in milliseconds: it warms caches up and is left out of `times_ms`.
    pub warm_up_ms: f64,
    /// Times of all other runs, in milliseconds.
    pub times_ms: Vec<f64>,
    /// Their median; of the warm-up where there was no time for another run.
    pub timing: Option<Timing>,
    /// The median over the baseline's.
    pub ratio: Option<f64>,
}

/// A row that is not there.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeftOut {
    /// The row's name.
    pub id: String,
    /// Why.
    pub reason: String,
}

/// Rays traced, by kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Rays {
    /// From the eye.
    pub primary: u64,
    /// By reflection.
    pub reflection: u64,
    /// By refraction.
    pub refraction: u64,
    /// Towards lights.
    pub shadow: u64,
}

impl From<RayCounts> for Rays {
    fn from(rays: RayCounts) -> Self {
        let RayCounts { primary, reflection, refraction, shadow } = rays;
        Self { primary, reflection, refraction, shadow }
    }
}

impl Rays {
    /// All rays.
    #[must_use]
    pub fn total(self) -> u64 {
        self.primary + self.reflection + self.refraction + self.shadow
    }
}

impl RowRecord {
    /// The median time in milliseconds.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.timing.map_or(self.warm_up_ms, |timing| timing.median)
    }
}

impl Report {
    /// The baseline's row.
    #[must_use]
    pub fn baseline_row(&self) -> Option<&RowRecord> {
        self.rows.iter().find(|row| row.knob.is_none())
    }

    /// The row of this name.
    pub(super) fn row(&self, id: &str) -> Option<&RowRecord> {
        self.rows.iter().find(|row| row.id == id)
    }

    /// The rows of a knob with the baseline among them, by value.
    #[must_use]
    pub fn rows_of(&self, knob: Knob) -> Vec<&RowRecord> {
        let mut rows: Vec<_> =
            self.rows.iter().filter(|row| row.knob == Some(knob) || row.knob.is_none()).collect();
        if rows.len() < 2 {
            return Vec::new();
        }
        rows.sort_by(|a, b| {
            let value = |row: &RowRecord| row.value_of(knob, self).unwrap_or(f64::NEG_INFINITY);
            value(a).total_cmp(&value(b))
        });
        rows
    }

    /// Work out medians and ratios from the times.
    pub(super) fn settle(&mut self) {
        for row in &mut self.rows {
            let times = if row.times_ms.is_empty() { vec![row.warm_up_ms] } else { row.times_ms.clone() };
            row.timing = Timing::of(&times);
        }
        let base = self.baseline_row().map(RowRecord::time);
        for row in &mut self.rows {
            row.ratio = base.filter(|&base| base > 0.0).map(|base| row.time() / base);
        }
    }
}

impl RowRecord {
    /// The value of a knob in this row: its own, or the baseline's.
    #[must_use]
    pub fn value_of(&self, knob: Knob, report: &Report) -> Option<f64> {
        if self.knob == Some(knob) { self.value } else { report.baseline_values.get(&knob).copied() }
    }
}
