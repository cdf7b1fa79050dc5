//! A device that renderers and a window have in common.

use super::adapters::choose_for;
use super::context::Context;
use super::{AdapterReport, GpuError, GpuOptions};

/// A device that renderers and a window have in common: what one of them traces the other shows, without a way round
/// through the host. A clone is the same device.
#[derive(Clone)]
pub struct SharedDevice {
    pub(super) context: Context,
}

impl SharedDevice {
    /// Open the adapter that the options ask for.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::Refused`].
    pub fn new(options: &GpuOptions) -> Result<Self, GpuError> {
        Ok(Self { context: Context::new(options)? })
    }

    /// Open the adapter that the options ask for, among those that can show pictures on a window's surface, and tell what
    /// it can do there.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::Refused`].
    pub fn for_surface(
        instance: &wgpu::Instance,
        surface: &wgpu::Surface<'_>,
        options: &GpuOptions,
    ) -> Result<(Self, wgpu::SurfaceCapabilities), GpuError> {
        let adapter = choose_for(instance, surface, options.adapter.as_deref())?;
        let capabilities = surface.get_capabilities(&adapter);
        Ok((Self { context: Context::open(&adapter, options)? }, capabilities))
    }

    /// What the adapter is and can do.
    #[must_use]
    pub fn adapter(&self) -> &AdapterReport {
        &self.context.adapter
    }

    /// The device itself.
    #[must_use]
    pub fn device(&self) -> &wgpu::Device {
        &self.context.device
    }

    /// Its only queue, to write buffers; [`submit`](Self::submit) is for commands.
    #[must_use]
    pub fn queue(&self) -> &wgpu::Queue {
        &self.context.queue
    }

    /// Have the device do these commands after all that was submitted before, by whomever.
    pub fn submit(&self, commands: wgpu::CommandBuffer) -> wgpu::SubmissionIndex {
        self.context.submit(Some(commands))
    }

    /// Make a surface's pictures anew, while nobody submits.
    pub fn configure(&self, surface: &wgpu::Surface<'_>, config: &wgpu::SurfaceConfiguration) {
        self.context.configure(surface, config);
    }

    /// Wait until a submission is done.
    ///
    /// # Errors
    /// [`GpuError::DeviceLost`], [`GpuError::Refused`].
    pub fn wait_for(&self, submission: &wgpu::SubmissionIndex) -> Result<(), GpuError> {
        self.context.wait_for(Some(submission.clone()))
    }

    /// What the driver reported since somebody asked last.
    ///
    /// # Errors
    /// [`GpuError::DeviceLost`], [`GpuError::Refused`].
    pub fn check(&self) -> Result<(), GpuError> {
        self.context.check()
    }

    /// Copy records of so many bytes out of a buffer to the host, once all that was submitted is done.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`], [`GpuError::Refused`].
    pub fn read(&self, buffer: &wgpu::Buffer, record: u64) -> Result<Vec<u8>, GpuError> {
        let mut bytes = Vec::new();
        self.context.read(buffer, 0..buffer.size(), record, |part| bytes.extend_from_slice(part))?;
        Ok(bytes)
    }
}
