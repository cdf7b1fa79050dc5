//! The connection to one adapter, with every complaint of the driver turned into an error.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError, RwLock};
use std::time::Duration;

use super::adapters::{AdapterReport, choose, instance};
use super::cache::PipelineCache;
use super::pipeline::STORAGE_BUFFERS;
use super::{GpuError, GpuOptions, quiet};

/// How long one submission may take before the device counts as lost: a thousand times what it is meant to.
const PATIENCE: Duration = Duration::from_secs(60);

/// Bytes that one submission moves between the host and the device.
const TRANSFER: u64 = 32 << 20;

/// A device, its queue, and what went wrong there. A clone is the same device.
#[derive(Clone)]
pub(super) struct Context {
    pub(super) adapter: AdapterReport,
    /// [`Tile::step_budget`](crate::layout::Tile) of its submissions.
    pub(super) step_budget: u32,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) pipeline_cache: Arc<PipelineCache>,
    faults: Arc<Mutex<Option<Fault>>>,
    /// Read by whoever submits, written while a surface is configured.
    gate: Arc<RwLock<()>>,
}

/// What a driver reported behind the program's back.
#[derive(Debug)]
enum Fault {
    Lost(String),
    Error(String),
}

impl Context {
    /// Open the adapter that the options ask for.
    pub(super) fn new(options: &GpuOptions) -> Result<Self, GpuError> {
        Self::open(&choose(&instance(), options.adapter.as_deref())?, options)
    }

    /// Open this adapter.
    pub(super) fn open(adapter: &wgpu::Adapter, options: &GpuOptions) -> Result<Self, GpuError> {
        let report = AdapterReport::new(adapter);
        if report.max_storage_buffers < STORAGE_BUFFERS {
            let reason = format!("a shader sees {} storage buffers there", report.max_storage_buffers);
            return Err(report.refused("eight storage buffers", reason));
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("snellius"),
            required_features: adapter.features()
                & (wgpu::Features::PASSTHROUGH_SHADERS
                    | wgpu::Features::SHADER_F64
                    | wgpu::Features::PIPELINE_CACHE
                    | wgpu::Features::TIMESTAMP_QUERY),
            required_limits: limits(&report),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| report.refused("a device", error.to_string()))?;
        let faults = Arc::default();
        listen(&device, &faults);
        let cache = PipelineCache::open(&device, &adapter.get_info(), options.pipeline_cache.as_deref());
        Ok(Self {
            step_budget: report.step_budget(),
            adapter: report,
            device,
            queue,
            pipeline_cache: Arc::new(cache),
            faults,
            gate: Arc::default(),
        })
    }

    /// What the driver reported since the last time.
    pub(super) fn check(&self) -> Result<(), GpuError> {
        match self.faults.lock().unwrap_or_else(PoisonError::into_inner).take() {
            None => Ok(()),
            Some(Fault::Lost(reason)) if reason.is_empty() => {
                Err(GpuError::DeviceLost { reason: "the driver does not say why".into() })
            }
            Some(Fault::Lost(reason)) => Err(GpuError::DeviceLost { reason }),
            Some(Fault::Error(reason)) => Err(self.adapter.refused("a command", reason)),
        }
    }

    /// Have the device do these commands after all that was submitted before.
    pub(super) fn submit(&self, commands: Option<wgpu::CommandBuffer>) -> wgpu::SubmissionIndex {
        let _open = self.gate.read().unwrap_or_else(PoisonError::into_inner);
        self.queue.submit(commands)
    }

    /// Make a surface's pictures anew. wgpu waits until the device has nothing to do and fails where another thread submits
    /// something meanwhile (`GpuWaitTimeout`), so nobody may.
    pub(super) fn configure(&self, surface: &wgpu::Surface<'_>, config: &wgpu::SurfaceConfiguration) {
        let _closed = self.gate.write().unwrap_or_else(PoisonError::into_inner);
        surface.configure(&self.device, config);
    }

    /// Wait until all that was submitted is done.
    pub(super) fn wait(&self) -> Result<(), GpuError> {
        self.wait_for(None)
    }

    /// Wait until a submission is done, or all of them.
    pub(super) fn wait_for(&self, submission_index: Option<wgpu::SubmissionIndex>) -> Result<(), GpuError> {
        let wait = wgpu::PollType::Wait { submission_index, timeout: Some(PATIENCE) };
        // wgpu panics when a device is lost while it is waited for; the callback has the reason.
        let waited = quiet::catch(|| self.device.poll(wait));
        self.check()?;
        let lost = |reason: String| GpuError::DeviceLost { reason };
        match waited {
            Some(Ok(_)) => Ok(()),
            Some(Err(error)) => Err(lost(error.to_string())),
            None => Err(lost("the driver gave up while it was waited for".into())),
        }
    }

    /// Room for commands.
    pub(super) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    /// Bytes of the largest buffer that a shader sees whole.
    pub(super) fn largest_binding(&self) -> u64 {
        self.adapter.max_storage_binding.min(self.adapter.max_buffer)
    }

    /// Whether one buffer can hold that much and a shader see it.
    pub(super) fn check_size(&self, what: &'static str, needed: u64) -> Result<(), GpuError> {
        self.check_limit(what, needed, self.largest_binding())
    }

    /// Whether it is within a limit.
    pub(super) fn check_limit(&self, what: &'static str, needed: u64, limit: u64) -> Result<(), GpuError> {
        if needed <= limit {
            return Ok(());
        }
        Err(GpuError::TooLarge { what, needed, limit, adapter: self.adapter.name.clone() })
    }

    /// A buffer of zeros that is within the limits.
    pub(super) fn buffer(
        &self,
        what: &'static str,
        size: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, GpuError> {
        self.check_size(what, size)?;
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let descriptor = wgpu::BufferDescriptor { label: Some(what), size, usage, mapped_at_creation: false };
        let buffer = self.device.create_buffer(&descriptor);
        if pollster::block_on(scope.pop()).is_some() {
            return Err(GpuError::OutOfMemory { what, needed: size, adapter: self.adapter.name.clone() });
        }
        self.check()?;
        Ok(buffer)
    }

    /// Copy into a buffer from its start, in parts, so that the driver's copy of them stays small.
    pub(super) fn write(&self, buffer: &wgpu::Buffer, bytes: &[u8]) -> Result<(), GpuError> {
        for (part, offset) in bytes.chunks(TRANSFER as usize).zip((0..).step_by(TRANSFER as usize)) {
            self.queue.write_buffer(buffer, offset, part);
            self.submit(None);
            self.wait()?;
        }
        Ok(())
    }

    /// Copy records of so many bytes out of a buffer, in parts of whole records, each handed to `take`.
    pub(super) fn read(
        &self,
        buffer: &wgpu::Buffer,
        range: Range<u64>,
        record: u64,
        mut take: impl FnMut(&[u8]),
    ) -> Result<(), GpuError> {
        let part = (TRANSFER / record).max(1) * record;
        let staging = self.staging(part.min(range.end - range.start))?;
        let mut start = range.start;
        while start < range.end {
            let size = part.min(range.end - start);
            let mut encoder = self.encoder();
            encoder.copy_buffer_to_buffer(buffer, start, &staging, 0, size);
            self.submit(Some(encoder.finish()));
            self.map(&staging, size, &mut take)?;
            start += size;
        }
        Ok(())
    }

    /// A buffer for results on their way to the host.
    pub(super) fn staging(&self, size: u64) -> Result<wgpu::Buffer, GpuError> {
        self.buffer("results", size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST)
    }

    /// Wait for all that was submitted, and show the first bytes of a staging buffer to `take`.
    pub(super) fn map<T>(
        &self,
        staging: &wgpu::Buffer,
        size: u64,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let slice = staging.slice(..size);
        // A failure shows in `get_mapped_range` below.
        slice.map_async(wgpu::MapMode::Read, |_| ());
        self.wait()?;
        let view =
            slice.get_mapped_range().map_err(|error| self.adapter.refused("results", error.to_string()))?;
        let taken = take(&view);
        drop(view);
        staging.unmap();
        Ok(taken)
    }
}

/// What WebGPU promises, with buffers as large as the adapter's.
fn limits(adapter: &AdapterReport) -> wgpu::Limits {
    wgpu::Limits {
        max_storage_buffer_binding_size: adapter.max_storage_binding,
        max_buffer_size: adapter.max_buffer,
        ..wgpu::Limits::default()
    }
}

impl AdapterReport {
    /// The error of a driver that refuses what its limits and features allow.
    pub(super) fn refused(&self, what: &'static str, reason: String) -> GpuError {
        GpuError::Refused { adapter: self.name.clone(), what, reason: reason.trim().to_owned() }
    }
}

/// Keep the first fault that the driver reports, or that the device is lost.
fn listen(device: &wgpu::Device, faults: &Arc<Mutex<Option<Fault>>>) {
    let note = |faults: &Mutex<Option<Fault>>, fault| {
        let mut first = faults.lock().unwrap_or_else(PoisonError::into_inner);
        // That the device is gone explains what came before.
        if matches!((&*first, &fault), (None, _) | (Some(Fault::Error(_)), Fault::Lost(_))) {
            *first = Some(fault);
        }
    };
    let sink = Arc::clone(faults);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        note(&sink, Fault::Error(error.to_string()))
    }));
    let sink = Arc::clone(faults);
    device.set_device_lost_callback(move |_, message| note(&sink, Fault::Lost(message)));
}
