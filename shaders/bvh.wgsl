// Stop 2 of 7: bvh. Twin of src/kernel/bvh.rs, which says why the layout of the tree never shows.

import package::real::{real, vec3r, least, greatest};
import package::triangle::{Shear, shear_of, intersect_triangle};
import package::records::Triangle;
import package::bindings::{frame, triangle_at};
import package::wide::{is_done, sight_of, visit, whole_tree};
import package::constants::{
    FAR, LEAST_DIRECTION, MOST_REACH, NODE_STEPS, NONE, ORIGIN_PADDING, SLAB_PADDING, WALK_STEPS,
};

// A ray, prepared for boxes and triangles.
struct Ray {
    origin: vec3r,
    direction: vec3r,
    reciprocal: vec3r,
    origin_hi: vec3r,
    origin_lo: vec3r,
    origin_face: u32,
    shear: Shear,
}

// The nearest triangle on a ray; id NONE for a miss.
struct Hit {
    t: real,
    id: u32,
    index: u32,
    b1: real,
    b2: real,
    front: bool,
}

// Where a ray is inside a box's widened slabs.
struct Span {
    entry: real,
    exit: real,
}

// Passes through loops so far, those of the leaves' triangles too: an invocation rests when it has made enough.
var<private> steps: u32;

// Prepare a ray that leaves the face `origin_face`, or none.
fn make_ray(origin: vec3r, direction: vec3r, origin_face: u32) -> Ray {
    let to_lo = abs(origin - vec3r(frame.view.scene_lo));
    let to_hi = abs(origin - vec3r(frame.view.scene_hi));
    let reach = greatest(to_lo.x, to_hi.x) + greatest(to_lo.y, to_hi.y) + greatest(to_lo.z, to_hi.z);
    let delta = abs(origin) * ORIGIN_PADDING + vec3r(reach * SLAB_PADDING);
    let reciprocal =
        vec3r(safe_reciprocal(direction.x), safe_reciprocal(direction.y), safe_reciprocal(direction.z));
    return Ray(origin, direction, reciprocal, origin + delta, origin - delta, origin_face, shear_of(direction));
}

// 1/d, finite.
fn safe_reciprocal(d: real) -> real {
    let clamped = select(d, LEAST_DIRECTION, abs(d) < LEAST_DIRECTION);
    return 1.0 / clamped;
}

// The widened slab test.
fn slabs(ray: Ray, lo: vec3r, hi: vec3r) -> Span {
    let a = (lo - ray.origin_hi) * ray.reciprocal;
    let b = (hi - ray.origin_lo) * ray.reciprocal;
    let near = select(b, a, a < b);
    let distant = select(b, a, a > b);
    return Span(
        greatest(greatest(near.x, near.y), greatest(near.z, 0.0)),
        least(least(distant.x, distant.y), distant.z),
    );
}

// The hit on one triangle if it is nearer than `best`, or as near with a lower id; else `best`.
fn nearer(ray: Ray, index: u32, best: Hit) -> Hit {
    let tri = triangle_at(index);
    if tri.id == ray.origin_face {
        return best;
    }
    let c = intersect_triangle(ray.origin, ray.direction, ray.shear, tri);
    if !c.found {
        return best;
    }
    let own = triangle_slabs(ray, tri);
    let t = greatest(c.t, own.entry);
    let wins = t < best.t || (t == best.t && tri.id < best.id);
    if !wins || own.entry > own.exit {
        return best;
    }
    return Hit(t, tri.id, index, c.b1, c.b2, c.front);
}

// The slab test of a triangle's own box.
fn triangle_slabs(ray: Ray, tri: Triangle) -> Span {
    let v0 = vec3r(tri.v0);
    let v1 = vec3r(tri.v1);
    let v2 = vec3r(tri.v2);
    let lo = vec3r(
        least(least(v0.x, v1.x), v2.x), least(least(v0.y, v1.y), v2.y), least(least(v0.z, v1.z), v2.z));
    let hi = vec3r(
        greatest(greatest(v0.x, v1.x), v2.x),
        greatest(greatest(v0.y, v1.y), v2.y),
        greatest(greatest(v0.z, v1.z), v2.z));
    return slabs(ray, lo, hi);
}

// Whether a scene can make such a ray: no NaN, and nothing beyond reach.
fn is_usable(ray: Ray) -> bool {
    let d = abs(ray.direction);
    return abs(ray.origin_hi.x) + d.x + d.y + d.z < MOST_REACH;
}

// The nearest triangle in (0, limit), ties to the lowest primitive id.
//
// To the next node with triangles to test, then all of these (Aila and Laine 2009, "Understanding the efficiency of ray
// traversal on GPUs", section 3: while-while).
fn intersect(ray: Ray, limit: real) -> Hit {
    var best = Hit(limit, 0u, NONE, 0.0, 0.0, false);
    if !is_usable(ray) {
        best.id = NONE;
        return best;
    }
    let sight = sight_of(ray);
    var ahead = whole_tree(sight);
    loop {
        steps += WALK_STEPS;
        while ahead.triangles == 0u && !is_done(ahead) {
            steps += NODE_STEPS;
            ahead = visit(sight, ahead, best.t);
        }
        if ahead.triangles == 0u {
            break;
        }
        while ahead.triangles != 0u {
            steps += NODE_STEPS;
            best = nearer(ray, ahead.first_triangle + firstTrailingBit(ahead.triangles), best);
            ahead.triangles &= ahead.triangles - 1u;
        }
    }
    if best.index == NONE {
        best.id = NONE;
    }
    return best;
}

// Whether any triangle lies in (0, limit): for shadows of which every blocker is opaque. To the first that is found.
fn occluded(ray: Ray, limit: real) -> bool {
    if !is_usable(ray) {
        return false;
    }
    let nothing = Hit(limit, 0u, NONE, 0.0, 0.0, false);
    let sight = sight_of(ray);
    var ahead = whole_tree(sight);
    var found = false;
    loop {
        steps += WALK_STEPS;
        while ahead.triangles == 0u && !is_done(ahead) {
            steps += NODE_STEPS;
            ahead = visit(sight, ahead, limit);
        }
        while ahead.triangles != 0u && !found {
            steps += NODE_STEPS;
            found = nearer(ray, ahead.first_triangle + firstTrailingBit(ahead.triangles), nothing).index != NONE;
            ahead.triangles &= ahead.triangles - 1u;
        }
        if found || is_done(ahead) {
            break;
        }
    }
    return found;
}

// The limit of a ray without end.
fn far() -> real {
    return FAR;
}
