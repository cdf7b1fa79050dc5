//! Rays on the CPU.

use std::time::{Duration, Instant};

use rayon::ThreadPool;
use rayon::prelude::*;
use serde::Serialize;

use super::RayAnswer;
use crate::cpu::{Cast, WideBvh};
use crate::kernel::bvh::{Hit, Ray, make_ray};
use crate::kernel::{Vec3, World};
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
    world: World<'a>,
    tree: &'a WideBvh,
    rays: &'a [Cast],
    query: Query,
    mode: Mode,
    pool: &'a ThreadPool,
    found: Vec<RayAnswer>,
}

impl<'a> RayHost<'a> {
    /// Make room for the answers. The tree is that of the world's triangles.
    #[must_use]
    pub fn new(
        world: World<'a>,
        tree: &'a WideBvh,
        rays: &'a [Cast],
        query: Query,
        mode: Mode,
        pool: &'a ThreadPool,
    ) -> Self {
        Self { world, tree, rays, query, mode, pool, found: vec![RayAnswer::MISS; rays.len()] }
    }

    /// Trace them, and tell how long that took.
    pub fn trace(&mut self) -> Duration {
        let Self { world, tree, rays, query, mode, pool, found } = self;
        let chunks = || {
            let pairs = rays.par_chunks(CHUNK).zip(found.par_chunks_mut(CHUNK));
            // Each for itself: else rayon hands out rows of them, up to a quarter of all, and a thread waits at the end.
            pairs.with_max_len(1).for_each(|(rays, found)| match mode {
                Mode::Single => one_by_one(world, tree, rays, *query, found),
                Mode::Coherent => as_stream(tree, rays, *query, found),
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

fn one_by_one(world: &World<'_>, tree: &WideBvh, rays: &[Cast], query: Query, found: &mut [RayAnswer]) {
    for (cast, found) in rays.iter().zip(found) {
        let ray = prepared(world, cast);
        *found = match query {
            Query::Nearest => RayAnswer::nearest(&tree.intersect(&ray, cast.limit)),
            Query::Any => RayAnswer::any(tree.occluded(&ray, cast.limit)),
        };
    }
}

/// The kernel's ray.
#[inline(always)]
pub(super) fn prepared(world: &World<'_>, cast: &Cast) -> Ray<f32> {
    make_ray(world, Vec3::load(cast.origin), Vec3::load(cast.direction), cast.origin_face)
}

fn as_stream(tree: &WideBvh, rays: &[Cast], query: Query, found: &mut [RayAnswer]) {
    let mut hits = [Hit { t: 0.0, id: NONE, index: NONE, b1: 0.0, b2: 0.0, front: false }; STREAM];
    let mut blocked = [false; STREAM];
    for (rays, found) in rays.chunks(STREAM).zip(found.chunks_mut(STREAM)) {
        match query {
            Query::Nearest => {
                tree.intersect_stream(rays, &mut hits[..rays.len()]);
                found.iter_mut().zip(&hits).for_each(|(found, hit)| *found = RayAnswer::nearest(hit));
            }
            Query::Any => {
                tree.occluded_stream(rays, &mut blocked[..rays.len()]);
                found.iter_mut().zip(&blocked).for_each(|(found, &blocked)| *found = RayAnswer::any(blocked));
            }
        }
    }
}
