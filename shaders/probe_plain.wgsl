// Entry points: functions of numbers alone, each over many inputs. Twins in src/selftest/lockstep/plain.rs.

import package::real::{real, vec3r};
import package::probe::{begin, put, put3, put_flag, put_word, take, take3, take_word};
import package::adaptive::{Surroundings, display, round_end, tally, variance, wants_more};
import package::constants::PROBE_GROUP;
import package::film::flush;
import package::hash::{mix_hash, sample_offset};
import package::light::phong;
import package::material::fresnel;
import package::math::{arctangent, cross3, dot3, exp_neg, length3, max3, power, unit3};
import package::bvh::safe_reciprocal;
import package::records::{Statistics, Tile, Triangle};
import package::surface::{lift, turn_towards};
import package::texture::{blend, wrap};
import package::triangle::{Crossing, moller_trumbore, shear_of, watertight};

@compute @workgroup_size(PROBE_GROUP)
fn probe_dot3(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let a = take3();
        put(dot3(a, take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_cross3(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let a = take3();
        put3(cross3(a, take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_length3(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put(length3(take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_unit3(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put3(unit3(take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_max3(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put(max3(take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_exp_neg(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put(exp_neg(take()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_power(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let x = take();
        put(power(x, take()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_arctangent(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let y = take();
        put(arctangent(y, take()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_mix_hash(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let hash = take_word();
        put_word(mix_hash(hash, take_word()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_sample_offset(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let offset = sample_offset(take_word());
        put(offset[0]);
        put(offset[1]);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_flush(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put(flush(take()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_safe_reciprocal(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put(safe_reciprocal(take()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_shear_of(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let shear = shear_of(take3());
        put_word(shear.axis);
        put3(shear.by);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_watertight(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let origin = take3();
        let direction = take3();
        put_crossing(watertight(origin, shear_of(direction), take_triangle()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_moller_trumbore(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let origin = take3();
        let direction = take3();
        put_crossing(moller_trumbore(origin, direction, take_triangle()));
    }
}

fn take_triangle() -> Triangle {
    let v0 = vec3f(take3());
    let v1 = vec3f(take3());
    let v2 = vec3f(take3());
    return Triangle(v0, 0u, v1, 0u, v2, 0u);
}

fn put_crossing(crossing: Crossing) {
    put_flag(crossing.found);
    if crossing.found {
        put(crossing.t);
        put(crossing.b1);
        put(crossing.b2);
        put_flag(crossing.front);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_turn_towards(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let v = take3();
        put3(turn_towards(v, take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_lift(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let point = take3();
        let corner = take3();
        put3(lift(point, corner, take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_fresnel(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let cosine = take();
        let result = fresnel(cosine, take());
        put(result.reflectance);
        put(result.bend);
        put_flag(result.total);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_phong(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let n = take3();
        let l = take3();
        let direction = take3();
        let shininess = take();
        put3(phong(n, l, direction, dot3(n, l), shininess, take3()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_wrap(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let u = take();
        let place = wrap(u, take_word());
        put(place[0]);
        put(place[1]);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_blend(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let a = take3();
        let b = take3();
        let c = take3();
        let d = take3();
        let fx = take();
        put3(blend(a, b, c, d, fx, take()));
    }
}

fn take_statistics() -> Statistics {
    let sum = vec3f(take3());
    let squares = f32(take());
    let samples = take_word();
    return Statistics(sum, squares, samples, take_word(), 0u, 0u);
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_display(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put3(vec3r(display(vec3f(take3()))));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_tally(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let before = take_statistics();
        let radiance = vec3f(take3());
        let after = tally(before, radiance, take_word());
        put3(vec3r(after.sum));
        put(real(after.squares));
        put_word(after.samples);
        put_word(after.body);
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_variance(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        put(real(variance(take_statistics())));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_wants_more(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let here = take_statistics();
        let pooled = take_statistics();
        let around = Surroundings(pooled, f32(take()));
        var tile: Tile;
        tile.round = take_word();
        tile.threshold = f32(take());
        put_flag(wants_more(here, around, tile, take_word()));
    }
}

@compute @workgroup_size(PROBE_GROUP)
fn probe_round_end(@builtin(global_invocation_id) id: vec3u) {
    if begin(id.x) {
        let start = take_word();
        put_word(round_end(start, take_word()));
    }
}
