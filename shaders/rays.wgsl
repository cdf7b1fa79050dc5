// Entry points of the benchmark of rays: what rays meet, without shading. Twin of src/bench/rays/measure.rs.

import package::probe::{begin, put, put_behind, put_word, take, take3, take_word};
import package::bvh::{Ray, intersect, make_ray, occluded};
import package::constants::{NONE, PROBE_GROUP};
import package::real::real;

// The nearest crossing of each ray: distance and face.
@compute @workgroup_size(PROBE_GROUP)
fn rays_nearest(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let ray = take_ray();
    let hit = intersect(ray, take());
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
    let ray = take_ray();
    let blocked = occluded(ray, take());
    put_behind();
    put(real(0.0));
    put_word(select(NONE, 0u, blocked));
}

// A ray of a file: origin, where it begins to count (always there), direction; its end follows.
fn take_ray() -> Ray {
    let origin = take3();
    _ = take_word();
    let direction = take3();
    return make_ray(origin, direction, NONE);
}
