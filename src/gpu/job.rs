//! One picture in work: tile after tile into the film.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use super::GpuError;
use super::context::Context;
use super::film::FilmBuffer;
use super::pace::Pace;
use crate::film::{Frame, Progress, RayCounts};
use crate::layout::constants::BLOCK;
use crate::layout::{Aov, FilmHead, Texel, Tile};

/// Rounds of the loop that tells whether the driver ends loops early.
const CANARY_ROUNDS: u32 = 8;

/// The blocks of a crop, numbered row by row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blocks {
    columns: u32,
    rows: u32,
}

impl Blocks {
    /// The blocks of so many pixels.
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { columns: width.div_ceil(BLOCK), rows: height.div_ceil(BLOCK) }
    }

    pub(super) fn count(self) -> u32 {
        self.columns * self.rows
    }

    /// Clear the pixels of the blocks from `finished` on: their sums are not whole.
    pub(super) fn erase_from(self, finished: u32, frame: &mut Frame) {
        for (y, row) in (0..frame.height).zip(frame.texels.chunks_mut(frame.width.max(1) as usize)) {
            row[self.pixels_before(finished, y, frame.width)..].fill(Texel::default());
        }
        let aovs = frame.aovs.iter_mut().flat_map(|aovs| aovs.chunks_mut(frame.width.max(1) as usize));
        for (y, row) in (0..frame.height).zip(aovs) {
            row[self.pixels_before(finished, y, frame.width)..].fill(Aov::default());
        }
    }

    /// How many pixels at the left of row `y` belong to the first `finished` blocks.
    fn pixels_before(self, finished: u32, y: u32, width: u32) -> usize {
        let columns = finished.saturating_sub(y / BLOCK * self.columns).min(self.columns);
        (columns * BLOCK).min(width) as usize
    }
}

/// One picture in work.
pub(super) struct Job<'a> {
    pub(super) context: &'a Context,
    pub(super) pipeline: &'a wgpu::ComputePipeline,
    pub(super) film: &'a FilmBuffer,
    pub(super) group: wgpu::BindGroup,
}

impl Job<'_> {
    /// Trace what `pace` has left, until it is done or `progress` breaks off.
    pub(super) fn trace(&self, pace: &mut Pace, progress: &dyn Progress) -> Result<RayCounts, GpuError> {
        let mut rays = RayCounts::default();
        while let Some(tile) = pace.next() {
            let longest = self.trace_tile(tile, &mut rays)?;
            pace.took(longest);
            let (done, total) = pace.progress();
            if progress.advance(done, total) == ControlFlow::Break(()) {
                break;
            }
        }
        Ok(rays)
    }

    /// Trace one tile in as many submissions as its invocations need; returns what the longest one took.
    fn trace_tile(&self, tile: Tile, rays: &mut RayCounts) -> Result<Duration, GpuError> {
        let step_budget = self.context.adapter.step_budget();
        let (canary_rounds, canary_result) = (CANARY_ROUNDS, Tile::canary_result(CANARY_ROUNDS));
        let mut longest = Duration::ZERO;
        for resume in std::iter::once(0).chain(std::iter::repeat(1)) {
            let start = Instant::now();
            let head = self.submit(Tile { step_budget, resume, canary_rounds, canary_result, ..tile })?;
            longest = longest.max(start.elapsed());
            rays.primary += u64::from(head.primary);
            rays.reflection += u64::from(head.reflection);
            rays.refraction += u64::from(head.refraction);
            rays.shadow += u64::from(head.shadow);
            if head.cut_short > 0 {
                return Err(GpuError::LoopLimit { adapter: self.context.adapter.name.clone() });
            }
            if head.paused == 0 {
                break;
            }
        }
        Ok(longest)
    }

    /// Trace one tile, wait for it, and see that all of it ran.
    pub(super) fn submit(&self, tile: Tile) -> Result<FilmHead, GpuError> {
        self.film.set_tile(self.context, tile);
        let mut encoder = self.context.encoder();
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(self.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.dispatch_workgroups(tile.block_count, 1, 1);
        }
        self.film.take_head(&mut encoder);
        self.context.queue.submit([encoder.finish()]);
        let head = self.film.head(self.context)?;
        let expected = tile.block_count * BLOCK * BLOCK;
        if head.done != expected {
            return Err(GpuError::TileLost { first_block: tile.first_block, expected, done: head.done });
        }
        Ok(head)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_blocks_survive_a_stop() {
        let blocks = Blocks::new(20, 10);
        assert_eq!(blocks.count(), 6);
        let grey = Texel { dropped: 1.0, ..Texel::default() };
        let mut frame = Frame {
            width: 20,
            height: 10,
            texels: vec![grey; 200],
            aovs: Some(vec![Aov { depth: 1.0, ..Aov::default() }; 200]),
            float: crate::layout::Float::Strict,
            rays: RayCounts::default(),
            times: crate::film::TraceTimes::default(),
            complete: false,
        };
        blocks.erase_from(4, &mut frame);
        let kept: Vec<usize> =
            frame.texels.chunks(20).map(|row| row.iter().filter(|texel| **texel == grey).count()).collect();
        assert_eq!(kept, [20, 20, 20, 20, 20, 20, 20, 20, 8, 8]);
        let aovs = frame.aovs.unwrap_or_default();
        assert_eq!(aovs.iter().filter(|aov| aov.depth == 1.0).count(), 8 * 20 + 2 * 8);
    }
}
