//! One picture in work: band after band of it in the film, each tile after tile.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::GpuError;
use super::blocks::Blocks;
use super::clock::Clock;
use super::context::Context;
use super::film::{FilmBuffer, Pixels};
use super::pace::Pace;
use crate::film::{Frame, Progress, RayCounts};
use crate::layout::constants::BLOCK;
use crate::layout::{FilmHead, Tile};

/// Rounds of the loop that tells whether the driver ends loops early.
const CANARY_ROUNDS: u32 = 8;

/// One picture in work.
pub(super) struct Job<'a> {
    pub(super) context: &'a Context,
    /// Measures its passes, where the renderer was asked to.
    pub(super) clock: Option<&'a Clock>,
    pub(super) pipeline: wgpu::ComputePipeline,
    /// Holds `band_height` rows.
    pub(super) film: Arc<FilmBuffer>,
    pub(super) group: wgpu::BindGroup,
    pub(super) blocks: Blocks,
    pub(super) band_height: u32,
    /// Bytes before the recorded tree in the film.
    pub(super) tree_at: u64,
}

impl Job<'_> {
    /// Trace what `pace` has left into `frame`, until it is done or `progress` breaks off.
    pub(super) fn trace(
        &self,
        pace: &mut Pace,
        progress: &dyn Progress,
        frame: &mut Frame,
    ) -> Result<(), GpuError> {
        let mut read = Pixels::default();
        for first_row in (0..self.blocks.height).step_by(self.band_height as usize) {
            let end_row = self.blocks.height.min(first_row + self.band_height);
            let start = Instant::now();
            let pixels = u64::from(self.blocks.width) * u64::from(end_row - first_row);
            let flow = self.trace_band(first_row, end_row, pace, progress, &mut frame.rays)?;
            let traced = Instant::now();
            self.film.read(self.context, pixels, &mut read)?;
            frame.times.trace += traced - start;
            frame.times.readback += traced.elapsed();
            if flow == ControlFlow::Break(()) {
                break;
            }
        }
        frame.texels = read.texels;
        if let Some(aovs) = &mut frame.aovs {
            *aovs = read.aovs;
        }
        Ok(())
    }

    /// Trace the rows from `first_row` to `end_row` into the film.
    fn trace_band(
        &self,
        first_row: u32,
        end_row: u32,
        pace: &mut Pace,
        progress: &dyn Progress,
        rays: &mut RayCounts,
    ) -> Result<ControlFlow<()>, GpuError> {
        while let Some(tile) = pace.next(self.blocks.before_row(end_row)) {
            let longest = self.trace_tile(Tile { first_row, ..tile }, rays)?;
            pace.took(longest);
            let (done, total) = pace.progress();
            if progress.advance(done, total) == ControlFlow::Break(()) {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Trace one tile in as many submissions as its invocations need; returns what the longest one took.
    pub(super) fn trace_tile(&self, tile: Tile, rays: &mut RayCounts) -> Result<Duration, GpuError> {
        let mut longest = Duration::ZERO;
        let mut resume = 0;
        loop {
            let start = Instant::now();
            let head = self.submit(Tile { resume, ..tile })?;
            longest = longest.max(start.elapsed());
            rays.add([head.primary, head.reflection, head.refraction, head.shadow].map(u64::from));
            if head.paused == 0 {
                return Ok(longest);
            }
            resume = 1;
        }
    }

    /// Trace a tile until its invocations are done or rest.
    pub(super) fn submit(&self, tile: Tile) -> Result<FilmHead, GpuError> {
        let tile = Tile {
            step_budget: self.context.step_budget,
            canary_rounds: CANARY_ROUNDS,
            canary_result: Tile::canary_result(CANARY_ROUNDS),
            ..tile
        };
        self.run(&self.pipeline, FilmHead { tile, ..FilmHead::default() })
    }

    /// Run an entry point on the head's blocks, and see that all invocations ran and no loop was cut short.
    pub(super) fn run(&self, pipeline: &wgpu::ComputePipeline, head: FilmHead) -> Result<FilmHead, GpuError> {
        let tile = head.tile;
        self.film.set_head(self.context, head);
        let timestamp_writes = self.clock.map(|clock| clock.next_pass(self.context)).transpose()?;
        let mut encoder = self.context.encoder();
        {
            let mut pass =
                encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: None, timestamp_writes });
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.dispatch_workgroups(tile.block_count, 1, 1);
        }
        self.film.take_head(&mut encoder);
        self.context.submit(Some(encoder.finish()));
        let head = self.film.head(self.context)?;
        let expected = tile.block_count * BLOCK * BLOCK;
        if head.done != expected {
            return Err(GpuError::TileLost { first_block: tile.first_block, expected, done: head.done });
        }
        if head.cut_short > 0 {
            return Err(GpuError::LoopLimit { adapter: self.context.adapter.name.clone() });
        }
        Ok(head)
    }
}
