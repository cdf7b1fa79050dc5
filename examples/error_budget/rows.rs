//! The rows of a study that keep an error, and the time of the cheapest against that of a budget.

use snellius::layout::{Precision, Settings};

use super::Result;
use super::stage::{Shot, Stage};

/// Those of `snellius study`.
const DEPTHS: [u32; 6] = [1, 2, 4, 8, 16, 32];
const CUTOFFS: [f32; 7] = [0.0625, 0.015_625, 0.003_906_25, 1e-3, 1e-4, 1e-5, 1e-6];

/// The cheapest row that keeps the error, timed in turn with what the budget chose.
pub(super) struct Row {
    pub(super) label: String,
    pub(super) row_ms: f64,
    chosen_ms: f64,
}

impl Row {
    /// Time of the budget's choice over the row's.
    pub(super) fn ratio(&self) -> f64 {
        self.chosen_ms / self.row_ms
    }
}

/// The cheapest row by first runs, then medians of so many more of both, interleaved; `None` if no row keeps the error.
pub(super) fn cheapest(
    stage: &Stage,
    truth: &Shot,
    limit: f64,
    chosen: &Settings,
    runs: usize,
) -> Result<Option<Row>> {
    let mut best: Option<(f64, String, Settings)> = None;
    for (label, settings) in rows(stage) {
        let shot = stage.shoot(&settings)?;
        if shot.rmse(truth) <= limit && best.as_ref().is_none_or(|(ms, ..)| shot.ms < *ms) {
            best = Some((shot.ms, label, settings));
        }
    }
    let Some((_, label, settings)) = best else { return Ok(None) };
    let (mut row_ms, mut chosen_ms) = (Vec::new(), Vec::new());
    for _ in 0..runs.max(1) {
        row_ms.push(stage.shoot(&settings)?.ms);
        chosen_ms.push(stage.shoot(chosen)?.ms);
    }
    Ok(Some(Row { label, row_ms: median(row_ms), chosen_ms: median(chosen_ms) }))
}

/// What a study changes of the scene's own settings, of one sample.
fn rows(stage: &Stage) -> Vec<(String, Settings)> {
    let render = &stage.scene.render;
    let base = Settings { depth: render.depth, cutoff: render.cutoff as f32, ..Settings::default() };
    let double = Settings { precision: Precision::F64, ..base };
    let named = [("baseline".to_owned(), base), ("f64".to_owned(), double)];
    let depths = DEPTHS.map(|depth| (format!("depth {depth}"), Settings { depth, ..base }));
    let cutoffs = CUTOFFS.map(|cutoff| (format!("cut-off {cutoff:e}"), Settings { cutoff, ..base }));
    named.into_iter().chain(depths).chain(cutoffs).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    f64::midpoint(values[(values.len() - 1) / 2], values[values.len() / 2])
}
