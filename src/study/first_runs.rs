//! The first run of each row: its picture, with its errors.

use std::collections::BTreeMap;
use std::time::Duration;

use super::metrics::Seen;
use super::plan::{Row, Target};
use super::run::{Course, Judges};
use super::{Certificate, Errors, Knob, LeftOut, RowRecord, StudyError, Truth, output};

/// Of the study's time, when first runs must have ended: the rest is for timing.
const FIRST_RUNS_UNTIL: f64 = 0.75;
/// One first run may take this share of the study's time; but many samples, whose time can be foretold.
const ROW_SHARE: f64 = 0.04;
/// Samples that adaptive antialiasing is expected to take at the least.
const ADAPTIVE_SAMPLES: u32 = 4;

impl Course<'_> {
    /// Trace every row once, for its picture and to warm up; what may take long comes last.
    pub(super) fn errors(&mut self, rows: &[Row], judges: &Judges) -> Result<(), StudyError> {
        let mut order: Vec<&Row> = rows.iter().collect();
        order.sort_by_key(|row| {
            let is_endless = row.setup.settings.cutoff == 0.0;
            (is_endless, row.knob.is_some_and(|knob| knob.truth() == Truth::Sampling))
        });
        for row in order {
            let id = row.id();
            if self.report.row(&id).is_some() {
                continue;
            }
            self.say(&id);
            match self.first_run(row, judges)? {
                Ok(record) => {
                    self.report.rows.push(record);
                    self.save()?;
                }
                Err(reason) => self.report.left_out.push(LeftOut { id, reason }),
            }
        }
        Ok(())
    }

    /// How long a first run may take, or why it is not even begun.
    fn limit(&self, row: &Row) -> Result<Duration, String> {
        let Some(knob) = row.knob else {
            // The baseline has been shown to fit, in f64.
            return Ok(self.budget);
        };
        let left = self.budget.as_secs_f64() * FIRST_RUNS_UNTIL - self.spent();
        let base = self.report.baseline_row().map_or(0.0, RowRecord::time) / 1e3;
        // How many samples adaptive antialiasing takes is for the picture to say: some at the least.
        let samples = if knob == Knob::Adaptive { ADAPTIVE_SAMPLES } else { row.setup.settings.samples };
        let expected = base * f64::from(samples);
        if expected > left {
            return Err(format!("would take about {expected:.0} s: allow more with --budget"));
        }
        if let Target::Gpu { adapter } = &row.setup.target
            && self.report.left_out.iter().any(|other| other.id.contains(adapter.as_str()))
        {
            return Err("as its first row".to_owned());
        }
        let share =
            if knob.truth() == Truth::Sampling { left } else { self.budget.as_secs_f64() * ROW_SHARE };
        Ok(Duration::from_secs_f64(share.min(left).max(0.0)))
    }

    /// A row's record, or why there is none.
    fn first_run(&mut self, row: &Row, judges: &Judges) -> Result<Result<RowRecord, String>, StudyError> {
        let limit = match self.limit(row) {
            Ok(limit) => limit,
            Err(reason) => return Ok(Err(reason)),
        };
        let shot = match self.lab.shoot(&row.setup, limit) {
            Ok(Some(shot)) => shot,
            Ok(None) => {
                return Ok(Err(format!(
                    "stopped after {:.0} s: allow more with --budget",
                    limit.as_secs_f64()
                )));
            }
            // What an adapter cannot do is worth a line, not the study.
            Err(StudyError::Gpu(error)) => return Ok(Err(error.to_string())),
            Err(error) => return Err(error),
        };
        let seen = Seen::of(&shot.frame);
        let mut errors = BTreeMap::new();
        for (&truth, reference) in judges {
            if judges_row(truth, row.knob) {
                errors.insert(truth, Errors::between(&seen, reference)?);
            }
        }
        if let Some(reference) = row.knob.and_then(|knob| judges.get(&knob.truth())) {
            self.store
                .write(&output::error_image_name(&row.id()), &output::error_image(&seen, reference)?)?;
        }
        let is_certified = row.knob.is_none_or(Knob::is_truncation);
        let tree = judges.get(&Truth::Truncation).filter(|_| is_certified);
        let certificate = tree.map(|tree| Certificate::of(&seen, tree));
        Ok(Ok(RowRecord {
            id: row.id(),
            knob: row.knob,
            label: row.label.clone(),
            value: row.value,
            rays: shot.frame.rays.into(),
            errors,
            certificate,
            warm_up_ms: shot.time.as_secs_f64() * 1e3,
            times_ms: Vec::new(),
            timing: None,
            ratio: None,
        }))
    }
}

/// Whether a reference can judge a row: its own knob's, the whole tree where samples and triangles are the
/// same, and each of them the baseline.
fn judges_row(truth: Truth, knob: Option<Knob>) -> bool {
    match knob {
        None => true,
        Some(knob) => knob.truth() == truth || (truth == Truth::Whole && knob.keeps_samples()),
    }
}
