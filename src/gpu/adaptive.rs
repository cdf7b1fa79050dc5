//! Adaptive antialiasing on a device: rounds over the film, of which each traces the list that a sift has made.
//!
//! Entry point `sift` lists the pixels that are to be refined, in the film itself; `render` then traces the list instead
//! of the crop's blocks, so that all others cost nothing; `settle_film` divides the sums in the end. The host learns
//! only how long the list is.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use super::blocks::Blocks;
use super::film::{FilmBuffer, Pixels};
use super::job::Job;
use super::pace::Pace;
use super::{GpuError, GpuRenderer, Variant, pipeline};
use crate::film::{Frame, Progress, RayCounts, SampleCounts, TraceTimes};
use crate::layout::constants::{BASE_SAMPLES, BLOCK};
use crate::layout::{FilmHead, Tile, View, refinement_rounds};

/// Blocks of one dispatch that traces nothing: within every adapter's limit of workgroups.
const SIFTED_BLOCKS: u32 = 1 << 15;

/// The entry points between rounds.
#[derive(Clone)]
pub(super) struct Sifter {
    sift: wgpu::ComputePipeline,
    settle: wgpu::ComputePipeline,
}

/// A band in work, with its border.
pub(super) struct Rounds<'a> {
    job: Job<'a>,
    sifter: Sifter,
    threshold: f32,
    /// Most samples of a pixel.
    limit: u32,
    pace: Pace,
    rays: RayCounts,
}

/// What one round traces.
struct Pass {
    /// Pixels of the list; 0 for the blocks of the film.
    listed: u32,
    /// Blocks of pixels.
    blocks: u32,
    /// Samples that the pixels have by now, at the most.
    before: u32,
    /// Samples that each gets, at most.
    samples: u32,
}

impl GpuRenderer {
    /// Trace the view, refined where one more sample of a pixel is worth more than the threshold.
    ///
    /// The crop is traced with a border as wide as pixels learn from each other, so that it is a part of the whole; and
    /// so is each band, where the adapter cannot hold the picture in one buffer. A stop settles every pixel with the
    /// samples that it has.
    pub(super) fn render_adaptive(
        &mut self,
        view: &View,
        variant: &Variant,
        threshold: f32,
        progress: &dyn Progress,
    ) -> Result<Frame, GpuError> {
        let start = Instant::now();
        let border = refinement_rounds(view.samples);
        let bands = self.bands(view, variant)?;
        let work = |band: &View| pixels_of(&band.grown(border)) * u64::from(view.samples);
        let mut meter =
            Meter { progress, before: 0, total: bands.iter().map(work).sum(), told: Cell::new(0) };
        let mut frame = Frame {
            width: view.crop[2],
            height: 0,
            texels: Vec::new(),
            samples: SampleCounts::Each(Vec::new()),
            aovs: variant.aovs().then(Vec::new),
            float: variant.float,
            rays: RayCounts::default(),
            times: TraceTimes::default(),
            complete: true,
        };
        for band in &bands {
            let grown = band.grown(border);
            let mut rounds = self.rounds(&grown, variant, threshold)?;
            let traced = Instant::now();
            let flow = rounds.trace(&meter)?;
            let read = Instant::now();
            let part = rounds.read(variant)?.part(band.crop_within(&grown));
            frame.times.trace += read - traced;
            frame.times.readback += read.elapsed();
            frame.append(part);
            meter.before += work(band);
            if flow == ControlFlow::Break(()) {
                frame.complete = false;
                break;
            }
        }
        frame.pad_to(view.crop[3]);
        frame.times.compile = start.elapsed().saturating_sub(frame.times.trace + frame.times.readback);
        Ok(frame)
    }

    /// The crop in bands of which each, with its border, fits one film.
    fn bands(&mut self, view: &View, variant: &Variant) -> Result<Vec<View>, GpuError> {
        let border = refinement_rounds(view.samples);
        let grown = view.grown(border);
        let rows = self.film_rows(&grown, variant)?;
        let [left, top, width, height] = view.crop;
        let most = if grown.crop[3] <= rows { height } else { rows.saturating_sub(2 * border).max(1) };
        let band = |y| View { crop: [left, top + y, width, most.min(height - y)], ..*view };
        Ok((0..height).step_by(most.max(1) as usize).map(band).collect())
    }

    /// All that a band needs to be traced.
    pub(super) fn rounds(
        &mut self,
        grown: &View,
        variant: &Variant,
        threshold: f32,
    ) -> Result<Rounds<'_>, GpuError> {
        let sifter = self.sifter(variant)?;
        let job = self.prepare(grown, variant)?;
        if job.band_height < job.blocks.height {
            let needed = job.film.size_for(pixels_of(grown));
            job.context.check_size("a row of the picture with its border", needed)?;
        }
        let kind = job.context.adapter.kind;
        let pace = Pace::new(job.blocks.count(), BASE_SAMPLES, variant.most_blocks(), kind);
        Ok(Rounds { job, sifter, threshold, limit: grown.samples, pace, rays: RayCounts::default() })
    }

    /// The entry points between rounds, compiled for the variant.
    fn sifter(&mut self, variant: &Variant) -> Result<Sifter, GpuError> {
        if let Some(sifter) = self.sifters.get(variant) {
            return Ok(sifter.clone());
        }
        let compile = |entry| {
            let (context, layout) = (&self.context, &self.scene.layout);
            pipeline::compile(context, layout, self.sources, ("sift", entry), variant).map(|one| one.pipeline)
        };
        let sifter = Sifter { sift: compile("sift")?, settle: compile("settle_film")? };
        self.sifters.insert(*variant, sifter.clone());
        Ok(sifter)
    }
}

impl Rounds<'_> {
    /// Trace the film as a picture of its own.
    pub(super) fn trace_whole(
        &mut self,
        progress: &dyn Progress,
        pixels: u64,
    ) -> Result<ControlFlow<()>, GpuError> {
        let total = pixels * u64::from(self.limit);
        self.trace(&Meter { progress, before: 0, total, told: Cell::new(0) })
    }

    /// The film in work.
    pub(super) fn film(&self) -> &Arc<FilmBuffer> {
        &self.job.film
    }

    /// Rays traced so far.
    pub(super) fn rays(&self) -> RayCounts {
        self.rays
    }

    /// Trace the film round by round, and settle it.
    fn trace(&mut self, meter: &Meter<'_>) -> Result<ControlFlow<()>, GpuError> {
        let Blocks { width, height, .. } = self.job.blocks;
        self.job.film.clear(self.job.context, u64::from(width) * u64::from(height));
        let blocks = self.job.blocks.count();
        let mut flow =
            self.trace_pass(&Pass { listed: 0, blocks, before: 0, samples: BASE_SAMPLES }, meter)?;
        for round in 0..refinement_rounds(self.limit) {
            if flow == ControlFlow::Break(()) {
                break;
            }
            let tile = Tile { round, threshold: self.threshold, ..Tile::default() };
            let listed = self.sweep(&self.sifter.sift, tile)?;
            if listed == 0 {
                break;
            }
            let before = BASE_SAMPLES << round;
            // Pixels that were spared before have fewer samples, and may add all of them.
            let samples = before.min((self.limit - before).max(before / 2));
            flow = self.trace_pass(
                &Pass { listed, blocks: listed.div_ceil(BLOCK * BLOCK), before, samples },
                meter,
            )?;
        }
        self.sweep(&self.sifter.settle, Tile::default())?;
        Ok(flow)
    }

    /// Trace what one round is to.
    fn trace_pass(&mut self, pass: &Pass, meter: &Meter<'_>) -> Result<ControlFlow<()>, GpuError> {
        let pixels = u64::from(self.job.blocks.width) * u64::from(self.job.blocks.height);
        let traced = if pass.listed == 0 { pixels } else { u64::from(pass.listed) };
        let spared = (pixels - traced) * u64::from(self.limit) + traced * u64::from(pass.before);
        self.pace = self.pace.again(pass.blocks, pass.samples);
        while let Some(tile) = self.pace.next(pass.blocks) {
            let longest = self.job.trace_tile(Tile { listed: pass.listed, ..tile }, &mut self.rays)?;
            self.pace.took(longest);
            let (done, all) = self.pace.progress();
            let part =
                (u128::from(traced * u64::from(pass.samples)) * u128::from(done)) / u128::from(all.max(1));
            if meter.advance(spared + part as u64) == ControlFlow::Break(()) {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Run an entry point that traces nothing over all blocks; returns the length of the list.
    fn sweep(&self, pipeline: &wgpu::ComputePipeline, tile: Tile) -> Result<u32, GpuError> {
        let blocks = self.job.blocks.count();
        let mut listed = 0;
        for first_block in (0..blocks).step_by(SIFTED_BLOCKS as usize) {
            let tile = Tile { first_block, block_count: SIFTED_BLOCKS.min(blocks - first_block), ..tile };
            listed = self.job.run(pipeline, FilmHead { tile, listed, ..FilmHead::default() })?.listed;
        }
        Ok(listed)
    }

    /// Bring the film to the host.
    fn read(&self, variant: &Variant) -> Result<Frame, GpuError> {
        let job = &self.job;
        let (width, height) = (job.blocks.width, job.blocks.height);
        let mut pixels = Pixels::default();
        job.film.read(job.context, u64::from(width) * u64::from(height), &mut pixels)?;
        Ok(Frame {
            width,
            height,
            texels: pixels.texels,
            samples: SampleCounts::Each(pixels.statistics.iter().map(|one| one.samples).collect()),
            aovs: variant.aovs().then_some(pixels.aovs),
            float: variant.float,
            rays: self.rays,
            times: TraceTimes::default(),
            complete: true,
        })
    }
}

fn pixels_of(view: &View) -> u64 {
    u64::from(view.crop[2]) * u64::from(view.crop[3])
}

/// Tells progress in samples, of which those that turn out needless count as traced.
struct Meter<'a> {
    progress: &'a dyn Progress,
    /// Of the bands before.
    before: u64,
    total: u64,
    /// What was told last: pixels that are taken up again do not turn it back.
    told: Cell<u64>,
}

impl Meter<'_> {
    fn advance(&self, done: u64) -> ControlFlow<()> {
        self.told.set(self.told.get().max(self.before + done));
        self.progress.advance(self.told.get(), self.total)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::testing::{Subject, assert_same, find, on_each};
    use super::*;
    use crate::film::Renderer;
    use crate::layout::{Precision, Texel};

    fn goblet() -> Subject {
        Subject::new("goblet.toml", [45, 60], 1).adaptive(12, 0.02)
    }

    fn mean_samples(frame: &Frame) -> f64 {
        let sum: u64 = (0..frame.texels.len()).map(|pixel| u64::from(frame.samples.of(pixel))).sum();
        sum as f64 / frame.texels.len() as f64
    }

    #[test]
    fn every_device_refines_the_same_pixels_to_the_same_bits() {
        let subject = goblet();
        let cpu = subject.on_cpu();
        let mean = mean_samples(&cpu);
        assert!(mean > 2.5 && mean < 8.0, "{mean}");
        on_each(|options| {
            let gpu = subject.renderer(options).render(&subject.view, &subject.settings, &()).unwrap();
            assert_same(&gpu, &cpu);
        });
    }

    #[test]
    fn a_threshold_of_0_gives_the_bits_of_uniform_sampling() {
        let uniform = Subject::new("whitted.toml", [40, 30], 7);
        let expected = uniform.on_cpu();
        let adaptive = uniform.adaptive(7, 0.0);
        let cpu = adaptive.on_cpu();
        assert_eq!((&cpu.texels, &cpu.aovs, cpu.rays), (&expected.texels, &expected.aovs, expected.rays));
        let Some(options) = find("llvmpipe") else { return };
        let gpu = adaptive.renderer(&options).render(&adaptive.view, &adaptive.settings, &()).unwrap();
        assert_same(&gpu, &cpu);
    }

    #[test]
    fn invocations_that_rest_refine_to_the_same_bits() {
        let subject = Subject::new("goblet.toml", [19, 26], 1).adaptive(9, 0.01);
        let cpu = subject.on_cpu();
        let Some(options) = find("llvmpipe") else { return };
        let mut renderer = subject.renderer(&options);
        renderer.context.step_budget = 1;
        assert_same(&renderer.render(&subject.view, &subject.settings, &()).unwrap(), &cpu);
    }

    #[test]
    fn a_crop_is_a_part_of_the_whole_on_both_devices() {
        let subject = goblet();
        let whole = subject.on_cpu();
        let view = View { crop: [17, 23, 9, 20], ..subject.view };
        let expected = whole.part([17, 23, 9, 20]);
        let part = Subject { view, ..goblet() };
        let cpu = part.on_cpu();
        assert_eq!((&cpu.texels, &cpu.samples), (&expected.texels, &expected.samples));
        assert_eq!(cpu.aovs, expected.aovs);
        let Some(options) = find("llvmpipe") else { return };
        assert_same(&part.renderer(&options).render(&part.view, &part.settings, &()).unwrap(), &cpu);
    }

    #[test]
    fn bands_do_not_show() {
        let Some(options) = find("llvmpipe") else { return };
        let subject = goblet();
        let cpu = subject.on_cpu();
        let mut renderer = subject.renderer(&options);
        let whole = renderer.render(&subject.view, &subject.settings, &()).unwrap();
        assert_same(&whole, &cpu);
        // Four rows of blocks fit, and most of a fifth.
        let film = renderer.films.pop().unwrap();
        renderer.context.adapter.max_storage_binding = film.buffer.size() - 45 * 22 * 96;
        let banded = renderer.render(&subject.view, &subject.settings, &()).unwrap();
        assert_eq!((&banded.texels, &banded.samples), (&cpu.texels, &cpu.samples));
        assert_eq!((banded.height, banded.aovs), (60, cpu.aovs));
        // Borders were traced twice.
        assert!(banded.rays.total() > cpu.rays.total());
        renderer.films.clear();
        renderer.context.adapter.max_storage_binding = 64 << 10;
        let error = renderer.render(&subject.view, &subject.settings, &()).unwrap_err();
        assert!(matches!(error, GpuError::TooLarge { .. }), "{error}");
    }

    #[test]
    fn double_precision_refines_too() {
        let Some(options) = find("llvmpipe") else { return };
        let subject = Subject::new("prism.toml", [24, 18], 1).adaptive(8, 0.02).with(Precision::F64);
        let cpu = subject.on_cpu();
        let gpu = subject.renderer(&options).render(&subject.view, &subject.settings, &()).unwrap();
        let same = (0..cpu.texels.len()).filter(|&pixel| gpu.samples.of(pixel) == cpu.samples.of(pixel));
        assert!(same.count() * 100 >= cpu.texels.len() * 99);
    }

    /// Stops when so much of the work is done.
    struct StopAt(f64);

    impl Progress for StopAt {
        fn advance(&self, done: u64, total: u64) -> ControlFlow<()> {
            assert!(done <= total);
            let stop = done as f64 > self.0 * total as f64;
            if stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }

    #[test]
    fn a_stop_settles_what_is_there() {
        let subject = Subject::new("goblet.toml", [60, 80], 1).adaptive(16, 0.001);
        let expected = subject.on_cpu();
        let check = |frame: Frame, what: &str| {
            assert!(!frame.complete && frame.texels.len() == expected.texels.len(), "{what}");
            // Means, not sums: near the finished picture.
            let brightness = |texels: &[Texel]| texels.iter().map(|t| f64::from(t.radiance[1])).sum::<f64>();
            let ratio = brightness(&frame.texels) / brightness(&expected.texels);
            assert!((0.9..1.1).contains(&ratio), "{what}: {ratio}");
        };
        let mut cpu = crate::cpu::CpuRenderer::new(&subject.scene, 0).unwrap();
        check(cpu.render(&subject.view, &subject.settings, &StopAt(0.3)).unwrap(), "CPU");
        let Some(options) = find("llvmpipe") else { return };
        let mut gpu = subject.renderer(&options);
        check(gpu.render(&subject.view, &subject.settings, &StopAt(0.3)).unwrap(), "GPU");
    }
}
