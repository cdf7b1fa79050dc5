// Entry points of the self-test: rays through the scene, whole. Twin of src/selftest/rays.rs.

import package::probe::{begin, put, put3, put_flag, put_word, take, take3, take_word};
import package::bindings::attributes;
import package::bvh::{Hit, far, intersect, make_ray};
import package::constants::{NONE, PROBE_GROUP};
import package::hash::mix_hash;
import package::math::dot3;
import package::media::{cross_face, set_body};
import package::real::{real, vec3r};
import package::surface::{resolve, spawn_before, spawn_behind};

// A straight ray from face to face: where it goes, and what it met.
@compute @workgroup_size(PROBE_GROUP)
fn probe_walk(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    var origin = take3();
    var origin_face = NONE;
    let direction = take3();
    var media = take_word();
    let limit = take_word();
    var faces = 0u;
    var idle = 0u;
    var hash = 0u;
    var first = NONE;
    var distance = real(0.0);
    var point = vec3r(0.0);
    var escaped = false;
    while !escaped && faces < limit {
        let ray = make_ray(origin, direction, origin_face);
        let hit = intersect(ray, far());
        escaped = hit.id == NONE;
        if !escaped {
            let surface = resolve(ray, hit);
            if faces == 0u {
                first = hit.id;
                distance = hit.t;
                point = surface.point;
            }
            faces++;
            hash = mix_hash(hash, hit.id);
            if set_body(media, surface.body, hit.front) == media {
                idle++;
            }
            media = cross_face(media, hit.id, hit.front);
            origin = spawn_behind(surface);
            origin_face = hit.id;
        }
    }
    put_flag(escaped);
    put_word(faces);
    put_word(idle);
    put_word(media);
    put_word(hash);
    put_word(first);
    put(distance);
    put3(point);
    put_word(canary(limit));
}

// A ray that leaves a given point of a face, and what it meets first.
@compute @workgroup_size(PROBE_GROUP)
fn probe_leave(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let index = take_word();
    let face = take_word();
    let b1 = take();
    let b2 = take();
    let arriving = take3();
    let leaving = take3();
    let behind = take_word() == 1u;
    let rounds = take_word();
    let front = dot3(vec3r(attributes[face].normal), arriving) < 0.0;
    let surface = resolve(make_ray(vec3r(0.0), arriving, NONE), Hit(0.0, face, index, b1, b2, front));
    var origin = spawn_before(surface);
    if behind {
        origin = spawn_behind(surface);
    }
    let hit = intersect(make_ray(origin, leaving, face), far());
    put3(origin);
    put_word(hit.id);
    put(hit.t);
    put_word(canary(rounds));
}

// What a loop of so many rounds finds: another result shows that the driver ended it, and maybe others, before their time.
fn canary(rounds: u32) -> u32 {
    var x = 0u;
    for (var i = 0u; i < rounds; i++) {
        x = x * 3u + 1u;
    }
    return x;
}
