//! The figures as Markdown; what fails is in bold.

use snellius::selftest::{Agreement, LEAST_EQUAL_F64, LEAST_EQUAL_FAST};

use super::measure::{Row, Target};

/// The head, and a row of what is required.
pub(super) fn head(first: &Target, second: &Target) -> String {
    let columns = [
        "scene".to_owned(),
        "triangles".to_owned(),
        "rays".to_owned(),
        format!("{} strict: differing pixels", first.name),
        format!("{} fast: equal primitive hash", first.name),
        format!("{} strict: differing pixels", second.name),
        "CPU f64: equal body hash".to_owned(),
        "CPU f64: p99 of abs(ΔRGB) there".to_owned(),
        "allowed".to_owned(),
    ];
    let required =
        format!("| *required* | | | 0 | ≥ {LEAST_EQUAL_FAST} % | 0 | ≥ {LEAST_EQUAL_F64} % | ≤ allowed | |");
    format!("| {} |\n|---|{}\n{required}", columns.join(" | "), "--:|".repeat(columns.len() - 1))
}

/// One scene.
pub(super) fn row(row: &Row) -> String {
    let cells = [
        format!("`{}`", row.scene),
        grouped(row.triangles as u64),
        grouped(row.rays),
        strict(&row.strict),
        mark(percent(row.fast), row.fast >= LEAST_EQUAL_FAST),
        strict(&row.second_strict),
        mark(percent(row.bodies), row.bodies >= LEAST_EQUAL_F64),
        mark(format!("{:.1e}", row.p99), row.p99 <= row.allowed),
        format!("{:.1e}", row.allowed),
    ];
    format!("| {} |", cells.join(" | "))
}

/// What was compared, at which size and with which drivers.
pub(super) fn caption(first: &Target, second: &Target, rows: &[Row]) -> String {
    let [width, height] = first.size;
    let relative = rows.iter().map(|row| row.p99 / row.brightest.max(1.0)).fold(0.0, f32::max);
    format!(
        "One sample a pixel; {}; {}; f64 at {width}×{height}. Allowed is 1e-4 of the scene's `max_radiance`, at least \
         1e-4; of the brightest value in its picture, at least 1, a scene's p99 is at most {relative:.1e}.",
        described(first),
        described(second)
    )
}

fn described(target: &Target) -> String {
    let Target { name, report, size: [width, height] } = target;
    let driver = if report.driver_info.is_empty() { &report.driver } else { &report.driver_info };
    format!("{name}: {}, {driver}, at {width}×{height}", report.name)
}

fn strict(strict: &Agreement) -> String {
    let rays = if strict.same_rays { "" } else { ", other rays" };
    mark(format!("{}{rays}", strict.differing), strict.is_exact())
}

fn mark(figure: String, holds: bool) -> String {
    if holds { figure } else { format!("**{figure}**") }
}

/// Three decimals, rounded down: only what is equal everywhere reads 100.
fn percent(value: f64) -> String {
    format!("{:.3} %", (value * 1000.0).floor() / 1000.0)
}

/// Digits in threes, with narrow no-break spaces.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let threes: Vec<_> = digits.as_bytes().rchunks(3).rev().map(String::from_utf8_lossy).collect();
    threes.join("\u{202f}")
}
