//! What a device promises about zeros, infinities and subnormal numbers.
//!
//! NoContraction keeps a compiler from rewriting sums; these promises keep it from treating −0 as 0 and from flushing
//! subnormal numbers (Vulkan specification, "VkPhysicalDeviceFloatControlsProperties"). wgpu does not ask for them, and so
//! they are asked for here.

use ash::vk;

/// Promises about the arithmetic of one precision; a strict shader asks for those there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FloatControls {
    /// The sign of zero, infinities and NaN are kept.
    pub signed_zero_inf_nan: bool,
    /// Subnormal numbers are kept.
    pub denorms: bool,
    /// Results are rounded to the nearest, ties to even.
    pub round_to_nearest: bool,
}

impl FloatControls {
    /// Those that are given, in words.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        let all = [
            (self.signed_zero_inf_nan, "keeps the sign of zero"),
            (self.denorms, "keeps subnormals"),
            (self.round_to_nearest, "rounds to nearest"),
        ];
        all.into_iter().filter(|(given, _)| *given).map(|(_, name)| name).collect()
    }
}

/// Promises about f32, and about f64 beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Promises {
    /// About f32.
    pub f32: FloatControls,
    /// About f64.
    pub f64: FloatControls,
}

impl Promises {
    /// Ask the driver. None where the device is older than Vulkan 1.2, which made SPV_KHR_float_controls a part of itself.
    pub(super) fn of(adapter: &wgpu::Adapter) -> Self {
        // SAFETY: the handle is only asked, under the guard, and nothing of it is destroyed.
        let Some(adapter) = (unsafe { adapter.as_hal::<wgpu::hal::api::Vulkan>() }) else {
            return Self::default();
        };
        let (device, shared) = (adapter.raw_physical_device(), adapter.shared_instance());
        let instance = shared.raw_instance();
        // SAFETY: the physical device belongs to this instance, and both live as long as the guard.
        let version = unsafe { instance.get_physical_device_properties(device) }.api_version;
        if shared.instance_api_version() < vk::API_VERSION_1_1 || version < vk::API_VERSION_1_2 {
            return Self::default();
        }
        let mut controls = vk::PhysicalDeviceFloatControlsProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut controls);
        // SAFETY: as above; an instance of 1.1 has this command, a device of 1.2 fills this record.
        unsafe { instance.get_physical_device_properties2(device, &mut properties) };
        Self::from(&controls)
    }
}

impl From<&vk::PhysicalDeviceFloatControlsProperties<'_>> for Promises {
    /// Some drivers treat all widths alike, or all but 32 bits, and then may be asked only for all of them. The shaders
    /// say nothing about 16 bits.
    fn from(controls: &vk::PhysicalDeviceFloatControlsProperties<'_>) -> Self {
        let is = |flag: vk::Bool32| flag == vk::TRUE;
        let has_32 = |independence| independence != vk::ShaderFloatControlsIndependence::NONE;
        let has_64 = |independence| independence == vk::ShaderFloatControlsIndependence::ALL;
        let denorms = controls.denorm_behavior_independence;
        let rounding = controls.rounding_mode_independence;
        Self {
            f32: FloatControls {
                signed_zero_inf_nan: is(controls.shader_signed_zero_inf_nan_preserve_float32),
                denorms: is(controls.shader_denorm_preserve_float32) && has_32(denorms),
                round_to_nearest: is(controls.shader_rounding_mode_rte_float32) && has_32(rounding),
            },
            f64: FloatControls {
                signed_zero_inf_nan: is(controls.shader_signed_zero_inf_nan_preserve_float64),
                denorms: is(controls.shader_denorm_preserve_float64) && has_64(denorms),
                round_to_nearest: is(controls.shader_rounding_mode_rte_float64) && has_64(rounding),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_that_must_be_alike_are_not_asked_for_one_by_one() {
        let mut controls = vk::PhysicalDeviceFloatControlsProperties {
            shader_denorm_preserve_float32: vk::TRUE,
            shader_denorm_preserve_float64: vk::TRUE,
            ..Default::default()
        };
        let mut denorms = |independence| {
            controls.denorm_behavior_independence = independence;
            let promises = Promises::from(&controls);
            [promises.f32.denorms, promises.f64.denorms]
        };
        assert_eq!(denorms(vk::ShaderFloatControlsIndependence::NONE), [false, false]);
        assert_eq!(denorms(vk::ShaderFloatControlsIndependence::TYPE_32_ONLY), [true, false]);
        assert_eq!(denorms(vk::ShaderFloatControlsIndependence::ALL), [true, true]);
    }
}
