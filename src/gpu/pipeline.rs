//! A compute pipeline out of one entry point of the shaders.

use std::borrow::Cow;

use super::assemble::{Shader, Source, assemble};
use super::context::Context;
use super::spirv::write_spirv;
use super::{GpuError, Variant};
use crate::layout::{Float, Precision};

/// The scene's arrays: nodes, triangles, attributes, texture coordinates, materials, texels from binding 0 on.
pub(super) const SCENE: u32 = 6;
/// Binding of the [`View`](crate::layout::View) with the lights behind it.
pub(super) const FRAME: u32 = SCENE;
/// Binding of the buffer that a shader writes: the film, or the records of a probe.
pub(super) const WRITTEN: u32 = FRAME + 1;
/// All of them are storage buffers, as many as WebGPU promises. A uniform buffer would do for the view, but lavapipe
/// folds those that decide loops into a copy of the shader at every dispatch, which took half of the time (Mesa 22.3,
/// 13 ms a dispatch).
pub(super) const STORAGE_BUFFERS: u32 = WRITTEN + 1;

/// Group 0 of every pipeline. The bindings have no gaps: see [`write_spirv`].
pub(super) fn bind_group_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..STORAGE_BUFFERS)
        .map(|binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: binding != WRITTEN },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scene"),
        entries: &entries,
    })
}

/// A pipeline, and where its shader expects the pixels.
#[derive(Clone)]
pub(super) struct Compiled {
    pub(super) pipeline: wgpu::ComputePipeline,
    /// Bytes before the texels of the film; 0 for a shader without film.
    pub(super) texels_at: u64,
    /// Bytes before the recorded tree; 0 for a shader without.
    pub(super) tree_at: u64,
    /// Bytes of an invocation's private variables.
    pub(super) private: u64,
}

/// The bytes of the variables that each invocation has for itself.
fn private_bytes(module: &naga::Module) -> u64 {
    let private = module.global_variables.iter().filter(|(_, one)| one.space == naga::AddressSpace::Private);
    private.map(|(_, one)| u64::from(module.types[one.ty].inner.size(module.to_ctx()))).sum()
}

/// The offset of a part of the film in the shader's own record of it, which depends on the variant; 0 for none.
fn film_offset(module: &naga::Module, part: &str) -> u64 {
    let film = module.types.iter().find(|(_, kind)| kind.name.as_deref() == Some("Film"));
    let member = film.and_then(|(_, kind)| match &kind.inner {
        naga::TypeInner::Struct { members, .. } => {
            members.iter().find(|member| member.name.as_deref() == Some(part))
        }
        _ => None,
    });
    member.map_or(0, |member| u64::from(member.offset))
}

/// Assemble and compile one entry point.
///
/// # Errors
/// [`GpuError::Shader`], [`GpuError::NoF64`], [`GpuError::Refused`].
pub(super) fn compile(
    context: &Context,
    layout: &wgpu::BindGroupLayout,
    sources: &[Source<'_>],
    (root, entry): (&str, &str),
    variant: &Variant,
) -> Result<Compiled, GpuError> {
    if variant.precision == Precision::F64 && !context.adapter.f64 {
        return Err(GpuError::NoF64 { adapter: context.adapter.name.clone() });
    }
    let shader = assemble(sources, root, entry, variant)?;
    let scopes = [wgpu::ErrorFilter::Internal, wgpu::ErrorFilter::Validation]
        .map(|filter| context.device.push_error_scope(filter));
    let module = module(context, &shader, variant)?;
    let layout = context.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(entry),
        bind_group_layouts: &[Some(layout)],
        ..wgpu::PipelineLayoutDescriptor::default()
    });
    let pipeline = context.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry),
        layout: Some(&layout),
        module: &module,
        entry_point: Some(entry),
        compilation_options: wgpu::PipelineCompilationOptions {
            zero_initialize_workgroup_memory: false,
            ..wgpu::PipelineCompilationOptions::default()
        },
        cache: context.pipeline_cache.cache(),
    });
    for scope in scopes.into_iter().rev() {
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(context.adapter.refused("a compute pipeline", error.to_string()));
        }
    }
    context.check()?;
    let at = |name| film_offset(&shader.module, name);
    let private = private_bytes(&shader.module);
    Ok(Compiled { pipeline, texels_at: at("texels"), tree_at: at("tree"), private })
}

/// Hand the shader to the driver: decorated and as it is if strict, else through wgpu without run-time checks.
fn module(context: &Context, shader: &Shader, variant: &Variant) -> Result<wgpu::ShaderModule, GpuError> {
    match variant.float {
        Float::Strict => {
            let words = write_spirv(shader, variant, &context.adapter.promises)?;
            let entry_points: Vec<_> = shader.module.entry_points.iter().map(entry_point).collect();
            let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
                label: Some("strict"),
                entry_points: entry_points.into(),
                spirv: Some(words.into()),
                ..wgpu::ShaderModuleDescriptorPassthrough::default()
            };
            // SAFETY: the words are naga's, of a module that it validated, and decorations do not change their
            // meaning. Indices are within bounds for every scene that `flatten` makes, and loops end.
            Ok(unsafe { context.device.create_shader_module_passthrough(descriptor) })
        }
        Float::Fast => {
            let descriptor = wgpu::ShaderModuleDescriptor {
                label: Some("fast"),
                source: wgpu::ShaderSource::Wgsl(Cow::Borrowed(&shader.wgsl)),
            };
            // SAFETY: as above.
            Ok(unsafe {
                context
                    .device
                    .create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked())
            })
        }
    }
}

fn entry_point(point: &naga::EntryPoint) -> wgpu::PassthroughShaderEntryPoint<'_> {
    let [x, y, z] = point.workgroup_size;
    wgpu::PassthroughShaderEntryPoint { name: point.name.as_str().into(), workgroup_size: (x, y, z) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::SOURCES;
    use super::super::testing::PLAIN;
    use super::*;
    use crate::layout::EffectSet;

    #[test]
    fn the_invocations_of_a_dispatch_take_tens_of_megabytes() {
        for precision in [Precision::F32, Precision::F64] {
            for stack_size in [2, 18, 66] {
                let variant = Variant { precision, stack_size, effects: EffectSet::ALL, ..PLAIN };
                let module = assemble(SOURCES, "render", "render", &variant).unwrap().module;
                let bytes = film_offset(&module, "texels");
                assert!((8 << 20..33 << 20).contains(&bytes), "{variant:?}: {bytes}");
            }
        }
    }
}
