// Entry points of the benchmark of rays: what rays meet, without shading. Twin of src/bench/rays/host.rs.

import package::probe::{begin, put, put_behind, put_word, take, take3, take_word};
import package::bvh::{Ray, intersect, make_ray, occluded};
import package::constants::{NONE, PROBE_GROUP};
import package::real::real;

// A ray, and where it ends.
struct Cast {
    ray: Ray,
    limit: real,
}

// The nearest crossing of each ray: distance and face.
@compute @workgroup_size(PROBE_GROUP)
fn rays_nearest(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let asked = take_cast();
    let hit = intersect(asked.ray, asked.limit);
    put_behind();
    put(select(hit.t, real(0.0), hit.id == NONE));
    put_word(hit.id);
}

// Whether each ray crosses anything: face 0, or none.
@compute @workgroup_size(PROBE_GROUP)
fn rays_any(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let asked = take_cast();
    let blocked = occluded(asked.ray, asked.limit);
    put_behind();
    put(real(0.0));
    put_word(select(NONE, 0u, blocked));
}

// A record's ray: origin, end, direction, the face that it leaves.
fn take_cast() -> Cast {
    let origin = take3();
    let limit = take();
    let direction = take3();
    return Cast(make_ray(origin, direction, take_word()), limit);
}
