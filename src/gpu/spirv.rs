//! naga's SPIR-V, and the strict form of it: every float operation as written.

use naga::back::spv;
use spirv::{Decoration, Op};

use super::assemble::Shader;
use super::{GpuError, Variant};
use crate::layout::Float;

/// Words before the first instruction (SPIR-V specification, section 2.3).
const HEADER: usize = 5;

/// Write the entry point as SPIR-V for `vkCreateShaderModule`, strict where the variant is.
///
/// Bounds are not checked: `flatten` proves every index. Loops get no bound, workgroup memory is not cleared.
///
/// # Errors
/// [`GpuError::Shader`] where naga cannot write the module.
pub fn write_spirv(shader: &Shader, variant: &Variant) -> Result<Vec<u32>, GpuError> {
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
        Float::Strict => forbid_contraction(&words),
        Float::Fast => words,
    })
}

/// Decorate every float arithmetic result with NoContraction, so that no compiler fuses or rearranges it
/// (SPIR-V specification, section 3.20, and Vulkan's "Precision and Operation of SPIR-V Instructions").
fn forbid_contraction(words: &[u32]) -> Vec<u32> {
    let mut annotations_end = None;
    let mut decorations = Vec::new();
    let mut at = HEADER;
    while let Some(&first) = words.get(at) {
        let (op, length) = (Op::from_u32(first & 0xffff), (first >> 16) as usize);
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
        at += length.max(1);
    }
    let (before, behind) = words.split_at(annotations_end.unwrap_or(words.len()));
    [before, &decorations, behind].concat()
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
        let variant = Variant { float, ..PLAIN };
        write_spirv(&assemble(&[("sums", SUMS)], "sums", "main", &variant).unwrap(), &variant).unwrap()
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
}
