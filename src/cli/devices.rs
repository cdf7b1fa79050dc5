//! `snellius devices`: what can trace on this machine.

use serde::Serialize;

use super::console::{Console, print, print_json};
use super::device::cpu_name;
use super::{CliError, Outcome};
use crate::gpu::{AdapterReport, adapters};

/// List what can trace on this machine
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius devices
  snellius render scenes/ice.toml -o ice.png --adapter llvmpipe

Strict float: the adapter can give the CPU's bits. f64: it can trace in 64 bits.
Without a Vulkan driver the CPU traces all the same; on Debian and Ubuntu the package
mesa-vulkan-drivers has drivers for most GPUs and one in software.")]
pub(super) struct DevicesArgs {
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &DevicesArgs, console: Console) -> Result<Outcome, CliError> {
    let report = Report::new(&adapters());
    if args.json {
        print_json(&report)?;
    } else {
        print(&table(&report))?;
        if report.adapters.is_empty() {
            console.note("no Vulkan adapter found");
        }
    }
    Ok(Outcome::Done)
}

#[derive(Serialize)]
struct Report {
    cpu: Cpu,
    adapters: Vec<Adapter>,
}

#[derive(Serialize)]
struct Cpu {
    name: String,
    threads: usize,
}

#[derive(Serialize)]
struct Adapter {
    name: String,
    kind: &'static str,
    driver: String,
    strict_float: bool,
    float_controls: Vec<&'static str>,
    f64: bool,
    timestamps: bool,
    subgroup: [u32; 2],
    max_storage_binding: u64,
    max_buffer: u64,
    max_storage_buffers: u32,
}

impl Report {
    fn new(adapters: &[AdapterReport]) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        Self { cpu: Cpu { name: cpu_name(), threads }, adapters: adapters.iter().map(Adapter::new).collect() }
    }
}

impl Adapter {
    fn new(report: &AdapterReport) -> Self {
        Self {
            name: report.name.clone(),
            kind: report.kind.name(),
            driver: format!("{} {}", report.driver, report.driver_info).trim().to_owned(),
            strict_float: report.strict_float,
            float_controls: report.promises.f32.names(),
            f64: report.f64,
            timestamps: report.timestamps,
            subgroup: report.subgroup,
            max_storage_binding: report.max_storage_binding,
            max_buffer: report.max_buffer,
            max_storage_buffers: report.max_storage_buffers,
        }
    }
}

fn table(report: &Report) -> String {
    let mut text = format!("CPU  {}, {} threads\n", report.cpu.name, report.cpu.threads);
    let yes_no = |yes| if yes { "yes" } else { "no" };
    for adapter in &report.adapters {
        text += &format!(
            "GPU  {} ({})\n       driver         {}\n       strict float   {}{}\n       f64            {}\n       \
             largest buffer {} MiB, {} MiB seen at once\n       subgroup       {} to {}\n",
            adapter.name,
            adapter.kind,
            adapter.driver,
            yes_no(adapter.strict_float),
            kept(&adapter.float_controls),
            yes_no(adapter.f64),
            adapter.max_buffer >> 20,
            adapter.max_storage_binding >> 20,
            adapter.subgroup[0],
            adapter.subgroup[1],
        );
    }
    text
}

/// What the driver promises beyond strict sums.
fn kept(promises: &[&str]) -> String {
    if promises.is_empty() { String::new() } else { format!(" ({})", promises.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{AdapterKind, FloatControls, Promises};

    #[test]
    fn every_adapter_is_listed_with_what_it_can_do() {
        let adapter = AdapterReport {
            name: "llvmpipe".to_owned(),
            kind: AdapterKind::Software,
            driver: "lavapipe".to_owned(),
            driver_info: "Mesa 22.3".to_owned(),
            strict_float: true,
            promises: Promises {
                f32: FloatControls { signed_zero_inf_nan: true, ..FloatControls::default() },
                ..Promises::default()
            },
            f64: false,
            timestamps: true,
            subgroup: [4, 8],
            max_storage_binding: 128 << 20,
            max_buffer: 256 << 20,
            max_storage_buffers: 8,
        };
        let text = table(&Report::new(&[adapter]));
        for part in [
            "llvmpipe (software)",
            "lavapipe Mesa 22.3",
            "strict float   yes (keeps the sign of zero)",
            "f64            no",
            "256 MiB",
        ] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }
}
