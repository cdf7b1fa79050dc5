//! Pictures that stay on the device: a film as a window shows it, while it is traced and after.

use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use super::film::{FilmBuffer, PixelLayout, Pixels};
use super::job::Job;
use super::pace::{Pace, SUBMISSION};
use super::{GpuError, GpuRenderer, SharedDevice, Variant};
use crate::film::{Frame, Progress, RayCounts, SampleCounts, TraceTimes};
use crate::layout::constants::BLOCK;
use crate::layout::{Float, Settings, Tile, View};

/// A picture in device memory. While a handle of it lives, no other picture is traced into its memory, unless it is a
/// [`Rolling`](super::Rolling) one's.
#[derive(Clone)]
pub struct Film {
    pub(super) buffer: Arc<FilmBuffer>,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Film {
    /// The memory, a storage buffer.
    #[must_use]
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer.buffer
    }

    /// Words of 32 bits before the first pixel.
    #[must_use]
    pub fn first_word(&self) -> u32 {
        (self.buffer.texels_at() / 4) as u32
    }

    /// Words of a pixel: a [`Texel`](crate::layout::Texel), then an [`Aov`](crate::layout::Aov) if the picture was traced
    /// with them, then [`Statistics`](crate::layout::Statistics) if it was refined.
    #[must_use]
    pub fn pixel_words(&self) -> u32 {
        (self.buffer.layout().size() / 4) as u32
    }

    /// Whether there are AOVs.
    #[must_use]
    pub fn has_aovs(&self) -> bool {
        self.buffer.layout().aovs
    }

    /// Whether the pixels have samples of their own number.
    #[must_use]
    pub fn has_statistics(&self) -> bool {
        self.buffer.layout().statistics
    }

    /// Pixels of the largest picture that can be brought to the device.
    #[must_use]
    pub fn most_pixels(device: &SharedDevice, aovs: bool) -> u64 {
        let layout = PixelLayout { aovs, statistics: false };
        FilmBuffer::most_pixels(device.context.largest_binding(), 0, layout)
    }

    /// Bring a picture of the host to the device.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`], [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn of_frame(device: &SharedDevice, frame: &Frame) -> Result<Self, GpuError> {
        let context = &device.context;
        let layout = PixelLayout { aovs: frame.aovs.is_some(), statistics: false };
        let buffer = FilmBuffer::new(context, 0, frame.texels.len() as u64, layout)?;
        let mut bytes = Vec::with_capacity(frame.texels.len() * layout.size() as usize);
        for (index, texel) in frame.texels.iter().enumerate() {
            bytes.extend_from_slice(bytemuck::bytes_of(texel));
            if let Some(aov) = frame.aovs.as_ref().and_then(|aovs| aovs.get(index)) {
                bytes.extend_from_slice(bytemuck::bytes_of(aov));
            }
        }
        context.write(&buffer.buffer, &bytes)?;
        Ok(Self { buffer: Arc::new(buffer), width: frame.width, height: frame.height })
    }
}

/// What is on a film.
#[derive(Clone)]
pub struct Exposure {
    /// The film.
    pub film: Film,
    /// Samples that a pixel has when the picture is complete; until then the film holds sums.
    pub samples: u32,
    /// Samples that every pixel has.
    pub passes: u32,
    /// Blocks, in the order of their numbers, that have one more.
    pub blocks: u32,
    /// The arithmetic that was used.
    pub float: Float,
    /// Rays traced so far.
    pub rays: RayCounts,
    /// Time spent tracing so far, and before that on the pipeline.
    pub times: TraceTimes,
}

impl Exposure {
    /// A picture of the host, brought to the device.
    ///
    /// # Errors
    /// As [`Film::of_frame`].
    pub fn of_frame(device: &SharedDevice, frame: &Frame) -> Result<Self, GpuError> {
        let samples = match frame.samples {
            SampleCounts::Same(samples) => samples,
            SampleCounts::Each(ref samples) => samples.iter().copied().max().unwrap_or(1),
        };
        Ok(Self {
            film: Film::of_frame(device, frame)?,
            samples,
            passes: samples,
            blocks: 0,
            float: frame.float,
            rays: frame.rays,
            times: frame.times,
        })
    }

    /// Whether the film holds the finished picture.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.passes == self.samples
    }

    /// Blocks in a row of the picture.
    #[must_use]
    pub fn columns(&self) -> u32 {
        self.film.width.div_ceil(BLOCK)
    }

    /// Bring the finished picture to the host.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`].
    pub fn frame(&self, device: &SharedDevice) -> Result<Frame, GpuError> {
        let Film { buffer, width, height } = &self.film;
        let mut pixels = Pixels::default();
        buffer.read(&device.context, u64::from(*width) * u64::from(*height), &mut pixels)?;
        Ok(Frame {
            width: *width,
            height: *height,
            texels: pixels.texels,
            samples: if buffer.layout().statistics {
                SampleCounts::Each(pixels.statistics.iter().map(|one| one.samples).collect())
            } else {
                SampleCounts::Same(self.samples)
            },
            aovs: buffer.layout().aovs.then_some(pixels.aovs),
            float: self.float,
            rays: self.rays,
            times: self.times,
            complete: self.is_complete(),
        })
    }
}

/// Hears after each tile what the film holds, and may break off.
pub type Watch<'a> = &'a (dyn Fn(&Exposure) -> ControlFlow<()> + Sync);

impl GpuRenderer {
    /// Trace the whole view into a film that stays on the device, sample after sample: the picture of
    /// [`render`](crate::film::Renderer::render), bit for bit, once it is complete. With adaptive antialiasing it is
    /// shown when it is complete only.
    ///
    /// # Errors
    /// As of `render`; [`GpuError::TooLarge`] for a picture beyond [`most_pixels`](Self::most_pixels).
    pub fn expose(
        &mut self,
        view: &View,
        settings: &Settings,
        watch: Watch<'_>,
    ) -> Result<Exposure, GpuError> {
        let start = Instant::now();
        let variant = self.variant(settings);
        let view = &self.plan(settings).applied_to(view);
        let last = self.pace.take().filter(|(of, _)| *of == variant);
        if let Some(threshold) = settings.threshold().filter(|_| variant.adaptive()) {
            return self.expose_adaptive(view, &variant, threshold, watch);
        }
        let job = self.prepare(view, &variant)?;
        whole(&job)?;
        let blocks = job.blocks.count();
        let mut pace =
            last.map_or_else(|| first_pace(&job, &variant), |(_, pace)| pace).aiming_at(SUBMISSION);
        let mut exposure = blank(&job.film, view, &variant);
        exposure.times.compile = start.elapsed();
        'passes: for first_sample in 0..view.samples {
            pace = pace.again(blocks, 1);
            while trace_next(&job, &mut pace, blocks, first_sample, &mut exposure)?.is_some() {
                if watch(&exposure) == ControlFlow::Break(()) {
                    break 'passes;
                }
            }
        }
        self.pace = Some((variant, pace));
        Ok(exposure)
    }

    /// The same, refined where it is worth it.
    fn expose_adaptive(
        &mut self,
        view: &View,
        variant: &Variant,
        threshold: f32,
        watch: Watch<'_>,
    ) -> Result<Exposure, GpuError> {
        let start = Instant::now();
        let mut rounds = self.rounds(view, variant, threshold)?;
        let heard = Heard { watch, exposure: Mutex::new(blank(rounds.film(), view, variant)) };
        let compile = start.elapsed();
        let flow = rounds.trace_whole(&heard, u64::from(view.crop[2]) * u64::from(view.crop[3]))?;
        let mut exposure = heard.exposure.into_inner().unwrap_or_else(PoisonError::into_inner);
        exposure.rays = rounds.rays();
        exposure.times = TraceTimes { compile, trace: start.elapsed() - compile, ..TraceTimes::default() };
        if flow == ControlFlow::Continue(()) {
            exposure.passes = exposure.samples;
        }
        Ok(exposure)
    }

    /// The largest picture, in pixels, that one film can hold under these settings.
    ///
    /// # Errors
    /// As of `render`, where the shader is not compiled yet.
    pub fn most_pixels(&mut self, settings: &Settings) -> Result<u64, GpuError> {
        let variant = self.variant(settings);
        self.most_film_pixels(&variant)
    }
}

/// That a picture fits one film.
pub(super) fn whole(job: &Job<'_>) -> Result<(), GpuError> {
    if job.band_height == job.blocks.height {
        return Ok(());
    }
    let pixels = u64::from(job.blocks.width) * u64::from(job.blocks.height);
    job.context.check_size("the picture", job.film.size_for(pixels))
}

/// Before anything is known of the adapter.
pub(super) fn first_pace(job: &Job<'_>, variant: &Variant) -> Pace {
    Pace::new(job.blocks.count(), 1, variant.most_blocks(), job.context.adapter.kind)
}

/// Trace the next tile before block `end`, and note on an unfinished picture what it has by now; none where no tile is
/// left.
pub(super) fn trace_next(
    job: &Job<'_>,
    pace: &mut Pace,
    end: u32,
    first_sample: u32,
    exposure: &mut Exposure,
) -> Result<Option<Tile>, GpuError> {
    let Some(tile) = pace.next(end) else { return Ok(None) };
    let start = Instant::now();
    let longest = job.trace_tile(Tile { first_sample, ..tile }, &mut exposure.rays)?;
    pace.took(longest);
    exposure.times.trace += start.elapsed();
    if !exposure.is_complete() {
        exposure.blocks = pace.finished_blocks();
        if exposure.blocks == job.blocks.count() {
            (exposure.passes, exposure.blocks) = (first_sample + 1, 0);
        }
    }
    Ok(Some(tile))
}

/// A film before the first ray.
pub(super) fn blank(film: &Arc<FilmBuffer>, view: &View, variant: &Variant) -> Exposure {
    let [_, _, width, height] = view.crop;
    Exposure {
        film: Film { buffer: Arc::clone(film), width, height },
        samples: view.samples,
        passes: 0,
        blocks: 0,
        float: variant.float,
        rays: RayCounts::default(),
        times: TraceTimes::default(),
    }
}

/// Progress of a refinement, for one who watches films.
struct Heard<'a> {
    watch: Watch<'a>,
    exposure: Mutex<Exposure>,
}

impl Progress for Heard<'_> {
    fn advance(&self, _done: u64, _total: u64) -> ControlFlow<()> {
        (self.watch)(&self.exposure.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::testing::{Subject, assert_same, find};
    use super::*;
    use crate::film::Renderer;

    fn shared(subject: &Subject) -> Option<(SharedDevice, GpuRenderer)> {
        let device = SharedDevice::new(&find("llvmpipe")?).unwrap();
        let renderer = GpuRenderer::on(&device, &subject.scene).unwrap();
        Some((device, renderer))
    }

    #[test]
    fn a_film_that_stays_holds_the_bits_of_a_rendered_frame() {
        for subject in [
            Subject::new("whitted.toml", [45, 30], 3),
            Subject::new("goblet.toml", [30, 40], 1).adaptive(9, 0.02),
        ] {
            let Some((device, mut renderer)) = shared(&subject) else { return };
            let rendered = renderer.render(&subject.view, &subject.settings, &()).unwrap();
            let exposure =
                renderer.expose(&subject.view, &subject.settings, &|_| ControlFlow::Continue(())).unwrap();
            assert_same(&exposure.frame(&device).unwrap(), &rendered);
        }
    }

    #[test]
    fn samples_come_one_by_one_and_a_stop_keeps_those_that_are_there() {
        let subject = Subject::new("whitted.toml", [40, 30], 4);
        let Some((_, mut renderer)) = shared(&subject) else { return };
        let heard = Mutex::new(Vec::new());
        let stop = |exposure: &Exposure| {
            heard.lock().unwrap().push((exposure.passes, exposure.blocks));
            if exposure.passes == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let exposure = renderer.expose(&subject.view, &subject.settings, &stop).unwrap();
        assert!(exposure.passes == 2 && !exposure.is_complete());
        let heard = heard.into_inner().unwrap();
        assert!(heard.is_sorted() && heard.len() > 3, "{heard:?}");
    }

    #[test]
    fn a_film_that_is_looked_at_is_not_written_to() {
        let subject = Subject::new("prism.toml", [24, 16], 1);
        let Some((device, mut renderer)) = shared(&subject) else { return };
        let watch: Watch<'_> = &|_| ControlFlow::Continue(());
        let first = renderer.expose(&subject.view, &subject.settings, watch).unwrap();
        let before = first.frame(&device).unwrap();
        let dark = Settings { depth: 0, ..subject.settings };
        let second = renderer.expose(&View { depth: 0, ..subject.view }, &dark, watch).unwrap();
        assert_ne!(second.frame(&device).unwrap().texels, before.texels);
        assert_same(&first.frame(&device).unwrap(), &before);
        drop((first, second));
        renderer.expose(&subject.view, &subject.settings, watch).unwrap();
        assert_eq!(renderer.films.len(), 2);
    }

    #[test]
    fn a_frame_of_the_host_comes_back_as_it_was() {
        let subject = Subject::new("whitted.toml", [20, 14], 2);
        let Some((device, _)) = shared(&subject) else { return };
        let frame = subject.on_cpu();
        assert_same(&Exposure::of_frame(&device, &frame).unwrap().frame(&device).unwrap(), &frame);
    }
}
