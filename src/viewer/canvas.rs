//! The window's surface and the device that it shares with the renderer.

use std::sync::Arc;

use winit::window::Window;

use super::ViewerError;
use super::look::Look;
use super::present::Presenter;
use crate::film::Preview;
use crate::gpu::{GpuError, GpuOptions, SharedDevice, instance};

/// Behind panels and pictures.
const BACKDROP: wgpu::Color = wgpu::Color { r: 0.07, g: 0.07, b: 0.08, a: 1.0 };
/// Rows of textures are copied in multiples of so many bytes.
const ROW: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// A window's surface, its device, and what draws there.
pub(super) struct Canvas {
    window: Arc<Window>,
    /// In pixels; 0 while the window is minimised.
    size: [u32; 2],
    instance: wgpu::Instance,
    /// None only while it is made anew.
    surface: Option<wgpu::Surface<'static>>,
    config: wgpu::SurfaceConfiguration,
    pub(super) device: SharedDevice,
    pub(super) presenter: Presenter,
    gui: egui_wgpu::Renderer,
    /// What was painted last.
    drawn: Option<wgpu::SubmissionIndex>,
}

/// What egui wants to be painted.
pub(super) struct Painted {
    pub(super) triangles: Vec<egui::ClippedPrimitive>,
    pub(super) textures: egui::TexturesDelta,
    pub(super) pixels_per_point: f32,
}

impl Canvas {
    pub(super) fn new(window: Arc<Window>, options: &GpuOptions) -> Result<Self, ViewerError> {
        let instance = instance();
        let surface = create_surface(&instance, &window)?;
        let (device, capabilities) = SharedDevice::for_surface(&instance, &surface, options)?;
        let config = configuration(&device, &capabilities, &window)?;
        let presenter = Presenter::new(&device, config.format);
        let options =
            egui_wgpu::RendererOptions { dithering: false, ..egui_wgpu::RendererOptions::default() };
        let gui = egui_wgpu::Renderer::new(device.device(), config.format, options);
        let size = window.inner_size().into();
        let surface = Some(surface);
        let mut canvas =
            Self { window, size, instance, surface, config, device, presenter, gui, drawn: None };
        canvas.configure();
        Ok(canvas)
    }

    /// The same window on a new device.
    pub(super) fn reopen(&mut self, options: &GpuOptions) -> Result<(), ViewerError> {
        // A window has one surface at a time.
        self.surface = None;
        *self = Self::new(Arc::clone(&self.window), options)?;
        Ok(())
    }

    /// The window's size in pixels; 0 while it is minimised.
    pub(super) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Take on a new size of the window.
    pub(super) fn resize(&mut self, size: [u32; 2]) {
        self.size = size;
        self.configure();
    }

    /// Make the surface as large as the window, unless that has no size.
    fn configure(&mut self) {
        let [width, height] = self.size;
        let most = self.device.device().limits().max_texture_dimension_2d;
        if width > 0 && height > 0 {
            (self.config.width, self.config.height) = (width.min(most), height.min(most));
            if let Some(surface) = &self.surface {
                self.device.configure(surface, &self.config);
            }
        }
    }

    /// Paint the window, the films in its part `area`; false where there is nothing to paint on for now.
    pub(super) fn paint(
        &mut self,
        painted: Painted,
        look: &Look,
        area: [u32; 4],
    ) -> Result<bool, ViewerError> {
        self.take_textures(&painted.textures);
        let target = self.acquire()?;
        if let Some(target) = &target {
            let view = target.texture.create_view(&wgpu::TextureViewDescriptor::default());
            // While a window is resized its surface may lag behind what it was told to be.
            let size = [target.texture.width(), target.texture.height()];
            self.draw(&view, size, &painted, look, area);
        }
        self.free_textures(painted.textures);
        let is_shown = target.is_some();
        if let Some(target) = target {
            self.window.pre_present_notify();
            self.device.queue().present(target);
        }
        self.check()?;
        Ok(is_shown)
    }

    /// Take note of a frame that is not painted.
    pub(super) fn leave_out(&mut self, painted: Painted) {
        self.take_textures(&painted.textures);
        self.free_textures(painted.textures);
    }

    /// Wait until the device has drawn what was painted last.
    pub(super) fn finish(&self) -> Result<(), GpuError> {
        self.drawn.as_ref().map_or(Ok(()), |drawn| self.device.wait_for(drawn))
    }

    /// Paint what the window shows into a picture.
    pub(super) fn picture(
        &mut self,
        painted: Painted,
        look: &Look,
        area: [u32; 4],
    ) -> Result<(u32, u32, Preview), ViewerError> {
        self.take_textures(&painted.textures);
        let (width, height) = (self.config.width, self.config.height);
        let device = self.device.device();
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("screenshot"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.config.format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.draw(&view, [width, height], &painted, look, area);
        self.free_textures(painted.textures);
        let row = (width * 4).next_multiple_of(ROW);
        let buffer = self.device.device().create_buffer(&wgpu::BufferDescriptor {
            label: Some("screenshot"),
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut encoder =
            self.device.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        self.device.submit(encoder.finish());
        let bytes = self.device.read(&buffer, 4)?;
        let is_bgra = self.config.format == wgpu::TextureFormat::Bgra8Unorm;
        let pixel = |p: &[u8]| if is_bgra { [p[2], p[1], p[0]] } else { [p[0], p[1], p[2]] };
        let rows = bytes.chunks_exact(row as usize);
        let pixels = rows.flat_map(|row| row[..width as usize * 4].chunks_exact(4).map(pixel)).collect();
        Ok((width, height, Preview { pixels, legend: "the window".to_owned() }))
    }

    fn draw(
        &mut self,
        view: &wgpu::TextureView,
        size: [u32; 2],
        painted: &Painted,
        look: &Look,
        area: [u32; 4],
    ) {
        let (device, queue) = (self.device.device(), self.device.queue());
        let screen =
            egui_wgpu::ScreenDescriptor { size_in_pixels: size, pixels_per_point: painted.pixels_per_point };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.gui.update_buffers(device, queue, &mut encoder, &painted.triangles, &screen);
        {
            let attachment = wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(BACKDROP), store: wgpu::StoreOp::Store },
            };
            let mut pass = encoder
                .begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some("window"),
                    color_attachments: &[Some(attachment)],
                    ..wgpu::RenderPassDescriptor::default()
                })
                .forget_lifetime();
            self.presenter.draw(&mut pass, look, clipped(area, size));
            pass.set_scissor_rect(0, 0, size[0], size[1]);
            self.gui.render(&mut pass, &painted.triangles, &screen);
        }
        self.drawn = Some(self.device.submit(encoder.finish()));
    }

    fn take_textures(&mut self, textures: &egui::TexturesDelta) {
        let (device, queue) = (self.device.device(), self.device.queue());
        for (id, deltas) in &textures.set {
            for delta in deltas {
                self.gui.update_texture(device, queue, *id, delta);
            }
        }
    }

    fn free_textures(&mut self, mut textures: egui::TexturesDelta) {
        textures.free.iter().for_each(|id| self.gui.free_texture(id));
        textures.clear();
    }

    /// The picture that comes next on the window; a lost surface is made anew once.
    fn acquire(&mut self) -> Result<Option<wgpu::SurfaceTexture>, ViewerError> {
        use wgpu::CurrentSurfaceTexture as Current;
        if self.size.contains(&0) {
            return Ok(None);
        }
        for _ in 0..2 {
            let Some(surface) = &self.surface else { return Ok(None) };
            match surface.get_current_texture() {
                Current::Success(texture) | Current::Suboptimal(texture) => return Ok(Some(texture)),
                Current::Timeout | Current::Occluded => return Ok(None),
                Current::Outdated => self.configure(),
                Current::Lost => {
                    // Perhaps the whole device is.
                    self.check()?;
                    self.surface = None;
                    self.surface = Some(create_surface(&self.instance, &self.window)?);
                    self.configure();
                }
                Current::Validation => self.check()?,
            }
        }
        self.check()?;
        Ok(None)
    }

    /// What the driver reported, once what was used and is no more is given back.
    fn check(&self) -> Result<(), GpuError> {
        // Its errors are reported too.
        let _ = self.device.device().poll(wgpu::PollType::Poll);
        self.device.check()
    }
}

fn create_surface(
    instance: &wgpu::Instance,
    window: &Arc<Window>,
) -> Result<wgpu::Surface<'static>, ViewerError> {
    instance.create_surface(Arc::clone(window)).map_err(|error| ViewerError::Surface(error.to_string()))
}

/// 8-bit codes, one frame ahead.
fn configuration(
    device: &SharedDevice,
    capabilities: &wgpu::SurfaceCapabilities,
    window: &Window,
) -> Result<wgpu::SurfaceConfiguration, ViewerError> {
    let wanted = [wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
    let format = capabilities.formats.iter().find(|format| wanted.contains(format)).ok_or_else(|| {
        ViewerError::Gpu(GpuError::Refused {
            adapter: device.adapter().name.clone(),
            what: "a window",
            reason: "it has no format of 8 bits a channel".to_owned(),
        })
    })?;
    let size = window.inner_size();
    Ok(wgpu::SurfaceConfiguration {
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        format: *format,
        color_space: wgpu::SurfaceColorSpace::default(),
        width: size.width.max(1),
        height: size.height.max(1),
        present_mode: wgpu::PresentMode::AutoVsync,
        desired_maximum_frame_latency: 1,
        alpha_mode: wgpu::CompositeAlphaMode::Auto,
        view_formats: Vec::new(),
    })
}

/// The part of an area that lies within the target.
fn clipped([left, top, width, height]: [u32; 4], [across, down]: [u32; 2]) -> [u32; 4] {
    let (left, top) = (left.min(across), top.min(down));
    [left, top, width.min(across - left), height.min(down - top)]
}
