// Entry points: functions that look at the scene, each over many inputs. Twins in src/selftest/lockstep/scene.rs.

import package::probe::{begin, put, put3, put_flag, put_word, take, take3, take_word};
import package::real::{real, vec3r};
import package::background::background;
import package::bvh::{far, intersect, make_ray, occluded, slabs};
import package::camera::primary_ray;
import package::constants::{NONE, PROBE_GROUP};
import package::light::{direct, transmittance};
import package::material::{scatter, shadow_transmission};
import package::math::length3;
import package::media::{attenuation, cross_face, current_medium};
import package::surface::{Surface, resolve, spawn_before, spawn_behind};
import package::texture::texture_color;

// What a ray meets, if `found`.
struct Meeting {
    found: bool,
    direction: vec3r,
    surface: Surface,
}

fn take_meeting() -> Meeting {
    var meeting: Meeting;
    let origin = take3();
    meeting.direction = take3();
    let ray = make_ray(origin, meeting.direction, NONE);
    let hit = intersect(ray, far());
    meeting.found = hit.id != NONE;
    if meeting.found {
        meeting.surface = resolve(ray, hit);
    }
    return meeting;
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_primary_ray(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let x = take();
        put3(primary_ray(x, take()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_make_ray(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let origin = take3();
        let ray = make_ray(origin, take3(), NONE);
        put3(ray.reciprocal);
        put3(ray.origin_hi);
        put3(ray.origin_lo);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_slabs(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let origin = take3();
        let direction = take3();
        let lo = take3();
        let span = slabs(make_ray(origin, direction, NONE), lo, lo + abs(take3()));
        put(span.entry);
        put(span.exit);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_intersect(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let origin = take3();
        let direction = take3();
        let hit = intersect(make_ray(origin, direction, take_word()), far());
        put_word(hit.id);
        put(hit.t);
        put(hit.b1);
        put(hit.b2);
        put_flag(hit.front);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_occluded(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let origin = take3();
        let direction = take3();
        let limit = take();
        put_flag(occluded(make_ray(origin, direction, take_word()), limit));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_resolve(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let meeting = take_meeting();
        put_flag(meeting.found);
        if meeting.found {
            let s = meeting.surface;
            put3(s.normal);
            put3(s.shadow_point);
            put(s.uv[0]);
            put(s.uv[1]);
            put3(spawn_before(s));
            put3(spawn_behind(s));
        }
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_scatter(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let meeting = take_meeting();
        let before = take_word();
        let behind = take_word();
        put_flag(meeting.found);
        if meeting.found {
            let s = scatter(meeting.surface, meeting.direction, before, behind);
            put3(s.reflected);
            put3(s.reflection);
            put3(s.refracted);
            put3(s.transmission);
            put_flag(s.reflects);
            put_flag(s.transmits);
        }
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_shadow_transmission(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let meeting = take_meeting();
        let before = take_word();
        let behind = take_word();
        put_flag(meeting.found);
        if meeting.found {
            put3(shadow_transmission(meeting.surface, meeting.direction, before, behind));
        }
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_direct(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let meeting = take_meeting();
        let media = take_word();
        put_flag(meeting.found);
        if meeting.found {
            let local = direct(meeting.surface, meeting.direction, media);
            put3(local.radiance);
            put_word(local.seen);
            put_word(local.shadow_rays);
        }
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_transmittance(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let origin = take3();
        let light = take3();
        let path = light - origin;
        let distance = length3(path);
        let l = vec3r(path.x / distance, path.y / distance, path.z / distance);
        put3(transmittance(origin, l, distance, light, NONE, take_word()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_current_medium(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put_word(current_medium(take_word()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_cross_face(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let mask = take_word();
        let face = take_word();
        put_word(cross_face(mask, face, take_word() == 1u));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_attenuation(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let medium = take_word();
        put3(attenuation(medium, take()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_texture_color(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let u = take();
        let v = take();
        put3(texture_color(take_word(), array<real, 2>(u, v)));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_background(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put3(background(take3()));
    }
}
