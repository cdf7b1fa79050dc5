// Entry point: one bent path a record. Twin of src/selftest/paths.rs.

import package::probe::{begin, put3, put_word, take3, take_word};
import package::probe_rays::canary;
import package::real::vec3r;
import package::constants::{BEND_FREE, BEND_LIMIT, BEND_LIMITED, BEND_ABSORBED, NONE, PROBE_GROUP, RAY_PRIMARY};
import package::material::scatter;
import package::media::{attenuation, current_medium};
import package::surface::{spawn_before, spawn_behind};
import package::whitted::{Branch, find_surface};

@compute @workgroup_size(PROBE_GROUP)
fn probe_bend(@builtin(global_invocation_id) id: vec3u) {
    if !begin(id.x) {
        return;
    }
    let origin = take3();
    let direction = take3();
    var branch = Branch(origin, take_word(), direction, 0u, vec3r(1.0), RAY_PRIMARY, NONE);
    let reflect = take_word();
    let limit = take_word();
    var ids: array<u32, BEND_LIMIT>;
    for (var k = 0u; k < BEND_LIMIT; k++) {
        ids[k] = NONE;
    }
    // One surface after the other.
    var end = BEND_LIMITED;
    var surfaces = 0u;
    var reflected = 0u;
    while surfaces < limit {
        let landing = find_surface(branch);
        if !landing.found {
            end = BEND_FREE;
            branch.media = landing.media;
            break;
        }
        let before = current_medium(landing.media);
        let behind = current_medium(landing.media_behind);
        let bit = 1u << surfaces;
        ids[surfaces] = landing.surface.id;
        surfaces++;
        branch.weight = branch.weight * attenuation(before, landing.distance);
        // The child that is asked for; the other where there is no such child.
        let children = scatter(landing.surface, branch.direction, before, behind);
        if !children.reflects && !children.transmits {
            end = BEND_ABSORBED;
            break;
        }
        if children.reflects && ((reflect & bit) != 0u || !children.transmits) {
            reflected |= bit;
            branch = Branch(
                spawn_before(landing.surface), landing.media, children.reflected, 0u,
                branch.weight * children.reflection, RAY_PRIMARY, landing.surface.id);
        } else {
            branch = Branch(
                spawn_behind(landing.surface), landing.media_behind, children.refracted, 0u,
                branch.weight * children.transmission, RAY_PRIMARY, landing.surface.id);
        }
    }
    put_word(end);
    put_word(surfaces);
    put_word(reflected);
    put_word(branch.media);
    for (var k = 0u; k < BEND_LIMIT; k++) {
        put_word(ids[k]);
    }
    put3(branch.origin);
    put3(branch.direction);
    put3(branch.weight);
    put_word(canary(limit));
}
