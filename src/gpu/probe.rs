//! Running one function of the kernel over many inputs: the harness of the lock-step comparison.
//!
//! A probe is an entry point `fn probe_NAME(@builtin(global_invocation_id) id: vec3u)` of workgroup size `PROBE_GROUP`. It sees
//! the scene in bindings 0–6 and, in place of the film,
//!
//! ```wgsl
//! struct Records { first: u32, end: u32, stride: u32, reserved: u32, words: array<u32> }
//! @group(0) @binding(7) var<storage, read_write> records: Records;
//! ```
//!
//! Invocation `id.x` owns record `first + id.x`, if that is below `end`: the `stride` words from `record · stride` on. It
//! reads its inputs there and overwrites them with its results.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use super::assemble::Source;
use super::buffers::SceneBuffers;
use super::clock::Clock;
use super::context::Context;
use super::pipeline::Compiled;
use super::{AdapterReport, GpuError, GpuOptions, Variant, pipeline};
use crate::layout::constants::PROBE_GROUP;
use crate::layout::{FlatScene, View};

/// Records of one dispatch: a small part of a second on any adapter.
const DISPATCH: u32 = 1 << 16;
/// Bytes before the words: which records a dispatch works on.
const HEAD: u64 = 16;

/// A scene on an adapter, for probes. What was compiled once is kept, over scenes too.
pub struct Prober {
    context: Context,
    sources: &'static [Source<'static>],
    scene: SceneBuffers,
    /// By file, entry point and variant.
    pipelines: HashMap<(String, String, Variant), Compiled>,
    clock: Option<Clock>,
}

/// Records on an adapter.
pub struct Records {
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
    stride: u32,
    count: u32,
    bytes: u64,
}

impl Prober {
    /// Open an adapter, to run probes of these shader files on this scene and view.
    ///
    /// # Errors
    /// As [`GpuRenderer::new`](super::GpuRenderer::new).
    pub fn new(
        scene: &FlatScene,
        view: &View,
        options: &GpuOptions,
        sources: &'static [Source<'static>],
    ) -> Result<Self, GpuError> {
        let context = Context::new(options)?;
        let buffers = SceneBuffers::new(&context, scene)?;
        buffers.set_view(&context, view);
        let clock = Clock::new(&context)?;
        Ok(Self { context, sources, scene: buffers, pipelines: HashMap::new(), clock })
    }

    /// The adapter that runs.
    #[must_use]
    pub fn adapter(&self) -> &AdapterReport {
        &self.context.adapter
    }

    /// Put another scene and view in place of those that probes see.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn show(&mut self, scene: &FlatScene, view: &View) -> Result<(), GpuError> {
        self.scene = SceneBuffers::new(&self.context, scene)?;
        self.scene.set_view(&self.context, view);
        Ok(())
    }

    /// Which of the scene's triangles stands at each place of the adapter's.
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.scene.order
    }

    /// Run the entry point `entry` of the file `root` over records of `stride` words, in place.
    ///
    /// A rest of `records` shorter than `stride` is left alone.
    ///
    /// # Errors
    /// [`GpuError::Shader`], [`GpuError::NoF64`], [`GpuError::Refused`], [`GpuError::TooLarge`] for the records,
    /// [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn run(
        &mut self,
        (root, entry): (&str, &str),
        variant: &Variant,
        stride: usize,
        records: &mut [u32],
    ) -> Result<(), GpuError> {
        let loaded = self.load(stride, records)?;
        self.dispatch(&loaded, (root, entry), variant)?;
        self.read(&loaded, records)
    }

    /// Put records of `stride` words on the adapter, to be run there once or more.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn load(&self, stride: usize, records: &[u32]) -> Result<Records, GpuError> {
        let context = &self.context;
        let bytes = size_of_val(records) as u64;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let buffer = context.buffer("the records", HEAD + bytes.max(4), usage)?;
        context.queue.write_buffer(&buffer, HEAD, bytemuck::cast_slice(records));
        let stride = stride.max(1);
        Ok(Records {
            group: self.scene.bind(context, &buffer),
            buffer,
            stride: stride as u32,
            count: (records.len() / stride) as u32,
            bytes,
        })
    }

    /// Run an entry point over records, and tell how long the adapter took: by its own clock, or by the host's where it has
    /// none.
    ///
    /// # Errors
    /// [`GpuError::Shader`], [`GpuError::NoF64`], [`GpuError::Refused`], [`GpuError::DeviceLost`].
    pub fn dispatch(
        &mut self,
        records: &Records,
        entry: (&str, &str),
        variant: &Variant,
    ) -> Result<Duration, GpuError> {
        let compiled = self.pipeline(entry, variant)?;
        let context = &self.context;
        if let Some(clock) = &self.clock {
            clock.reset();
        }
        let Records { buffer, group, stride, count, .. } = records;
        let started = Instant::now();
        for first in (0..*count).step_by(DISPATCH as usize) {
            let end = (*count).min(first + DISPATCH);
            let head = [first, end, *stride, 0];
            context.queue.write_buffer(buffer, 0, bytemuck::cast_slice(&head));
            let mut encoder = context.encoder();
            {
                let timestamp_writes = match &self.clock {
                    Some(clock) => Some(clock.next_pass(context)?),
                    None => None,
                };
                let descriptor = wgpu::ComputePassDescriptor { label: Some("probe"), timestamp_writes };
                let mut pass = encoder.begin_compute_pass(&descriptor);
                pass.set_pipeline(&compiled.pipeline);
                pass.set_bind_group(0, group, &[]);
                pass.dispatch_workgroups((end - first).div_ceil(PROBE_GROUP), 1, 1);
            }
            context.submit(Some(encoder.finish()));
            context.wait()?;
        }
        match &self.clock {
            Some(clock) => clock.elapsed(context),
            None => Ok(started.elapsed()),
        }
    }

    /// Read records back.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn read(&self, from: &Records, records: &mut [u32]) -> Result<(), GpuError> {
        let mut at = 0;
        self.context.read(&from.buffer, HEAD..HEAD + from.bytes, size_of::<u32>() as u64, |bytes| {
            let words: &[u32] = bytemuck::cast_slice(bytes);
            records[at..at + words.len()].copy_from_slice(words);
            at += words.len();
        })
    }

    /// The pipeline of an entry point, compiled when it is first asked for.
    fn pipeline(&mut self, (root, entry): (&str, &str), variant: &Variant) -> Result<Compiled, GpuError> {
        let key = (root.to_owned(), entry.to_owned(), *variant);
        if let Some(compiled) = self.pipelines.get(&key) {
            return Ok(compiled.clone());
        }
        let layout = &self.scene.layout;
        let compiled = pipeline::compile(&self.context, layout, self.sources, (root, entry), variant)?;
        self.pipelines.insert(key, compiled.clone());
        Ok(compiled)
    }
}
