//! The measured figures as a page for people.

use super::Report;
use crate::bench::{EffectRow, Sides};
use crate::gpu::InvocationMemory;

/// Two tables and what they were measured on.
pub(super) fn page(report: &Report) -> String {
    let mut text = String::new();
    text += "| scene | device | rays | own effects, ms | all effects, ms | ratio (95 %) | compile, ms | private bytes | bytes at rest |\n";
    text += "|---|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for row in &report.scenes {
        text += &format!(
            "| `{}` | {} | {} | {} | {} |\n",
            row.scene,
            row.device,
            row.rays,
            times(row),
            device_figures(row)
        );
    }
    if !report.alone.is_empty() {
        text += "\n| added alone | to | device | without, ms | with, ms | ratio (95 %) | compile, ms | private bytes | bytes at rest |\n";
        text += "|---|---|---|--:|--:|--:|--:|--:|--:|\n";
        for row in &report.alone {
            text += &format!(
                "| {} | `{}` | {} | {} | {} |\n",
                row.added.join(" + "),
                row.scene,
                row.device,
                times(row),
                device_figures(row)
            );
        }
    }
    text + &caption(report)
}

fn times(row: &EffectRow) -> String {
    let (Sides { special, general }, ratio) = (row.trace_ms, row.ratio);
    format!("{special:.1} | {general:.1} | {:.2} ({:.2}–{:.2})", ratio.median, ratio.low, ratio.high)
}

/// Compile times and memory, which the CPU has not.
fn device_figures(row: &EffectRow) -> String {
    let compile = row.compile_ms.map(|Sides { special, general }| format!("{special:.0}, {general:.0}"));
    let bytes = |of: fn(InvocationMemory) -> u64| {
        row.memory
            .map(|Sides { special, general }| format!("{}, {}", of(special), of(general)))
            .unwrap_or_default()
    };
    let (private, at_rest) = (bytes(|memory| memory.private), bytes(|memory| memory.at_rest));
    format!("{} | {private} | {at_rest}", compile.unwrap_or_default())
}

fn caption(report: &Report) -> String {
    let [width, height] = report.size;
    let machine = &report.machine;
    format!(
        "\n{width}×{height}, one sample a pixel; trace times: medians of {} runs of each side in turn; every row's two \
         pictures are the same bits. Compile (medians of three fresh renderers) and bytes: own effects, then all; {}. {}\n",
        report.rounds,
        machine.shaders(),
        machine.sentence()
    )
}
