// Entry point: one workgroup a block of pixels.

import package::whitted::{lane, trace_pixel};
import package::bindings::{film, frame};
import package::constants::BLOCK;

@compute @workgroup_size(BLOCK, BLOCK)
fn render(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_id) local: vec3u,
    @builtin(local_invocation_index) index: u32,
) {
    let crop = frame.view.crop;
    let columns = (crop.z + BLOCK - 1u) / BLOCK;
    let block = film.head.tile.first_block + group.x;
    let x = (block % columns) * BLOCK + local.x;
    let y = (block / columns) * BLOCK + local.y;
    if x < crop.z && y < crop.w {
        lane = group.x * BLOCK * BLOCK + index;
        let slot = (y - film.head.tile.first_row) * crop.z + x;
        if !trace_pixel(vec2u(crop.x + x, crop.y + y), slot) {
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
    var x = 0u;
    for (var i = 0u; i < film.head.tile.canary_rounds; i++) {
        x = x * 3u + 1u;
    }
    return x == film.head.tile.canary_result;
}
