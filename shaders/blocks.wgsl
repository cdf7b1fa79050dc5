// Which pixel of the film is an invocation's: one workgroup has a block of pixels, or as many entries of the list.

import package::bindings::{film, frame};
import package::constants::{BLOCK, NONE};

// Where invocation `index` of a group lies in the crop; beyond it in blocks that its edges cut.
//
// Invocations that run in step are neighbours both ways: four pixels by two for eight, eight by four for 32.
fn place_in_block(group: u32, index: u32) -> vec2u {
    let columns = (frame.view.crop.z + BLOCK - 1u) / BLOCK;
    let block = film.head.tile.first_block + group;
    let row = block / columns;
    let corner = vec2u(block - row * columns, row) * BLOCK;
    return corner + vec2u((index & 3u) | ((index >> 1u) & 4u), ((index >> 2u) & 1u) | ((index >> 3u) & 6u));
}

// The slot in the film of a place in the crop, or NONE outside of it.
fn slot_at(place: vec2u) -> u32 {
    let crop = frame.view.crop;
    let slot = (place.y - film.head.tile.first_row) * crop.z + place.x;
    return select(NONE, slot, place.x < crop.z && place.y < crop.w);
}

// The listed pixel's slot, or NONE behind the last entry.
@if(adaptive)
fn slot_in_list(group: u32, index: u32) -> u32 {
    let entry = (film.head.tile.first_block + group) * BLOCK * BLOCK + index;
    if entry < film.head.tile.listed {
        return film.texels[entry].statistics.listed;
    }
    return NONE;
}

// Where a slot lies in the crop.
fn place_of(slot: u32) -> vec2u {
    let width = frame.view.crop.z;
    return vec2u(slot % width, film.head.tile.first_row + slot / width);
}
