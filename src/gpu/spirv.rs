//! naga's SPIR-V, and the strict form of it: every float operation as written.

use naga::back::spv;
use spirv::{Capability, Decoration, ExecutionMode, Op};

use super::assemble::Shader;
use super::float_controls::{FloatControls, Promises};
use super::{GpuError, Variant};
use crate::layout::{Float, Precision};

/// Words before the first instruction (SPIR-V specification, section 2.3).
const HEADER: usize = 5;

/// Write the entry point as SPIR-V for `vkCreateShaderModule`, strict where the variant is: with NoContraction, and with
/// what the device promises.
///
/// Bounds are not checked: `flatten` proves every index. Loops get no bound, workgroup memory is not cleared.
///
/// # Errors
/// [`GpuError::Shader`] where naga cannot write the module.
pub fn write_spirv(shader: &Shader, variant: &Variant, promises: &Promises) -> Result<Vec<u32>, GpuError> {
    let options = spv::Options {
        // The oldest that every Vulkan takes; nothing newer is used.
        lang_version: (1, 0),
        flags: spv::WriterFlags::empty(),
        // Keep the shader's own bindings: wgpu numbers those of a layout without gaps by their position.
        fake_missing_bindings: true,
        bounds_check_policies: naga::proc::BoundsCheckPolicies {
            index: naga::proc::BoundsCheckPolicy::Unchecked,
            buffer: naga::proc::BoundsCheckPolicy::Unchecked,
            image_load: naga::proc::BoundsCheckPolicy::Unchecked,
            binding_array: naga::proc::BoundsCheckPolicy::Unchecked,
        },
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::None,
        force_loop_bounding: false,
        emit_int_div_checks: false,
        ..spv::Options::default()
    };
    let words = spv::write_vec(&shader.module, &shader.info, &options, None).map_err(|error| {
        GpuError::Shader { file: "shaders".into(), line: 1, column: 1, message: error.to_string() }
    })?;
    Ok(match variant.float {
        Float::Strict => ask_for(&widths(variant, promises), &forbid_contraction(&words)),
        Float::Fast => words,
    })
}

/// Decorate every float arithmetic result with NoContraction, so that no compiler fuses or rearranges it
/// (SPIR-V specification, section 3.20, and Vulkan's "Precision and Operation of SPIR-V Instructions").
fn forbid_contraction(words: &[u32]) -> Vec<u32> {
    let mut annotations_end = None;
    let mut decorations = Vec::new();
    for (op, at) in instructions(words) {
        if annotations_end.is_none() && op.is_some_and(is_behind_annotations) {
            annotations_end = Some(at);
        }
        if op.is_some_and(is_float_arithmetic) {
            // Such an instruction is its opcode, its type, its result and the operands.
            decorations.extend([
                3 << 16 | Op::Decorate as u32,
                words[at + 2],
                Decoration::NoContraction as u32,
            ]);
        }
    }
    let (before, behind) = words.split_at(annotations_end.unwrap_or(words.len()));
    [before, &decorations, behind].concat()
}

/// The widths in bits that a variant computes in, and what the device promises about each.
fn widths(variant: &Variant, promises: &Promises) -> Vec<(u32, FloatControls)> {
    match variant.precision {
        Precision::F32 => vec![(32, promises.f32)],
        Precision::F64 => vec![(32, promises.f32), (64, promises.f64)],
    }
}

/// Declare execution modes of the extension SPV_KHR_float_controls for the first entry point, with what they need.
fn ask_for(widths: &[(u32, FloatControls)], words: &[u32]) -> Vec<u32> {
    let Some(entry_point) = instructions(words).find(|(op, _)| *op == Some(Op::EntryPoint)) else {
        return words.to_vec();
    };
    // OpEntryPoint: its opcode, the execution model, the function.
    let function = words[entry_point.1 + 2];
    let (mut capabilities, mut modes) = (Vec::new(), Vec::new());
    for &(width, controls) in widths {
        for (promised, capability, mode) in [
            (
                controls.signed_zero_inf_nan,
                Capability::SignedZeroInfNanPreserve,
                ExecutionMode::SignedZeroInfNanPreserve,
            ),
            (controls.denorms, Capability::DenormPreserve, ExecutionMode::DenormPreserve),
            (controls.round_to_nearest, Capability::RoundingModeRTE, ExecutionMode::RoundingModeRTE),
        ] {
            if promised {
                capabilities.extend([2 << 16 | Op::Capability as u32, capability as u32]);
                modes.extend([4 << 16 | Op::ExecutionMode as u32, function, mode as u32, width]);
            }
        }
    }
    if modes.is_empty() {
        return words.to_vec();
    }
    // Capabilities come first, then extensions; execution modes follow the last entry point (section 2.4).
    let end_of = |wanted: Op| {
        let mut behind = instructions(words).skip_while(|(op, _)| *op != Some(wanted));
        behind.find(|(op, _)| *op != Some(wanted)).map_or(words.len(), |(_, at)| at)
    };
    let (extensions_at, modes_at) = (end_of(Op::Capability), end_of(Op::EntryPoint));
    let (head, rest) = words.split_at(HEADER);
    let (own_capabilities, rest) = rest.split_at(extensions_at - HEADER);
    let (middle, rest) = rest.split_at(modes_at - extensions_at);
    [head, own_capabilities, &capabilities, &extension("SPV_KHR_float_controls"), middle, &modes, rest]
        .concat()
}

/// OpExtension with a name: a string of words, zero at its end (section 2.2.1).
fn extension(name: &str) -> Vec<u32> {
    let mut bytes = name.as_bytes().to_vec();
    bytes.resize((name.len() / 4 + 1) * 4, 0);
    let text = bytes
        .chunks_exact(4)
        .map(|four| four.iter().rev().fold(0, |word, &byte| word << 8 | u32::from(byte)));
    let length = bytes.len() as u32 / 4 + 1;
    [length << 16 | Op::Extension as u32].into_iter().chain(text).collect()
}

/// The instructions of a module: opcode, and where it stands.
fn instructions(words: &[u32]) -> impl Iterator<Item = (Option<Op>, usize)> {
    let mut at = HEADER;
    std::iter::from_fn(move || {
        let (first, here) = (*words.get(at)?, at);
        at += ((first >> 16) as usize).max(1);
        Some((Op::from_u32(first & 0xffff), here))
    })
}

/// The instructions that SPIR-V calls arithmetic, of those with a float result.
fn is_float_arithmetic(op: Op) -> bool {
    matches!(
        op,
        Op::FNegate
            | Op::FAdd
            | Op::FSub
            | Op::FMul
            | Op::FDiv
            | Op::FRem
            | Op::FMod
            | Op::VectorTimesScalar
            | Op::MatrixTimesScalar
            | Op::VectorTimesMatrix
            | Op::MatrixTimesVector
            | Op::MatrixTimesMatrix
            | Op::OuterProduct
            | Op::Dot
    )
}

/// Types, constants and variables follow the annotations, and functions those (section 2.4).
fn is_behind_annotations(op: Op) -> bool {
    let op = op as u32;
    (Op::TypeVoid as u32..=Op::TypeForwardPointer as u32).contains(&op)
        || (Op::ConstantTrue as u32..=Op::SpecConstantOp as u32).contains(&op)
        || [Op::Undef, Op::Variable, Op::Function].iter().any(|&other| op == other as u32)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::assemble::assemble;
    use super::super::testing::PLAIN;
    use super::*;

    const SUMS: &str = "
        @group(0) @binding(7) var<storage, read_write> data: array<f32>;
        @compute @workgroup_size(64)
        fn main(@builtin(global_invocation_id) id: vec3u) {
            let a = data[id.x];
            data[id.x] = -a * a + a / 3.0 - dot(vec3f(a), 2.0 * vec3f(a));
            data[id.x + 1u] = f32(id.x * 2u + 1u);
        }";

    fn words(float: Float) -> Vec<u32> {
        promised(float, &Promises::default())
    }

    fn promised(float: Float, promises: &Promises) -> Vec<u32> {
        let variant = Variant { float, ..PLAIN };
        let shader = assemble(&[("sums", SUMS)], "sums", "main", &variant).unwrap();
        write_spirv(&shader, &variant, promises).unwrap()
    }

    /// Decorations with NoContraction.
    fn decorations(words: &[u32]) -> usize {
        let decoration = [3 << 16 | Op::Decorate as u32, Decoration::NoContraction as u32];
        words.windows(3).filter(|three| [three[0], three[2]] == decoration).count()
    }

    #[test]
    fn strict_decorates_each_float_operation_and_fast_none() {
        // −, ×, /, +, −, dot, vector × scalar.
        assert_eq!(decorations(&words(Float::Strict)), 7);
        assert_eq!(decorations(&words(Float::Fast)), 0);
    }

    #[test]
    fn strict_only_adds_decorations() {
        let (strict, fast) = (words(Float::Strict), words(Float::Fast));
        assert_eq!(strict.len(), fast.len() + 3 * 7);
        assert_eq!(strict[..HEADER], fast[..HEADER]);
    }

    const ALL: FloatControls =
        FloatControls { signed_zero_inf_nan: true, denorms: true, round_to_nearest: true };

    #[test]
    fn strict_asks_for_what_is_promised_of_its_precision_and_fast_for_nothing() {
        let promises = Promises { f32: ALL, f64: ALL };
        let count = |words: &[u32], op: Op| instructions(words).filter(|(one, _)| *one == Some(op)).count();
        let (plain, asked) = (words(Float::Strict), promised(Float::Strict, &promises));
        assert_eq!(count(&asked, Op::ExecutionMode), count(&plain, Op::ExecutionMode) + 3);
        assert_eq!(count(&asked, Op::Capability), count(&plain, Op::Capability) + 3);
        assert_eq!(count(&asked, Op::Extension), count(&plain, Op::Extension) + 1);
        assert_eq!(promised(Float::Fast, &promises), words(Float::Fast));
    }

    #[test]
    fn modes_stand_where_the_specification_wants_them() {
        let asked = promised(Float::Strict, &Promises { f32: ALL, f64: ALL });
        let order = |op| match op {
            Some(Op::Capability) => Some(0),
            Some(Op::Extension) => Some(1),
            Some(Op::ExtInstImport) => Some(2),
            Some(Op::MemoryModel) => Some(3),
            Some(Op::EntryPoint) => Some(4),
            Some(Op::ExecutionMode) => Some(5),
            _ => None,
        };
        let sections: Vec<_> = instructions(&asked).map_while(|(op, _)| order(op)).collect();
        assert!(sections.is_sorted() && sections.contains(&5), "{sections:?}");
    }

    #[test]
    fn an_extension_is_named_in_words_that_end_with_zero() {
        assert_eq!(extension("abcd"), [3 << 16 | 10, 0x6463_6261, 0]);
        assert_eq!(extension("abc"), [2 << 16 | 10, 0x0063_6261]);
    }
}
