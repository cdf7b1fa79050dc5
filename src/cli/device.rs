//! Which device traces.

use std::fs;
use std::path::PathBuf;

use super::CliError;
use super::console::Console;
use super::values::whole_in;
use crate::cpu::CpuRenderer;
use crate::film::{Frame, Progress, Renderer};
use crate::gpu::{AdapterReport, GpuOptions, GpuRenderer, adapters};
use crate::layout::{Backend, FlatScene, Precision, Settings, View};

/// Flags that choose a device.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Device")]
pub(super) struct DeviceArgs {
    /// Device that traces [default: the GPU where there is a real one, else the CPU]
    #[arg(long, value_name = "DEVICE")]
    backend: Option<Backend>,
    /// Part of the name of a Vulkan adapter, as `snellius devices` lists them; implies --backend gpu
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Threads of the CPU [default: RAYON_NUM_THREADS, else one for each core]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, 1, 4096))]
    threads: Option<u32>,
}

/// The device that the flags ask for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Choice {
    /// The CPU; 0 threads for one each core.
    Cpu { threads: usize },
    /// A Vulkan adapter, by a part of its name or the best there is.
    Gpu { adapter: Option<String> },
    /// What this machine has.
    Auto { threads: usize },
}

impl DeviceArgs {
    /// Threads of the CPU; 0 for one each core.
    #[cfg(feature = "viewer")]
    pub(super) fn threads(&self) -> usize {
        self.threads.map_or(0, |threads| threads as usize)
    }

    pub(super) fn choice(self) -> Result<Choice, CliError> {
        let threads = self.threads.map_or(0, |threads| threads as usize);
        match (self.backend, self.adapter) {
            (Some(Backend::Cpu), Some(adapter)) => {
                Err(CliError::usage(format!("--backend cpu has no adapter {adapter:?}"))
                    .hint("leave out --backend or --adapter"))
            }
            (Some(Backend::Cpu), None) => Ok(Choice::Cpu { threads }),
            (Some(Backend::Gpu), adapter) | (None, adapter @ Some(_)) => Ok(Choice::Gpu { adapter }),
            (None, None) => Ok(Choice::Auto { threads }),
        }
    }
}

impl Choice {
    /// Settle what was left open, and say so in one line.
    pub(super) fn settle(self, precision: Precision, console: Console) -> Self {
        let Self::Auto { threads } = self else { return self };
        let (choice, reason) = settle(&adapters(), precision, threads);
        console.note(reason);
        choice
    }

    /// Make the device ready for a scene.
    pub(super) fn open(self, scene: &FlatScene) -> Result<Device<'_>, CliError> {
        match self {
            Self::Cpu { threads } | Self::Auto { threads } => {
                Ok(Device::Cpu(CpuRenderer::new(scene, threads)?))
            }
            Self::Gpu { adapter } => {
                let options = GpuOptions { adapter, pipeline_cache: pipeline_folder() };
                Ok(Device::Gpu(Box::new(GpuRenderer::new(scene, &options)?)))
            }
        }
    }
}

/// Where compiled pipelines are kept between runs: the user's cache folder, as the operating system has it.
pub(super) fn pipeline_folder() -> Option<PathBuf> {
    let folders = directories::ProjectDirs::from("", "", "snellius")?;
    Some(folders.cache_dir().join("pipelines"))
}

/// The first real adapter that has what is needed, else the CPU; and why.
fn settle(adapters: &[AdapterReport], precision: Precision, threads: usize) -> (Choice, String) {
    let real = || adapters.iter().filter(|adapter| adapter.kind.is_real());
    let able = |adapter: &&AdapterReport| precision == Precision::F32 || adapter.f64;
    if let Some(adapter) = real().find(able) {
        return (Choice::Gpu { adapter: None }, format!("tracing on the GPU: {}", adapter.name));
    }
    let lack = if real().next().is_some() { "no GPU here has 64-bit floats" } else { "no GPU found" };
    (Choice::Cpu { threads }, format!("{lack}: tracing on the CPU"))
}

/// A device that is ready for a scene.
pub(super) enum Device<'a> {
    Cpu(CpuRenderer<'a>),
    Gpu(Box<GpuRenderer>),
}

impl Device<'_> {
    pub(super) fn backend(&self) -> Backend {
        match self {
            Self::Cpu(_) => Backend::Cpu,
            Self::Gpu(_) => Backend::Gpu,
        }
    }

    /// The device's name.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Cpu(_) => cpu_name(),
            Self::Gpu(renderer) => renderer.adapter().name.clone(),
        }
    }

    /// Name and version of the driver; on the CPU the number of threads.
    pub(super) fn driver(&self) -> String {
        match self {
            Self::Cpu(renderer) => format!("rayon, {} threads", renderer.threads()),
            Self::Gpu(renderer) => {
                let AdapterReport { driver, driver_info, .. } = renderer.adapter();
                format!("{driver} {driver_info}").trim().to_owned()
            }
        }
    }
}

impl Renderer for Device<'_> {
    type Error = CliError;

    fn render(
        &mut self,
        view: &View,
        settings: &Settings,
        progress: &dyn Progress,
    ) -> Result<Frame, CliError> {
        Ok(match self {
            Self::Cpu(renderer) => renderer.render(view, settings, progress)?,
            Self::Gpu(renderer) => renderer.render(view, settings, progress)?,
        })
    }
}

/// The processor's name where Linux tells it, else "CPU".
pub(super) fn cpu_name() -> String {
    fs::read_to_string("/proc/cpuinfo").ok().as_deref().and_then(model_name).unwrap_or("CPU").to_owned()
}

fn model_name(cpuinfo: &str) -> Option<&str> {
    let line = cpuinfo.lines().find(|line| line.starts_with("model name"))?;
    line.split_once(':').map(|(_, name)| name.trim())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::gpu::{AdapterKind, Promises};

    fn adapter(name: &str, kind: AdapterKind, f64: bool) -> AdapterReport {
        AdapterReport {
            name: name.to_owned(),
            kind,
            driver: String::new(),
            driver_info: String::new(),
            strict_float: true,
            promises: Promises::default(),
            f64,
            timestamps: false,
            subgroup: [8, 8],
            max_storage_binding: 0,
            max_buffer: 0,
            max_storage_buffers: 8,
        }
    }

    fn args(backend: Option<Backend>, adapter: Option<&str>) -> DeviceArgs {
        DeviceArgs { backend, adapter: adapter.map(str::to_owned), threads: None }
    }

    #[test]
    fn an_adapter_implies_the_gpu() {
        let named = Choice::Gpu { adapter: Some("llvmpipe".to_owned()) };
        assert_eq!(args(None, Some("llvmpipe")).choice().unwrap(), named);
        assert!(args(Some(Backend::Cpu), Some("llvmpipe")).choice().is_err());
    }

    #[test]
    fn software_adapters_are_not_taken_unasked() {
        let (choice, reason) = settle(&[adapter("llvmpipe", AdapterKind::Software, true)], Precision::F32, 3);
        assert_eq!(choice, Choice::Cpu { threads: 3 });
        assert_eq!(reason, "no GPU found: tracing on the CPU");
    }

    #[test]
    fn a_gpu_without_64_bit_floats_is_not_taken_for_them() {
        let found = [adapter("Iris", AdapterKind::Integrated, false)];
        assert_eq!(settle(&found, Precision::F32, 0).0, Choice::Gpu { adapter: None });
        assert_eq!(settle(&found, Precision::F64, 0).0, Choice::Cpu { threads: 0 });
    }

    #[test]
    fn the_processor_is_named_by_the_kernel() {
        assert_eq!(model_name("processor : 0\nmodel name\t: Some CPU @ 2 GHz\n"), Some("Some CPU @ 2 GHz"));
        assert_eq!(model_name("Hardware : board"), None);
    }
}
