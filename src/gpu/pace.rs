//! How much work goes into one submission: as much as the adapter does in a small part of a second.
//!
//! Work is counted in units of one sample of one block. An operating system resets a device that is busy for
//! seconds, and a desktop stutters well before; submissions of 25 ms cost a fraction of a percent in waiting.

use std::time::Duration;

use super::AdapterKind;
use crate::layout::Tile;

/// What a submission is meant to take where nobody waits for it; work ahead can be twice as hard as that behind.
pub(super) const SUBMISSION: Duration = Duration::from_millis(25);
/// Greatest growth from one submission to the next: rays may meet a harder part of the picture.
const GROWTH: f64 = 2.0;
/// Blocks that a graphics card traces side by side, at the least.
const CARD_WIDTH: u32 = 32;

/// Cuts a picture into tiles, one submission after the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    blocks: u32,
    samples: u32,
    /// Most blocks of one dispatch.
    most_blocks: u32,
    /// Blocks that the adapter traces side by side: fewer take as long.
    width: u32,
    /// The tile that was submitted last, or one before the first.
    last: Tile,
    /// What a submission is meant to take.
    target: Duration,
    /// Units that fit one submission.
    units: f64,
}

impl Pace {
    /// A picture of so many blocks and samples per pixel, at most so many blocks at once, on that kind of adapter.
    pub(super) fn new(blocks: u32, samples: u32, most_blocks: u32, kind: AdapterKind) -> Self {
        let width = if kind.is_real() {
            CARD_WIDTH
        } else {
            std::thread::available_parallelism().map_or(1, |threads| threads.get() as u32)
        };
        Self::with_width(blocks, samples, most_blocks, width)
    }

    fn with_width(blocks: u32, samples: u32, most_blocks: u32, width: u32) -> Self {
        let last = Tile { sample_count: samples, ..Tile::default() };
        let (target, units) = (SUBMISSION, f64::from(width));
        Self { blocks, samples, most_blocks, width: width.min(most_blocks), last, target, units }
    }

    /// The same with submissions of that length.
    pub(super) fn aiming_at(self, target: Duration) -> Self {
        let units = self.units * target.as_secs_f64() / self.target.as_secs_f64();
        Self { target, units: units.max(f64::from(self.width)), ..self }
    }

    /// Another part of the same picture: so many blocks, at what the adapter does by now.
    pub(super) fn again(&self, blocks: u32, samples: u32) -> Self {
        Self { blocks, samples, ..*self }.from(0)
    }

    /// The same from that block on.
    pub(super) fn from(self, first_block: u32) -> Self {
        let last = Tile { first_block, sample_count: self.samples, ..Tile::default() };
        Self { last, ..self }
    }

    /// The next tile to submit, of the blocks before `end`; none when those are done.
    pub(super) fn next(&mut self, end: u32) -> Option<Tile> {
        let first_sample = self.last.first_sample + self.last.sample_count;
        if first_sample < self.samples {
            let sample_count = self.fitting_samples(self.last.block_count, first_sample);
            self.last = Tile { first_sample, sample_count, ..self.last };
            return Some(self.last);
        }
        let first_block = self.last.first_block + self.last.block_count;
        if first_block >= end {
            return None;
        }
        let block_count = self.fitting_blocks().min(end - first_block);
        let sample_count = self.fitting_samples(block_count, 0);
        self.last = Tile { first_block, block_count, sample_count, ..Tile::default() };
        Some(self.last)
    }

    /// Learn from what the last tile took.
    pub(super) fn took(&mut self, elapsed: Duration) {
        let units = f64::from(self.last.block_count) * f64::from(self.last.sample_count);
        let fitting = units * self.target.as_secs_f64() / elapsed.as_secs_f64().max(1e-6);
        self.units = fitting.min(units * GROWTH).max(f64::from(self.width));
    }

    /// Units done, and all of them.
    pub(super) fn progress(&self) -> (u64, u64) {
        let Tile { first_block, block_count, first_sample, sample_count, .. } = self.last;
        let done = u64::from(first_block) * u64::from(self.samples)
            + u64::from(block_count) * u64::from(first_sample + sample_count);
        (done, u64::from(self.blocks) * u64::from(self.samples))
    }

    /// Blocks whose samples are all traced.
    pub(super) fn finished_blocks(&self) -> u32 {
        let Tile { first_block, block_count, first_sample, sample_count, .. } = self.last;
        if first_sample + sample_count == self.samples { first_block + block_count } else { first_block }
    }

    /// Blocks of the next tile: with all their samples if enough of them fit, else as few as keep the adapter busy.
    fn fitting_blocks(&self) -> u32 {
        ((self.units / f64::from(self.samples)) as u32).clamp(self.width, self.most_blocks)
    }

    /// Samples of the next tile of so many blocks.
    fn fitting_samples(&self, blocks: u32, first: u32) -> u32 {
        let fitting = self.units / f64::from(blocks.max(1));
        (fitting as u32).clamp(1, self.samples - first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: u32 = 4;

    /// What a tile takes on an adapter that traces four blocks side by side, each sample in so long.
    fn time(tile: Tile, unit: Duration) -> Duration {
        unit * tile.block_count.div_ceil(WIDTH) * tile.sample_count
    }

    /// The tiles of a picture in two bands.
    fn tiles(blocks: u32, samples: u32, unit: Duration) -> Vec<Tile> {
        let mut pace = Pace::with_width(blocks, samples, 4096, WIDTH);
        let mut tiles = Vec::new();
        for end in [blocks / 3, blocks] {
            while let Some(tile) = pace.next(end) {
                assert!(tile.first_block + tile.block_count <= end);
                tiles.push(tile);
                pace.took(time(tile, unit));
            }
            assert_eq!(pace.finished_blocks(), end);
        }
        assert_eq!(pace.progress().0, pace.progress().1);
        tiles
    }

    #[test]
    fn every_sample_of_every_block_is_traced_once_and_in_order() {
        for (blocks, samples, micros) in
            [(1, 1, 10), (4800, 4, 1), (300, 7, 400), (40, 64, 30_000), (70_000, 1, 0)]
        {
            let mut next = vec![0; blocks as usize];
            for tile in tiles(blocks, samples, Duration::from_micros(micros)) {
                for block in tile.first_block..tile.first_block + tile.block_count {
                    assert_eq!(next[block as usize], tile.first_sample);
                    next[block as usize] += tile.sample_count;
                }
            }
            assert!(next.iter().all(|&done| done == samples));
        }
    }

    #[test]
    fn submissions_stay_under_fifty_milliseconds_at_any_speed() {
        for micros in [1, 20, 300, 4000, 30_000] {
            let unit = Duration::from_micros(micros);
            let longest = tiles(4800, 16, unit).into_iter().map(|tile| time(tile, unit)).max();
            assert!(longest <= Some(Duration::from_millis(50)), "{micros} µs a unit: {longest:?}");
        }
    }

    #[test]
    fn a_slow_adapter_is_kept_busy() {
        let tiles = tiles(96, 4, Duration::from_millis(40));
        assert!(tiles.iter().all(|tile| tile.block_count == WIDTH && tile.sample_count == 1), "{tiles:?}");
    }

    #[test]
    fn a_fast_adapter_gets_few_submissions() {
        assert!(tiles(4800, 4, Duration::from_nanos(100)).len() < 20);
    }

    #[test]
    fn an_empty_picture_has_no_tiles() {
        assert!(tiles(0, 4, Duration::ZERO).is_empty());
    }
}
