//! What strict float changes on an adapter.

use crate::selftest::lockstep::{PROBES, RECORDS};
use crate::selftest::{Case, Device, DeviceError, Effort, Finding};

/// S1.
pub(super) const S1: Case = Case {
    id: "S1",
    title: "kernel functions, bit for bit",
    claim: "every function of the kernel gives the CPU's bits on a strict adapter; where the driver may rewrite sums, \
            those that do not are named, the simplest first",
    run,
};

/// The bound is 0: each operation of a strict shader is rounded as the CPU rounds it, and their order is written down.
/// Subnormal numbers and zeros of either sign count as one: the film flushes them, and no sign of zero ever decides.
fn run(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let functions = PROBES.iter().map(|(_, probes)| probes.len()).sum();
    let records = if effort == Effort::Quick { RECORDS / 16 } else { RECORDS };
    let differences = device.differences(records)?;
    let count = differences.len() as f64;
    let what = "functions with other bits than the CPU's";
    let mut findings = vec![if device.is_exact() {
        Finding::at_most(what, count, 0.0, functions)
    } else {
        Finding::reported(what, count, functions)
    }];
    findings.extend(differences.iter().map(|difference| {
        let share = 100.0 * difference.differing as f64 / difference.records as f64;
        let what = format!("`{}`: per cent of inputs with other bits", difference.function);
        Finding::reported(what, share, difference.records)
    }));
    Ok(findings)
}
