//! A scene in device memory.

use std::borrow::Cow;
use std::sync::Arc;

use bytemuck::{NoUninit, Zeroable, bytes_of, cast_slice};

use super::GpuError;
use super::context::Context;
use super::pipeline::{FRAME, SCENE, WRITTEN, bind_group_layout};
use crate::bvh::{self, MOST_PACKED};
use crate::layout::{FlatScene, Node, Triangle, View, WideNode};

/// Storage buffers that the host fills.
const STORED: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE.union(wgpu::BufferUsages::COPY_DST);

/// What is uploaded: its name, and the records as bytes.
type Array<'a> = (&'static str, Cow<'a, [u8]>);

/// Place of the materials among the arrays.
const MATERIALS: usize = 4;

/// A scene in device memory, with the view that it is traced by.
pub(super) struct SceneBuffers {
    pub(super) layout: wgpu::BindGroupLayout,
    /// In the order of their bindings.
    arrays: Vec<wgpu::Buffer>,
    /// The view, then the lights.
    frame: wgpu::Buffer,
    /// Which of the scene's triangles stands at each place.
    pub(super) order: Vec<u32>,
    /// What the other arrays were made of, shared with every copy of the scene.
    nodes: Arc<[Node]>,
    texels: Arc<[u32]>,
}

impl SceneBuffers {
    /// Upload the scene. Every size is checked before the first byte moves.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`] names the array, its size and the limit.
    pub(super) fn new(context: &Context, scene: &FlatScene) -> Result<Self, GpuError> {
        let packed = bvh::pack(&scene.nodes, &scene.triangles);
        let triangles: Vec<Triangle> =
            packed.order.iter().map(|&index| scene.triangles[index as usize]).collect();
        let arrays: [Array<'_>; SCENE as usize] = [
            ("the tree of boxes", bytes(&packed.nodes)),
            ("the triangles", bytes(&triangles)),
            ("the triangles' attributes", bytes(&scene.attributes)),
            ("the texture coordinates", bytes(&scene.uvs)),
            materials(scene),
            ("the textures and the background", bytes(&scene.texels)),
        ];
        for (what, bytes) in &arrays {
            context.check_size(what, bytes.len() as u64)?;
        }
        let (tree, bytes) = &arrays[0];
        context.check_limit(tree, bytes.len() as u64, (MOST_PACKED * size_of::<WideNode>()) as u64)?;
        Ok(Self {
            frame: frame(context, scene)?,
            arrays: arrays.iter().map(|array| upload(context, array)).collect::<Result<_, GpuError>>()?,
            layout: bind_group_layout(&context.device),
            order: packed.order,
            nodes: Arc::clone(&scene.nodes),
            texels: Arc::clone(&scene.texels),
        })
    }

    /// Put another scene in place of this one: quickly where only lights and materials are others.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub(super) fn show(&mut self, context: &Context, scene: &FlatScene) -> Result<(), GpuError> {
        if Arc::ptr_eq(&self.nodes, &scene.nodes) && Arc::ptr_eq(&self.texels, &scene.texels) {
            self.frame = frame(context, scene)?;
            self.arrays[MATERIALS] = upload(context, &materials(scene))?;
        } else {
            *self = Self::new(context, scene)?;
        }
        Ok(())
    }

    /// Trace by this view from the next submission on.
    pub(super) fn set_view(&self, context: &Context, view: &View) {
        context.queue.write_buffer(&self.frame, 0, bytes_of(view));
    }

    /// The scene with the buffer that the shader writes.
    pub(super) fn bind(&self, context: &Context, written: &wgpu::Buffer) -> wgpu::BindGroup {
        let arrays = (0..SCENE).zip(&self.arrays);
        let others = [(FRAME, &self.frame), (WRITTEN, written)];
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

fn materials(scene: &FlatScene) -> Array<'_> {
    ("the materials", bytes(&scene.materials))
}

fn upload(context: &Context, (what, bytes): &Array<'_>) -> Result<wgpu::Buffer, GpuError> {
    let buffer = context.buffer(what, bytes.len() as u64, STORED)?;
    context.write(&buffer, bytes)?;
    Ok(buffer)
}

/// Room for a view, and the lights behind it.
fn frame(context: &Context, scene: &FlatScene) -> Result<wgpu::Buffer, GpuError> {
    let lights = bytes(&scene.lights);
    let size = (size_of::<View>() + lights.len()) as u64;
    context.check_size("the lights", size)?;
    let frame = context.buffer("the view and the lights", size, STORED)?;
    context.queue.write_buffer(&frame, size_of::<View>() as u64, &lights);
    Ok(frame)
}

/// The records as bytes; one zero record for none, since no binding may be empty.
fn bytes<T: NoUninit + Zeroable>(records: &[T]) -> Cow<'_, [u8]> {
    match records {
        [] => Cow::Owned(vec![0; size_of::<T>()]),
        records => Cow::Borrowed(cast_slice(records)),
    }
}
