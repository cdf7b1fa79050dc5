//! Films on a window: `shaders/present.wgsl` reads them where they were traced.

use bytemuck::bytes_of;

use super::groups::{bind, group_layout, pipeline_layout, storage, texture};
use super::look::{Layer, Look, ViewKind};
use super::reels::{Reel, Shot, code_steps, shader};
use crate::gpu::{Exposure, GpuError, SharedDevice};
use crate::layout::constants::BLOCK;

/// Words of the ranges: near, far, rays, samples, dropped, bound, and two more.
pub(super) const RANGES: usize = 8;

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
    format: wgpu::TextureFormat,
    beauty: wgpu::RenderPipeline,
    false_colours: wgpu::RenderPipeline,
    enlarge: wgpu::RenderPipeline,
    measure: wgpu::ComputePipeline,
    show_layout: wgpu::BindGroupLayout,
    enlarge_layout: wgpu::BindGroupLayout,
    measure_layout: wgpu::BindGroupLayout,
    steps: wgpu::Buffer,
    ranges: wgpu::Buffer,
    /// In place of a film that is not there.
    nothing: wgpu::Buffer,
    smoothly: wgpu::Sampler,
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
        let show_layout = group_layout(
            device,
            wgpu::ShaderStages::FRAGMENT,
            &[0, 1, 2, 3, 4].map(|binding| (binding, read)),
        );
        let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let enlarge_layout =
            group_layout(device, wgpu::ShaderStages::FRAGMENT, &[(3, read), (6, texture()), (7, sampler)]);
        let measured = [(0, read), (3, read), (5, storage(false))];
        let measure_layout = group_layout(device, wgpu::ShaderStages::COMPUTE, &measured);
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
            ("ranges", RANGES * 4, stored | wgpu::BufferUsages::COPY_SRC),
            ("nothing", 4, stored),
        ];
        let [steps_buffer, ranges, nothing] = buffers.map(|(label, size, usage)| {
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
            format,
            beauty: draws(device, &module, &show_layout, "beauty", format),
            false_colours: draws(device, &module, &show_layout, "false_colours", format),
            enlarge: draws(device, &module, &enlarge_layout, "enlarge", format),
            measure,
            show_layout,
            enlarge_layout,
            measure_layout,
            steps: steps_buffer,
            ranges,
            nothing,
            smoothly: device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..wgpu::SamplerDescriptor::default()
            }),
        }
    }

    /// Measure the last finished film of the look, on the device.
    pub fn measure(&self, look: &Look) {
        let Some(coarse) = &look.coarse else { return };
        // Minima begin with the greatest float.
        let start: [u32; RANGES] = [f32::MAX.to_bits(), 0, 0, 0, 0, 0, 0, 0];
        let (device, queue) = (self.device.device(), self.device.queue());
        queue.write_buffer(&self.ranges, 0, bytes_of(&start));
        let shot = self.record(&Shot { film: Reel::of(coarse), ..Shot::default() });
        let words = coarse.film.buffer().as_entire_binding();
        let resources = [(0, words), (3, shot.as_entire_binding()), (5, self.ranges.as_entire_binding())];
        let group = bind(device, &self.measure_layout, &resources);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.measure);
            pass.set_bind_group(0, &group, &[]);
            let [width, height] = [coarse.film.width, coarse.film.height];
            pass.dispatch_workgroups(width.div_ceil(BLOCK), height.div_ceil(BLOCK), 1);
        }
        self.device.submit(encoder.finish());
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
        for layer in look.layers(area) {
            self.draw_layer(pass, look, &layer, area);
        }
    }

    fn draw_layer(&self, pass: &mut wgpu::RenderPass<'_>, look: &Look, layer: &Layer<'_>, area: [u32; 4]) {
        let Layer { exposure, kind, part: [left, top, width, height] } = *layer;
        if width == 0 || height == 0 {
            return;
        }
        let [_, _, across, down] = area;
        if kind == ViewKind::Beauty && [exposure.film.width, exposure.film.height] != [across, down] {
            let small = self.develop(look, exposure);
            let shot = self.record(&Shot { area: area.map(|side| side as f32), ..Shot::default() });
            let resources = [
                (3, shot.as_entire_binding()),
                (6, wgpu::BindingResource::TextureView(&small)),
                (7, wgpu::BindingResource::Sampler(&self.smoothly)),
            ];
            pass.set_pipeline(&self.enlarge);
            pass.set_bind_group(0, &bind(self.device.device(), &self.enlarge_layout, &resources), &[]);
        } else {
            pass.set_pipeline(if kind == ViewKind::Beauty { &self.beauty } else { &self.false_colours });
            pass.set_bind_group(0, &self.group(look, exposure, kind, area), &[]);
        }
        pass.set_scissor_rect(left, top, width, height);
        pass.draw(0..3, 0..1);
    }

    /// A film in codes, as a texture of its own size: few pixels are developed once, not at each of the window's many.
    fn develop(&self, look: &Look, exposure: &Exposure) -> wgpu::TextureView {
        let [width, height] = [exposure.film.width, exposure.film.height];
        let device = self.device.device();
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("developed"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let attachment = wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            };
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("develop"),
                color_attachments: &[Some(attachment)],
                ..wgpu::RenderPassDescriptor::default()
            });
            pass.set_pipeline(&self.beauty);
            let area = [0, 0, width, height];
            pass.set_bind_group(0, &self.group(look, exposure, ViewKind::Beauty, area), &[]);
            pass.draw(0..3, 0..1);
        }
        // Before what reads it: the queue keeps the order.
        self.device.submit(encoder.finish());
        view
    }

    /// What the pixels of a film are shown by.
    fn group(&self, look: &Look, exposure: &Exposure, kind: ViewKind, area: [u32; 4]) -> wgpu::BindGroup {
        let shot = self.record(&Shot {
            film: Reel::of(exposure),
            reference: look.reference.as_ref().map(Reel::of).unwrap_or_default(),
            area: area.map(|side| side as f32),
            gain: look.exposure.exp2(),
            kind: kind.index(),
            reserved: [0; 2],
        });
        let reference = look.reference.as_ref().map_or(&self.nothing, |exposure| exposure.film.buffer());
        let buffers = [exposure.film.buffer(), reference, &self.steps, &shot, &self.ranges];
        let resources: Vec<_> = (0..).zip(buffers.map(wgpu::Buffer::as_entire_binding)).collect();
        bind(self.device.device(), &self.show_layout, &resources)
    }

    fn record(&self, shot: &Shot) -> wgpu::Buffer {
        let buffer = self.device.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("look"),
            size: size_of::<Shot>() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.device.queue().write_buffer(&buffer, 0, bytes_of(shot));
        buffer
    }
}

/// A pipeline that covers its target with what an entry point says of each pixel.
fn draws(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::BindGroupLayout,
    entry: &str,
    format: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry),
        layout: Some(&pipeline_layout(device, layout)),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("cover"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
