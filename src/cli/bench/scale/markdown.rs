//! The fitted powers as a page for people.

use super::Report;
use crate::bench::{Growth, Spread};

/// A line for each axis and device, and what it was measured on.
pub(super) fn page(report: &Report) -> String {
    let mut text = String::from(
        "| time grows with | device | from | to | ms at the ends | slope (95 %) | accepted |\n|---|---|--:|--:|--:|--:|--:|\n",
    );
    text.extend(report.axes.iter().map(line));
    text + &format!(
        "\nSlopes s of time ∝ amount^s: least squares of logarithms over all amounts, median of rounds in turn after a \
         warm-up, with its 95 % interval. Every picture has the CPU's bits. {}\n",
        report.machine.sentence()
    )
}

fn line(growth: &Growth) -> String {
    let Growth { label, device, points, slope: Spread { median, low, high }, limit, .. } = growth;
    let [Some(first), Some(last)] = [points.first(), points.last()] else { return String::new() };
    let limit = limit.map(|limit| format!("≤ {limit}")).unwrap_or_default();
    format!(
        "| {label} | {device} | {} | {} | {:.2}, {:.2} | {median:.3} ({low:.3}–{high:.3}) | {limit} |\n",
        first.amount, last.amount, first.trace_ms.median, last.trace_ms.median
    )
}
