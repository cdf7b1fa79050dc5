// Entry point: one workgroup traces a block of pixels.

import package::whitted::{lane, trace_pixel};
import package::bindings::{film, frame};
import package::blocks::{place_in_block, place_of, slot_at, slot_in_list};
import package::constants::{BLOCK, NONE};

@compute @workgroup_size(BLOCK, BLOCK)
fn render(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) index: u32) {
    var place = place_in_block(group.x, index);
    var slot = slot_at(place);
    @if(adaptive) {
        if film.head.tile.listed != 0u {
            slot = slot_in_list(group.x, index);
            place = place_of(slot);
        }
    }
    if slot != NONE {
        @if(rests) lane = group.x * BLOCK * BLOCK + index;
        if !trace_pixel(frame.view.crop.xy + place, slot) {
            atomicAdd(&film.head.paused, 1u);
        }
    }
    if !canary_lives() {
        atomicAdd(&film.head.cut_short, 1u);
    }
    atomicAdd(&film.head.done, 1u);
}

// Whether a loop may still make its rounds: some drivers end the loops of an invocation that has made too many, without a
// word, and then this one ends early too.
fn canary_lives() -> bool {
    let rounds = film.head.tile.canary_rounds;
    var x = 0u;
    for (var i = 0u; i < rounds; i++) {
        x = x * 3u + 1u;
    }
    return x == film.head.tile.canary_result;
}
