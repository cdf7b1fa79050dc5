// Which pixel of the film is an invocation's: one workgroup has a block of pixels, or as many entries of the list.

import package::bindings::{film, frame};
import package::constants::{BLOCK, NONE};

// The pixel's slot in the film, or NONE outside the picture.
fn slot_in_block(group: u32, local: vec2u) -> u32 {
    let crop = frame.view.crop;
    let columns = (crop.z + BLOCK - 1u) / BLOCK;
    let block = film.head.tile.first_block + group;
    let x = (block % columns) * BLOCK + local.x;
    let y = (block / columns) * BLOCK + local.y;
    return select(NONE, (y - film.head.tile.first_row) * crop.z + x, x < crop.z && y < crop.w);
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
