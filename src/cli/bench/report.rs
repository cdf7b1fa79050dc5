//! What `snellius bench --effects --json` prints.

use serde::Serialize;

use crate::bench::{EffectRow, Target};

/// All that was measured.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    pub(super) machine: Machine,
    /// Width and height of the pictures.
    pub(super) size: [u32; 2],
    /// Rounds in which both sides were traced.
    pub(super) rounds: u32,
    /// Each scene's own effects against all of them.
    pub(super) scenes: Vec<EffectRow>,
    /// Each effect switched on alone in a scene that does not need it.
    pub(super) alone: Vec<EffectRow>,
    /// Pairs of pictures that differed: they have no row.
    pub(super) failed: usize,
}

/// Where it was measured, and with what.
#[derive(Debug, Serialize)]
pub(super) struct Machine {
    pub(super) version: &'static str,
    /// The processor.
    pub(super) cpu: String,
    /// Threads that it runs side by side.
    pub(super) threads: usize,
    /// Name and driver of each adapter.
    pub(super) adapters: Vec<String>,
    /// Whether Mesa was told to keep no compiled shaders.
    pub(super) cold: bool,
}

impl Machine {
    pub(super) fn new(cpu: String, targets: &[Target]) -> Self {
        let driver = |target: &Target| match target {
            Target::Cpu { .. } => None,
            Target::Adapter(report) => {
                Some(format!("{}, {} {}", report.name, report.driver, report.driver_info).trim().to_owned())
            }
        };
        Self {
            version: env!("CARGO_PKG_VERSION"),
            cpu,
            threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            adapters: targets.iter().filter_map(driver).collect(),
            cold: std::env::var("MESA_SHADER_CACHE_DISABLE")
                .is_ok_and(|value| value == "true" || value == "1"),
        }
    }
}
