//! Films on a window: `shaders/present.wgsl` reads them where they were traced.

use bytemuck::{Pod, Zeroable, bytes_of};

use super::look::{Look, ViewKind};
use crate::film::srgb_code;
use crate::gpu::{Exposure, GpuError, SharedDevice};
use crate::layout::constants::{BLOCK, LEAST_NORMAL, NONE};

/// Words of the ranges: near, far, rays, samples, dropped, bound, and two more.
const RANGES: usize = 8;
/// The shader, without the constants that it shares with the renderer.
const SHADER: &str = include_str!("../../shaders/present.wgsl");

/// How a film lies in its buffer, and what is on it: `Reel` of the shader.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
struct Reel {
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
struct Uniform {
    fine: Reel,
    coarse: Reel,
    reference: Reel,
    area: [f32; 4],
    wipe: f32,
    gain: f32,
    views: [u32; 2],
}

/// Greatest and least values of a finished film.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ranges {
    /// Distances along primary rays that met something, in scene units; near above far where none did.
    pub depth: [f32; 2],
    /// Most rays of a pixel.
    pub rays: u32,
    /// Most samples of a pixel.
    pub samples: u32,
    /// Greatest weight of a pixel's cut rays.
    pub dropped: f32,
    /// Greatest bound on a pixel's error.
    pub bound: f32,
}

/// Shows films.
pub struct Presenter {
    device: SharedDevice,
    pipeline: wgpu::RenderPipeline,
    measure: wgpu::ComputePipeline,
    show_layout: wgpu::BindGroupLayout,
    measure_layout: wgpu::BindGroupLayout,
    steps: wgpu::Buffer,
    uniform: wgpu::Buffer,
    ranges: wgpu::Buffer,
    /// In place of a film that is not there.
    nothing: wgpu::Buffer,
}

impl Presenter {
    /// For targets of this format, whose values are sRGB codes.
    #[must_use]
    pub fn new(device: &SharedDevice, format: wgpu::TextureFormat) -> Self {
        let shared = device;
        let device = shared.device();
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("present"),
            source: wgpu::ShaderSource::Wgsl(shader().into()),
        });
        let read = storage(true);
        let uniform = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let show = [(0, read), (1, read), (2, read), (3, uniform), (4, read), (6, read)];
        let show_layout = group_layout(device, wgpu::ShaderStages::FRAGMENT, &show);
        let measured = [(1, read), (3, uniform), (5, storage(false))];
        let measure_layout = group_layout(device, wgpu::ShaderStages::COMPUTE, &measured);
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("present"),
            layout: Some(&pipeline_layout(device, &show_layout)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("cover"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("present"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let measure = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("measure"),
            layout: Some(&pipeline_layout(device, &measure_layout)),
            module: &module,
            entry_point: Some("measure"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let stored = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let steps = code_steps();
        let buffers = [
            ("steps", size_of_val(&steps), stored),
            ("look", size_of::<Uniform>(), wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST),
            ("ranges", RANGES * 4, stored | wgpu::BufferUsages::COPY_SRC),
            ("nothing", 4, stored),
        ];
        let [steps_buffer, uniform, ranges, nothing] = buffers.map(|(label, size, usage)| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size as u64,
                usage,
                mapped_at_creation: false,
            })
        });
        shared.queue().write_buffer(&steps_buffer, 0, bytes_of(&steps));
        Self {
            device: shared.clone(),
            pipeline,
            measure,
            show_layout,
            measure_layout,
            steps: steps_buffer,
            uniform,
            ranges,
            nothing,
        }
    }

    /// Measure the last finished film of the look, on the device.
    pub fn measure(&self, look: &Look) {
        let Some(coarse) = &look.coarse else { return };
        // Minima begin with the greatest float.
        let start: [u32; RANGES] = [f32::MAX.to_bits(), 0, 0, 0, 0, 0, 0, 0];
        let (device, queue) = (self.device.device(), self.device.queue());
        queue.write_buffer(&self.ranges, 0, bytes_of(&start));
        queue.write_buffer(&self.uniform, 0, bytes_of(&self.uniform_of(look, [0.0; 4])));
        let group = bind(
            device,
            &self.measure_layout,
            &[(1, coarse.film.buffer()), (3, &self.uniform), (5, &self.ranges)],
        );
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.measure);
            pass.set_bind_group(0, &group, &[]);
            let [width, height] = [coarse.film.width, coarse.film.height];
            pass.dispatch_workgroups(width.div_ceil(BLOCK), height.div_ceil(BLOCK), 1);
        }
        queue.submit([encoder.finish()]);
    }

    /// What was measured last: 32 bytes.
    ///
    /// # Errors
    /// [`GpuError::DeviceLost`].
    pub fn ranges(&self) -> Result<Ranges, GpuError> {
        let bytes = self.device.read(&self.ranges, 4)?;
        let words: [u32; RANGES] = *bytemuck::from_bytes(&bytes);
        let real = |word: usize| f32::from_bits(words[word]);
        Ok(Ranges {
            depth: [real(0), real(1)],
            rays: words[2],
            samples: words[3],
            dropped: real(4),
            bound: real(5),
        })
    }

    /// Draw the look into the part `area` of a target (left, top, width and height in pixels).
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, look: &Look, area: [u32; 4]) {
        let [left, top, width, height] = area;
        if width == 0 || height == 0 {
            return;
        }
        let uniform = self.uniform_of(look, area.map(|side| side as f32));
        self.device.queue().write_buffer(&self.uniform, 0, bytes_of(&uniform));
        let buffer = |exposure: &Option<Exposure>| {
            exposure.as_ref().map_or(&self.nothing, |exposure| exposure.film.buffer()).clone()
        };
        let [fine, coarse, reference] = [&look.fine, &look.coarse, &look.reference].map(buffer);
        let buffers = [
            (0, &fine),
            (1, &coarse),
            (2, &self.steps),
            (3, &self.uniform),
            (4, &self.ranges),
            (6, &reference),
        ];
        let group = bind(self.device.device(), &self.show_layout, &buffers);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.set_scissor_rect(left, top, width, height);
        pass.draw(0..3, 0..1);
    }

    fn uniform_of(&self, look: &Look, area: [f32; 4]) -> Uniform {
        let reel = |exposure: &Option<Exposure>| exposure.as_ref().map(reel).unwrap_or_default();
        let [first, second] = [look.first, look.second.unwrap_or(look.first)].map(ViewKind::index);
        Uniform {
            fine: reel(&look.fine),
            coarse: reel(&look.coarse),
            reference: reel(&look.reference),
            area,
            wipe: if look.second.is_some() { (look.wipe * area[2]).round() } else { f32::MAX },
            gain: look.exposure.exp2(),
            views: [first, second],
        }
    }
}

/// The whole shader.
fn shader() -> String {
    format!(
        "const BLOCK: u32 = {BLOCK}u;\nconst NONE: u32 = {NONE}u;\nconst LEAST_NORMAL: f32 = {LEAST_NORMAL:e}f;\n{SHADER}"
    )
}

fn reel(exposure: &Exposure) -> Reel {
    let Exposure { film, samples, passes, blocks, .. } = exposure;
    let aov_at = if film.has_aovs() { 8 } else { 0 };
    Reel {
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

/// The least linear value of each 8-bit code.
fn code_steps() -> [f32; 256] {
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

fn storage(read_only: bool) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn group_layout(
    device: &wgpu::Device,
    visibility: wgpu::ShaderStages,
    bindings: &[(u32, wgpu::BindingType)],
) -> wgpu::BindGroupLayout {
    let entry = |&(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let entries: Vec<_> = bindings.iter().map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("films"),
        entries: &entries,
    })
}

fn pipeline_layout(device: &wgpu::Device, group: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("films"),
        bind_group_layouts: &[Some(group)],
        ..wgpu::PipelineLayoutDescriptor::default()
    })
}

fn bind(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    buffers: &[(u32, &wgpu::Buffer)],
) -> wgpu::BindGroup {
    let bindings = buffers.iter().map(|(binding, buffer)| (*binding, buffer.as_entire_binding()));
    let entries: Vec<_> =
        bindings.map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("films"), layout, entries: &entries })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_shader_is_sound_and_its_records_are_ours() {
        let module = naga::front::wgsl::parse_str(&shader()).unwrap();
        let flags = naga::valid::ValidationFlags::all();
        naga::valid::Validator::new(flags, naga::valid::Capabilities::empty()).validate(&module).unwrap();
        for (name, bytes) in
            [("Reel", size_of::<Reel>()), ("Look", size_of::<Uniform>()), ("Ranges", 4 * RANGES)]
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
