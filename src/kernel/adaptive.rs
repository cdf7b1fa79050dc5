//! Adaptive antialiasing: where more samples are worth their rays. Twin of `shaders/adaptive.wgsl`.
//!
//! Of n samples with standard deviation σ, one more moves the mean by about σ/n, and lowers its squared error σ²/n by
//! about σ²/n². Going on while σ/n ≥ T therefore spends each sample where it lowers the error of the picture most: n
//! comes out proportional to σ, as in the optimal allocation of Neyman (1934, "On the two different aspects of the
//! representative method", J. R. Stat. Soc. 97(4)). A bound on the standard error σ/√n instead would make n proportional
//! to σ² and drown the noisiest pixels in samples.
//!
//! σ is measured on values for a display, [`display`], so that T is a step that an eye sees alike in light and dark. A
//! few samples tell little of σ, so a pixel's neighbours vote with it (Whitted 1980: a square whose corners differ is
//! divided): in round 0 the samples of the 3×3 pixels are taken for its own, later their mean variance. Edges of the
//! bodies that rays from the eye meet first are refined once in any case.
//!
//! Sums are of f32 in every precision, as all of the film.

use crate::layout::constants::{BASE_SAMPLES, SEVERAL};
use crate::layout::{Statistics, Tile};

/// What a pixel's 3×3 neighbourhood knows, itself included.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surroundings {
    /// All samples as if they were one pixel's.
    pub pooled: Statistics,
    /// Mean of the pixels' variances.
    pub variance: f32,
}

/// Linear radiance as a display's value in [0, 1]: gamma 2, which is sRGB's curve to a few hundredths and exact on every
/// device.
pub fn display(radiance: [f32; 3]) -> [f32; 3] {
    radiance.map(|x| {
        let x = if x > 0.0 { x } else { 0.0 };
        let x = if x < 1.0 { x } else { 1.0 };
        x.sqrt()
    })
}

/// Enter a sample of this radiance, whose ray met this body first.
pub fn tally(statistics: &mut Statistics, radiance: [f32; 3], body: u32) {
    let sum = display(radiance);
    let squares = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
    let one = Statistics { sum, squares, samples: 1, body, ..Statistics::default() };
    *statistics = pool(statistics, &one);
}

/// The samples of both as if they were one pixel's; the rest is the first one's.
pub fn pool(a: &Statistics, b: &Statistics) -> Statistics {
    let mut both = *a;
    both.sum = [a.sum[0] + b.sum[0], a.sum[1] + b.sum[1], a.sum[2] + b.sum[2]];
    both.squares = a.squares + b.squares;
    both.samples = a.samples + b.samples;
    if a.samples == 0 {
        both.body = b.body;
    } else if b.samples != 0 && a.body != b.body {
        both.body = SEVERAL;
    }
    both
}

/// Variance of one sample, the mean over the channels; 0 for fewer than two.
pub fn variance(statistics: &Statistics) -> f32 {
    if statistics.samples < 2 {
        return 0.0;
    }
    let n = statistics.samples as i32 as f32;
    let [r, g, b] = statistics.sum;
    let spread = statistics.squares - (r * r + g * g + b * b) / n;
    // Rounding may leave less than nothing.
    if spread > 0.0 { spread / ((n - 1.0) * 3.0) } else { 0.0 }
}

/// What a pixel's neighbours in the film know, row by row.
pub fn surroundings(film: &[Statistics], [width, height]: [u32; 2], [x, y]: [u32; 2]) -> Surroundings {
    let mut found = Surroundings::default();
    let mut count = 0;
    for row in y.saturating_sub(1)..height.min(y + 2) {
        for column in x.saturating_sub(1)..width.min(x + 2) {
            let one = &film[(row * width + column) as usize];
            found.pooled = pool(&found.pooled, one);
            found.variance += variance(one);
            count += 1;
        }
    }
    found.variance /= count as f32;
    found
}

/// Whether a pixel is to be refined in the tile's round, if it may have `limit` samples.
pub fn wants_more(here: &Statistics, around: &Surroundings, tile: &Tile, limit: u32) -> bool {
    if here.samples >= limit {
        return false;
    }
    let mut expected = variance(here);
    expected = if around.variance > expected { around.variance } else { expected };
    if tile.round == 0 {
        if around.pooled.body == SEVERAL {
            return true;
        }
        let pooled = variance(&around.pooled);
        expected = if pooled > expected { pooled } else { expected };
    }
    expected.sqrt() >= tile.threshold * here.samples as i32 as f32
}

/// Samples that a pixel has at the end of a round in which it is traced, if it may have `limit`: as many again.
pub fn round_end(start: u32, limit: u32) -> u32 {
    let end = if start == 0 { BASE_SAMPLES } else { start + start };
    if end < limit { end } else { limit }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::constants::NONE;

    fn of(samples: &[(f32, u32)]) -> Statistics {
        let mut statistics = Statistics::default();
        for &(grey, body) in samples {
            tally(&mut statistics, [grey; 3], body);
        }
        statistics
    }

    fn wants(here: &Statistics, film: &[Statistics; 9], round: u32, threshold: f32) -> bool {
        let mut film = *film;
        film[4] = *here;
        let tile = Tile { round, threshold, ..Tile::default() };
        wants_more(here, &surroundings(&film, [3, 3], [1, 1]), &tile, 64)
    }

    #[test]
    fn variance_is_that_of_display_values() {
        // Display values 0.5 and 1: variance 1/8 about 0.75.
        assert_eq!(variance(&of(&[(0.25, 1), (1.0, 1)])), 0.125);
        assert_eq!(variance(&of(&[(0.25, 1), (900.0, 1)])), 0.125);
        assert_eq!(variance(&of(&[(0.3, 1); 7])), 0.0);
    }

    #[test]
    fn a_pixel_stops_when_one_more_sample_hardly_moves_it() {
        let here = of(&[(0.25, 1), (1.0, 1)]);
        let alone = [here; 9];
        // σ/n = √(1/8)/2 = 0.177.
        assert!(wants(&here, &alone, 1, 0.17) && !wants(&here, &alone, 1, 0.18));
    }

    #[test]
    fn noisy_neighbours_count() {
        let (calm, noisy) = (of(&[(0.25, 1); 2]), of(&[(0.0, 1), (1.0, 1)]));
        let mut film = [calm; 9];
        assert!(!wants(&calm, &film, 1, 0.01));
        film[8] = noisy;
        assert!(wants(&calm, &film, 1, 0.01));
    }

    #[test]
    fn an_edge_between_pixels_is_seen_in_round_0_by_colour_or_by_body() {
        let (dark, bright) = (of(&[(0.0, 1); 2]), of(&[(1.0, 1); 2]));
        let other = of(&[(0.0, NONE); 2]);
        for neighbour in [bright, other] {
            let mut film = [dark; 9];
            film[3] = neighbour;
            assert!(wants(&dark, &film, 0, 0.1), "{neighbour:?}");
            assert!(!wants(&dark, &film, 1, 0.1), "{neighbour:?}");
        }
    }

    #[test]
    fn a_threshold_of_0_refines_everything() {
        let calm = of(&[(0.25, 1); 2]);
        assert!(wants(&calm, &[calm; 9], 3, 0.0));
    }

    #[test]
    fn samples_double_up_to_the_limit() {
        assert_eq!([0, 2, 4, 8].map(|start| round_end(start, 12)), [2, 4, 8, 12]);
        let full = of(&[(0.0, 1), (1.0, 2)]);
        let tile = Tile::default();
        assert!(!wants_more(&full, &surroundings(&[full], [1, 1], [0, 0]), &tile, 2));
    }
}
