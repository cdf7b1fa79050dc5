// Entry points between rounds of adaptive antialiasing: list the pixels to be refined; settle all in the end.

import package::adaptive::{surroundings, wants_more};
import package::bindings::{film, frame};
import package::blocks::{place_in_block, slot_at};
import package::film::settle;
import package::constants::{BLOCK, NONE};

@compute @workgroup_size(BLOCK, BLOCK)
fn sift(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) index: u32) {
    let place = place_in_block(group.x, index);
    let slot = slot_at(place);
    if slot != NONE {
        let here = film.texels[slot].statistics;
        let around = surroundings(frame.view.crop.zw, place);
        if wants_more(here, around, film.head.tile, frame.view.samples) {
            film.texels[slot].statistics.start = here.samples;
            let entry = atomicAdd(&film.head.listed, 1u);
            film.texels[entry].statistics.listed = slot;
        }
    }
    atomicAdd(&film.head.done, 1u);
}

@compute @workgroup_size(BLOCK, BLOCK)
fn settle_film(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) index: u32) {
    let slot = slot_at(place_in_block(group.x, index));
    if slot != NONE {
        let samples = film.texels[slot].statistics.samples;
        if samples != 0u {
            film.texels[slot].texel = settle(film.texels[slot].texel, samples);
        }
    }
    atomicAdd(&film.head.done, 1u);
}
