//! How rays of the f32 CPU path go through a scene: eight boxes or triangles at a time.
//!
//! [`WideBvh`] is collapsed from the binary tree of the scene: nodes of up to eight children with boxes in full precision,
//! leaves of up to eight triangles, both as arrays of lanes, four cache lines a node and five a leaf. The kernels are written
//! once over `simd::Simd` and compiled for AVX-512, AVX2 and what the target has anyway; which of them runs is decided
//! when the tree is made. A stream goes as packets of as many rays as there are lanes: those of one octant and axis meet
//! a node as a beam, by interval arithmetic, then each for itself.
//!
//! **The bits are the scalar kernel's.** [`kernel::bvh`](crate::kernel::bvh) says why no tree shows: a triangle counts where
//! its own box is hit, no nearer than that box's entry, and no box that holds it is entered later. So a traversal need only
//! (1) never cull a box that the scalar slab test enters before the best distance, and (2) compute a triangle's hit by the
//! same operations in the same order. Boxes are tested by the scalar's operations, less the comparison of both planes, whose
//! outcome the direction tells; a beam by the same operations on its extremes, which rounding keeps in order. The raise to
//! the own box is computed only for triangles whose edges the ray passes, not after the best hit.

mod beam;
mod bests;
mod layout;
mod packet;
mod pages;
mod ray;
mod simd;
mod single;
mod stack;
mod stream;
#[cfg(test)]
mod tests;
mod tree;
mod triangle;
#[cfg(target_arch = "x86_64")]
mod x86;

use crate::kernel::bvh::{Hit, Ray, is_usable};
use crate::layout::constants::NONE;
use crate::layout::{Node, Triangle};
use bests::Bests;
use layout::WIDTH;
pub use packet::Cast;
use packet::Packet;
use ray::Spread;
use simd::{Portable, Simd, Task};
use single::Best;
use tree::Tree;
#[cfg(target_arch = "x86_64")]
use x86::{Avx2, Avx512};

/// The instructions that a tree is traced with.
#[derive(Debug, Clone, Copy)]
enum Level {
    Portable(Portable),
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(Avx512),
}

impl Level {
    /// All that this processor has, the best last.
    fn available() -> Vec<Self> {
        let levels = vec![Self::Portable(Portable)];
        #[cfg(target_arch = "x86_64")]
        let levels = levels
            .into_iter()
            .chain(Avx2::detect().map(Self::Avx2))
            .chain(Avx512::detect().map(Self::Avx512))
            .collect();
        levels
    }

    #[inline(always)]
    fn run<T: Task>(self, task: T) -> T::Output {
        match self {
            Self::Portable(s) => task.run::<WIDTH, _, _>(s, s),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(s) => s.run(task),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(s) => s.run(task),
        }
    }
}

/// A tree of eight children a node, and the instructions that it is traced with.
#[derive(Debug, Clone)]
pub struct WideBvh {
    tree: Tree,
    level: Level,
}

impl WideBvh {
    /// Collapse a binary tree, whose triangles stand in the order of its leaves.
    #[must_use]
    pub fn new(nodes: &[Node], triangles: &[Triangle]) -> Self {
        let best = Level::available().pop().unwrap_or(Level::Portable(Portable));
        Self { tree: Tree::new(nodes, triangles), level: best }
    }

    /// Memory of nodes and triangles, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.tree.bytes()
    }

    /// The name of the instructions in use.
    #[must_use]
    pub fn instructions(&self) -> &'static str {
        match self.level {
            Level::Portable(_) => "portable",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => "AVX2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => "AVX-512",
        }
    }

    /// The nearest triangle in (0, limit), ties to the lowest primitive id: the bits of
    /// [`bvh::intersect`](crate::kernel::bvh::intersect), `index` into the triangles that the tree was made of.
    #[must_use]
    #[inline]
    pub fn intersect(&self, ray: &Ray<f32>, limit: f32) -> Hit<f32> {
        let hit = self.nearest(ray, limit);
        if hit.id == NONE { hit } else { Hit { index: self.tree.index(hit.index), ..hit } }
    }

    /// [`intersect`](Self::intersect), but for `index`: it is for [`triangle`](Self::triangle).
    #[inline]
    pub(super) fn nearest(&self, ray: &Ray<f32>, limit: f32) -> Hit<f32> {
        let miss = Hit { t: limit, id: NONE, index: NONE, b1: 0.0, b2: 0.0, front: false };
        if !is_usable(ray) {
            return miss;
        }
        let best = self.level.run(Closest { tree: &self.tree, ray, limit });
        if best.place == NONE {
            return miss;
        }
        Hit {
            t: best.t,
            id: best.id,
            index: best.place,
            b1: best.b1,
            b2: best.b2,
            front: best.turns == (ray.shear.by.z > 0.0),
        }
    }

    /// A triangle as it lies in its leaf.
    #[inline]
    pub(super) fn triangle(&self, place: u32) -> Triangle {
        self.tree.triangle(place)
    }

    /// Whether any triangle lies in (0, limit), as [`bvh::occluded`](crate::kernel::bvh::occluded) says.
    #[must_use]
    #[inline]
    pub fn occluded(&self, ray: &Ray<f32>, limit: f32) -> bool {
        is_usable(ray) && self.level.run(Any { tree: &self.tree, ray, limit })
    }

    /// [`intersect`](Self::intersect) for each ray of a stream, into as many `hits`. Fast where neighbours go the same way.
    pub fn intersect_stream(&self, casts: &[Cast], hits: &mut [Hit<f32>]) {
        self.level.run(ClosestStream { tree: &self.tree, casts, hits });
    }

    /// [`occluded`](Self::occluded) for each ray of a stream.
    pub fn occluded_stream(&self, casts: &[Cast], blocked: &mut [bool]) {
        self.level.run(AnyStream { tree: &self.tree, casts, blocked });
    }
}

struct Closest<'a> {
    tree: &'a Tree,
    ray: &'a Ray<f32>,
    limit: f32,
}

impl Task for Closest<'_> {
    type Output = Best;

    #[inline(always)]
    fn run<const N: usize, W: Simd<WIDTH>, S: Simd<N>>(self, w: W, _: S) -> Best {
        let mut best = Best::none(self.limit);
        single::closest(w, self.tree, &Spread::new(w, self.ray), Tree::ROOT, &mut best);
        best
    }
}

struct Any<'a> {
    tree: &'a Tree,
    ray: &'a Ray<f32>,
    limit: f32,
}

impl Task for Any<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<const N: usize, W: Simd<WIDTH>, S: Simd<N>>(self, w: W, _: S) -> bool {
        single::any(w, self.tree, &Spread::new(w, self.ray), Tree::ROOT, self.limit)
    }
}

struct ClosestStream<'a> {
    tree: &'a Tree,
    casts: &'a [Cast],
    hits: &'a mut [Hit<f32>],
}

impl Task for ClosestStream<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const N: usize, W: Simd<WIDTH>, S: Simd<N>>(self, w: W, s: S) {
        for (casts, hits) in self.casts.chunks(N).zip(self.hits.chunks_mut(N)) {
            let packet = Packet::<N>::new(s, casts, self.tree);
            let mut bests = Bests::none(&packet);
            let mut left = packet.usable();
            while left != 0 {
                let group = packet.group(left);
                stream::closest(w, s, self.tree, &packet, group, &mut bests);
                left &= !group;
            }
            for (lane, hit) in hits.iter_mut().enumerate() {
                *hit = bests.hit(self.tree, &packet, lane);
            }
        }
    }
}

struct AnyStream<'a> {
    tree: &'a Tree,
    casts: &'a [Cast],
    blocked: &'a mut [bool],
}

impl Task for AnyStream<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const N: usize, W: Simd<WIDTH>, S: Simd<N>>(self, w: W, s: S) {
        for (casts, blocked) in self.casts.chunks(N).zip(self.blocked.chunks_mut(N)) {
            let packet = Packet::<N>::new(s, casts, self.tree);
            let (mut left, mut bits) = (packet.usable(), 0);
            while left != 0 {
                let group = packet.group(left);
                bits |= stream::any(w, s, self.tree, &packet, group);
                left &= !group;
            }
            for (lane, blocked) in blocked.iter_mut().enumerate() {
                *blocked = bits >> lane & 1 == 1;
            }
        }
    }
}
