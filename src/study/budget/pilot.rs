//! What samples cost in accuracy: blocks of the picture's own pixels, with more and more samples.

use std::collections::HashMap;

use super::super::StudyError;
use super::super::metrics::Seen;
use super::Request;
use super::bisection::first;
use super::estimate::{figure, values};
use crate::cpu::CpuRenderer;
use crate::film::{Frame, Metric, Renderer};
use crate::flatten::view;
use crate::layout::constants::{BASE_SAMPLES, MAX_DEPTH};
use crate::layout::{Precision, Settings};

/// Side of a block in pixels.
const BLOCK: u32 = 16;
/// Blocks that are traced at most: by chance, one in each part of the picture.
const MOST_BLOCKS: u32 = 64;
/// Blocks that are traced at least; a picture of twice as many is traced whole.
const LEAST_BLOCKS: u32 = 16;
/// One pixel in so many is traced, where that is between the two.
const SPARSE: u32 = 8;
/// Threads share a block in tiles of this side.
const TILE: u32 = 4;
/// Samples differ by this cut-off as they would by any.
const CUTOFF: f32 = 1.0 / 256.0;
/// As which power of the samples the error is taken to fall where nothing is known yet: between −1/2 of random ones and
/// −1 of the best sequences.
const EXPONENT: f64 = 0.65;
/// As many times as many samples are the judge, at least [`LEAST_TRUER`].
const TRUER: u32 = 4;
const LEAST_TRUER: u32 = 64;
/// What the estimate of an error may be too low by. On scenes/opaque.toml and scenes/prism.toml at 40×30, against 2048
/// samples, it was between 0.87 and 1.11 of the true error for 13 to 64 samples; judged by only twice as many, from 0.69.
const MARGIN: f64 = 1.15;
/// Greatest step from one number of samples to the next.
const MOST_GROWTH: f64 = 16.0;
/// Thresholds of adaptive antialiasing that are tried are 2^-4 to 2^-14.
const THRESHOLDS: [i32; 2] = [4, 14];
/// Adaptive antialiasing is to save at least this share of the rays.
const WORTH: f64 = 0.95;

/// How many samples, and what is known of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sampled {
    pub(super) samples: u32,
    pub(super) adaptive: Option<f32>,
    /// The figure, and what it is below with 95 % confidence; foretold where it is above what was asked for.
    pub(super) figure: [f64; 2],
    /// Samples of a pixel, the mean.
    pub(super) mean: f64,
    /// Mean of 1/samples.
    pub(super) inverse: f64,
}

/// Blocks with so many samples.
struct Blocks {
    seen: Seen,
    samples: Vec<u32>,
    rays: u64,
}

/// Blocks of a picture.
pub(super) struct Pilot<'a> {
    request: Request<'a>,
    metric: Metric,
    renderer: CpuRenderer<'a>,
    /// Left, top, width and height of each block.
    crops: Vec<[u32; 4]>,
    known: HashMap<(u32, Option<u32>), Blocks>,
}

impl<'a> Pilot<'a> {
    pub(super) fn new(request: &Request<'a>, metric: Metric) -> Result<Self, StudyError> {
        let renderer = CpuRenderer::with_tile(request.scene, 0, TILE)?;
        let crops = crops(request.size);
        Ok(Self { request: *request, metric, renderer, crops, known: HashMap::new() })
    }

    /// Pixels of the blocks.
    pub(super) fn pixels(&self) -> usize {
        self.crops.iter().map(|[_, _, width, height]| (width * height) as usize).sum()
    }

    /// Settings that were tried.
    pub(super) fn tried(&self) -> usize {
        self.known.len()
    }

    /// The fewest samples that keep a limit, spread evenly or where they are worth most; what `most` would give where that
    /// is not enough.
    pub(super) fn cheapest(&mut self, limit: f64, most: u32) -> Result<Sampled, StudyError> {
        let (mut too_few, mut samples) = (0, 1);
        let even = loop {
            let even = self.try_out(samples, None, truer(samples))?;
            if even.figure[1] <= limit {
                break even;
            }
            // Not even a fall with the power of −1 would lead there: no sequence in the plane does better (Niederreiter
            // 1992, Random Number Generation and Quasi-Monte Carlo Methods, section 2.1).
            let reach = f64::from(samples) / f64::from(most);
            if samples >= most || even.figure[0] * reach > limit {
                return Ok(Sampled { figure: even.figure.map(|f| f * reach.sqrt()), samples: most, ..even });
            }
            too_few = samples;
            let growth = (even.figure[1] / limit.max(f64::MIN_POSITIVE)).powf(1.0 / EXPONENT);
            let growth = growth.clamp(2.0, MOST_GROWTH);
            samples = ((f64::from(samples) * growth) as u32).min(most);
        };
        let (most, reference) = (even.samples, truer(even.samples));
        let even = self.fewer(even, too_few, limit, reference)?;
        match self.adaptive(most, limit, reference)? {
            Some(adaptive) if self.rays(&adaptive) < WORTH * self.rays(&even) => Ok(adaptive),
            _ => Ok(even),
        }
    }

    /// Between too few samples and enough of them.
    fn fewer(
        &mut self,
        enough: Sampled,
        too_few: u32,
        limit: f64,
        reference: u32,
    ) -> Result<Sampled, StudyError> {
        let (mut low, mut best) = (too_few, enough);
        // To within a fifth.
        while f64::from(best.samples) > 1.2 * f64::from(low) + 1.0 {
            let middle = if low == 0 { 1 } else { (f64::from(low) * f64::from(best.samples)).sqrt() as u32 };
            if middle <= low || middle >= best.samples {
                break;
            }
            let tried = self.try_out(middle, None, reference)?;
            if tried.figure[1] <= limit {
                best = tried;
            } else {
                low = middle;
            }
        }
        Ok(best)
    }

    /// The greatest threshold that keeps a limit with at most so many samples.
    fn adaptive(&mut self, most: u32, limit: f64, reference: u32) -> Result<Option<Sampled>, StudyError> {
        if most <= BASE_SAMPLES {
            return Ok(None);
        }
        let threshold = |exponent: i32| 2.0_f32.powi(-exponent);
        first(
            THRESHOLDS,
            |exponent| self.try_out(most, Some(threshold(exponent)), reference),
            |tried| tried.figure[1] <= limit,
        )
    }

    /// Hold samples against more of them.
    ///
    /// The first n of N independent samples have a mean that is n-N apart by the square root of (N − n)/N of its own error:
    /// (1/n − 1/N)σ² against σ²/n. How this strays for those of a low-discrepancy sequence, [`MARGIN`] allows for.
    fn try_out(
        &mut self,
        samples: u32,
        adaptive: Option<f32>,
        reference: u32,
    ) -> Result<Sampled, StudyError> {
        self.trace(reference, None)?;
        self.trace(samples, adaptive)?;
        let (tried, judge) = (self.blocks(samples, adaptive), self.blocks(reference, None));
        let (Some(tried), Some(judge)) = (tried, judge) else {
            return Err(StudyError::TooSlow { seconds: 0.0 });
        };
        let all = f64::from(reference);
        let own = |n: u32| all / (all - f64::from(n)).max(1.0);
        let own = |n: u32| if self.metric == Metric::Rmse { own(n) } else { own(n).sqrt() };
        let errors = values(self.metric, &tried.seen, &judge.seen);
        let errors: Vec<_> = errors.into_iter().zip(&tried.samples).map(|(e, &n)| e * own(n)).collect();
        let pixels = tried.samples.len().max(1) as f64;
        let over = |value: fn(f64) -> f64| tried.samples.iter().map(|&n| value(f64::from(n))).sum::<f64>();
        Ok(Sampled {
            samples,
            adaptive,
            figure: self.figure(&errors),
            mean: over(|n| n) / pixels,
            inverse: over(|n| 1.0 / n.max(1.0)) / pixels,
        })
    }

    /// The figure of pixels' errors: pixels of a block are alike, so that blocks are what is counted.
    fn figure(&self, errors: &[f64]) -> [f64; 2] {
        let size = self.crops.first().map_or(1, |[_, _, width, height]| (width * height) as usize);
        let group = |block: &[f64]| match self.metric {
            Metric::Max => block.iter().copied().fold(0.0, f64::max),
            _ => block.iter().sum::<f64>() / block.len() as f64,
        };
        let groups: Vec<_> = errors.chunks(size).map(group).collect();
        let [figure, above] = figure(self.metric, &groups, self.share(), false);
        [figure, above * MARGIN]
    }

    /// Of the picture, what the blocks are.
    fn share(&self) -> f64 {
        let [width, height] = self.request.size;
        self.pixels() as f64 / (f64::from(width) * f64::from(height))
    }

    fn rays(&self, sampled: &Sampled) -> f64 {
        self.blocks(sampled.samples, sampled.adaptive).map_or(f64::MAX, |blocks| blocks.rays as f64)
    }

    fn blocks(&self, samples: u32, adaptive: Option<f32>) -> Option<&Blocks> {
        self.known.get(&(samples, adaptive.map(f32::to_bits)))
    }

    /// Trace the blocks with so many samples, one below the other.
    fn trace(&mut self, samples: u32, adaptive: Option<f32>) -> Result<(), StudyError> {
        if self.blocks(samples, adaptive).is_some() {
            return Ok(());
        }
        let Request { scene, camera, size, base, .. } = self.request;
        let settings = Settings {
            depth: MAX_DEPTH,
            cutoff: CUTOFF,
            precision: Precision::F32,
            samples,
            adaptive,
            aovs: false,
            ..base
        };
        let mut all: Option<Frame> = None;
        for &crop in &self.crops {
            let view = view(camera, scene, size, Some(crop), &settings);
            let block = self.renderer.render(&view, &settings, &())?;
            match &mut all {
                None => all = Some(block),
                Some(all) => all.append(block),
            }
        }
        if let Some(frame) = all {
            let samples_of = |pixel| frame.samples.of(pixel);
            let blocks = Blocks {
                seen: Seen::of(&frame),
                samples: (0..frame.texels.len()).map(samples_of).collect(),
                rays: frame.texels.iter().map(|texel| u64::from(texel.rays)).sum(),
            };
            self.known.insert((samples, adaptive.map(f32::to_bits)), blocks);
        }
        Ok(())
    }
}

/// Samples of the judge of so many.
fn truer(samples: u32) -> u32 {
    (samples * TRUER).max(LEAST_TRUER)
}

/// One block by chance in each part of the picture; the whole of a small one.
fn crops([width, height]: [u32; 2]) -> Vec<[u32; 4]> {
    let all = width * height / (BLOCK * BLOCK);
    if all <= 2 * LEAST_BLOCKS {
        return vec![[0, 0, width, height]];
    }
    let blocks = (all / SPARSE).clamp(LEAST_BLOCKS, MOST_BLOCKS);
    let side = BLOCK.min(width).min(height);
    let aspect = f64::from(width) / f64::from(height);
    let columns = ((f64::from(blocks) * aspect).sqrt().round() as u32).clamp(1, (width / side).min(blocks));
    let rows = (blocks / columns).clamp(1, height / side);
    let crop = |index: u32| {
        let place = |part: u32, parts: u32, length: u32, chance: f64| {
            let [low, high] =
                [part, part + 1].map(|part| u64::from(length) * u64::from(part) / u64::from(parts));
            let room = (high - low) as u32 - side;
            low as u32 + (f64::from(room + 1) * chance) as u32
        };
        // Multiples of the plastic number's powers: far from the picture's own periods.
        let chance = |step: f64| (f64::from(index + 1) * step).fract();
        [
            place(index % columns, columns, width, chance(0.754_877_666_246_692_8)),
            place(index / columns, rows, height, chance(0.569_840_290_998_053_2)),
            side,
            side,
        ]
    };
    (0..columns * rows).map(crop).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_lie_in_the_picture_and_apart() {
        for size in [[1280, 720], [720, 1280], [16384, 16], [300, 200], [17, 16384]] {
            let crops = crops(size);
            assert!((12..=64).contains(&crops.len()), "{size:?}: {}", crops.len());
            for (i, [x, y, w, h]) in crops.iter().enumerate() {
                assert!(x + w <= size[0] && y + h <= size[1]);
                let meets =
                    |[a, b, c, d]: &[u32; 4]| x < &(a + c) && a < &(x + w) && y < &(b + d) && b < &(y + h);
                assert!(!crops[i + 1..].iter().any(meets), "{size:?} {i}");
            }
        }
        assert_eq!(crops([100, 80]), [[0, 0, 100, 80]]);
    }
}
