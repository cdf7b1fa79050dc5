//! What `shaders/present.wgsl` reads: its text, and the records that tell it how films lie in their memory.

use bytemuck::{Pod, Zeroable};

use crate::film::srgb_code;
use crate::gpu::Exposure;
use crate::layout::constants::{BLOCK, LEAST_NORMAL, NONE};

/// The shader, without the constants that it shares with the renderer.
const SHADER: &str = include_str!("../../shaders/present.wgsl");

/// How a film lies in its buffer, and what is on it: `Reel` of the shader.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct Reel {
    width: u32,
    height: u32,
    first_word: u32,
    pixel_words: u32,
    columns: u32,
    samples: u32,
    passes: u32,
    blocks: u32,
    aov_at: u32,
    statistics_at: u32,
    reserved: [u32; 2],
}

/// What is shown, and where: `Look` of the shader.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
pub(super) struct Shot {
    pub(super) film: Reel,
    pub(super) reference: Reel,
    pub(super) area: [f32; 4],
    pub(super) gain: f32,
    pub(super) kind: u32,
    pub(super) reserved: [u32; 2],
}

impl Reel {
    pub(super) fn of(exposure: &Exposure) -> Self {
        let Exposure { film, samples, passes, blocks, .. } = exposure;
        let aov_at = if film.has_aovs() { 8 } else { 0 };
        Self {
            width: film.width,
            height: film.height,
            first_word: film.first_word(),
            pixel_words: film.pixel_words(),
            columns: exposure.columns(),
            samples: *samples,
            passes: *passes,
            blocks: *blocks,
            aov_at,
            statistics_at: if film.has_statistics() { 8 + aov_at } else { 0 },
            reserved: [0; 2],
        }
    }
}

/// The whole shader.
pub(super) fn shader() -> String {
    format!(
        "const BLOCK: u32 = {BLOCK}u;\nconst NONE: u32 = {NONE}u;\nconst LEAST_NORMAL: f32 = {LEAST_NORMAL:e}f;\n{SHADER}"
    )
}

/// The least linear value of each 8-bit code.
pub(super) fn code_steps() -> [f32; 256] {
    std::array::from_fn(|code| {
        // Codes grow with the bits of floats that are not negative.
        let (mut low, mut high) = (0.0_f32.to_bits(), 1.0_f32.to_bits());
        while low < high {
            let middle = low + (high - low) / 2;
            let reached = srgb_code(f32::from_bits(middle), 255) >= code as u16;
            if reached { high = middle } else { low = middle + 1 }
        }
        f32::from_bits(low)
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::present::RANGES;
    use super::*;

    #[test]
    fn the_shader_is_sound_and_its_records_are_ours() {
        let module = naga::front::wgsl::parse_str(&shader()).unwrap();
        let flags = naga::valid::ValidationFlags::all();
        naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module).unwrap();
        for (name, bytes) in
            [("Reel", size_of::<Reel>()), ("Look", size_of::<Shot>()), ("Ranges", 4 * RANGES)]
        {
            let (_, record) = module.types.iter().find(|(_, one)| one.name.as_deref() == Some(name)).unwrap();
            assert_eq!(record.inner.size(module.to_ctx()) as usize, bytes, "{name}");
        }
    }

    #[test]
    fn each_code_begins_where_its_step_says() {
        let steps = code_steps();
        for code in 1..=255_u16 {
            let first = steps[usize::from(code)];
            assert_eq!(srgb_code(first, 255), code);
            assert_eq!(srgb_code(f32::from_bits(first.to_bits() - 1), 255), code - 1);
        }
    }
}
