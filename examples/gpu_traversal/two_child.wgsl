// The plain way through a tree, to compare with: two children a node, 64 bytes each, "while-while" (Aila and Laine 2009,
// "Understanding the efficiency of ray traversal on GPUs", section 3). Triangles and their test are the program's own.

import package::bvh::{Hit, Ray, is_usable, make_ray, nearer, slabs};
import package::constants::{BVH_STACK, NONE, PROBE_GROUP};
import package::probe::{begin, put, put_behind, put_word, take, take3, take_word};
import package::real::{real, vec3r};

// A ray, and where it ends.
struct Cast {
    ray: Ray,
    limit: real,
}

// A child that is a leaf: below the mark its triangles, less one, and the first of them.
const LEAF: u32 = 0x80000000u;
const COUNT_SHIFT: u32 = 28u;
const FIRST: u32 = 0x0fffffffu;
// Nothing is left.
const DONE: u32 = 0xffffffffu;

// Lower corner and first, upper corner and count, of both children; in place of the texture coordinates, which rays do not need.
@group(0) @binding(3) var<storage, read> two_child: array<array<vec4u, 4>>;

var<private> waiting: array<u32, BVH_STACK>;
var<private> size: u32;

@compute @workgroup_size(PROBE_GROUP)
fn rays_nearest(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let asked = take_cast();
    let hit = walk(asked.ray, asked.limit, false);
    put_behind();
    put(select(hit.t, real(0.0), hit.index == NONE));
    put_word(select(hit.id, NONE, hit.index == NONE));
}

@compute @workgroup_size(PROBE_GROUP)
fn rays_any(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let asked = take_cast();
    let hit = walk(asked.ray, asked.limit, true);
    put_behind();
    put(real(0.0));
    put_word(select(0u, NONE, hit.index == NONE));
}

fn take_cast() -> Cast {
    let origin = take3();
    let limit = take();
    let direction = take3();
    return Cast(make_ray(origin, direction, take_word()), limit);
}

// The nearest triangle in (0, limit), or any.
fn walk(ray: Ray, limit: real, any: bool) -> Hit {
    var best = Hit(limit, 0u, NONE, 0.0, 0.0, false);
    if !is_usable(ray) {
        return best;
    }
    size = 0u;
    var at = 0u;
    loop {
        while at < LEAF {
            at = descend(ray, at, best.t);
        }
        if at == DONE {
            break;
        }
        let first = at & FIRST;
        let end = first + ((at & ~LEAF) >> COUNT_SHIFT) + 1u;
        for (var i = first; i < end; i++) {
            best = nearer(ray, i, best);
        }
        if any && best.index != NONE {
            break;
        }
        at = pop();
    }
    return best;
}

// From a node to the nearer of the children that the ray enters; the other waits.
fn descend(ray: Ray, index: u32, limit: real) -> u32 {
    let words = two_child[index];
    let a = slabs(ray, vec3r(bitcast<vec3f>(words[0].xyz)), vec3r(bitcast<vec3f>(words[1].xyz)));
    let b = slabs(ray, vec3r(bitcast<vec3f>(words[2].xyz)), vec3r(bitcast<vec3f>(words[3].xyz)));
    let meets_a = a.entry <= a.exit && a.entry <= limit;
    let meets_b = b.entry <= b.exit && b.entry <= limit;
    let child_a = child(words[0].w, words[1].w);
    let child_b = child(words[2].w, words[3].w);
    if meets_a && meets_b {
        let swap = b.entry < a.entry;
        waiting[size] = select(child_b, child_a, swap);
        size++;
        return select(child_a, child_b, swap);
    }
    if meets_a {
        return child_a;
    }
    if meets_b {
        return child_b;
    }
    return pop();
}

fn child(first: u32, count: u32) -> u32 {
    return select(LEAF | ((count - 1u) << COUNT_SHIFT) | first, first, count == 0u);
}

fn pop() -> u32 {
    if size == 0u {
        return DONE;
    }
    size--;
    return waiting[size];
}
