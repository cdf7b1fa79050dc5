//! What the host does before and after the rays, whatever traces them.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::bench::effects::milliseconds;
use crate::bench::{BenchError, median};
use crate::cpu::thread_pool;
use crate::film::{BitDepth, Development, Frame, Metadata, encode_png};
use crate::flatten::flatten;
use crate::scene::Scene;

/// Times that reading a scene and writing its picture are repeated, for a median.
const REPEATS: usize = 3;
/// No repetition begins after so long.
const PATIENCE: Duration = Duration::from_secs(1);

/// Median times in milliseconds of reading and flattening a scene, and of its tree, with so many threads; 0 for all.
pub(super) fn preparation(path: &Path, threads: usize) -> Result<(f64, f64), BenchError> {
    let pool = thread_pool(threads)?;
    let begun = Instant::now();
    let (mut loads, mut trees) = (Vec::new(), Vec::new());
    while loads.is_empty() || (loads.len() < REPEATS && begun.elapsed() < PATIENCE) {
        let started = Instant::now();
        let flat = pool.install(|| flatten(&Scene::load(path)?))?;
        loads.push(started.elapsed().saturating_sub(flat.bvh_time));
        trees.push(flat.bvh_time);
    }
    Ok((milliseconds(median(&loads)), milliseconds(median(&trees))))
}

/// The median time in milliseconds of making a PNG of a picture.
pub(super) fn encode_time(picture: &Frame) -> Result<f64, BenchError> {
    let mut times = Vec::new();
    for _ in 0..REPEATS {
        let started = Instant::now();
        let display = Development::default().apply(&picture.radiance());
        encode_png(picture.width, picture.height, &display, BitDepth::default(), &Metadata::new())?;
        times.push(started.elapsed());
    }
    Ok(milliseconds(median(&times)))
}
