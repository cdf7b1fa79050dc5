//! What the cases found, as a page.

use super::arithmetic;
use super::report::{CaseReport, Figure, Report};
use super::text::{cell, sentence};

/// The page: adapters, their arithmetic, a table case × device, what each case claims, and the figures beyond their bounds,
/// or if `verbose` all of them.
pub(super) fn page(report: &Report, verbose: bool) -> String {
    let mut text = format!(
        "# Stability\n\nWritten by `snellius selftest --markdown`, version {}, {} run, {} test.\n\n",
        report.version, report.effort, report.intersector
    );
    for [name, driver] in &report.adapters {
        text += &format!("- {name}: {driver}\n");
    }
    text += "\n## Arithmetic\n\nWhat the adapters make of f32; it explains what follows.\n\n";
    text += &table("", &arithmetic::heads(&report.arithmetic), &arithmetic::rows(&report.arithmetic));
    text += "\n## The cases\n\nThe most telling figure of each, with its bound.\n\n";
    let row = |case: &CaseReport| {
        (format!("{} {}", case.case, case.title), case.results.iter().map(cell).collect::<Vec<_>>())
    };
    text += &table("case", &report.devices, &report.cases.iter().map(row).collect::<Vec<_>>());
    for case in &report.cases {
        text += &format!("\n### {}: {}\n\nClaim: {}.\n", case.case, case.title, case.claim);
        for result in &case.results {
            let items: String =
                result.findings.iter().filter(|figure| verbose || !figure.holds).map(item).collect();
            if !items.is_empty() {
                text += &format!("\n{}:\n\n{items}", result.device);
            }
        }
    }
    text
}

fn table(corner: &str, heads: &[String], rows: &[(String, Vec<String>)]) -> String {
    let mut text = format!("| {corner} | {} |\n|---|{}\n", heads.join(" | "), "---|".repeat(heads.len()));
    for (label, cells) in rows {
        text += &format!("| {label} | {} |\n", cells.join(" | "));
    }
    text
}

fn item(figure: &Figure) -> String {
    format!("- {}{}\n", if figure.holds { "" } else { "✗ " }, sentence(figure))
}
