//! Agreement with theory: measured, expected and bound of the self-test's closed forms, for each device.

use snellius::gpu::{AdapterReport, GpuOptions, SOURCES};
use snellius::layout::{Float, Intersector, Precision};
use snellius::selftest::{Bound, CASES, Case, CpuDevice, Device, Effort, Finding, GpuDevice};

use super::Result;

/// The section with its table: a line for each figure that has an answer on paper, a column for each device.
pub(super) fn section(adapters: &[AdapterReport]) -> Result<String> {
    let mut devices: Vec<Box<dyn Device>> = Vec::new();
    for precision in [Precision::F32, Precision::F64] {
        devices.push(Box::new(CpuDevice::new(precision, Intersector::Watertight)));
    }
    for adapter in adapters {
        let options = GpuOptions { adapter: Some(adapter.name.clone()), ..GpuOptions::default() };
        devices.push(Box::new(GpuDevice::new(&options, Float::Strict, Intersector::Watertight, SOURCES)?));
    }
    let names: Vec<_> = devices.iter().map(|device| device.name().to_owned()).collect();
    let mut lines = vec![
        "## Agreement with theory".to_owned(),
        String::new(),
        "What has an answer on paper, and what each device measures. `snellius selftest` runs all cases."
            .to_owned(),
        String::new(),
        format!("| case | figure | expected | within | {} |", names.join(" | ")),
        format!("|---|---|---|---|{}", "---|".repeat(names.len())),
    ];
    for case in CASES {
        lines.extend(rows(case, &mut devices)?);
    }
    Ok(lines.join("\n"))
}

/// The figures of a case that are expected to be near a value.
fn rows(case: &Case, devices: &mut [Box<dyn Device>]) -> Result<Vec<String>> {
    let mut found: Vec<Vec<Finding>> = Vec::new();
    for device in devices {
        found.push((case.run)(device.as_mut(), Effort::Short)?);
    }
    let Some(first) = found.first() else { return Ok(Vec::new()) };
    let row = |(index, finding): (usize, &Finding)| {
        let Bound::Near { expected, within } = finding.bound else { return None };
        let measured = found.iter().map(|findings| {
            let same = findings.get(index).filter(|other| other.what == finding.what);
            same.map_or_else(|| "–".to_owned(), |other| figure(other.figure))
        });
        let measured = measured.collect::<Vec<_>>().join(" | ");
        Some(format!("| {} | {} | {} | {within:.1e} | {measured} |", case.id, finding.what, figure(expected)))
    };
    Ok(first.iter().enumerate().filter_map(row).collect())
}

/// Seven digits where the value is not tiny.
fn figure(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 => format!("{value:.3e}"),
        size if size >= 1e4 => format!("{value:.1}"),
        _ => format!("{value:.7}"),
    }
}
