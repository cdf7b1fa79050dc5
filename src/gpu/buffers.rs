//! A scene in device memory.

use std::borrow::Cow;

use bytemuck::{NoUninit, Zeroable, bytes_of, cast_slice};

use super::GpuError;
use super::context::Context;
use super::pipeline::{SCENE, TILE, VIEW, WRITTEN, bind_group_layout};
use crate::layout::{FlatScene, View};

/// Storage buffers that the host fills.
const STORED: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE.union(wgpu::BufferUsages::COPY_DST);
/// Bytes of the record at binding [`TILE`]: four words.
const TILE_SIZE: u64 = 16;

/// A scene in device memory, with the view and tile that it is traced by.
pub(super) struct SceneBuffers {
    pub(super) layout: wgpu::BindGroupLayout,
    /// In the order of their bindings.
    arrays: Vec<wgpu::Buffer>,
    view: wgpu::Buffer,
    tile: wgpu::Buffer,
}

impl SceneBuffers {
    /// Upload the scene. Every size is checked before the first byte moves.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] names the array, its size and the limit.
    pub(super) fn new(context: &Context, scene: &FlatScene) -> Result<Self, GpuError> {
        let arrays: [(_, Cow<'_, [u8]>); SCENE as usize] = [
            ("the tree of boxes", bytes(&scene.nodes)),
            ("the triangles", bytes(&scene.triangles)),
            ("the triangles' attributes", bytes(&scene.attributes)),
            ("the triangles' corners", bytes(&scene.corners)),
            ("the materials", bytes(&scene.materials)),
            ("the lights", bytes(&scene.lights)),
            ("the textures and the background", bytes(&scene.texels)),
        ];
        for (what, bytes) in &arrays {
            context.check_size(what, bytes.len() as u64)?;
        }
        let upload = |(what, bytes): &(&'static str, Cow<'_, [u8]>)| {
            let buffer = context.buffer(what, bytes.len() as u64, STORED)?;
            context.write(&buffer, bytes)?;
            Ok(buffer)
        };
        Ok(Self {
            layout: bind_group_layout(&context.device),
            arrays: arrays.iter().map(upload).collect::<Result<_, GpuError>>()?,
            view: context.buffer("the view", size_of::<View>() as u64, STORED)?,
            tile: context.buffer("the tile", TILE_SIZE, STORED)?,
        })
    }

    /// Trace by this view from the next submission on.
    pub(super) fn set_view(&self, context: &Context, view: &View) {
        context.queue.write_buffer(&self.view, 0, bytes_of(view));
    }

    /// Trace this part in the next submission: a [`Tile`](crate::layout::Tile), or a probe's range.
    pub(super) fn set_tile(&self, context: &Context, words: [u32; 4]) {
        context.queue.write_buffer(&self.tile, 0, bytes_of(&words));
    }

    /// The scene with the buffer that the shader writes.
    pub(super) fn bind(&self, context: &Context, written: &wgpu::Buffer) -> wgpu::BindGroup {
        let arrays = (0..SCENE).zip(&self.arrays);
        let others = [(WRITTEN, written), (VIEW, &self.view), (TILE, &self.tile)];
        let entries: Vec<_> = arrays
            .chain(others)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        context.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &self.layout,
            entries: &entries,
        })
    }
}

/// The records as bytes; one zero record for none, since no binding may be empty.
fn bytes<T: NoUninit + Zeroable>(records: &[T]) -> Cow<'_, [u8]> {
    match records {
        [] => Cow::Owned(vec![0; size_of::<T>()]),
        records => Cow::Borrowed(cast_slice(records)),
    }
}
