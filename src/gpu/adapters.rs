//! The Vulkan adapters of this machine: what they are, what they can do, and which one to take.

use super::{GpuError, Promises};

/// What an adapter is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AdapterKind {
    /// A card with its own memory.
    Discrete,
    /// Shares the processor's memory.
    Integrated,
    /// A part of a card, lent to a virtual machine.
    Virtual,
    /// A driver that runs shaders on the processor: lavapipe, SwiftShader.
    Software,
    /// The driver does not say.
    Unknown,
}

impl AdapterKind {
    /// Whether there is hardware behind it.
    #[must_use]
    pub fn is_real(self) -> bool {
        matches!(self, Self::Discrete | Self::Integrated | Self::Virtual)
    }

    /// One word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Software => "software",
            Self::Unknown => "unknown",
        }
    }

    /// Which kind to take first: the least.
    fn rank(self) -> u8 {
        match self {
            Self::Discrete => 0,
            Self::Integrated => 1,
            Self::Virtual => 2,
            Self::Unknown => 3,
            Self::Software => 4,
        }
    }
}

impl From<wgpu::DeviceType> for AdapterKind {
    fn from(kind: wgpu::DeviceType) -> Self {
        match kind {
            wgpu::DeviceType::DiscreteGpu => Self::Discrete,
            wgpu::DeviceType::IntegratedGpu => Self::Integrated,
            wgpu::DeviceType::VirtualGpu => Self::Virtual,
            wgpu::DeviceType::Cpu => Self::Software,
            wgpu::DeviceType::Other => Self::Unknown,
        }
    }
}

/// An adapter, as plain data.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AdapterReport {
    /// The device's name.
    pub name: String,
    /// What it is made of.
    pub kind: AdapterKind,
    /// The driver's name.
    pub driver: String,
    /// The driver's version, in its own words.
    pub driver_info: String,
    /// Takes SPIR-V as it is: `--float strict` works.
    pub strict_float: bool,
    /// What strict shaders ask for beyond that.
    pub promises: Promises,
    /// Has 64-bit floats: `--precision f64` works.
    pub f64: bool,
    /// Measures its own time.
    pub timestamps: bool,
    /// Least and greatest number of invocations that run in step.
    pub subgroup: [u32; 2],
    /// Greatest part of a buffer that a shader sees, in bytes.
    pub max_storage_binding: u64,
    /// Greatest buffer, in bytes.
    pub max_buffer: u64,
    /// Storage buffers that one shader sees.
    pub max_storage_buffers: u32,
}

impl AdapterReport {
    /// Rounds of loops after which an invocation rests. On a card this bounds the time of a submission. Mesa's llvmpipe
    /// ends all loops after 65535 rounds (`LP_MAX_TGSI_LOOP_ITERATIONS` of its gallivm), counting those of eight
    /// invocations in step together: an eighth of them, halved for the ray that spends the last step.
    pub(super) fn step_budget(&self) -> u32 {
        if self.driver.contains("llvmpipe") { 4096 } else { 65_536 }
    }

    pub(super) fn new(adapter: &wgpu::Adapter) -> Self {
        let (info, features, limits) = (adapter.get_info(), adapter.features(), adapter.limits());
        Self {
            name: info.name,
            kind: info.device_type.into(),
            driver: info.driver,
            driver_info: info.driver_info,
            strict_float: features.contains(wgpu::Features::PASSTHROUGH_SHADERS),
            promises: Promises::of(adapter),
            f64: features.contains(wgpu::Features::SHADER_F64),
            timestamps: features.contains(wgpu::Features::TIMESTAMP_QUERY),
            subgroup: [info.subgroup_min_size, info.subgroup_max_size],
            max_storage_binding: limits.max_storage_buffer_binding_size,
            max_buffer: limits.max_buffer_size,
            max_storage_buffers: limits.max_storage_buffers_per_shader_stage,
        }
    }

    /// Whether it may be asked if it can show pictures on a window: the SwiftShader of Chromium has no windows, and crashes
    /// when it is asked (seen with Chromium 156).
    #[must_use]
    pub fn knows_windows(&self) -> bool {
        !self.driver.contains("SwiftShader")
    }

    /// Whether `part`, in any case, is part of the device's or the driver's name. `lavapipe` stands for
    /// `llvmpipe`, the name that it gives itself.
    #[must_use]
    pub fn is_called(&self, part: &str) -> bool {
        let part = part.to_lowercase().replace("lavapipe", "llvmpipe");
        [&self.name, &self.driver].iter().any(|name| name.to_lowercase().contains(&part))
    }
}

/// Every Vulkan adapter of this machine, in the driver loader's order. `WGPU_BACKEND` is honoured: without
/// `vulkan` in it, none.
#[must_use]
pub fn adapters() -> Vec<AdapterReport> {
    enumerate(&instance()).iter().map(AdapterReport::new).collect()
}

/// The connection to the Vulkan loader, with wgpu's environment variables honoured.
#[must_use]
pub fn instance() -> wgpu::Instance {
    let wanted = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wanted.backends & wgpu::Backends::VULKAN,
        ..wanted
    })
}

fn enumerate(instance: &wgpu::Instance) -> Vec<wgpu::Adapter> {
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN))
}

/// The adapter called `wanted`, else that of `WGPU_ADAPTER_NAME`, else the first of the best kind.
///
/// # Errors
/// [`GpuError::NoAdapter`].
pub(super) fn choose(instance: &wgpu::Instance, wanted: Option<&str>) -> Result<wgpu::Adapter, GpuError> {
    choose_among(enumerate(instance), wanted)
}

/// The same among those that can show pictures on a window's surface.
///
/// # Errors
/// [`GpuError::NoAdapter`].
pub(super) fn choose_for(
    instance: &wgpu::Instance,
    surface: &wgpu::Surface<'_>,
    wanted: Option<&str>,
) -> Result<wgpu::Adapter, GpuError> {
    let able = |adapter: &wgpu::Adapter| {
        AdapterReport::new(adapter).knows_windows() && adapter.is_surface_supported(surface)
    };
    choose_among(enumerate(instance).into_iter().filter(able).collect(), wanted)
}

fn choose_among(mut adapters: Vec<wgpu::Adapter>, wanted: Option<&str>) -> Result<wgpu::Adapter, GpuError> {
    let wanted = wanted.map(str::to_owned).or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok());
    let reports: Vec<_> = adapters.iter().map(AdapterReport::new).collect();
    match best(&reports, wanted.as_deref()) {
        Some(index) => Ok(adapters.swap_remove(index)),
        None => Err(GpuError::NoAdapter {
            wanted,
            found: reports.into_iter().map(|report| report.name).collect(),
        }),
    }
}

/// The first of the best kind among those called `wanted`.
fn best(reports: &[AdapterReport], wanted: Option<&str>) -> Option<usize> {
    (0..reports.len())
        .filter(|&index| wanted.is_none_or(|part| reports[index].is_called(part)))
        .min_by_key(|&index| reports[index].kind.rank())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(name: &str, kind: AdapterKind) -> AdapterReport {
        AdapterReport {
            name: name.into(),
            kind,
            driver: String::new(),
            driver_info: String::new(),
            strict_float: false,
            promises: Promises::default(),
            f64: false,
            timestamps: false,
            subgroup: [8, 8],
            max_storage_binding: 0,
            max_buffer: 0,
            max_storage_buffers: 8,
        }
    }

    #[test]
    fn hardware_comes_before_software() {
        let found = [
            report("llvmpipe (LLVM 15)", AdapterKind::Software),
            report("Iris", AdapterKind::Integrated),
            report("GeForce", AdapterKind::Discrete),
            report("Radeon", AdapterKind::Discrete),
        ];
        assert_eq!(best(&found, None), Some(2));
        assert_eq!(best(&found, Some("iris")), Some(1));
        assert_eq!(best(&found, Some("Lavapipe")), Some(0));
        assert_eq!(best(&found, Some("arc")), None);
        assert_eq!(best(&[], None), None);
    }
}
