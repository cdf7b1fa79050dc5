//! All rows as comma-separated values (RFC 4180), numbers in full.

use super::super::{Knob, Report, RowRecord};

const HEAD: [&str; 25] = [
    "id",
    "knob",
    "value",
    "median_ms",
    "low_ms",
    "high_ms",
    "confidence",
    "runs",
    "ratio",
    "primary",
    "reflection",
    "refraction",
    "shadow",
    "reference",
    "rmse",
    "p999",
    "max",
    "flip",
    "other_paths",
    "not_finite",
    "bound_mean",
    "true_mean",
    "bound_max",
    "true_max",
    "bounds_broken",
];

/// One line a row and reference that judges it.
pub(super) fn csv(report: &Report) -> String {
    let mut lines = vec![HEAD.join(",")];
    for row in &report.rows {
        lines.extend(lines_of(row));
    }
    lines.push(String::new());
    lines.join("\r\n")
}

fn lines_of(row: &RowRecord) -> Vec<String> {
    let optional = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
    let t = row.timing;
    let mut first = vec![
        quoted(&row.id),
        row.knob.map_or("", Knob::name).to_owned(),
        optional(row.value),
        optional(t.map(|t| t.median)),
        optional(t.map(|t| t.low)),
        optional(t.map(|t| t.high)),
        optional(t.map(|t| t.confidence)),
        t.map_or_else(String::new, |t| t.runs.to_string()),
        optional(row.ratio),
    ];
    let rays = row.rays;
    first.extend([rays.primary, rays.reflection, rays.refraction, rays.shadow].map(|n| n.to_string()));
    let c = row.certificate;
    let mut last: Vec<_> =
        [c.map(|c| c.bound_mean), c.map(|c| c.error_mean), c.map(|c| c.bound_max), c.map(|c| c.error_max)]
            .map(optional)
            .into();
    last.push(c.map_or_else(String::new, |c| c.broken.to_string()));
    let line = |(truth, errors): (&super::super::Truth, &super::super::Errors)| {
        let mut middle = vec![truth.name().to_owned()];
        middle.extend([errors.rmse, errors.p999, errors.max, errors.flip].map(|value| value.to_string()));
        middle.extend([errors.paths, errors.non_finite].map(|value| value.to_string()));
        [first.clone(), middle, last.clone()].concat().join(",")
    };
    row.errors.iter().map(line).collect()
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}
