//! What dispatches take by the device's own clock: timestamp queries around each.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::GpuError;
use super::context::Context;

/// Passes that are noted before their times are brought out: 16 KiB of them.
const PASSES: u32 = 1024;
/// Bytes of a timestamp.
const STAMP: u64 = wgpu::QUERY_SIZE as u64;

/// Timestamps at both ends of each pass.
pub(super) struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    staging: wgpu::Buffer,
    /// Nanoseconds of a tick.
    tick: f64,
    noted: Mutex<Noted>,
}

/// What the clock has measured since it was set to zero.
#[derive(Debug, Clone, Copy, Default)]
struct Noted {
    /// Passes whose times are still on the device.
    passes: u32,
    /// Ticks of those before.
    ticks: u64,
}

impl Clock {
    /// A clock at zero; none where the adapter has no timestamps.
    pub(super) fn new(context: &Context) -> Result<Option<Self>, GpuError> {
        if !context.adapter.timestamps {
            return Ok(None);
        }
        let size = 2 * u64::from(PASSES) * STAMP;
        let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let queries = context.device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("clock"),
            ty: wgpu::QueryType::Timestamp,
            count: 2 * PASSES,
        });
        Ok(Some(Self {
            queries,
            resolved: context.buffer("timestamps", size, usage)?,
            staging: context.staging(size)?,
            tick: f64::from(context.queue.get_timestamp_period()),
            noted: Mutex::default(),
        }))
    }

    /// Set it to zero.
    pub(super) fn reset(&self) {
        *self.noted.lock().unwrap_or_else(PoisonError::into_inner) = Noted::default();
    }

    /// Where the next pass notes its beginning and end.
    pub(super) fn next_pass(
        &self,
        context: &Context,
    ) -> Result<wgpu::ComputePassTimestampWrites<'_>, GpuError> {
        let mut noted = self.noted.lock().unwrap_or_else(PoisonError::into_inner);
        if noted.passes == PASSES {
            self.settle(context, &mut noted)?;
        }
        let first = 2 * noted.passes;
        noted.passes += 1;
        Ok(wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        })
    }

    /// What all passes took since it was set to zero.
    pub(super) fn elapsed(&self, context: &Context) -> Result<Duration, GpuError> {
        let mut noted = self.noted.lock().unwrap_or_else(PoisonError::into_inner);
        self.settle(context, &mut noted)?;
        Ok(Duration::from_nanos((noted.ticks as f64 * self.tick) as u64))
    }

    /// Bring out the times of the passes noted last.
    fn settle(&self, context: &Context, noted: &mut Noted) -> Result<(), GpuError> {
        if noted.passes == 0 {
            return Ok(());
        }
        let size = 2 * u64::from(noted.passes) * STAMP;
        let mut encoder = context.encoder();
        encoder.resolve_query_set(&self.queries, 0..2 * noted.passes, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.staging, 0, size);
        context.submit(Some(encoder.finish()));
        noted.ticks += context.map(&self.staging, size, ticks_between)?;
        noted.passes = 0;
        Ok(())
    }
}

/// The sum of the passes' ticks, of a beginning and an end each. A clock that ran backwards counts nothing.
fn ticks_between(stamps: &[u8]) -> u64 {
    let stamp = |bytes: &[u8]| bytes.iter().rev().fold(0_u64, |sum, &byte| sum << 8 | u64::from(byte));
    let passes = stamps.chunks_exact(2 * STAMP as usize).map(|pass| pass.split_at(STAMP as usize));
    passes.map(|(begin, end)| stamp(end).saturating_sub(stamp(begin))).sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::testing::{Subject, on_each};
    use super::*;
    use crate::film::Renderer;

    #[test]
    fn ticks_are_those_between_both_ends_of_each_pass() {
        let stamps = [1000_u64, 1300, 5000, 5001, 90, 80].map(u64::to_le_bytes).concat();
        assert_eq!(ticks_between(&stamps), 301);
    }

    #[test]
    fn the_passes_of_a_picture_take_a_part_of_its_time() {
        let subject = Subject::new("opaque.toml", [64, 48], 1);
        on_each(|options| {
            let mut renderer = subject.renderer(options);
            assert_eq!(renderer.device_time().unwrap(), None);
            renderer.start_clock().unwrap();
            for _ in 0..2 {
                let host = renderer.render(&subject.view, &subject.settings, &()).unwrap().times.trace;
                if let Some(device) = renderer.device_time().unwrap() {
                    assert!(!device.is_zero() && device <= host, "{device:?} of {host:?}");
                }
            }
        });
    }
}
