//! Adaptive antialiasing on the CPU: rounds over the film, of which each refines the pixels that the last one told.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::film::{Frame, Progress, RayCounts, SampleCounts, TraceTimes};
use crate::kernel::adaptive::{round_end, surroundings, wants_more};
use crate::kernel::whitted::trace_pixel;
use crate::kernel::{Real, Simulation, World, film};
use crate::layout::{Aov, Float, Settings, Statistics, Texel, Tile, View, refinement_rounds};

/// Pixels that a thread takes at a time.
const CHUNK: usize = 256;

/// Trace the view, refined where one more sample of a pixel is worth more than the threshold.
///
/// The crop is traced with a border as wide as pixels learn from each other, so that it is a part of the whole. A stop
/// settles every pixel with the samples that it has.
pub(super) fn render_adaptive<R: Real, S: Simulation>(
    world: &World<S>,
    settings: &Settings,
    threshold: f32,
    progress: &dyn Progress,
) -> Frame {
    let started = Instant::now();
    let asked = world.view;
    let rounds = refinement_rounds(asked.samples);
    let view = asked.grown(rounds);
    let world = World { view: &view, ..*world };
    let mut film = Film::new(&world, progress);
    let mut flow = film.trace::<R>();
    for round in 0..rounds {
        let tile = Tile { round, threshold, ..Tile::default() };
        if flow == ControlFlow::Break(()) || !film.sift(&tile) {
            break;
        }
        flow = film.trace::<R>();
    }
    film.settle();
    let frame = Frame {
        width: view.crop[2],
        height: view.crop[3],
        samples: SampleCounts::Each(film.statistics.iter().map(|one| one.samples).collect()),
        texels: film.texels,
        aovs: settings.aovs.then_some(film.aovs),
        float: Float::Strict,
        rays: film.rays,
        times: TraceTimes { trace: started.elapsed().max(Duration::from_nanos(1)), ..TraceTimes::default() },
        complete: flow == ControlFlow::Continue(()),
    };
    frame.part(asked.crop_within(&view))
}

/// A picture in work.
struct Film<'a, S> {
    world: &'a World<'a, S>,
    progress: &'a dyn Progress,
    texels: Vec<Texel>,
    aovs: Vec<Aov>,
    statistics: Vec<Statistics>,
    rays: RayCounts,
    /// The greatest progress told.
    told: AtomicU64,
}

impl<'a, S: Simulation> Film<'a, S> {
    /// A black one, of which every pixel is to be traced.
    fn new(world: &'a World<'a, S>, progress: &'a dyn Progress) -> Self {
        let [_, _, width, height] = world.view.crop;
        let pixels = width as usize * height as usize;
        Self {
            world,
            progress,
            texels: vec![Texel::default(); pixels],
            aovs: vec![Aov::default(); pixels],
            statistics: vec![Statistics { listed: 1, ..Statistics::default() }; pixels],
            rays: RayCounts::default(),
            told: AtomicU64::new(0),
        }
    }

    /// Trace this round's samples of the listed pixels.
    fn trace<R: Real>(&mut self) -> ControlFlow<()> {
        let Self { world, progress, .. } = *self;
        let View { crop: [left, top, width, _], samples: limit, .. } = *world.view;
        let total = self.statistics.len() as u64 * u64::from(limit);
        let spared = self.statistics.iter().filter(|one| one.listed == 0).count() as u64 * u64::from(limit);
        let done = AtomicU64::new(spared);
        let told = &self.told;
        let stop = AtomicBool::new(false);
        let chunks = (
            self.texels.par_chunks_mut(CHUNK),
            self.aovs.par_chunks_mut(CHUNK),
            self.statistics.par_chunks_mut(CHUNK),
        );
        let trace_chunk = |stack: &mut Vec<_>, (chunk, (texels, aovs, statistics)): (usize, Chunk<'_>)| {
            let mut rays = [0; 4];
            let mut samples = 0;
            if stop.load(Ordering::Relaxed) {
                return rays;
            }
            let pixels = texels.iter_mut().zip(aovs).zip(statistics);
            for (slot, ((texel, aov), one)) in (chunk * CHUNK..).zip(pixels) {
                if one.listed == 0 {
                    continue;
                }
                let slot = slot as u32;
                let pixel = [left + slot % width, top + slot / width];
                let range = one.start..round_end(one.start, limit);
                let traced = trace_pixel::<R>(world, stack, pixel, range, texel, aov, Some(one));
                rays.iter_mut().zip(traced).for_each(|(sum, n)| *sum += u64::from(n));
                samples += u64::from(one.samples);
            }
            let done = done.fetch_add(samples, Ordering::Relaxed) + samples;
            // Pixels that are taken up again do not turn it back.
            let told = told.fetch_max(done, Ordering::Relaxed).max(done);
            if progress.advance(told, total) == ControlFlow::Break(()) {
                stop.store(true, Ordering::Relaxed);
            }
            rays
        };
        let rays = chunks
            .into_par_iter()
            .enumerate()
            .map_init(Vec::new, trace_chunk)
            .reduce(|| [0; 4], |a: [u64; 4], b| [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]);
        self.rays.add(rays);
        if stop.into_inner() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// List the pixels that the tile's round refines; false if there are none.
    fn sift(&mut self, tile: &Tile) -> bool {
        let View { crop: [_, _, width, height], samples: limit, .. } = *self.world.view;
        let film = &self.statistics;
        let wanted: Vec<bool> = (0..film.len() as u32)
            .into_par_iter()
            .map(|slot| {
                let around = surroundings(film, [width, height], [slot % width, slot / width]);
                wants_more(&film[slot as usize], &around, tile, limit)
            })
            .collect();
        for (one, &wanted) in self.statistics.iter_mut().zip(&wanted) {
            one.start = one.samples;
            one.listed = u32::from(wanted);
        }
        wanted.contains(&true)
    }

    /// Divide every pixel's sums.
    fn settle(&mut self) {
        for (texel, one) in self.texels.iter_mut().zip(&self.statistics).filter(|(_, one)| one.samples != 0) {
            film::settle(texel, one.samples);
        }
    }
}

/// Pixels that one thread traces.
type Chunk<'a> = (&'a mut [Texel], &'a mut [Aov], &'a mut [Statistics]);
