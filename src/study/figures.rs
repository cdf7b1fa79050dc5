//! The plots of a report.

use super::pareto::front;
use super::{Certificate, Knob, Report, RowRecord, Truth};
use crate::plot::{
    Axis, BLACK, BLUE, Figure, GREEN, GREY, Kind, Line, Mark, ORANGE, PURPLE, Panel, Point, Rule, SKY,
    Series, VERMILLION,
};

/// All plots that the report has figures for.
pub(super) fn figures(report: &Report) -> Vec<Figure> {
    [pareto(report), truncation(report), sampling(report)].into_iter().flatten().collect()
}

/// A knob's colour in every plot.
fn color(knob: Option<Knob>) -> &'static str {
    match knob {
        None => BLACK,
        Some(Knob::Depth) => BLUE,
        Some(Knob::Cutoff) => VERMILLION,
        Some(Knob::Samples) => GREEN,
        Some(Knob::Adaptive) => VERMILLION,
        Some(Knob::Precision) => PURPLE,
        Some(Knob::Intersector) => SKY,
        Some(Knob::Effects) => GREY,
        Some(Knob::Tessellation | Knob::Device) => ORANGE,
    }
}

/// A row's name among rows of other knobs.
pub(super) fn name_of(row: &RowRecord) -> String {
    match row.knob {
        None => "baseline".to_owned(),
        Some(Knob::Samples) if row.label == "1" => "1 sample".to_owned(),
        Some(Knob::Samples) => format!("{} samples", row.label),
        Some(Knob::Adaptive) => format!("adaptive {}", row.label),
        Some(Knob::Depth) => format!("depth {}", row.label),
        Some(Knob::Cutoff) => format!("cut-off {}", row.label),
        Some(Knob::Tessellation) => format!("solids {}", row.label),
        Some(Knob::Device) => device_name(&row.label),
        Some(Knob::Precision | Knob::Intersector | Knob::Effects) => row.label.clone(),
    }
}

/// A device without what its driver says of itself in brackets: "llvmpipe, strict".
fn device_name(label: &str) -> String {
    match (label.split_once(" ("), label.rsplit_once("), ")) {
        (Some((name, _)), Some((_, float))) => format!("{name}, {float}"),
        _ => label.to_owned(),
    }
}

fn log(label: &str) -> Axis {
    Axis { label: label.to_owned(), kind: Kind::Log, at_points: false }
}

/// An axis of whole numbers, each written out.
fn counts(label: &str) -> Axis {
    Axis { at_points: true, ..log(label) }
}

/// Error against time with the front that no other setting beats, one panel for each reference that judges
/// rows of several settings.
fn pareto(report: &Report) -> Option<Figure> {
    let panels: Vec<_> = [Truth::Whole, Truth::Sampling, Truth::Tessellation]
        .into_iter()
        .filter_map(|truth| pareto_panel(report, truth))
        .collect();
    (!panels.is_empty()).then(|| Figure {
        name: "pareto",
        title: "Error against time".to_owned(),
        caption: "Filled: the Pareto front, which no other setting beats in both time and error. Horizontal bars: \
                  95 % intervals of the median time. Dotted, where it is near: the reference's own uncertainty, \
                  below which errors mean nothing."
            .to_owned(),
        panels,
    })
}

/// The rows that a reference judges, the baseline among them.
pub(super) fn judged(report: &Report, truth: Truth) -> Vec<&RowRecord> {
    let of_truth = |row: &&RowRecord| row.errors.contains_key(&truth);
    report.rows.iter().filter(of_truth).collect()
}

fn pareto_panel(report: &Report, truth: Truth) -> Option<Panel> {
    let rows = judged(report, truth);
    if rows.len() < 2 {
        return None;
    }
    let error = |row: &RowRecord| row.errors.get(&truth).map_or(0.0, |errors| errors.rmse);
    let best = front(&rows.iter().map(|row| (row.time(), error(row))).collect::<Vec<_>>());
    let point = |row: &RowRecord, mark| Point {
        x: row.time(),
        y: error(row),
        span: row.timing.map(|timing| [timing.low, timing.high]),
        name: Some(name_of(row)),
        mark,
    };
    let steps = best.iter().map(|&i| Point { name: None, span: None, ..point(rows[i], Mark::Filled) });
    let mut series =
        vec![Series { name: String::new(), color: "#b0b0b0", line: Line::Solid, points: steps.collect() }];
    for (index, row) in rows.iter().enumerate() {
        let mark = if best.contains(&index) { Mark::Filled } else { Mark::Hollow };
        let points = vec![point(row, mark)];
        series.push(Series { name: String::new(), color: color(row.knob), line: Line::None, points });
    }
    // Names of the front before the others'; marks are drawn from the last to the first.
    let is_front = |series: &Series| series.points.iter().all(|point| point.mark == Mark::Filled);
    series[1..].sort_by_key(|series| !is_front(series));
    series.rotate_left(1);
    let least = rows.iter().map(|row| error(row)).filter(|&e| e > 0.0).fold(f64::MAX, f64::min);
    let rules = uncertainty(report, truth).into_iter().filter(|rule| rule.y > least * RULE_REACH).collect();
    let against = match truth {
        Truth::Whole => "against the whole tree in f64",
        Truth::Truncation => "against the whole tree",
        Truth::Sampling => "against many samples",
        Truth::Arithmetic => "against f64",
        Truth::Tessellation => "against the finest solids",
    };
    Some(Panel {
        title: format!("Error {against}"),
        x: log("time of a picture in ms"),
        y: log("RMSE, linear RGB in [0, 1]"),
        series,
        rules,
    })
}

/// A line far below all errors would only press them together.
const RULE_REACH: f64 = 0.1;

/// The reference's uncertainty as a line.
fn uncertainty(report: &Report, truth: Truth) -> Vec<Rule> {
    let Some(record) = report.references.get(&truth) else { return Vec::new() };
    let estimated = record.uncertainty.estimated.rmse;
    let certified = record.uncertainty.certified.map(|certified| certified.rmse).filter(|&rmse| rmse > 0.0);
    let rule = |y: f64, name: &str| Rule { y, name: name.to_owned() };
    let estimated = (estimated > 0.0).then(|| rule(estimated, "reference, estimated"));
    let certified = certified.map(|y| rule(y, "reference, proven"));
    certified.into_iter().chain(estimated).collect()
}

/// True error and certified bound against depth and cut-off.
fn truncation(report: &Report) -> Option<Figure> {
    let panels: Vec<_> =
        [(Knob::Depth, "depth of the ray tree"), (Knob::Cutoff, "least weight of a traced ray")]
            .into_iter()
            .filter_map(|(knob, label)| truncation_panel(report, knob, label))
            .collect();
    (!panels.is_empty()).then(|| Figure {
        name: "truncation",
        title: "Truncation: certified bound and true error".to_owned(),
        caption:
            "The bound is certain for every pixel, whatever the scene; the true error is the distance to a \
                  tree of depth 64 in the same arithmetic. Both in linear radiance, not clamped."
                .to_owned(),
        panels,
    })
}

fn truncation_panel(report: &Report, knob: Knob, label: &str) -> Option<Panel> {
    let rows: Vec<(f64, Certificate)> = report
        .rows_of(knob)
        .into_iter()
        .filter_map(|row| Some((row.value_of(knob, report)?, row.certificate?)))
        .collect();
    if rows.len() < 2 {
        return None;
    }
    // A place for nothing only where there is one.
    let kind = if rows.iter().any(|(x, _)| *x <= 0.0) { Kind::LogAndZero } else { Kind::Log };
    type Pick = fn(&Certificate) -> f64;
    let lines: [(&str, &'static str, Line, Pick); 4] = [
        ("bound, greatest", VERMILLION, Line::Dashed, |c| c.bound_max),
        ("true error, greatest", VERMILLION, Line::Solid, |c| c.error_max),
        ("bound, mean", BLUE, Line::Dashed, |c| c.bound_mean),
        ("true error, mean", BLUE, Line::Solid, |c| c.error_mean),
    ];
    let series = lines.map(|(name, color, line, value)| Series {
        name: name.to_owned(),
        color,
        line,
        points: rows
            .iter()
            .map(|(x, certificate)| Point {
                x: *x,
                y: value(certificate),
                span: None,
                name: None,
                mark: if line == Line::Solid { Mark::Filled } else { Mark::Hollow },
            })
            .collect(),
    });
    Some(Panel {
        title: knob.title().to_owned(),
        x: Axis { label: label.to_owned(), kind, at_points: knob == Knob::Depth },
        y: log("linear radiance"),
        series: series.into(),
        rules: Vec::new(),
    })
}

/// Error and time against samples.
fn sampling(report: &Report) -> Option<Figure> {
    let rows: Vec<_> = report
        .rows_of(Knob::Samples)
        .into_iter()
        .filter_map(|row| {
            let errors = row.errors.get(&Truth::Sampling)?;
            Some((row.value_of(Knob::Samples, report)?, row, errors))
        })
        .collect();
    let (first, ..) = rows.first()?;
    if rows.len() < 3 {
        return None;
    }
    let plain = |x: f64, y: f64, mark| Point { x, y, span: None, name: None, mark };
    let errors = rows.iter().map(|(x, _, errors)| plain(*x, errors.rmse, Mark::Filled)).collect();
    let start = rows[0].2.rmse;
    let guide = rows.iter().map(|(x, ..)| plain(*x, start * (first / x).sqrt(), Mark::Hollow)).collect();
    let times = rows.iter().map(|(x, row, _)| plain(*x, row.time(), Mark::Filled)).collect();
    let series = |name: &str, color, line, points| Series { name: name.to_owned(), color, line, points };
    let error_panel = Panel {
        title: "Error".to_owned(),
        x: counts("samples per pixel"),
        y: log("RMSE, linear RGB in [0, 1]"),
        series: vec![
            series("true error", GREEN, Line::Solid, errors),
            series("random samples: 1/√n", GREY, Line::Dashed, guide),
        ],
        rules: uncertainty(report, Truth::Sampling),
    };
    let time_panel = Panel {
        title: "Time".to_owned(),
        x: counts("samples per pixel"),
        y: log("time of a picture in ms"),
        series: vec![series("", GREEN, Line::Solid, times)],
        rules: Vec::new(),
    };
    Some(Figure {
        name: "sampling",
        title: "Samples per pixel".to_owned(),
        caption:
            "Dashed: how the error of independent samples would fall. The first samples of the reference are \
                  those of the rows, so that errors of many samples are understated."
                .to_owned(),
        panels: vec![error_panel, time_panel],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_device_is_named_in_few_words() {
        assert_eq!(device_name("llvmpipe (LLVM 15.0.6, 256 bits) (software), strict"), "llvmpipe, strict");
        assert_eq!(device_name("CPU, 1 thread"), "CPU, 1 thread");
    }
}
