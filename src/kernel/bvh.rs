//! Stop 2 of 7: bvh. Twin of `shaders/bvh.wgsl`.
//!
//! **Layout never shows.** The nearest hit, ties to the lowest primitive id, is the same for every tree over the same
//! triangles. A triangle's rounded distance may lie before its own box's entry, so (1) slabs are widened by δ, a bound
//! on all rounding; (2) a hit counts only if its own triangle's box is hit, and its distance is raised to that box's
//! entry; (3) a node is culled only when its entry is beyond the best distance. Every step of the slab test is monotone
//! in the box's corners, so a box that holds another is entered no later and left no earlier: no node above the
//! winning triangle is ever culled.

use crate::layout::Triangle;
use crate::layout::constants::{
    FAR, LEAST_DIRECTION, MAX_BVH_DEPTH, MOST_REACH, NONE, ORIGIN_PADDING, SLAB_PADDING,
};

use super::triangle::{Shear, intersect_triangle, shear_of};
use super::{Real, Simulation, Vec3, World};

/// A ray, prepared for boxes and triangles.
#[derive(Debug, Clone, Copy)]
pub struct Ray<R> {
    /// Where it starts.
    pub origin: Vec3<R>,
    /// Unit direction.
    pub direction: Vec3<R>,
    /// Reciprocal of the direction, finite.
    pub reciprocal: Vec3<R>,
    /// Origin + δ and origin − δ.
    pub origin_hi: Vec3<R>,
    /// See `origin_hi`.
    pub origin_lo: Vec3<R>,
    /// Primitive id of the face that it leaves, `NONE` for none: being straight, it does not meet that face again.
    pub origin_face: u32,
    /// For the triangle test.
    pub shear: Shear<R>,
}

/// The nearest triangle on a ray.
#[derive(Debug, Clone, Copy)]
pub struct Hit<R> {
    /// Distance.
    pub t: R,
    /// Primitive id; `NONE` for a miss.
    pub id: u32,
    /// Index into the triangles.
    pub index: u32,
    /// Barycentric weight of the second corner.
    pub b1: R,
    /// Barycentric weight of the third corner.
    pub b2: R,
    /// Whether the ray comes from the front.
    pub front: bool,
}

/// Where a ray is inside a box's widened slabs.
#[derive(Debug, Clone, Copy)]
pub struct Span<R> {
    /// Not below 0.
    pub entry: R,
    /// Beyond `entry` where the box is hit.
    pub exit: R,
}

/// Prepare a ray that leaves the face `origin_face`, or none.
#[inline]
pub fn make_ray<R: Real>(
    world: &World<impl Simulation>,
    origin: Vec3<R>,
    direction: Vec3<R>,
    origin_face: u32,
) -> Ray<R> {
    let to_lo = (origin - Vec3::load(world.view.scene_lo)).abs();
    let to_hi = (origin - Vec3::load(world.view.scene_hi)).abs();
    let reach = to_lo.x.greatest(to_hi.x) + to_lo.y.greatest(to_hi.y) + to_lo.z.greatest(to_hi.z);
    let delta = origin.abs() * R::of(ORIGIN_PADDING) + Vec3::splat(reach * R::of(SLAB_PADDING));
    Ray {
        origin,
        direction,
        reciprocal: direction.map(safe_reciprocal),
        origin_hi: origin + delta,
        origin_lo: origin - delta,
        origin_face,
        shear: shear_of(direction),
    }
}

/// 1/d, finite: a component too small to matter counts as `LEAST_DIRECTION`; zero has no sign.
#[inline]
pub fn safe_reciprocal<R: Real>(d: R) -> R {
    let least = R::of(LEAST_DIRECTION);
    let clamped = if d.abs() < least { least } else { d };
    R::ONE / clamped
}

/// The widened slab test.
pub fn slabs<R: Real>(ray: &Ray<R>, lo: Vec3<R>, hi: Vec3<R>) -> Span<R> {
    let a = (lo - ray.origin_hi) * ray.reciprocal;
    let b = (hi - ray.origin_lo) * ray.reciprocal;
    let near_x = a.x.least(b.x);
    let near_y = a.y.least(b.y);
    let near_z = a.z.least(b.z);
    let far_x = a.x.greatest(b.x);
    let far_y = a.y.greatest(b.y);
    let far_z = a.z.greatest(b.z);
    Span {
        entry: near_x.greatest(near_y).greatest(near_z.greatest(R::ZERO)),
        exit: far_x.least(far_y).least(far_z),
    }
}

/// The hit on one triangle if it is nearer than `best`, or as near with a lower id; else `best`.
pub fn nearer<R: Real>(world: &World<impl Simulation>, ray: &Ray<R>, index: u32, best: Hit<R>) -> Hit<R> {
    let tri = &world.scene.triangles[index as usize];
    if tri.id == ray.origin_face {
        return best;
    }
    let Some(c) = intersect_triangle(world.intersector, ray.origin, ray.direction, &ray.shear, tri) else {
        return best;
    };
    let own = triangle_slabs(ray, tri);
    let t = c.t.greatest(own.entry);
    let wins = t < best.t || (t == best.t && tri.id < best.id);
    if !wins || own.entry > own.exit {
        return best;
    }
    Hit { t, id: tri.id, index, b1: c.b1, b2: c.b2, front: c.front }
}

/// The slab test of a triangle's own box.
pub fn triangle_slabs<R: Real>(ray: &Ray<R>, tri: &Triangle) -> Span<R> {
    let (v0, v1, v2) = (Vec3::<R>::load(tri.v0), Vec3::<R>::load(tri.v1), Vec3::<R>::load(tri.v2));
    let lo =
        Vec3::new(v0.x.least(v1.x).least(v2.x), v0.y.least(v1.y).least(v2.y), v0.z.least(v1.z).least(v2.z));
    let hi = Vec3::new(
        v0.x.greatest(v1.x).greatest(v2.x),
        v0.y.greatest(v1.y).greatest(v2.y),
        v0.z.greatest(v1.z).greatest(v2.z),
    );
    slabs(ray, lo, hi)
}

/// Whether a scene can make such a ray: one with a NaN would enter every box, for comparisons tell nothing about it, and
/// so would one from so far that the padding swallows the scene.
#[inline]
pub fn is_usable<R: Real>(ray: &Ray<R>) -> bool {
    let d = ray.direction.abs();
    // The padding of each component holds all of the origin.
    ray.origin_hi.x.abs() + d.x + d.y + d.z < R::of(MOST_REACH)
}

/// The nearest triangle in (0, limit), ties to the lowest primitive id.
pub fn intersect<R: Real>(world: &World<impl Simulation>, ray: &Ray<R>, limit: R) -> Hit<R> {
    let mut best = Hit { t: limit, id: 0, index: NONE, b1: R::ZERO, b2: R::ZERO, front: false };
    if !is_usable(ray) {
        return Hit { id: NONE, ..best };
    }
    let mut stack = [0u32; MAX_BVH_DEPTH as usize];
    let mut size = 0;
    let mut at = 0u32;
    loop {
        // Meet both children.
        let node = &world.scene.nodes[at as usize];
        let a = slabs(ray, Vec3::load(node.a_lo), Vec3::load(node.a_hi));
        let b = slabs(ray, Vec3::load(node.b_lo), Vec3::load(node.b_hi));
        // Nearer child first; leaves at once.
        let swap = b.entry < a.entry;
        let mut inner = [false; 2];
        let mut first = [0u32; 2];
        for side in 0..2 {
            let is_a = (side == 0) != swap;
            let (span, count) = if is_a { (a, node.a_count) } else { (b, node.b_count) };
            first[side] = if is_a { node.a_first } else { node.b_first };
            let hit = span.entry <= span.exit && span.entry <= best.t;
            inner[side] = hit && count == 0;
            if hit {
                for i in first[side]..first[side] + count {
                    best = nearer(world, ray, i, best);
                }
            }
        }
        // Descend, the farther one waits.
        if inner[0] && inner[1] {
            stack[size] = first[1];
            size += 1;
            at = first[0];
        } else if inner[0] {
            at = first[0];
        } else if inner[1] {
            at = first[1];
        } else if size > 0 {
            size -= 1;
            at = stack[size];
        } else {
            break;
        }
    }
    if best.index == NONE {
        best.id = NONE;
    }
    best
}

/// Whether any triangle lies in (0, limit): for shadows of which every blocker is opaque. In no order, to the first that
/// is found.
pub fn occluded<R: Real>(world: &World<impl Simulation>, ray: &Ray<R>, limit: R) -> bool {
    if !is_usable(ray) {
        return false;
    }
    let nothing = Hit { t: limit, id: 0, index: NONE, b1: R::ZERO, b2: R::ZERO, front: false };
    let mut stack = [0u32; MAX_BVH_DEPTH as usize];
    let mut size = 0;
    let mut at = 0u32;
    loop {
        // Meet both children.
        let node = &world.scene.nodes[at as usize];
        let a = (slabs(ray, Vec3::load(node.a_lo), Vec3::load(node.a_hi)), node.a_first, node.a_count);
        let b = (slabs(ray, Vec3::load(node.b_lo), Vec3::load(node.b_hi)), node.b_first, node.b_count);
        for (span, first, count) in [a, b] {
            if span.entry > span.exit || span.entry > limit {
                continue;
            }
            // Leaves at once; all others wait.
            if count == 0 {
                stack[size] = first;
                size += 1;
            } else if (first..first + count).any(|i| nearer(world, ray, i, nothing).index != NONE) {
                return true;
            }
        }
        if size == 0 {
            return false;
        }
        size -= 1;
        at = stack[size];
    }
}

/// The limit of a ray without end.
pub fn far<R: Real>() -> R {
    R::of(FAR)
}
