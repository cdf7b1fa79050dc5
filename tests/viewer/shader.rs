//! `shaders/present.wgsl`: what a window shows is what files hold.

use std::ops::ControlFlow;

use snellius::film::{AovKind, Development, Frame, Renderer, srgb_code};
use snellius::gpu::{Exposure, GpuRenderer, SharedDevice};
use snellius::layout::Settings;
use snellius::scene::Scene;
use snellius::viewer::{Look, Presenter, Stage, ViewKind};

use crate::lockstep::devices::find;

const SIZE: [u32; 2] = [96, 64];

/// A film of a scene, and the same as a frame.
fn traced(device: &SharedDevice, size: [u32; 2], samples: u32) -> (Exposure, Frame) {
    let path = super::scene("goblet.toml");
    let stage = Stage::of(&path, Scene::load(&path).unwrap()).unwrap();
    let settings = Settings { samples, depth: 8, aovs: true, ..Settings::default() };
    let view = snellius::flatten::view(&stage.scene.camera, &stage.flat.scene, size, None, &settings);
    let mut renderer = GpuRenderer::on(device, &stage.flat.scene).unwrap();
    let exposure = renderer.expose(&view, &settings, &|_| ControlFlow::Continue(())).unwrap();
    let frame = renderer.render(&view, &settings, &()).unwrap();
    (exposure, frame)
}

/// What a window of the picture's size shows.
fn shown(device: &SharedDevice, look: &Look) -> Vec<[u8; 3]> {
    let presenter = Presenter::new(device, wgpu::TextureFormat::Rgba8Unorm);
    presenter.measure(look);
    let [width, height] = SIZE;
    let texture = device.device().create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let row = (width * 4).next_multiple_of(256);
    let buffer = device.device().create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row * height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let mut encoder = device.device().create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let attachment = wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(attachment)],
            ..wgpu::RenderPassDescriptor::default()
        });
        presenter.draw(&mut pass, look, [0, 0, width, height]);
    }
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
    );
    device.queue().submit([encoder.finish()]);
    let bytes = device.read(&buffer, 4).unwrap();
    let rows = bytes.chunks_exact(row as usize).map(|row| &row[..4 * width as usize]);
    rows.flat_map(|row| row.chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]])).collect()
}

#[test]
fn a_window_shows_the_codes_of_a_png_file() {
    for part in ["llvmpipe", "swiftshader"] {
        let Some(options) = find(part) else { return };
        let device = SharedDevice::new(&options).unwrap();
        let (exposure, frame) = traced(&device, SIZE, 2);
        for exposure_ev in [0.0, -1.5] {
            let look = Look { coarse: Some(exposure.clone()), exposure: exposure_ev, ..Look::default() };
            let development = Development { exposure: exposure_ev, ..Development::default() };
            let code = |pixel: [f32; 3]| pixel.map(|v| srgb_code(v, 255) as u8);
            let expected: Vec<_> = development.apply(&frame.radiance()).into_iter().map(code).collect();
            assert!(shown(&device, &look) == expected, "{part} at {exposure_ev} EV");
        }
    }
}

#[test]
fn false_colours_are_those_of_the_command_line() {
    let Some(options) = find("llvmpipe") else { return };
    let device = SharedDevice::new(&options).unwrap();
    let (exposure, frame) = traced(&device, SIZE, 2);
    for kind in AovKind::ALL {
        let look = Look { coarse: Some(exposure.clone()), first: ViewKind::Aov(kind), ..Look::default() };
        let expected = kind.preview(&frame).unwrap().pixels;
        let found = shown(&device, &look);
        let far =
            expected.iter().zip(&found).filter(|(a, b)| (0..3).any(|c| a[c].abs_diff(b[c]) > 1)).count();
        assert_eq!(far, 0, "{}", kind.name());
    }
}

#[test]
fn a_film_in_work_shows_the_mean_of_its_samples_and_the_last_picture_elsewhere() {
    let Some(options) = find("llvmpipe") else { return };
    let device = SharedDevice::new(&options).unwrap();
    let (coarse, _) = traced(&device, SIZE, 1);
    let (complete, _) = traced(&device, SIZE, 2);
    let of = |fine: Option<Exposure>| Look { coarse: Some(coarse.clone()), fine, ..Look::default() };
    // Nothing of it is there yet.
    let none = Exposure { passes: 0, blocks: 0, ..complete.clone() };
    assert!(shown(&device, &of(Some(none))) == shown(&device, &of(None)));
    // Twelve blocks a row: the first row of blocks is there.
    let some = Exposure { passes: 0, blocks: 12, ..complete.clone() };
    let (mixed, whole) = (shown(&device, &of(Some(some))), shown(&device, &of(Some(complete))));
    let row = SIZE[0] as usize * 8;
    assert!(mixed[..row] == whole[..row] && mixed[row..] != whole[row..]);
}

#[test]
fn a_bit_that_differs_from_the_cpus_picture_is_seen() {
    let Some(options) = find("llvmpipe") else { return };
    let device = SharedDevice::new(&options).unwrap();
    let (exposure, mut frame) = traced(&device, SIZE, 2);
    let bits = frame.texels[777].radiance[1].to_bits();
    frame.texels[777].radiance[1] = f32::from_bits(bits ^ 1);
    let reference = Some(Exposure::of_frame(&device, &frame).unwrap());
    let look = Look { coarse: Some(exposure), reference, first: ViewKind::Difference, ..Look::default() };
    let found = shown(&device, &look);
    let differing: Vec<_> = (0..found.len()).filter(|&pixel| found[pixel] != [0; 3]).collect();
    assert_eq!(differing, [777]);
}

#[test]
fn a_film_of_fewer_pixels_is_shown_between_them() {
    let Some(options) = find("llvmpipe") else { return };
    let device = SharedDevice::new(&options).unwrap();
    let [width, height] = SIZE.map(|side| side / 2);
    let (coarse, frame) = traced(&device, [width, height], 1);
    let found = shown(&device, &Look { coarse: Some(coarse), ..Look::default() });
    let display = Development::default().apply(&frame.radiance());
    let code = |x: i64, y: i64, channel: usize| {
        let (x, y) = (x.clamp(0, i64::from(width) - 1), y.clamp(0, i64::from(height) - 1));
        f64::from(srgb_code(display[(y * i64::from(width) + x) as usize][channel], 255))
    };
    for (index, pixel) in found.iter().enumerate() {
        let at = [index % SIZE[0] as usize, index / SIZE[0] as usize].map(|side| side as f64 / 2.0 - 0.25);
        let [x, y] = at.map(|side| side.floor() as i64);
        let [u, v] = at.map(|side| side - side.floor());
        for channel in 0..3 {
            let row = |y| code(x, y, channel) * (1.0 - u) + code(x + 1, y, channel) * u;
            let expected = row(y) * (1.0 - v) + row(y + 1) * v;
            // Devices weigh texels with eight bits.
            assert!((f64::from(pixel[channel]) - expected).abs() <= 2.0, "{index}: {pixel:?} {expected}");
        }
    }
}

#[test]
fn the_upper_part_of_a_small_film_in_work_lies_over_the_last_picture() {
    let Some(options) = find("llvmpipe") else { return };
    let device = SharedDevice::new(&options).unwrap();
    let (coarse, _) = traced(&device, SIZE, 1);
    let (small, _) = traced(&device, SIZE.map(|side| side / 2), 1);
    let before = shown(&device, &Look { coarse: Some(coarse.clone()), ..Look::default() });
    let after = shown(&device, &Look { coarse: Some(small.clone()), ..Look::default() });
    // Six blocks a row: the first of four rows is there, of which the last line would look at the second.
    let some = Exposure { passes: 0, blocks: 7, ..small };
    let mixed = shown(&device, &Look { coarse: Some(coarse), fine: Some(some), ..Look::default() });
    let row = SIZE[0] as usize * 15;
    assert!(mixed[..row] == after[..row] && mixed[row..] == before[row..]);
    assert!(after != before);
}
