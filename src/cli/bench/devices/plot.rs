//! The measured rates as a drawing.

use super::super::{color_of, short_name};
use super::Report;
use crate::bench::{DeviceRow, SceneRow};
use crate::plot::{DotSeries, Dots};

/// Rays a second of each device in each scene.
pub(super) fn dots(report: &Report) -> Dots {
    let mut names: Vec<&str> = Vec::new();
    for side in report.scenes.iter().flat_map(|row| &row.devices) {
        if !names.contains(&side.device.as_str()) {
            names.push(&side.device);
        }
    }
    let series = names.iter().enumerate().map(|(index, name)| DotSeries {
        name: short_name(name),
        color: color_of(index),
        values: report.scenes.iter().map(|row| rate(row, name)).collect(),
    });
    Dots {
        title: "Rays of all kinds while tracing, more is better".to_owned(),
        label: "million rays a second, with 95 % intervals".to_owned(),
        rows: report.scenes.iter().map(|row| row.scene.clone()).collect(),
        series: series.collect(),
    }
}

/// Millions a second: the least of the interval, the median, the most.
fn rate(row: &SceneRow, device: &str) -> Option<[f64; 3]> {
    let side: &DeviceRow = row.devices.iter().find(|side| side.device == device)?;
    let rays = row.rays.total as f64;
    let time = side.trace_ms;
    Some([time.high, time.median, time.low].map(|milliseconds| rays / milliseconds.max(1e-9) / 1e3))
}
