// Entry point: one workgroup a block of pixels.

import package::whitted::trace_pixel;
import package::bindings::{film, tile, view};
import package::constants::{BLOCK, RAY_PRIMARY, RAY_REFLECTION, RAY_REFRACTION, RAY_SHADOW};

@compute @workgroup_size(BLOCK, BLOCK)
fn render(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let columns = (view.crop.z + BLOCK - 1u) / BLOCK;
    let block = tile.first_block + group.x;
    let x = (block % columns) * BLOCK + local.x;
    let y = (block / columns) * BLOCK + local.y;
    if x < view.crop.z && y < view.crop.w {
        let pixel = vec2u(view.crop.x + x, view.crop.y + y);
        let end = tile.first_sample + tile.sample_count;
        let rays = trace_pixel(pixel, tile.first_sample, end, y * view.crop.z + x);
        atomicAdd(&film.primary, rays[RAY_PRIMARY]);
        atomicAdd(&film.reflection, rays[RAY_REFLECTION]);
        atomicAdd(&film.refraction, rays[RAY_REFRACTION]);
        atomicAdd(&film.shadow, rays[RAY_SHADOW]);
    }
    atomicAdd(&film.done, 1u);
}
