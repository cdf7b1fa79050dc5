//! What was measured with, and on what.

use serde::{Deserialize, Serialize};

use super::super::device::cpu_name;
use crate::bench::{Target, cpu_instructions};

/// The program and the machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Machine {
    pub(super) version: String,
    /// The commit that the program was built from, where `SNELLIUS_COMMIT` told the compiler.
    pub(super) commit: Option<String>,
    /// Operating system and architecture.
    pub(super) system: String,
    /// The processor.
    pub(super) cpu: String,
    /// Threads that it runs side by side.
    pub(super) threads: usize,
    /// The vector instructions that its rays are traced with.
    pub(super) instructions: String,
    /// Name and driver of each adapter.
    pub(super) adapters: Vec<String>,
    /// Whether Mesa was told to keep no compiled shaders.
    pub(super) cold: bool,
}

impl Machine {
    /// This machine, with the adapters among the targets.
    pub(super) fn new(targets: &[Target]) -> Self {
        let driver = |target: &Target| match target {
            Target::Cpu { .. } => None,
            Target::Adapter(report) => {
                let driver = format!("{} {}", report.driver, report.driver_info);
                Some(format!("{}, {}", target.name(), driver.trim()))
            }
        };
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("SNELLIUS_COMMIT").map(str::to_owned),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            cpu: cpu_name(),
            threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            instructions: cpu_instructions().to_owned(),
            adapters: targets.iter().filter_map(driver).collect(),
            cold: std::env::var("MESA_SHADER_CACHE_DISABLE")
                .is_ok_and(|value| value == "true" || value == "1"),
        }
    }

    /// One sentence for a caption.
    pub(super) fn sentence(&self) -> String {
        let commit = self.commit.as_ref().map(|commit| format!(" ({commit})")).unwrap_or_default();
        let adapters: String = self.adapters.iter().map(|adapter| format!("; {adapter}")).collect();
        format!(
            "Version {}{commit}, {}; {}, {} threads, {}{adapters}.",
            self.version, self.system, self.cpu, self.threads, self.instructions
        )
    }

    /// What there is to know about cold compile times.
    pub(super) fn shaders(&self) -> &'static str {
        if self.cold { "nothing kept by Mesa" } else { "shaders kept by the driver count" }
    }
}
