//! The rows of a knob as words: the same table in Markdown and in HTML.

use super::super::reference::Worth;
use super::super::report::RowRecord;
use super::super::{Errors, Knob, Report, Truth};

/// A table of words.
pub(super) struct Table {
    pub(super) head: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

/// The columns that every table has.
const COLUMNS: [&str; 9] =
    ["median time", "95 % interval", "ratio", "rays", "RMSE", "p99.9", "max", "ꟻLIP", "other paths"];
/// Those that depth and cut-off have besides.
const BOUNDS: [&str; 4] = ["bound, mean", "true, mean", "bound, max", "true, max"];

/// What marks stand for.
pub(super) const MARKS: &str = "† below the reference's own uncertainty: the true error may be anything up to that. \
     * below what is proven of the reference, above what it is estimated to be off.";

/// The rows of a knob; `None` where there is only the baseline.
pub(super) fn of_knob(report: &Report, knob: Knob) -> Option<Table> {
    let rows = report.rows_of(knob);
    if rows.is_empty() {
        return None;
    }
    let mut head = vec![knob.name().to_owned()];
    head.extend(COLUMNS.map(str::to_owned));
    if knob.is_truncation() {
        head.extend(BOUNDS.map(str::to_owned));
    }
    let rows = rows.into_iter().map(|row| words(report, knob, row)).collect();
    Some(Table { head, rows })
}

fn words(report: &Report, knob: Knob, row: &RowRecord) -> Vec<String> {
    let mut words = vec![label(report, knob, row)];
    words.push(time(row.time()));
    words.push(interval(row));
    words.push(row.ratio.map_or_else(String::new, |ratio| format!("{ratio:.2}")));
    words.push(count(row.rays.total()));
    match row.errors.get(&knob.truth()) {
        Some(errors) => words.extend(error_words(report, knob.truth(), errors)),
        None => words.extend(std::iter::repeat_n("–".to_owned(), 5)),
    }
    if knob.is_truncation() {
        match row.certificate {
            Some(c) => words.extend([c.bound_mean, c.error_mean, c.bound_max, c.error_max].map(number)),
            None => words.extend(std::iter::repeat_n("–".to_owned(), BOUNDS.len())),
        }
    }
    words
}

fn label(report: &Report, knob: Knob, row: &RowRecord) -> String {
    if row.knob.is_some() {
        return row.label.clone();
    }
    let value = match knob {
        Knob::Cutoff => {
            row.value_of(knob, report).map(|value| super::super::plan::cutoff_label(value as f32))
        }
        _ => row.value_of(knob, report).map(|value| value.to_string()),
    };
    value.map_or_else(|| "baseline".to_owned(), |value| format!("{value} (baseline)"))
}

fn error_words(report: &Report, truth: Truth, errors: &Errors) -> [String; 5] {
    let uncertainty = report.references.get(&truth).map(|record| &record.uncertainty);
    let mark = |worth: Option<Worth>| match worth {
        Some(Worth::Nothing) => "†",
        Some(Worth::Estimated) => "*",
        Some(Worth::Proven) | None => "",
    };
    let estimated = |error: f64, uncertain: fn(&Errors) -> f64| {
        let below = uncertainty.is_some_and(|u| error <= uncertain(&u.estimated));
        format!("{}{}", number(error), if below { "†" } else { "" })
    };
    let rmse = mark(uncertainty.map(|u| u.worth_of_rmse(errors.rmse)));
    let max = mark(uncertainty.map(|u| u.worth_of_max(errors.max)));
    let broken = match errors.non_finite {
        0 => String::new(),
        pixels => format!(", {} not finite", count(pixels as u64)),
    };
    [
        format!("{}{rmse}", number(errors.rmse)),
        estimated(errors.p999, |e| e.p999),
        format!("{}{max}", number(errors.max)),
        estimated(errors.flip, |e| e.flip),
        format!("{}{broken}", count(errors.paths as u64)),
    ]
}

fn interval(row: &RowRecord) -> String {
    match row.timing {
        Some(timing) if timing.runs >= 2 => {
            let sure = if timing.confidence < 0.95 {
                format!(" ({:.0} %, {} runs)", timing.confidence * 100.0, timing.runs)
            } else {
                String::new()
            };
            format!("{} – {}{sure}", time(timing.low), time(timing.high))
        }
        _ if row.times_ms.is_empty() => "one run, not warm".to_owned(),
        _ => "one run".to_owned(),
    }
}

/// Milliseconds in three digits.
pub(super) fn time(ms: f64) -> String {
    match ms {
        ms if ms >= 9999.5 => format!("{:.1} s", ms / 1e3),
        ms if ms >= 99.5 => format!("{ms:.0} ms"),
        ms if ms >= 9.95 => format!("{ms:.1} ms"),
        ms => format!("{ms:.2} ms"),
    }
}

/// A figure in three digits.
pub(super) fn number(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        v if (1e-3..1e4).contains(&v.abs()) => {
            let places = usize::try_from(2 - v.abs().log10().floor() as i32).unwrap_or(0);
            format!("{v:.places$}")
        }
        v => format!("{v:.2e}").replace("e-", "e−"),
    }
}

/// A count in thousands, millions where it is large.
pub(super) fn count(value: u64) -> String {
    match value {
        0..10_000 => value.to_string(),
        10_000..1_000_000 => format!("{:.0} k", value as f64 / 1e3),
        _ => format!("{:.2} M", value as f64 / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_three_digits() {
        let shown = [0.0, 0.123_456, 1.5, 123.456, 1.234e-5, 0.001].map(number);
        assert_eq!(shown, ["0", "0.123", "1.50", "123", "1.23e−5", "0.00100"]);
        assert_eq!([1.234, 12.34, 123.4, 12_340.0].map(time), ["1.23 ms", "12.3 ms", "123 ms", "12.3 s"]);
        assert_eq!([999, 76_800, 2_151_191].map(count), ["999", "77 k", "2.15 M"]);
    }
}
