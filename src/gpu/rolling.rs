//! Pictures that follow a moving camera on a device that cannot keep up with it.
//!
//! Such a device is not to begin the picture anew with each step of the camera, or its lower part would never come; nor to
//! finish what was asked for long ago. So each step goes on where the last one was broken off, in the same film, round and
//! round: every block shows the view that was asked for last when its turn came. This is frameless rendering (Bishop,
//! Fuchs, McMillan, Zagier: Frameless Rendering: Double Buffering Considered Harmful, SIGGRAPH 1994) with blocks in order in
//! place of pixels at random.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::exposure::{Exposure, Watch, blank, first_pace, trace_next, whole};
use super::{GpuError, GpuRenderer, Variant};
use crate::film::{RayCounts, TraceTimes};
use crate::layout::{Settings, View};

/// What a submission is meant to take while somebody waits for its pixels.
const SUBMISSION: Duration = Duration::from_millis(10);

/// A picture of one sample a pixel that follows a camera.
pub struct Rolling {
    /// What there is of it; once complete it stays so, and its film is written to while it is looked at.
    pub exposure: Exposure,
    /// The part of it that shows the view asked for last, 0 to 1.
    pub share: f64,
    variant: Variant,
    /// The block whose turn it is.
    next: u32,
}

impl Rolling {
    fn begin(exposure: Exposure, variant: Variant) -> Self {
        Self { exposure, share: 0.0, variant, next: 0 }
    }

    /// Whether a view can be traced over what is there.
    fn takes(&self, view: &View, variant: &Variant) -> bool {
        let film = &self.exposure.film;
        self.variant == *variant && view.crop[2..] == [film.width, film.height]
    }
}

impl GpuRenderer {
    /// Trace a view, one sample a pixel, over the last one where that has the same size and is traced alike, from the block
    /// on at which that was broken off. `watch` hears after each tile but the last. When all blocks show the view the
    /// picture is that of [`expose`](Self::expose), bit for bit.
    ///
    /// # Errors
    /// As of `expose`.
    pub fn roll(
        &mut self,
        last: Option<Rolling>,
        view: &View,
        settings: &Settings,
        watch: Watch<'_>,
    ) -> Result<Rolling, GpuError> {
        let start = Instant::now();
        let settings = &Settings { adaptive: None, ..*settings };
        let variant = self.variant(settings);
        let view = &View { samples: 1, ..self.plan(settings).applied_to(view) };
        let known = self.pace.take().filter(|(of, _)| *of == variant);
        let last = last.filter(|last| last.takes(view, &variant));
        let job = match &last {
            Some(last) => self.prepare_on(Arc::clone(&last.exposure.film.buffer), view, &variant)?,
            None => self.prepare(view, &variant)?,
        };
        whole(&job)?;
        let blocks = job.blocks.count();
        let pace = known.map_or_else(|| first_pace(&job, &variant), |(_, pace)| pace);
        let mut pace = pace.aiming_at(SUBMISSION).again(blocks, 1);
        let mut rolling = last.unwrap_or_else(|| Rolling::begin(blank(&job.film, view, &variant), variant));
        let exposure = &mut rolling.exposure;
        exposure.rays = RayCounts::default();
        exposure.times = TraceTimes { compile: start.elapsed(), ..TraceTimes::default() };
        let (first, mut done) = (rolling.next, 0);
        'round: for (begin, end) in [(first, blocks), (0, first)] {
            pace = pace.from(begin);
            while let Some(tile) = trace_next(&job, &mut pace, end, 0, exposure)? {
                rolling.next = (tile.first_block + tile.block_count) % blocks;
                done += tile.block_count;
                if done < blocks && watch(exposure) == ControlFlow::Break(()) {
                    break 'round;
                }
            }
        }
        rolling.share = f64::from(done) / f64::from(blocks.max(1));
        self.pace = Some((variant, pace));
        Ok(rolling)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use super::super::SharedDevice;
    use super::super::testing::{Subject, assert_same, find};
    use super::*;
    use crate::film::Frame;

    /// A picture of 5 by 4 blocks, and the same from further off.
    fn views() -> Option<(Subject, View, SharedDevice, GpuRenderer)> {
        let subject = Subject::new("whitted.toml", [40, 30], 1);
        let device = SharedDevice::new(&find("llvmpipe")?).unwrap();
        let renderer = GpuRenderer::on(&device, &subject.scene).unwrap();
        let eye = subject.view.eye.map(|x| x * 1.1);
        let other = View { eye, ..subject.view };
        Some((subject, other, device, renderer))
    }

    fn exposed(renderer: &mut GpuRenderer, view: &View, subject: &Subject, device: &SharedDevice) -> Frame {
        let exposure = renderer.expose(view, &subject.settings, &|_| ControlFlow::Continue(())).unwrap();
        exposure.frame(device).unwrap()
    }

    /// Pixels that are those of a picture.
    fn equal(frame: &Frame, of: &Frame) -> Vec<bool> {
        frame.texels.iter().zip(&of.texels).map(|(a, b)| a == b).collect()
    }

    #[test]
    fn a_round_that_is_not_broken_off_gives_the_picture() {
        let Some((subject, _, device, mut renderer)) = views() else { return };
        let rolling =
            renderer.roll(None, &subject.view, &subject.settings, &|_| ControlFlow::Continue(())).unwrap();
        assert!(rolling.exposure.is_complete() && rolling.share == 1.0);
        let expected = exposed(&mut renderer, &subject.view, &subject, &device);
        assert_same(&rolling.exposure.frame(&device).unwrap(), &expected);
    }

    #[test]
    fn each_round_goes_on_where_the_last_one_was_broken_off() {
        let Some((subject, other, device, mut renderer)) = views() else { return };
        let pictures = [&subject.view, &other].map(|view| exposed(&mut renderer, view, &subject, &device));
        let heard = AtomicU32::new(0);
        // After two tiles.
        let brief = |_: &Exposure| match heard.fetch_add(1, Ordering::Relaxed) % 2 {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        };
        let all = |_: &Exposure| ControlFlow::Continue(());
        let first = renderer.roll(None, &subject.view, &subject.settings, &brief).unwrap();
        let (share, next) = (first.share, first.next);
        assert!(share > 0.0 && share < 1.0 && !first.exposure.is_complete());
        assert_eq!((first.exposure.passes, first.exposure.blocks), (0, next));
        // The whole round is of the second view, though the first blocks were there.
        let second = renderer.roll(Some(first), &other, &subject.settings, &all).unwrap();
        assert!(second.exposure.is_complete() && second.share == 1.0 && second.next == next);
        assert_same(&second.exposure.frame(&device).unwrap(), &pictures[1]);
        // A part of the first over the second.
        let third = renderer.roll(Some(second), &subject.view, &subject.settings, &brief).unwrap();
        assert!(third.exposure.is_complete() && third.share < 1.0 && third.next != next);
        let mixed = third.exposure.frame(&device).unwrap();
        let (new, old) = (equal(&mixed, &pictures[0]), equal(&mixed, &pictures[1]));
        assert!(new.iter().zip(&old).all(|(new, old)| *new || *old));
        assert!(new.contains(&false) && old.contains(&false));
        // What comes last has all of it again.
        let fourth = renderer.roll(Some(third), &subject.view, &subject.settings, &all).unwrap();
        assert_same(&fourth.exposure.frame(&device).unwrap(), &pictures[0]);
    }

    #[test]
    fn another_size_begins_anew() {
        let Some((subject, _, _, mut renderer)) = views() else { return };
        let stop = |_: &Exposure| ControlFlow::Break(());
        let first = renderer.roll(None, &subject.view, &subject.settings, &stop).unwrap();
        let small = Subject::new("whitted.toml", [24, 16], 1);
        let second = renderer.roll(Some(first), &small.view, &subject.settings, &stop).unwrap();
        assert_eq!([second.exposure.film.width, second.exposure.film.height], [24, 16]);
        assert!(!second.exposure.is_complete());
    }
}
