// Stop 2 of 7: bvh. Twin of src/kernel/bvh.rs, which says why the layout of the tree never shows.

import package::real::{real, vec3r, least, greatest};
import package::triangle::{Shear, shear_of, intersect_triangle};
import package::records::Triangle;
import package::bindings::{nodes, triangles, view};
import package::constants::{BVH_STACK, FAR, LEAST_DIRECTION, NONE, SLAB_PADDING};

// A ray, prepared for boxes and triangles.
struct Ray {
    origin: vec3r,
    direction: vec3r,
    reciprocal: vec3r,
    origin_hi: vec3r,
    origin_lo: vec3r,
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

// Prepare a ray.
fn make_ray(origin: vec3r, direction: vec3r) -> Ray {
    let to_lo = abs(origin - vec3r(view.scene_lo));
    let to_hi = abs(origin - vec3r(view.scene_hi));
    let reach = greatest(to_lo.x, to_hi.x) + greatest(to_lo.y, to_hi.y) + greatest(to_lo.z, to_hi.z);
    let delta = vec3r(reach * SLAB_PADDING);
    let reciprocal =
        vec3r(safe_reciprocal(direction.x), safe_reciprocal(direction.y), safe_reciprocal(direction.z));
    return Ray(origin, direction, reciprocal, origin + delta, origin - delta, shear_of(direction));
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
    var best = Hit(limit, 0u, NONE, 0.0, 0.0, false);
    var size = 0u;
    var at = 0u;
    loop {
        // Meet both children.
        let node = nodes[at];
        let a = slabs(ray, vec3r(node.a_lo), vec3r(node.a_hi));
        let b = slabs(ray, vec3r(node.b_lo), vec3r(node.b_hi));
        // Nearer child first.
        let swap = b.entry < a.entry;
        let near_entry = select(a.entry, b.entry, swap);
        let near_exit = select(a.exit, b.exit, swap);
        let far_entry = select(b.entry, a.entry, swap);
        let far_exit = select(b.exit, a.exit, swap);
        let near_first = select(node.a_first, node.b_first, swap);
        let near_count = select(node.a_count, node.b_count, swap);
        let far_first = select(node.b_first, node.a_first, swap);
        let far_count = select(node.b_count, node.a_count, swap);
        // Leaves at once.
        var near_inner = near_entry <= near_exit && near_entry <= best.t;
        if near_inner && near_count > 0u {
            for (var i = near_first; i < near_first + near_count; i++) {
                best = nearer(ray, i, best);
            }
            near_inner = false;
        }
        var far_inner = far_entry <= far_exit && far_entry <= best.t;
        if far_inner && far_count > 0u {
            for (var i = far_first; i < far_first + far_count; i++) {
                best = nearer(ray, i, best);
            }
            far_inner = false;
        }
        // Descend, the farther one waits.
        if near_inner && far_inner {
            bvh_stack[size] = far_first;
            size++;
            at = near_first;
        } else if near_inner {
            at = near_first;
        } else if far_inner {
            at = far_first;
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

// Whether any triangle lies in (0, limit): for scenes in which every blocker is opaque.
fn occluded(ray: Ray, limit: real) -> bool {
    let start = Hit(limit, 0u, NONE, 0.0, 0.0, false);
    var size = 0u;
    var at = 0u;
    var found = false;
    while !found {
        let node = nodes[at];
        let a = slabs(ray, vec3r(node.a_lo), vec3r(node.a_hi));
        let b = slabs(ray, vec3r(node.b_lo), vec3r(node.b_hi));
        var a_inner = a.entry <= a.exit && a.entry <= limit;
        if a_inner && node.a_count > 0u {
            for (var i = node.a_first; i < node.a_first + node.a_count; i++) {
                if nearer(ray, i, start).index != NONE {
                    found = true;
                    break;
                }
            }
            a_inner = false;
        }
        var b_inner = b.entry <= b.exit && b.entry <= limit;
        if b_inner && node.b_count > 0u {
            for (var i = node.b_first; i < node.b_first + node.b_count; i++) {
                if nearer(ray, i, start).index != NONE {
                    found = true;
                    break;
                }
            }
            b_inner = false;
        }
        if a_inner && b_inner {
            bvh_stack[size] = node.b_first;
            size++;
            at = node.a_first;
        } else if a_inner {
            at = node.a_first;
        } else if b_inner {
            at = node.b_first;
        } else if size > 0u {
            size--;
            at = bvh_stack[size];
        } else {
            break;
        }
    }
    return found;
}

// The limit of a ray without end.
fn far() -> real {
    return FAR;
}
