//! What adapters make of f32, as a person reads it.

use serde::Serialize;

use super::text::{columns, number};
use crate::cli::values::name_of;
use crate::layout::Float;
use crate::selftest::{Arithmetic, DeviceError, GpuDevice};

/// An adapter's arithmetic in one kind of float.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Measured {
    pub(super) adapter: String,
    pub(super) float: String,
    #[serde(flatten)]
    pub(super) arithmetic: Arithmetic,
}

/// Measure an adapter in each kind of float that it can be in.
pub(super) fn measure(device: &mut GpuDevice) -> Result<Vec<Measured>, DeviceError> {
    let strict = device.adapter().strict_float.then_some(Float::Strict);
    let floats = strict.into_iter().chain([Float::Fast]);
    let adapter = device.adapter().name.clone();
    let measured = |float| {
        let arithmetic = device.arithmetic(float)?;
        Ok(Measured { adapter: adapter.clone(), float: name_of(float), arithmetic })
    };
    floats.map(measured).collect()
}

impl Measured {
    /// The head of its column.
    fn name(&self) -> String {
        format!("{} {}", self.adapter.split(" (").next().unwrap_or_default(), self.float)
    }
}

/// Errors, rewritten expressions and special numbers, one row each, one column an adapter and float.
pub(super) fn rows(all: &[Measured]) -> Vec<(String, Vec<String>)> {
    let Some(first) = all.first().map(|one| &one.arithmetic) else { return Vec::new() };
    let row = |label: String, cell: &dyn Fn(&Arithmetic) -> String| {
        (label, all.iter().map(|one| cell(&one.arithmetic)).collect())
    };
    let kept = |kept: bool, lost: &str| if kept { "kept".to_owned() } else { lost.to_owned() };
    let mut rows = Vec::new();
    for (index, operation) in first.operations.iter().enumerate() {
        let allowed = operation.allowed.map_or_else(String::new, |ulps| format!(" (allowed {ulps})"));
        let label = format!("{}, error in ulp{allowed}", operation.name);
        rows.push(row(label, &|one| number(one.operations[index].ulps)));
    }
    for (index, rewrite) in first.rewrites.iter().enumerate() {
        let label = format!("{}, rewritten", rewrite.expression);
        rows.push(row(label, &|one| format!("{:.1} %", 100.0 * one.rewrites[index].share)));
    }
    rows.push(row("subnormal results".into(), &|one| kept(one.keeps_subnormals, "flushed to 0")));
    rows.push(row("the sign of zero".into(), &|one| kept(one.keeps_sign_of_zero, "lost")));
    rows
}

/// Heads of the columns.
pub(super) fn heads(all: &[Measured]) -> Vec<String> {
    all.iter().map(Measured::name).collect()
}

/// The same as a table.
pub(super) fn table(all: &[Measured]) -> String {
    columns(&heads(all), &rows(all))
}
