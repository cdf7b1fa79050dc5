// Stop 2 of 7: bvh. Twin of src/kernel/bvh.rs, which says why the layout of the tree never shows.

import package::real::{real, vec3r, least, greatest};
import package::triangle::{Shear, shear_of, intersect_triangle};
import package::records::Triangle;
import package::bindings::{frame, nodes, triangles};
import package::constants::{
    BVH_STACK, FAR, LEAST_DIRECTION, LOOP_STEPS, NODE_STEPS, NONE, ORIGIN_PADDING, SLAB_PADDING,
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

// Declared once: a function's own array would be cleared at every call.
var<private> bvh_stack: array<u32, BVH_STACK>;

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
    let tri = triangles[index];
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

// The nearest triangle in (0, limit), ties to the lowest primitive id.
fn intersect(ray: Ray, limit: real) -> Hit {
    return traverse(ray, limit, false);
}

// Whether any triangle lies in (0, limit): for scenes in which every blocker is opaque.
fn occluded(ray: Ray, limit: real) -> bool {
    return traverse(ray, limit, true).id != NONE;
}

// Walk the tree: to the nearest hit, or if any will do to the first that is found.
fn traverse(ray: Ray, limit: real, any_hit: bool) -> Hit {
    var best = Hit(limit, 0u, NONE, 0.0, 0.0, false);
    var size = 0u;
    var at = 0u;
    loop {
        // Meet both children.
        steps += NODE_STEPS;
        let node = nodes[at];
        let a = slabs(ray, vec3r(node.a_lo), vec3r(node.a_hi));
        let b = slabs(ray, vec3r(node.b_lo), vec3r(node.b_hi));
        // Nearer child first; leaves at once.
        let swap = b.entry < a.entry;
        var inner = vec2<bool>(false, false);
        var first = vec2u(0u, 0u);
        for (var side = 0u; side < 2u; side++) {
            let is_a = (side == 0u) != swap;
            let entry = select(b.entry, a.entry, is_a);
            let exit = select(b.exit, a.exit, is_a);
            let begin = select(node.b_first, node.a_first, is_a);
            let count = select(node.b_count, node.a_count, is_a);
            let hit = entry <= exit && entry <= best.t;
            first = select(vec2u(first.x, begin), vec2u(begin, first.y), side == 0u);
            let enters = hit && count == 0u;
            inner = select(vec2<bool>(inner.x, enters), vec2<bool>(enters, inner.y), side == 0u);
            if hit {
                steps += count + LOOP_STEPS;
                for (var i = begin; i < begin + count; i++) {
                    best = nearer(ray, i, best);
                }
            }
        }
        if any_hit && best.index != NONE {
            break;
        }
        // Descend, the farther one waits.
        if inner.x && inner.y {
            bvh_stack[size] = first.y;
            size++;
            at = first.x;
        } else if inner.x {
            at = first.x;
        } else if inner.y {
            at = first.y;
        } else if size > 0u {
            size--;
            at = bvh_stack[size];
        } else {
            break;
        }
    }
    if best.index == NONE {
        best.id = NONE;
    }
    return best;
}

// The limit of a ray without end.
fn far() -> real {
    return FAR;
}
