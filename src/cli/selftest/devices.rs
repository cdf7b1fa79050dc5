//! Which devices are put to the test.

use super::SelftestArgs;
use super::arithmetic::{self, Measured};
use crate::cli::CliError;
use crate::gpu::{GpuError, GpuOptions, SOURCES, adapters};
use crate::layout::{Backend, Precision};
use crate::selftest::{CpuDevice, Device, GpuDevice};

/// The devices, in the order of columns.
pub(super) struct Devices {
    pub(super) list: Vec<Box<dyn Device>>,
    /// Name, driver and its version of each adapter.
    pub(super) drivers: Vec<[String; 2]>,
    /// What each adapter makes of f32.
    pub(super) arithmetic: Vec<Measured>,
}

impl Devices {
    /// Open what the flags leave: both precisions of the CPU unless an adapter is named, then each adapter.
    pub(super) fn open(args: &SelftestArgs) -> Result<Self, CliError> {
        let mut devices = Self { list: Vec::new(), drivers: Vec::new(), arithmetic: Vec::new() };
        let cpu = args.backend.map_or(args.adapter.is_none(), |backend| backend == Backend::Cpu);
        if cpu {
            for precision in [Precision::F32, Precision::F64] {
                devices.list.push(Box::new(CpuDevice::new(precision, args.intersector)));
            }
        }
        if args.backend != Some(Backend::Cpu) {
            devices.open_adapters(args)?;
        }
        Ok(devices)
    }

    fn open_adapters(&mut self, args: &SelftestArgs) -> Result<(), CliError> {
        let wanted = args.adapter.clone().or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok());
        let found = adapters();
        let mut names: Vec<_> = found
            .iter()
            .filter(|adapter| wanted.as_ref().is_none_or(|part| adapter.is_called(part)))
            .map(|adapter| adapter.name.clone())
            .collect();
        // Twins are told apart by nothing.
        names.dedup();
        if names.is_empty() && (wanted.is_some() || args.backend == Some(Backend::Gpu)) {
            let found = found.into_iter().map(|adapter| adapter.name).collect();
            return Err(GpuError::NoAdapter { wanted, found }.into());
        }
        for name in names {
            let options = GpuOptions { adapter: Some(name), ..GpuOptions::default() };
            let mut device =
                GpuDevice::new(&options, args.float.unwrap_or_default(), args.intersector, SOURCES)?;
            let adapter = device.adapter();
            let driver = format!("{} {}", adapter.driver, adapter.driver_info).trim().to_owned();
            self.drivers.push([adapter.name.clone(), driver]);
            self.arithmetic.extend(arithmetic::measure(&mut device)?);
            self.list.push(Box::new(device));
        }
        Ok(())
    }
}
