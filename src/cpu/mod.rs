//! The CPU renderer: rayon over tiles, around [`kernel::whitted`](crate::kernel::whitted).

mod adaptive;
mod order;
mod through;
mod wide;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::film::{Frame, Progress, RayCounts, Renderer, SampleCounts, TraceTimes};
use crate::kernel::whitted::{Branch, trace_pixel};
use crate::kernel::{Real, Simulation, Within, World};
use crate::layout::{
    Aov, Effect, EffectSet, FlatScene, Float, Intersector, Precision, Scan, Settings, Texel, View,
};

pub use order::morton_order;
use through::Through;
pub use wide::{Cast, WideBvh};

/// Side of a tile in pixels, if none is asked for: small enough to balance the end of a frame, large enough to amortise
/// its bookkeeping.
const TILE: u32 = 16;

/// What scenes of paint call for. They have a kernel of their own, without the code of all other effects: 8 % faster on
/// `scenes/opaque.toml`. One for scenes without transmission was measured too and gained nothing on `scenes/mirrors.toml`:
/// the processor foresees its branches.
const PAINT: EffectSet = EffectSet::of(&[
    Effect::Shadows,
    Effect::Specular,
    Effect::SmoothNormals,
    Effect::Antialiasing,
    Effect::Aovs,
]);

/// The CPU cannot start its threads.
#[derive(Debug, thiserror::Error)]
#[error("cannot start {threads} threads: {source}; try fewer with --threads")]
pub struct CpuError {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

/// So many threads; 0 for one a core (or `RAYON_NUM_THREADS`).
///
/// # Errors
/// If the operating system gives no threads.
pub fn thread_pool(threads: usize) -> Result<rayon::ThreadPool, CpuError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|source| CpuError { threads, source })
}

/// Traces a scene on the CPU. The picture does not depend on the number of threads.
pub struct CpuRenderer<'a> {
    scene: &'a FlatScene,
    /// What the scene calls for.
    scan: Scan,
    pool: rayon::ThreadPool,
    tile: u32,
    /// The scene's tree for rays in f32, from the first of them on.
    wide: OnceLock<Box<WideBvh>>,
}

impl<'a> CpuRenderer<'a> {
    /// Use `threads` threads; 0 for one a core (or `RAYON_NUM_THREADS`).
    ///
    /// # Errors
    /// If the operating system gives no threads.
    pub fn new(scene: &'a FlatScene, threads: usize) -> Result<Self, CpuError> {
        Self::with_tile(scene, threads, TILE)
    }

    /// The same in tiles of `tile` pixels, ≥ 1, by as many: how work is shared out, which no picture shows.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_tile(scene: &'a FlatScene, threads: usize, tile: u32) -> Result<Self, CpuError> {
        Ok(Self {
            scene,
            scan: Scan::of(scene),
            pool: thread_pool(threads)?,
            tile: tile.max(1),
            wide: OnceLock::new(),
        })
    }

    fn wide(&self) -> &WideBvh {
        self.wide.get_or_init(|| Box::new(WideBvh::new(&self.scene.nodes, &self.scene.triangles)))
    }

    /// How many threads trace.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }
}

impl Renderer for CpuRenderer<'_> {
    type Error = CpuError;

    fn render(
        &mut self,
        view: &View,
        settings: &Settings,
        progress: &dyn Progress,
    ) -> Result<Frame, CpuError> {
        let plan = self.scan.effects(settings).plan(settings);
        let view = &plan.applied_to(view);
        let effects = plan.effects;
        let world = World { scene: self.scene, view, intersector: settings.intersector, effects };
        Ok(self.pool.install(|| match (settings.precision, settings.intersector) {
            (Precision::F32, Intersector::Watertight) if PAINT.has_all(effects) => {
                let effects = Within::<{ PAINT.bits() }>(effects);
                let world = world.simulating(Through { effects, tree: self.wide() });
                render::<f32>(&world, settings, self.tile, progress)
            }
            (Precision::F32, Intersector::Watertight) => {
                let world = world.simulating(Through { effects, tree: self.wide() });
                render::<f32>(&world, settings, self.tile, progress)
            }
            (Precision::F32, Intersector::MollerTrumbore) => {
                render::<f32>(&world, settings, self.tile, progress)
            }
            (Precision::F64, _) => render::<f64>(&world, settings, self.tile, progress),
        }))
    }
}

fn render<R: Real>(
    world: &World<impl Simulation>,
    settings: &Settings,
    side: u32,
    progress: &dyn Progress,
) -> Frame {
    match settings.threshold().filter(|_| world.simulates(Effect::Adaptive)) {
        Some(threshold) => adaptive::render_adaptive::<R, _>(world, settings, threshold, progress),
        None => render_uniform::<R>(world, settings, side, progress),
    }
}

/// One tile's pixels, row by row.
struct Tile {
    x: u32,
    y: u32,
    width: u32,
    texels: Vec<Texel>,
    aovs: Vec<Aov>,
    rays: [u64; 4],
}

fn render_uniform<R: Real>(
    world: &World<impl Simulation>,
    settings: &Settings,
    side: u32,
    progress: &dyn Progress,
) -> Frame {
    let [_, _, width, height] = world.view.crop;
    let pixels = width as usize * height as usize;
    let frame = Mutex::new(Frame {
        width,
        height,
        texels: vec![Texel::default(); pixels],
        samples: SampleCounts::Same(world.view.samples),
        aovs: settings.aovs.then(|| vec![Aov::default(); pixels]),
        float: Float::Strict,
        rays: RayCounts::default(),
        times: TraceTimes::default(),
        complete: true,
    });
    let started = Instant::now();
    let tiles = morton_order(width.div_ceil(side), height.div_ceil(side));
    let done = AtomicU64::new(0);
    let stop = AtomicBool::new(false);
    // One by one, so that none waits behind another at the end of the frame.
    tiles.par_iter().with_max_len(1).for_each_init(Vec::new, |stack, &place| {
        if stop.load(Ordering::Relaxed) {
            return;
        }
        let tile = trace_tile::<R>(world, stack, side, place);
        // Nothing panics while the lock is held.
        let mut frame = frame.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        paste(&mut frame, &tile);
        drop(frame);
        let finished = done.fetch_add(1, Ordering::Relaxed) + 1;
        if progress.advance(finished, tiles.len() as u64) == ControlFlow::Break(()) {
            stop.store(true, Ordering::Relaxed);
        }
    });
    let mut frame = frame.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    frame.complete = done.into_inner() == tiles.len() as u64;
    frame.times =
        TraceTimes { trace: started.elapsed().max(Duration::from_nanos(1)), ..TraceTimes::default() };
    frame
}

fn trace_tile<R: Real>(
    world: &World<impl Simulation>,
    stack: &mut Vec<Branch<R>>,
    side: u32,
    [column, row]: [u32; 2],
) -> Tile {
    let [left, top, width, height] = world.view.crop;
    let (x, y) = (column * side, row * side);
    let (w, h) = (side.min(width - x), side.min(height - y));
    let mut tile = Tile {
        x,
        y,
        width: w,
        texels: vec![Texel::default(); (w * h) as usize],
        aovs: vec![Aov::default(); (w * h) as usize],
        rays: [0; 4],
    };
    for i in 0..w * h {
        let pixel = [left + x + i % w, top + y + i / w];
        let rays = trace_pixel(
            world,
            stack,
            pixel,
            0..world.view.samples,
            &mut tile.texels[i as usize],
            &mut tile.aovs[i as usize],
            None,
        );
        for (sum, n) in tile.rays.iter_mut().zip(rays) {
            *sum += u64::from(n);
        }
    }
    tile
}

fn paste(frame: &mut Frame, tile: &Tile) {
    let width = tile.width as usize;
    for (row, texels) in tile.texels.chunks(width).enumerate() {
        let first = (tile.y as usize + row) * frame.width as usize + tile.x as usize;
        frame.texels[first..first + width].copy_from_slice(texels);
        if let Some(aovs) = &mut frame.aovs {
            aovs[first..first + width].copy_from_slice(&tile.aovs[row * width..(row + 1) * width]);
        }
    }
    frame.rays.add(tile.rays);
}
