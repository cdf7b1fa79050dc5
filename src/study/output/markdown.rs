//! The report as Markdown.

use super::super::{Knob, Report};
use super::table::{self, MARKS, Table, number, time};
use crate::plot::Figure;

/// The whole page.
pub(super) fn page(report: &Report, figures: &[Figure]) -> String {
    let mut page = vec![format!("# What accuracy costs in time: {}", report.scene)];
    page.push(introduction(report));
    for figure in figures {
        page.push(format!("![{}]({}.svg)", figure.title, figure.name));
        page.push(format!("**{}.** {}", figure.title, figure.caption));
    }
    page.push("## References".to_owned());
    page.push(table_text(&references(report)));
    for knob in Knob::ALL {
        if let Some(table) = table::of_knob(report, knob) {
            page.push(format!("## {}", knob.title()));
            page.push(table_text(&table));
        }
    }
    page.push(MARKS.to_owned());
    page.extend(left_out(report));
    page.join("\n\n") + "\n"
}

/// What was measured, and how; the same words in HTML.
pub(super) fn introduction(report: &Report) -> String {
    let [width, height] = report.size;
    format!(
        "{}×{height} pixels, {} triangles, on {} ({} threads), snellius {}. Baseline: {}. Each row changes one \
         setting of it. Errors are in linear RGB clamped to [0, 1], against the reference of the setting. Times \
         are medians of interleaved runs after a warm-up, of tracing alone: reading the scene and compiling \
         shaders are left out. The study took {:.0} s.",
        width, report.triangles, report.cpu, report.threads, report.version, report.baseline, report.spent_s
    )
}

/// The references and how far they may be off.
pub(super) fn references(report: &Report) -> Table {
    let head = [
        "truth of",
        "traced as",
        "time",
        "RMSE, proven",
        "RMSE, estimated",
        "max, proven",
        "max, estimated",
        "from",
    ];
    let rows = report
        .references
        .iter()
        .map(|(truth, record)| {
            let u = &record.uncertainty;
            let proven = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), number);
            vec![
                truth.name().to_owned(),
                record.setup.clone(),
                time(record.time_ms),
                proven(u.certified.map(|c| c.rmse)),
                number(u.estimated.rmse),
                proven(u.certified.map(|c| c.max)),
                number(u.estimated.max),
                u.source.clone(),
            ]
        })
        .collect();
    Table { head: head.map(str::to_owned).into(), rows }
}

fn left_out(report: &Report) -> Vec<String> {
    if report.left_out.is_empty() {
        return Vec::new();
    }
    let lines: Vec<_> = report.left_out.iter().map(|row| format!("- {}: {}", row.id, row.reason)).collect();
    vec!["## Left out".to_owned(), lines.join("\n")]
}

fn table_text(table: &Table) -> String {
    let line = |cells: &[String]| {
        format!("| {} |", cells.iter().map(|cell| cell.replace('|', "\\|")).collect::<Vec<_>>().join(" | "))
    };
    let rule = format!("|{}", "---|".repeat(table.head.len()));
    let mut lines = vec![line(&table.head), rule];
    lines.extend(table.rows.iter().map(|row| line(row)));
    lines.join("\n")
}
