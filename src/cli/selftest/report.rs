//! What the cases found, as data.

use std::time::Instant;

use serde::Serialize;

use super::arithmetic::Measured;
use super::devices::Devices;
use crate::cli::values::name_of;
use crate::layout::Intersector;
use crate::selftest::{Bound, Case, Device, DeviceError, Effort, Finding, Verdict};

/// Every case on every device.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    pub(super) version: &'static str,
    pub(super) effort: &'static str,
    pub(super) intersector: String,
    /// Names of the columns.
    pub(super) devices: Vec<String>,
    /// Name and driver of each adapter.
    pub(super) adapters: Vec<[String; 2]>,
    pub(super) arithmetic: Vec<Measured>,
    pub(super) cases: Vec<CaseReport>,
}

/// One case on every device.
#[derive(Debug, Serialize)]
pub(super) struct CaseReport {
    pub(super) case: &'static str,
    pub(super) title: &'static str,
    pub(super) claim: &'static str,
    pub(super) results: Vec<CaseResult>,
}

/// One case on one device.
#[derive(Debug, Serialize)]
pub(super) struct CaseResult {
    pub(super) device: String,
    pub(super) seconds: f64,
    pub(super) findings: Vec<Figure>,
}

/// A finding, judged.
#[derive(Debug, Serialize)]
pub(super) struct Figure {
    pub(super) what: String,
    pub(super) figure: f64,
    #[serde(flatten)]
    pub(super) bound: Limit,
    pub(super) trials: u64,
    pub(super) holds: bool,
}

/// A bound under its name; neither where the figure is only reported.
#[derive(Debug, Serialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(super) enum Limit {
    AtMost(f64),
    AtLeast(f64),
    Near { expected: f64, within: f64 },
    Reported(bool),
}

impl Report {
    pub(super) fn new(devices: &Devices, intersector: Intersector, effort: Effort) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION"),
            effort: match effort {
                Effort::Quick => "quick",
                Effort::Short => "short",
                Effort::Long => "long",
            },
            intersector: name_of(intersector),
            devices: devices.list.iter().map(|device| device.name().to_owned()).collect(),
            adapters: devices.drivers.clone(),
            arithmetic: devices.arithmetic.clone(),
            cases: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, case: &Case, results: Vec<CaseResult>) {
        let Case { id, title, claim, .. } = *case;
        self.cases.push(CaseReport { case: id, title, claim, results });
    }

    /// How many figures are beyond their bounds.
    pub(super) fn fallen(&self) -> usize {
        let results = self.cases.iter().flat_map(|case| &case.results);
        results.flat_map(|result| &result.findings).filter(|figure| !figure.holds).count()
    }

    /// Whether every case found something on every device, and all of it is within bounds.
    pub(super) fn verdict(&self) -> Verdict {
        let mut results = self.cases.iter().flat_map(|case| &case.results);
        let found = results.all(|result| !result.findings.is_empty());
        if found && self.fallen() == 0 { Verdict::Holds } else { Verdict::Falls }
    }
}

/// Put a device through a case.
pub(super) fn run(case: &Case, device: &mut dyn Device, effort: Effort) -> Result<CaseResult, DeviceError> {
    let started = Instant::now();
    let findings = (case.run)(device, effort)?;
    Ok(CaseResult {
        device: device.name().to_owned(),
        seconds: started.elapsed().as_secs_f64(),
        findings: findings.into_iter().map(Figure::from).collect(),
    })
}

impl From<Finding> for Figure {
    fn from(finding: Finding) -> Self {
        let holds = finding.verdict() == Verdict::Holds;
        let bound = match finding.bound {
            Bound::AtMost(most) => Limit::AtMost(most),
            Bound::AtLeast(least) => Limit::AtLeast(least),
            Bound::Near { expected, within } => Limit::Near { expected, within },
            Bound::Reported => Limit::Reported(true),
        };
        Self { what: finding.what, figure: finding.figure, bound, trials: finding.trials, holds }
    }
}
