//! The guaranteed builder: top down, binned surface area heuristic (Wald 2007, "On fast construction of
//! SAH-based bounding volume hierarchies"), with a median split wherever the depth would run out.

use super::aabb::Aabb;
use super::tree::{Branch, Item, Tree};
use super::{MAX_LEAF, NODE_COST};
use crate::layout::Triangle;
use crate::layout::constants::MAX_BVH_DEPTH;

/// Bins on each axis; 16 is within a per cent of a full sweep (Wald 2007, section 4).
const BINS: usize = 16;

/// Subtrees over fewer triangles are built by one thread.
const PARALLEL: usize = 8192;

/// Build a tree of at most [`MAX_BVH_DEPTH`] levels with at most [`MAX_LEAF`] triangles a leaf, for any
/// triangles with finite corners. `triangles` is not empty.
pub(super) fn build(triangles: &[Triangle]) -> Tree {
    let mut items: Vec<Item> =
        triangles.iter().zip(0..).map(|(triangle, index)| Item { aabb: Aabb::of(triangle), index }).collect();
    let nodes = subtree(&mut items, 0, MAX_BVH_DEPTH);
    Tree { nodes, order: items.iter().map(|item| item.index).collect() }
}

/// The nodes over `items`, whose first stands at `offset` in the order; at most `levels` inner nodes follow
/// each other.
fn subtree(items: &mut [Item], offset: u32, levels: u32) -> Vec<Branch> {
    if items.len() < PARALLEL {
        let mut nodes = vec![Branch { first: 0, count: 0 }];
        grow(&mut nodes, 0, items, offset, levels);
        return nodes;
    }
    let middle = split(items, levels).unwrap_or(items.len() / 2);
    let (left, right) = items.split_at_mut(middle);
    let (left, right) = rayon::join(
        || subtree(left, offset, levels - 1),
        || subtree(right, offset + middle as u32, levels - 1),
    );
    join(&left, &right)
}

/// Write the node over `items` to its slot and everything below it to the end.
fn grow(nodes: &mut Vec<Branch>, slot: usize, items: &mut [Item], offset: u32, levels: u32) {
    let Some(middle) = split(items, levels) else {
        nodes[slot] = Branch { first: offset, count: items.len() as u32 };
        return;
    };
    let children = nodes.len();
    nodes[slot] = Branch { first: children as u32, count: 0 };
    nodes.extend([Branch { first: 0, count: 0 }; 2]);
    let (left, right) = items.split_at_mut(middle);
    grow(nodes, children, left, offset, levels - 1);
    grow(nodes, children + 1, right, offset + middle as u32, levels - 1);
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
fn split(items: &mut [Item], levels: u32) -> Option<usize> {
    if items.len() == 1 {
        return None;
    }
    let fits = items.len() <= MAX_LEAF as usize;
    let centres = items.iter().fold(Aabb::EMPTY, |aabb, item| aabb.with(centre(item)));
    if levels <= levels_of_medians(items.len()) {
        return if fits { None } else { Some(split_at_median(items, &centres)) };
    }
    match best_plane(items, &centres) {
        Some(plane) if !fits || plane.cost < items.len() as f64 => Some(split_at_plane(items, &plane)),
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
fn split_at_median(items: &mut [Item], centres: &Aabb) -> usize {
    let length = |axis: usize| f64::from(centres.hi[axis]) - f64::from(centres.lo[axis]);
    let axis = (1..3).fold(0, |longest, axis| if length(axis) > length(longest) { axis } else { longest });
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| {
        centre(a)[axis].total_cmp(&centre(b)[axis]).then(a.index.cmp(&b.index))
    });
    middle
}

/// A plane between two bins, and the expected cost of splitting there in ray–triangle tests.
struct Plane {
    bins: Bins,
    /// Items of this bin and above go right.
    bin: usize,
    cost: f64,
}

/// Equal bins over the centres' extent along one axis.
#[derive(Clone, Copy)]
struct Bins {
    axis: usize,
    origin: f32,
    scale: f32,
}

impl Bins {
    /// `None` where all centres are (nearly) equal on this axis.
    fn new(axis: usize, centres: &Aabb) -> Option<Self> {
        let origin = centres.lo[axis];
        let scale = BINS as f32 / (centres.hi[axis] - origin);
        (scale.is_normal() && centres.hi[axis] > origin).then_some(Self { axis, origin, scale })
    }

    fn index(&self, item: &Item) -> usize {
        (((centre(item)[self.axis] - self.origin) * self.scale) as usize).min(BINS - 1)
    }
}

/// The cheapest plane by the surface area heuristic, if any separates the items.
fn best_plane(items: &[Item], centres: &Aabb) -> Option<Plane> {
    let whole = items.iter().fold(Aabb::EMPTY, |aabb, item| aabb.union(&item.aabb)).half_area();
    (0..3)
        .filter_map(|axis| Bins::new(axis, centres))
        .filter_map(|bins| cheapest_of(items, bins, whole))
        .min_by(|a, b| a.cost.total_cmp(&b.cost))
}

/// The cheapest plane of one axis.
fn cheapest_of(items: &[Item], bins: Bins, whole: f64) -> Option<Plane> {
    // Gather boxes and counts.
    let mut boxes = [Aabb::EMPTY; BINS];
    let mut counts = [0_usize; BINS];
    for item in items {
        let bin = bins.index(item);
        boxes[bin] = boxes[bin].union(&item.aabb);
        counts[bin] += 1;
    }
    // Sweep from the right for what lies above each plane …
    let mut above = [(0.0, 0); BINS];
    let mut running = (Aabb::EMPTY, 0);
    for bin in (1..BINS).rev() {
        running = (running.0.union(&boxes[bin]), running.1 + counts[bin]);
        above[bin] = (running.0.half_area(), running.1);
    }
    // … and from the left for what lies below.
    let mut best: Option<Plane> = None;
    let mut running = (Aabb::EMPTY, 0);
    for bin in 1..BINS {
        running = (running.0.union(&boxes[bin - 1]), running.1 + counts[bin - 1]);
        let (area, count) = above[bin];
        if running.1 == 0 || count == 0 {
            continue;
        }
        let hits = running.0.half_area() * running.1 as f64 + area * count as f64;
        let cost = NODE_COST + if whole > 0.0 { hits / whole } else { 0.0 };
        if best.as_ref().is_none_or(|best| cost < best.cost) {
            best = Some(Plane { bins, bin, cost });
        }
    }
    best
}

/// Move the items below the plane to the front.
fn split_at_plane(items: &mut [Item], plane: &Plane) -> usize {
    let mut middle = 0;
    for index in 0..items.len() {
        if plane.bins.index(&items[index]) < plane.bin {
            items.swap(middle, index);
            middle += 1;
        }
    }
    middle
}

/// The centre of an item's box. Halved first, so that the sum cannot overflow.
fn centre(item: &Item) -> [f32; 3] {
    std::array::from_fn(|axis| item.aabb.lo[axis] * 0.5 + item.aabb.hi[axis] * 0.5)
}
