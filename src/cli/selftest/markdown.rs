//! What the cases found, as a page.

use super::report::{Figure, Report};
use super::text::{cell, sentence};

/// The page: devices, a table case × device, what each case claims, and every figure.
pub(super) fn page(report: &Report) -> String {
    let mut text = format!(
        "# Stability\n\nWritten by `snellius selftest --markdown`, version {}, {} run, {} test.\n\n",
        report.version, report.effort, report.intersector
    );
    for [name, driver] in &report.adapters {
        text += &format!("- {name}: {driver}\n");
    }
    text += &format!(
        "\n| case | {} |\n|---|{}\n",
        report.devices.join(" | "),
        "---|".repeat(report.devices.len())
    );
    for case in &report.cases {
        let cells: Vec<_> = case.results.iter().map(cell).collect();
        text += &format!("| {} {} | {} |\n", case.case, case.title, cells.join(" | "));
    }
    for case in &report.cases {
        text += &format!("\n## {}: {}\n\nClaim: {}.\n", case.case, case.title, case.claim);
        for result in &case.results {
            text += &format!("\n{}:\n\n", result.device);
            text += &result.findings.iter().map(item).collect::<String>();
        }
    }
    text
}

fn item(figure: &Figure) -> String {
    format!("- {}{}\n", if figure.holds { "" } else { "✗ " }, sentence(figure))
}
