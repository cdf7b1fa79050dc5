//! The measured figures as a page for people.

use super::Report;
use crate::bench::{BreakEven, ByKind, Change, DeviceRow, Phases, Ratio, SceneRow, Spread, Verdict};

/// Headlines, the parts of the way, rates, threads, and what it was measured on.
pub(super) fn page(report: &Report) -> String {
    let tables = [
        headlines(&report.scenes),
        parts(&report.scenes),
        rates(&report.scenes),
        scaling(&report.scenes),
        changes(&report.changes),
        caption(report),
    ];
    tables.into_iter().filter(|table| !table.is_empty()).collect::<Vec<_>>().join("\n")
}

/// Each device of each scene, in a line of its own.
fn by_device(scenes: &[SceneRow], line: impl Fn(&SceneRow, &DeviceRow) -> String) -> String {
    let of_scene = |row: &SceneRow| -> String {
        let lines = row.devices.iter().map(|side| {
            let cells = line(row, side);
            format!("| `{}` | {} | {cells} |\n", row.scene, side.device)
        });
        lines.collect()
    };
    scenes.iter().map(of_scene).collect()
}

fn headlines(scenes: &[SceneRow]) -> String {
    let head = "| scene | device | trace, ms (95 %) | ÷ CPU, all threads (95 %) | Mrays/s | file to picture, ms | pictures sooner than the CPU |\n\
                |---|---|--:|--:|--:|--:|--:|\n";
    let line = |_: &SceneRow, side: &DeviceRow| {
        format!(
            "{} | {} | {:.2} | {:.0} | {}",
            milliseconds(side.trace_ms),
            ratio(side.ratio),
            side.mrays_per_s.total,
            side.picture_ms,
            side.break_even.map(break_even).unwrap_or_default()
        )
    };
    head.to_owned() + &by_device(scenes, line)
}

fn milliseconds(Spread { median, low, high }: Spread) -> String {
    // Three digits of short times.
    let digits = if median < 10.0 { 2 } else { 1 };
    format!("{median:.digits$} ({low:.digits$}–{high:.digits$})")
}

fn ratio(Ratio { median, low, high }: Ratio) -> String {
    format!("{median:.2} ({low:.2}–{high:.2})")
}

fn break_even(frames: BreakEven) -> String {
    match frames {
        BreakEven::From(1) => "any number".to_owned(),
        BreakEven::From(frames) => format!("{frames} or more"),
        BreakEven::UpTo(frames) => format!("up to {frames}"),
        BreakEven::Never => "none".to_owned(),
    }
}

fn parts(scenes: &[SceneRow]) -> String {
    let head = "| scene | device | load | BVH | open | upload | compile, cold | (warm) | trace | wait | read back | encode |\n\
                |---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    let line = |_: &SceneRow, side: &DeviceRow| {
        let Phases { load, bvh, open, upload, compile_cold, compile_warm, trace, wait, readback, encode } =
            side.phases_ms;
        let all = [load, bvh, open, upload, compile_cold, compile_warm, trace, wait, readback, encode];
        let is_cpu = side.threads.is_some();
        let cell = |(index, time): (usize, &f64)| {
            // Upload, compilation, waiting and reading back: what the CPU does not do.
            if is_cpu && [3, 4, 5, 7, 8].contains(&index) { String::new() } else { format!("{time:.1}") }
        };
        all.iter().enumerate().map(cell).collect::<Vec<_>>().join(" | ")
    };
    head.to_owned() + &by_device(scenes, line)
}

fn rates(scenes: &[SceneRow]) -> String {
    let head = "| scene | device | primary, Mrays/s | reflection | refraction | shadow |\n|---|---|--:|--:|--:|--:|\n";
    let line = |_: &SceneRow, side: &DeviceRow| {
        let ByKind { primary, reflection, refraction, shadow, .. } = side.mrays_per_s;
        [primary, reflection, refraction, shadow].map(|rate| format!("{rate:.2}")).join(" | ")
    };
    head.to_owned() + &by_device(scenes, line)
}

/// Threads against one; nothing where there is but one.
fn scaling(scenes: &[SceneRow]) -> String {
    let mut text = String::new();
    for row in scenes {
        for side in row.scaling.iter().filter(|side| side.threads > 1) {
            let part = side.speedup.median / side.threads as f64 * 100.0;
            text +=
                &format!("| `{}` | {} | {} | {part:.0} % |\n", row.scene, side.threads, ratio(side.speedup));
        }
    }
    if text.is_empty() {
        text
    } else {
        format!("| scene | threads | × one thread (95 %) | of ideal |\n|---|--:|--:|--:|\n{text}")
    }
}

fn changes(changes: &[Change]) -> String {
    if changes.is_empty() {
        return String::new();
    }
    let mut text =
        String::from("| scene | device | before, ms | now, ms | change | |\n|---|---|--:|--:|--:|---|\n");
    for Change { scene, device, before_ms, now_ms, verdict } in changes {
        let (before, change) = before_ms.map_or_else(Default::default, |before| {
            (milliseconds(before), format!("{:+.1} %", (now_ms.median / before.median - 1.0) * 100.0))
        });
        let verdict = match verdict {
            Verdict::Grown => "slower",
            Verdict::Kept => "",
            Verdict::New => "not in the baseline",
        };
        text += &format!(
            "| `{scene}` | {device} | {before} | {} | {change} | {verdict} |\n",
            milliseconds(*now_ms)
        );
    }
    text
}

fn caption(report: &Report) -> String {
    let size = |row: &SceneRow| {
        let [width, height] = row.size;
        format!("`{}` {width}×{height}, {} rounds", row.scene, row.rounds)
    };
    let sizes: Vec<_> = report.scenes.iter().map(size).collect();
    format!(
        "One sample a pixel; every device's pictures are those of the CPU, bit for bit; medians of runs in turn after a \
         warm-up, with 95 % intervals. {}. Milliseconds; the trace is the adapter's own time where it has timestamps, and \
         waiting is what the host sees beyond it. File to picture: a first start, {}. {}\n",
        sizes.join("; "),
        report.machine.shaders(),
        report.machine.sentence()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_counted_in_words() {
        assert_eq!(break_even(BreakEven::From(1)), "any number");
        assert_eq!(break_even(BreakEven::From(12)), "12 or more");
        assert_eq!(break_even(BreakEven::UpTo(3)), "up to 3");
        assert_eq!(break_even(BreakEven::Never), "none");
    }

    #[test]
    fn a_change_is_told_in_per_cent_and_a_new_row_has_none() {
        let time = |median| Spread { median, low: median, high: median };
        let change = |before_ms, verdict| Change {
            scene: "ice.toml".into(),
            device: "CPU".into(),
            before_ms,
            now_ms: time(20.0),
            verdict,
        };
        let text = changes(&[change(Some(time(16.0)), Verdict::Grown), change(None, Verdict::New)]);
        assert!(text.contains("| 16.0 (16.0–16.0) | 20.0 (20.0–20.0) | +25.0 % | slower |"), "{text}");
        assert!(text.contains("|  | 20.0 (20.0–20.0) |  | not in the baseline |"), "{text}");
    }
}
