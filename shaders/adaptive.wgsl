// Adaptive antialiasing: where more samples are worth their rays. Twin of src/kernel/adaptive.rs.

import package::records::{Statistics, Tile};
import package::bindings::film;
import package::constants::{BASE_SAMPLES, SEVERAL};

// What a pixel's 3×3 neighbourhood knows, itself included.
struct Surroundings {
    pooled: Statistics,
    variance: f32,
}

// Linear radiance as a display's value in [0, 1]: gamma 2.
fn display(radiance: vec3f) -> vec3f {
    let above = select(vec3f(0.0), radiance, radiance > vec3f(0.0));
    let inside = select(vec3f(1.0), above, above < vec3f(1.0));
    return vec3f(sqrt(inside.x), sqrt(inside.y), sqrt(inside.z));
}

// Enter a sample of this radiance, whose ray met this body first.
fn tally(statistics: Statistics, radiance: vec3f, body: u32) -> Statistics {
    let sum = display(radiance);
    let squares = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
    return pool(statistics, Statistics(sum, squares, 1u, body, 0u, 0u));
}

// The samples of both as if they were one pixel's; the rest is the first one's.
fn pool(a: Statistics, b: Statistics) -> Statistics {
    var both = a;
    both.sum = a.sum + b.sum;
    both.squares = a.squares + b.squares;
    both.samples = a.samples + b.samples;
    if a.samples == 0u {
        both.body = b.body;
    } else if b.samples != 0u && a.body != b.body {
        both.body = SEVERAL;
    }
    return both;
}

// Variance of one sample, the mean over the channels; 0 for fewer than two.
fn variance(statistics: Statistics) -> f32 {
    if statistics.samples < 2u {
        return 0.0;
    }
    let n = f32(i32(statistics.samples));
    let s = statistics.sum;
    let spread = statistics.squares - (s.x * s.x + s.y * s.y + s.z * s.z) / n;
    // Rounding may leave less than nothing.
    if spread > 0.0 {
        return spread / ((n - 1.0) * 3.0);
    }
    return 0.0;
}

// What a pixel's neighbours in the film know, row by row.
@if(adaptive)
fn surroundings(size: vec2u, pixel: vec2u) -> Surroundings {
    var found: Surroundings;
    var count = 0;
    for (var row = max(pixel.y, 1u) - 1u; row < min(size.y, pixel.y + 2u); row++) {
        for (var column = max(pixel.x, 1u) - 1u; column < min(size.x, pixel.x + 2u); column++) {
            let one = film.texels[row * size.x + column].statistics;
            found.pooled = pool(found.pooled, one);
            found.variance += variance(one);
            count++;
        }
    }
    found.variance /= f32(count);
    return found;
}

// Whether a pixel is to be refined in the tile's round, if it may have `limit` samples.
fn wants_more(here: Statistics, around: Surroundings, tile: Tile, limit: u32) -> bool {
    if here.samples >= limit {
        return false;
    }
    var expected = variance(here);
    expected = select(expected, around.variance, around.variance > expected);
    if tile.round == 0u {
        if around.pooled.body == SEVERAL {
            return true;
        }
        let pooled = variance(around.pooled);
        expected = select(expected, pooled, pooled > expected);
    }
    return sqrt(expected) >= tile.threshold * f32(i32(here.samples));
}

// Samples that a pixel has at the end of a round in which it is traced, if it may have `limit`: as many again.
fn round_end(start: u32, limit: u32) -> u32 {
    let end = select(start + start, BASE_SAMPLES, start == 0u);
    return select(limit, end, end < limit);
}
