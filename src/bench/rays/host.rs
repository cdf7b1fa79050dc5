//! Rays on the CPU.

use std::time::{Duration, Instant};

use rayon::ThreadPool;
use rayon::prelude::*;
use serde::Serialize;

use super::{RayAnswer, RayRecord, RayStage};
use crate::cpu::Cast;
use crate::kernel::Vec3;
use crate::kernel::bvh::{Hit, make_ray};
use crate::layout::constants::NONE;

/// Rays that a thread takes at a time.
const CHUNK: usize = 4096;

/// Rays that are handed to the stream kernel at a time.
const STREAM: usize = 64;

/// What is asked of a ray.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Query {
    /// Where it first hits.
    Nearest,
    /// Whether it hits.
    Any,
}

/// How rays are handed to the kernel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Mode {
    /// One by one.
    Single,
    /// As a stream, of which neighbours go together as long as they go the same way.
    Coherent,
}

/// A set of rays, ready to be traced by the CPU with some threads.
pub struct RayHost<'a> {
    stage: &'a RayStage,
    rays: &'a [RayRecord],
    query: Query,
    mode: Mode,
    pool: &'a ThreadPool,
    found: Vec<RayAnswer>,
}

impl<'a> RayHost<'a> {
    /// Make room for the answers.
    #[must_use]
    pub fn new(
        stage: &'a RayStage,
        rays: &'a [RayRecord],
        query: Query,
        mode: Mode,
        pool: &'a ThreadPool,
    ) -> Self {
        Self { stage, rays, query, mode, pool, found: vec![RayAnswer::MISS; rays.len()] }
    }

    /// Trace them, and tell how long that took.
    pub fn trace(&mut self) -> Duration {
        let Self { stage, rays, query, mode, pool, found } = self;
        let chunks = || {
            let pairs = rays.par_chunks(CHUNK).zip(found.par_chunks_mut(CHUNK));
            pairs.for_each(|(rays, found)| match mode {
                Mode::Single => one_by_one(stage, rays, *query, found),
                Mode::Coherent => as_stream(stage, rays, *query, found),
            });
        };
        let started = Instant::now();
        pool.install(chunks);
        started.elapsed()
    }

    /// What the last trace found, in the order of the rays; all misses before the first.
    #[must_use]
    pub fn answers(&self) -> &[RayAnswer] {
        &self.found
    }

    /// How rays are handed over.
    pub(super) fn mode(&self) -> Mode {
        self.mode
    }

    pub(super) fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }
}

fn one_by_one(stage: &RayStage, rays: &[RayRecord], query: Query, found: &mut [RayAnswer]) {
    let world = stage.world();
    for (ray, found) in rays.iter().zip(found) {
        let made = make_ray(&world, Vec3::load(ray.origin), Vec3::load(ray.direction), NONE);
        *found = match query {
            Query::Nearest => RayAnswer::nearest(&stage.wide.intersect(&made, ray.tmax)),
            Query::Any => RayAnswer::any(stage.wide.occluded(&made, ray.tmax)),
        };
    }
}

fn as_stream(stage: &RayStage, rays: &[RayRecord], query: Query, found: &mut [RayAnswer]) {
    let mut casts = [Cast { origin: [0.0; 3], limit: 0.0, direction: [0.0; 3], origin_face: NONE }; STREAM];
    let mut hits = [Hit { t: 0.0, id: NONE, index: NONE, b1: 0.0, b2: 0.0, front: false }; STREAM];
    let mut blocked = [false; STREAM];
    for (rays, found) in rays.chunks(STREAM).zip(found.chunks_mut(STREAM)) {
        let casts = &mut casts[..rays.len()];
        casts.iter_mut().zip(rays).for_each(|(cast, ray)| *cast = ray.into());
        match query {
            Query::Nearest => {
                stage.wide.intersect_stream(casts, &mut hits[..rays.len()]);
                found.iter_mut().zip(&hits).for_each(|(found, hit)| *found = RayAnswer::nearest(hit));
            }
            Query::Any => {
                stage.wide.occluded_stream(casts, &mut blocked[..rays.len()]);
                found.iter_mut().zip(&blocked).for_each(|(found, &blocked)| *found = RayAnswer::any(blocked));
            }
        }
    }
}
