//! The rows of a study: the baseline, and every setting that differs from it in one knob.

use serde::{Deserialize, Serialize};

use super::Knob;
use crate::gpu::AdapterReport;
use crate::layout::{EffectChoice, EffectSet, Float, Intersector, Precision, Settings};

/// Depths that are tried.
const DEPTHS: [u32; 6] = [1, 2, 4, 8, 16, 32];
/// Cut-offs that are tried: from a sixteenth, below what 8 bits show at 1/255, to nothing cut at all.
const CUTOFFS: [f32; 8] = [0.0625, 0.015_625, 0.003_906_25, 1e-3, 1e-4, 1e-5, 1e-6, 0.0];
/// Samples per pixel that are tried.
const SAMPLES: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];
/// Thresholds of adaptive antialiasing that are tried, with [`MOST_SAMPLES`].
const THRESHOLDS: [f32; 4] = [0.1, 0.03, 0.01, 0.003];
/// Samples that adaptive antialiasing may take.
const MOST_SAMPLES: u32 = 64;
/// Steps by which built-in solids are made finer or coarser.
const STEPS: [i32; 4] = [-2, -1, 0, 1];

/// Which device traces a row.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Target {
    /// The CPU; 0 threads for one a core.
    Cpu {
        /// Threads.
        threads: usize,
    },
    /// A Vulkan adapter by its name.
    Gpu {
        /// Its name.
        adapter: String,
    },
}

/// How a row's picture is made.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// The device.
    pub target: Target,
    /// Steps by which built-in solids are finer than in the file.
    pub steps: i32,
    /// How to trace.
    pub settings: Settings,
}

/// What every row differs from in one knob.
#[derive(Debug, Clone, PartialEq)]
pub struct Baseline {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// All threads of the CPU, f32, strict, watertight, one sample, the scene's depth and cut-off unless told
    /// otherwise.
    pub settings: Settings,
}

/// One setting that is measured.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// What it changes; `None` for the baseline.
    pub(super) knob: Option<Knob>,
    /// The knob's value in words.
    pub(super) label: String,
    /// The knob's value where it is a number.
    pub(super) value: Option<f64>,
    /// How it is traced.
    pub(super) setup: Setup,
}

impl Row {
    /// A name that no other row of the study has.
    pub(super) fn id(&self) -> String {
        match self.knob {
            None => "baseline".to_owned(),
            Some(knob) => format!("{}: {}", knob.name(), self.label),
        }
    }
}

/// What the rows are made from.
pub(super) struct Plan<'a> {
    pub(super) baseline: &'a Baseline,
    /// The knobs that are wanted.
    pub(super) knobs: &'a [Knob],
    /// Steps of the built-in solids that give other triangles; only 0 where there are none.
    pub(super) steps: &'a [i32],
    /// Adapters to compare with.
    pub(super) adapters: &'a [AdapterReport],
    /// What the scene calls for.
    pub(super) effects: EffectSet,
}

impl Plan<'_> {
    /// The rows: first the baseline, then knob by knob.
    pub(super) fn rows(&self) -> Vec<Row> {
        let baseline =
            Row { knob: None, label: "baseline".to_owned(), value: None, setup: self.baseline_setup() };
        let wanted = Knob::ALL.into_iter().filter(|knob| self.knobs.contains(knob));
        let others = wanted.flat_map(|knob| self.rows_of(knob));
        let is_other = |row: &Row| row.setup != baseline.setup;
        std::iter::once(baseline.clone()).chain(others.filter(is_other)).collect()
    }

    pub(super) fn baseline_setup(&self) -> Setup {
        Setup { target: Target::Cpu { threads: 0 }, steps: 0, settings: self.baseline.settings }
    }

    fn rows_of(&self, knob: Knob) -> Vec<Row> {
        let base = self.baseline.settings;
        match knob {
            Knob::Depth => {
                DEPTHS.map(|depth| self.changed(knob, f64::from(depth), Settings { depth, ..base })).into()
            }
            Knob::Cutoff => CUTOFFS
                .map(|cutoff| self.changed(knob, f64::from(cutoff), Settings { cutoff, ..base }))
                .into(),
            Knob::Samples => SAMPLES
                .map(|samples| self.changed(knob, f64::from(samples), Settings { samples, ..base }))
                .into(),
            Knob::Adaptive => THRESHOLDS
                .map(|threshold| {
                    let adaptive = Some(threshold);
                    let settings = Settings { adaptive, samples: MOST_SAMPLES, ..base };
                    let row = self.named(knob, &threshold.to_string(), settings);
                    Row { value: Some(f64::from(threshold)), ..row }
                })
                .into(),
            Knob::Precision => [Precision::F32, Precision::F64]
                .map(|precision| self.named(knob, precision_name(precision), Settings { precision, ..base }))
                .into(),
            Knob::Intersector => [Intersector::Watertight, Intersector::MollerTrumbore]
                .map(|test| self.named(knob, intersector_name(test), Settings { intersector: test, ..base }))
                .into(),
            Knob::Tessellation => self.tessellations(),
            Knob::Effects => self.effects(),
            Knob::Device => self.devices(),
        }
    }

    /// A row whose knob is a number.
    fn changed(&self, knob: Knob, value: f64, settings: Settings) -> Row {
        // Shortest digits that give the f32 back: 1/16 reads 0.0625 and 1e-5 not 0.00000999….
        let label = if knob == Knob::Cutoff { cutoff_label(settings.cutoff) } else { format!("{value}") };
        let setup = Setup { settings, ..self.baseline_setup() };
        Row { knob: Some(knob), label, value: Some(value), setup }
    }

    /// A row whose knob is a word.
    fn named(&self, knob: Knob, label: &str, settings: Settings) -> Row {
        let setup = Setup { settings, ..self.baseline_setup() };
        Row { knob: Some(knob), label: label.to_owned(), value: None, setup }
    }

    fn tessellations(&self) -> Vec<Row> {
        let row = |&steps: &i32| Row {
            knob: Some(Knob::Tessellation),
            label: format!("{steps:+} levels"),
            value: Some(f64::from(steps)),
            setup: Setup { steps, ..self.baseline_setup() },
        };
        self.steps.iter().filter(|steps| STEPS.contains(steps)).map(row).collect()
    }

    /// The general kernel, then the scene's own without each of its effects and those that need it.
    fn effects(&self) -> Vec<Row> {
        let base = self.baseline.settings;
        let row = |label: String, effects| self.named(Knob::Effects, &label, Settings { effects, ..base });
        let without = |effect| {
            let left = EffectChoice::Only(self.effects.without(effect).pruned());
            row(format!("without {effect}"), left)
        };
        let general = row("general kernel".to_owned(), EffectChoice::All);
        std::iter::once(general).chain(self.effects.iter().map(without)).collect()
    }

    /// One thread, all threads, and each adapter strict (where it can) and fast.
    fn devices(&self) -> Vec<Row> {
        let row = |label: String, target: Target, float: Float| Row {
            knob: Some(Knob::Device),
            label,
            value: None,
            setup: Setup { target, steps: 0, settings: Settings { float, ..self.baseline.settings } },
        };
        let mut rows = vec![row("CPU, 1 thread".to_owned(), Target::Cpu { threads: 1 }, Float::Strict)];
        for adapter in self.adapters {
            for float in [Float::Strict, Float::Fast] {
                if float == Float::Strict && !adapter.strict_float {
                    continue;
                }
                let label = format!("{} ({}), {}", adapter.name, adapter.kind.name(), float_name(float));
                rows.push(row(label, Target::Gpu { adapter: adapter.name.clone() }, float));
            }
        }
        rows
    }
}

/// A cut-off in the fewest digits that give the f32 back.
pub(super) fn cutoff_label(cutoff: f32) -> String {
    match cutoff {
        0.0 => "0".to_owned(),
        // A power of two of more than five digits.
        small
            if small.to_string().len() > 7
                && small.to_bits().trailing_zeros() >= f32::MANTISSA_DIGITS - 1 =>
        {
            format!("1/{}", 1.0 / small)
        }
        small if small < 1e-3 => format!("{small:e}"),
        large => large.to_string(),
    }
}

/// As the command line spells it.
pub(super) fn precision_name(precision: Precision) -> &'static str {
    match precision {
        Precision::F32 => "f32",
        Precision::F64 => "f64",
    }
}

/// As the command line spells it.
pub(super) fn float_name(float: Float) -> &'static str {
    match float {
        Float::Strict => "strict",
        Float::Fast => "fast",
    }
}

/// As the command line spells it.
pub(super) fn intersector_name(intersector: Intersector) -> &'static str {
    match intersector {
        Intersector::Watertight => "watertight",
        Intersector::MollerTrumbore => "moller-trumbore",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Effect;

    fn rows(knobs: &[Knob], steps: &[i32]) -> Vec<Row> {
        let settings = Settings { depth: 16, cutoff: 1e-3, ..Settings::default() };
        let baseline = Baseline { size: [64, 48], settings };
        let effects = EffectSet::of(&[Effect::Shadows, Effect::Reflection]);
        Plan { baseline: &baseline, knobs, steps, adapters: &[], effects }.rows()
    }

    #[test]
    fn each_row_differs_from_the_baseline_in_one_knob() {
        let rows = rows(&Knob::ALL, &[-1, 0, 1, 2]);
        let base = &rows[0].setup;
        for row in &rows[1..] {
            let (a, b) = (row.setup.settings, base.settings);
            let changes = [
                a.depth != b.depth,
                a.cutoff != b.cutoff,
                (a.samples, a.adaptive) != (b.samples, b.adaptive),
                a.precision != b.precision,
                a.intersector != b.intersector,
                row.setup.target != base.target,
                row.setup.steps != base.steps,
                a.effects != b.effects,
            ];
            assert_eq!(changes.iter().filter(|&&changed| changed).count(), 1, "{}", row.id());
        }
    }

    #[test]
    fn the_baseline_is_measured_once_and_no_name_is_used_twice() {
        let rows = rows(&Knob::ALL, &[-1, 0, 1]);
        let mut ids: Vec<_> = rows.iter().map(Row::id).collect();
        assert!(rows[1..].iter().all(|row| row.setup != rows[0].setup));
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), rows.len());
    }

    #[test]
    fn only_the_wanted_knobs_are_turned() {
        let rows = rows(&[Knob::Depth], &[0]);
        assert_eq!(rows.iter().filter(|row| row.knob == Some(Knob::Depth)).count(), 5);
        assert_eq!(rows.len(), 6);
    }

    #[test]
    fn cutoffs_read_as_a_person_writes_them() {
        let labels = CUTOFFS.map(cutoff_label);
        assert_eq!(labels, ["0.0625", "1/64", "1/256", "0.001", "1e-4", "1e-5", "1e-6", "0"]);
    }
}
