//! The hard cases hold on every device, and each catches the faults that it is there for.

#![allow(clippy::unwrap_used)]

mod faults;

use snellius::gpu::{GpuOptions, SOURCES, Source};
use snellius::layout::{Float, Intersector, Precision};
use snellius::selftest::{CASES, Case, CpuDevice, Device, DeviceError, Effort, Finding, GpuDevice, Verdict};

use crate::lockstep::devices::on_each;

/// A strict adapter with these shader files.
fn adapter(options: &GpuOptions, sources: &'static [Source<'static>]) -> GpuDevice {
    GpuDevice::new(options, Float::Strict, Intersector::Watertight, sources).unwrap()
}

/// What a case finds beyond its bounds; a case that finds nothing at all has failed too.
fn fallen(case: &Case, device: &mut dyn Device) -> Result<Vec<Finding>, DeviceError> {
    let findings = (case.run)(device, Effort::Quick)?;
    assert!(!findings.is_empty(), "{} finds nothing on {}", case.id, device.name());
    Ok(findings.into_iter().filter(|finding| finding.verdict() == Verdict::Falls).collect())
}

/// Fail with every figure that is beyond its bound.
fn assert_all_hold(device: &mut dyn Device) {
    let mut found = Vec::new();
    for case in CASES {
        found.extend(
            fallen(case, device).unwrap().into_iter().map(|finding| format!("{}: {finding:?}", case.id)),
        );
    }
    assert!(found.is_empty(), "on {}:\n{}", device.name(), found.join("\n"));
}

#[test]
fn every_case_holds_on_the_cpu() {
    for precision in [Precision::F32, Precision::F64] {
        assert_all_hold(&mut CpuDevice::new(precision, Intersector::Watertight));
    }
}

#[test]
fn every_case_holds_on_each_adapter() {
    on_each(|options| assert_all_hold(&mut adapter(options, SOURCES)));
}

#[test]
fn the_textbooks_triangle_test_leaks() {
    let t1 = CASES.iter().find(|case| case.id == "T1").unwrap();
    assert!(
        !fallen(t1, &mut CpuDevice::new(Precision::F32, Intersector::MollerTrumbore)).unwrap().is_empty()
    );
}

#[test]
fn cases_are_numbered_in_order_and_fit_a_table() {
    // The hard cases, then the closed forms, then what strict float changes.
    let family = |case: &Case| ["T", "C", "S"].iter().position(|letter| case.id.starts_with(letter)).unwrap();
    let number = |case: &Case| (family(case), case.id[1..].parse::<u32>().unwrap());
    let numbers: Vec<_> = CASES.iter().map(number).collect();
    assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
    for case in CASES {
        assert!(case.title.chars().count() <= 32, "{}", case.title);
        assert!(!case.claim.ends_with('.'), "{}: the program ends the sentence", case.id);
    }
}
