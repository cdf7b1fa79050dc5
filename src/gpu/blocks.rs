//! A picture as blocks of pixels, numbered row by row.

use crate::film::Frame;
use crate::layout::constants::BLOCK;

/// The blocks of a crop; those at its right and lower edges may be cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blocks {
    /// Pixels in a row.
    pub(super) width: u32,
    /// Rows of pixels.
    pub(super) height: u32,
    columns: u32,
}

impl Blocks {
    /// The blocks of so many pixels.
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { width, height, columns: width.div_ceil(BLOCK) }
    }

    pub(super) fn count(self) -> u32 {
        self.before_row(self.height)
    }

    /// How many blocks lie above row `y`, which is the first or the last of a row of blocks.
    pub(super) fn before_row(self, y: u32) -> u32 {
        self.columns * y.div_ceil(BLOCK)
    }

    /// Rows of a band of whole blocks with at most so many pixels; one row of blocks at the least, all rows at the most.
    pub(super) fn band_height(self, pixels: u64) -> u32 {
        let block_rows = pixels / (u64::from(self.width.max(1)) * u64::from(BLOCK));
        let rows = block_rows.max(1) * u64::from(BLOCK);
        rows.min(u64::from(self.height.max(1))) as u32
    }

    /// Clear the pixels of the blocks from `finished` on: their sums are not whole, or were never begun.
    pub(super) fn erase_from(self, finished: u32, frame: &mut Frame) {
        self.erase(finished, &mut frame.texels);
        if let Some(aovs) = &mut frame.aovs {
            self.erase(finished, aovs);
        }
    }

    fn erase<T: Clone + Default>(self, finished: u32, pixels: &mut Vec<T>) {
        pixels.resize(self.width as usize * self.height as usize, T::default());
        for (y, row) in (0..self.height).zip(pixels.chunks_mut(self.width.max(1) as usize)) {
            row[self.pixels_before(finished, y)..].fill(T::default());
        }
    }

    /// How many pixels at the left of row `y` belong to the first `finished` blocks.
    fn pixels_before(self, finished: u32, y: u32) -> usize {
        let columns = finished.saturating_sub(y / BLOCK * self.columns).min(self.columns);
        (columns * BLOCK).min(self.width) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{RayCounts, SampleCounts, TraceTimes};
    use crate::layout::{Aov, Float, Texel};

    #[test]
    fn only_whole_blocks_survive_a_stop() {
        let blocks = Blocks::new(20, 10);
        assert_eq!(blocks.count(), 6);
        let grey = Texel { dropped: 1.0, ..Texel::default() };
        // The last row was never read.
        let mut frame = Frame {
            width: 20,
            height: 10,
            texels: vec![grey; 180],
            samples: SampleCounts::Same(1),
            aovs: Some(vec![Aov { depth: 1.0, ..Aov::default() }; 180]),
            float: Float::Strict,
            rays: RayCounts::default(),
            times: TraceTimes::default(),
            complete: false,
        };
        blocks.erase_from(4, &mut frame);
        let kept: Vec<usize> =
            frame.texels.chunks(20).map(|row| row.iter().filter(|texel| **texel == grey).count()).collect();
        assert_eq!(kept, [20, 20, 20, 20, 20, 20, 20, 20, 8, 0]);
        let aovs = frame.aovs.unwrap_or_default();
        assert_eq!(aovs.iter().filter(|aov| aov.depth == 1.0).count(), 8 * 20 + 8);
    }

    #[test]
    fn bands_are_whole_rows_of_blocks() {
        let blocks = Blocks::new(20, 100);
        let heights = [0, 20 * 8, 20 * 24 - 1, 20 * 24, 1 << 40].map(|pixels| blocks.band_height(pixels));
        assert_eq!(heights, [8, 8, 16, 24, 100]);
        assert_eq!(Blocks::new(0, 0).band_height(0), 1);
        assert_eq!([0, 8, 16, 100].map(|y| blocks.before_row(y)), [0, 3, 6, 39]);
    }
}
