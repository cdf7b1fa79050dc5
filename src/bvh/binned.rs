//! The guaranteed builder: top down, binned surface area heuristic (Wald 2007, "On fast construction of
//! SAH-based bounding volume hierarchies"), with a median split wherever the depth would run out.

use glam::Vec4;
use rayon::prelude::*;

use super::aabb::unit_scale;
use super::tree::{Branch, Tree};
use super::{MAX_LEAF, NODE_COST};
use crate::layout::Triangle;
use crate::layout::constants::MAX_BVH_DEPTH;

/// Bins on each axis, at most; 16 is within a per cent of a full sweep (Wald 2007, section 4).
const BINS: usize = 16;
/// Bins over the fewest items, and items for which there is one more: most nodes are small, and clearing bins is what
/// they cost. The trees cost within half a per cent of those of 16 bins.
const LEAST_BINS: usize = 4;
const ITEMS_A_BIN: usize = 16;

/// Subtrees over fewer triangles are built by one thread.
const PARALLEL: usize = 8192;
/// Items that a thread looks at in a row where all threads look at the items of one node.
const CHUNK: usize = 16_384;

/// How far to split.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Leaves {
    /// Until the triangles fit into a leaf.
    Full,
    /// As long as it lessens the expected cost.
    Cheapest,
}

/// Build a tree of at most [`MAX_BVH_DEPTH`] levels with at most [`MAX_LEAF`] triangles a leaf, for any
/// triangles with finite corners. `triangles` is not empty; each node comes before its children.
pub(super) fn build(triangles: &[Triangle], leaves: Leaves) -> Tree {
    let scale = unit_scale(triangles);
    let item = |(index, triangle)| Item::new(triangle, scale, index as u32);
    let mut items: Vec<Item> = triangles.par_iter().enumerate().map(item).collect();
    let nodes = subtree(&mut items, 0, MAX_BVH_DEPTH, leaves);
    Tree { nodes, order: items.iter().map(Item::index).collect() }
}

/// The nodes over `items`, whose first stands at `offset` in the order; at most `levels` inner nodes follow
/// each other.
fn subtree(items: &mut [Item], offset: u32, levels: u32, leaves: Leaves) -> Vec<Branch> {
    if items.len() < PARALLEL {
        let mut grower =
            Grower { nodes: vec![Branch { first: 0, count: 0 }], gathered: Gathered::new(), leaves };
        grower.grow(0, items, offset, levels);
        return grower.nodes;
    }
    let middle = split(items, levels, leaves, &mut Gathered::new()).unwrap_or(items.len() / 2);
    let (left, right) = items.split_at_mut(middle);
    let (left, right) = rayon::join(
        || subtree(left, offset, levels - 1, leaves),
        || subtree(right, offset + middle as u32, levels - 1, leaves),
    );
    join(&left, &right)
}

/// The subtree that one thread builds, and what it gathers in for each node.
struct Grower {
    nodes: Vec<Branch>,
    gathered: Gathered,
    leaves: Leaves,
}

impl Grower {
    /// Write the node over `items` to its slot and everything below it to the end.
    fn grow(&mut self, slot: usize, items: &mut [Item], offset: u32, levels: u32) {
        let Some(middle) = split(items, levels, self.leaves, &mut self.gathered) else {
            self.nodes[slot] = Branch { first: offset, count: items.len() as u32 };
            return;
        };
        let children = self.nodes.len();
        self.nodes[slot] = Branch { first: children as u32, count: 0 };
        self.nodes.extend([Branch { first: 0, count: 0 }; 2]);
        let (left, right) = items.split_at_mut(middle);
        self.grow(children, left, offset, levels - 1);
        self.grow(children + 1, right, offset + middle as u32, levels - 1);
    }
}

/// One inner node over two subtrees: their roots become its adjacent children, the rest follows.
fn join(left: &[Branch], right: &[Branch]) -> Vec<Branch> {
    let root = Branch { first: 1, count: 0 };
    let moved = |by: u32| {
        move |node: &Branch| if node.count == 0 { Branch { first: node.first + by, ..*node } } else { *node }
    };
    let (left_moved, right_moved) = (moved(2), moved(1 + left.len() as u32));
    let mut nodes = Vec::with_capacity(1 + left.len() + right.len());
    nodes.extend([root, left_moved(&left[0]), right_moved(&right[0])]);
    nodes.extend(left[1..].iter().map(left_moved));
    nodes.extend(right[1..].iter().map(right_moved));
    nodes
}

/// Order `items` so that two halves meet at the returned place, or `None` where they are one leaf.
fn split(items: &mut [Item], levels: u32, leaves: Leaves, gathered: &mut Gathered) -> Option<usize> {
    let fits = items.len() <= MAX_LEAF as usize;
    if items.len() == 1 || (fits && leaves == Leaves::Full) {
        return None;
    }
    let centres = in_chunks(items, Extent::of_centres, Extent::union);
    if levels <= levels_of_medians(items.len()) {
        return if fits { None } else { Some(split_at_median(items, &centres)) };
    }
    match best_plane(items, &centres, gathered) {
        Some(plane) if !fits || plane.cost < items.len() as f32 => Some(split_at_plane(items, &plane)),
        Some(_) => None,
        None if fits => None,
        None => Some(split_at_median(items, &centres)),
    }
}

/// Levels of inner nodes that splitting `count` items into halves takes, down to leaves.
fn levels_of_medians(count: usize) -> u32 {
    count.div_ceil(MAX_LEAF as usize).next_power_of_two().trailing_zeros()
}

/// Halve by count along the longest axis of the centres.
fn split_at_median(items: &mut [Item], centres: &Extent) -> usize {
    let length = |axis: usize| centres.hi[axis] - centres.lo[axis];
    let axis = (1..3).fold(0, |longest, axis| if length(axis) > length(longest) { axis } else { longest });
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| {
        a.centre()[axis].total_cmp(&b.centre()[axis]).then(a.index().cmp(&b.index()))
    });
    middle
}

/// A plane between two bins of an axis, and the expected cost of splitting there in ray–triangle tests.
struct Plane {
    bins: Bins,
    axis: usize,
    /// Items of this bin and above go right.
    bin: u32,
    cost: f32,
}

/// The cheapest plane by the surface area heuristic, if any separates the items.
fn best_plane(items: &[Item], centres: &Extent, gathered: &mut Gathered) -> Option<Plane> {
    let bins = Bins::new(items.len(), centres);
    if items.len() > 2 * CHUNK {
        let gather = |items: &[Item]| {
            let mut gathered = Gathered::new();
            gathered.fill(items, &bins);
            gathered
        };
        *gathered = in_chunks(items, gather, Gathered::join);
    } else {
        gathered.fill(items, &bins);
    }
    let (bin, axis, hits) = (0..3)
        .filter(|&axis| bins.scale[axis] > 0.0)
        .filter_map(|axis| {
            let (bin, hits) = cheapest_of(&gathered.extents[axis], &gathered.counts[axis], bins.count)?;
            Some((bin, axis, hits))
        })
        .min_by(|a, b| a.2.total_cmp(&b.2))?;
    let whole = gathered.extents[axis].iter().copied().reduce(Extent::union)?.half_area();
    let cost = NODE_COST as f32 + if whole > 0.0 { hits / whole } else { 0.0 };
    Some(Plane { bins, axis, bin, cost })
}

/// The cheapest plane of one axis: its bin, and the sum of both sides' areas times their items.
fn cheapest_of(extents: &[Extent; BINS], counts: &[u32; BINS], bins: usize) -> Option<(u32, f32)> {
    // Sweep from the right for what lies above each plane …
    let mut above = [(0.0, 0); BINS];
    let mut running = (Extent::EMPTY, 0);
    for bin in (1..bins).rev() {
        running = (running.0.union(extents[bin]), running.1 + counts[bin]);
        above[bin] = (running.0.half_area(), running.1);
    }
    // … and from the left for what lies below.
    let mut best: Option<(u32, f32)> = None;
    let mut running = (Extent::EMPTY, 0);
    for bin in 1..bins {
        running = (running.0.union(extents[bin - 1]), running.1 + counts[bin - 1]);
        let (area, count) = above[bin];
        if running.1 == 0 || count == 0 {
            continue;
        }
        let hits = running.0.half_area() * running.1 as f32 + area * count as f32;
        if best.is_none_or(|best| hits < best.1) {
            best = Some((bin as u32, hits));
        }
    }
    best
}

/// Move the items below the plane to the front.
fn split_at_plane(items: &mut [Item], plane: &Plane) -> usize {
    let mut middle = 0;
    for index in 0..items.len() {
        let is_below = plane.bins.of(&items[index])[plane.axis] < plane.bin;
        // Without a branch, which would go wrong every other time: an item that stays above changes places with another.
        items.swap(middle, index);
        middle += usize::from(is_below);
    }
    middle
}

/// Equal bins over the centres' extent along each axis.
#[derive(Clone, Copy)]
struct Bins {
    count: usize,
    origin: Vec4,
    /// 0 on an axis where all centres are (nearly) equal.
    scale: Vec4,
}

impl Bins {
    fn new(items: usize, centres: &Extent) -> Self {
        let count = (LEAST_BINS + items / ITEMS_A_BIN).min(BINS);
        let scale = |axis: usize| {
            let scale = count as f32 / (centres.hi[axis] - centres.lo[axis]);
            if scale.is_normal() && centres.hi[axis] > centres.lo[axis] { scale } else { 0.0 }
        };
        Self { count, origin: centres.lo, scale: Vec4::new(scale(0), scale(1), scale(2), 0.0) }
    }

    /// An item's bin on each axis.
    #[inline(always)]
    fn of(&self, item: &Item) -> [u32; 3] {
        /// Its ulp is 1: a small number added to it is rounded, and stands in the last bits.
        const ROUND: f32 = (1 << 23) as f32;
        let last = (self.count - 1) as f32;
        let bin = (item.centre() - self.origin) * self.scale - Vec4::splat(0.5);
        let [x, y, z, _] = (bin.max(Vec4::ZERO).min(Vec4::splat(last)) + Vec4::splat(ROUND)).to_array();
        [x, y, z].map(|x| x.to_bits() % BINS as u32)
    }
}

/// What lies in each bin of each axis.
struct Gathered {
    extents: [[Extent; BINS]; 3],
    counts: [[u32; BINS]; 3],
}

impl Gathered {
    fn new() -> Self {
        Self { extents: [[Extent::EMPTY; BINS]; 3], counts: [[0; BINS]; 3] }
    }

    fn fill(&mut self, items: &[Item], bins: &Bins) {
        for axis in 0..3 {
            self.extents[axis][..bins.count].fill(Extent::EMPTY);
            self.counts[axis][..bins.count].fill(0);
        }
        for item in items {
            for (axis, bin) in bins.of(item).into_iter().enumerate() {
                let extent = &mut self.extents[axis][bin as usize];
                *extent = extent.union(item.extent);
                self.counts[axis][bin as usize] += 1;
            }
        }
    }

    /// What both have gathered in the same bins.
    fn join(mut self, other: Self) -> Self {
        for axis in 0..3 {
            for bin in 0..BINS {
                self.extents[axis][bin] = self.extents[axis][bin].union(other.extents[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }
}

/// What is found among all items, which many threads look at where they are many. The order must not matter.
fn in_chunks<T: Send>(
    items: &[Item],
    find: impl Fn(&[Item]) -> T + Sync + Send,
    join: impl Fn(T, T) -> T + Sync + Send,
) -> T {
    if items.len() <= 2 * CHUNK {
        return find(items);
    }
    items.par_chunks(CHUNK).map(&find).reduce_with(join).unwrap_or_else(|| find(items))
}

/// A triangle as the builder sees it.
#[derive(Debug, Clone, Copy)]
struct Item {
    /// The fourth lane of `lo` holds the triangle's index.
    extent: Extent,
}

impl Item {
    /// Added to an index, so that its bits are no subnormal number, with which processors take their time.
    const NORMAL: u32 = 1 << 30;

    fn new(triangle: &Triangle, scale: f32, index: u32) -> Self {
        let corner = |[x, y, z]: [f32; 3]| Vec4::new(x, y, z, 0.0) * scale;
        let [a, b, c] = [triangle.v0, triangle.v1, triangle.v2].map(corner);
        let lo = a.min(b).min(c);
        let tag = f32::from_bits(index + Self::NORMAL);
        Self { extent: Extent { lo: Vec4::new(lo.x, lo.y, lo.z, tag), hi: a.max(b).max(c) } }
    }

    fn index(&self) -> u32 {
        self.extent.lo.w.to_bits() - Self::NORMAL
    }

    /// Twice the centre of its box.
    #[inline(always)]
    fn centre(&self) -> Vec4 {
        self.extent.lo + self.extent.hi
    }
}

/// A box in three of four lanes, at the scale at which coordinates are in [−1, 1].
#[derive(Debug, Clone, Copy)]
struct Extent {
    lo: Vec4,
    hi: Vec4,
}

impl Extent {
    const EMPTY: Self = Self { lo: Vec4::MAX, hi: Vec4::MIN };

    #[inline(always)]
    fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Of twice the items' centres.
    fn of_centres(items: &[Item]) -> Self {
        items
            .iter()
            .map(Item::centre)
            .fold(Self::EMPTY, |all, centre| all.union(Self { lo: centre, hi: centre }))
    }

    /// Half the surface area. 0 where empty.
    #[inline(always)]
    fn half_area(&self) -> f32 {
        let size = self.hi - self.lo;
        if size.x < 0.0 { 0.0 } else { size.x * size.y + size.y * size.z + size.z * size.x }
    }
}
