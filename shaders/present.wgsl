// The viewer: a film on a window, developed or in false colours.
//
// src/viewer/present.rs puts the constants that it shares with the renderer before it: BLOCK, NONE, LEAST_NORMAL.

// How a film lies in its buffer, and what is on it.
struct Reel {
    // 0 for no film.
    width: u32,
    height: u32,
    first_word: u32,
    pixel_words: u32,
    // Blocks in a row.
    columns: u32,
    // Samples of a finished pixel, of every pixel, and how many blocks have one more.
    samples: u32,
    passes: u32,
    blocks: u32,
    // Words from a pixel's start to its AOV and to its statistics; 0 for none.
    aov_at: u32,
    statistics_at: u32,
    reserved: vec2u,
}

// What is shown, and where.
struct Look {
    film: Reel,
    // The CPU's picture.
    reference: Reel,
    // Left, top, width and height of the picture in pixels of the target.
    area: vec4f,
    gain: f32,
    // A number of AovKind from 1, or DIFFERENCE.
    kind: u32,
    reserved: vec2u,
}

// The greatest values of a film; as bits where they are floats, none of which is negative.
struct Ranges {
    near: u32, far: u32, rays: u32, samples: u32, dropped: u32, bound: u32, reserved: vec2u,
}

@group(0) @binding(0) var<storage, read> words: array<u32>;
@group(0) @binding(1) var<storage, read> reference: array<u32>;
@group(0) @binding(2) var<storage, read> steps: array<f32, 256>;
// No uniform: lavapipe folds those that decide branches into a copy of the shader, compiled anew at every draw.
@group(0) @binding(3) var<storage, read> look: Look;
@group(0) @binding(4) var<storage, read> ranges: Ranges;
@group(0) @binding(5) var<storage, read_write> measured: array<atomic<u32>, 8>;
// A film of fewer pixels than the picture has on the window, developed.
@group(0) @binding(6) var small: texture_2d<f32>;
@group(0) @binding(7) var smoothly: sampler;

// The view after those of AovKind.
const DIFFERENCE: u32 = 11u;
// Logarithmic scales span this factor below the greatest value.
const DECADES: f32 = 6.0;

// A triangle that covers the window.
@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// What the camera sees, pixel by pixel.
@fragment
fn beauty(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return vec4f(develop(mean(pixel_at(position.xy - look.area.xy))), 1.0);
}

// An auxiliary picture. An entry point of its own, since lavapipe runs both sides of every branch.
@fragment
fn false_colours(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return vec4f(false_colour(pixel_at(position.xy - look.area.xy)), 1.0);
}

// Between the pixels of a developed film.
@fragment
fn enlarge(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return textureSampleLevel(small, smoothly, (position.xy - look.area.xy) / look.area.zw, 0.0);
}

fn real(index: u32) -> f32 {
    return bitcast<f32>(words[index]);
}

// Samples of a pixel on the film.
fn samples_of(pixel: vec2u) -> u32 {
    let block = (pixel.y / BLOCK) * look.film.columns + pixel.x / BLOCK;
    return look.film.passes + select(0u, 1u, block < look.film.blocks);
}

// The pixel under a place in the picture.
fn pixel_at(place: vec2f) -> vec2u {
    let size = vec2f(f32(look.film.width), f32(look.film.height));
    return vec2u(clamp(floor(place * size / look.area.zw), vec2f(0.0), size - 1.0));
}

// First word of a pixel.
fn record(film: Reel, pixel: vec2u) -> u32 {
    return film.first_word + (pixel.y * film.width + pixel.x) * film.pixel_words;
}

// The mean of the samples that a pixel has: a finished film holds it, one in work their sum.
fn mean(pixel: vec2u) -> vec3f {
    let at = record(look.film, pixel);
    let sum = vec3f(real(at), real(at + 1u), real(at + 2u));
    let samples = samples_of(pixel);
    if samples == look.film.samples {
        return sum;
    }
    return sum / f32(samples);
}

// What a PNG file of the radiance shows, code for code.
fn develop(radiance: vec3f) -> vec3f {
    let exposed = radiance * look.gain;
    if !all(abs(exposed) <= vec3f(3.4028234e38)) {
        return vec3f(1.0, 0.0, 1.0);
    }
    return vec3f(srgb(exposed.x), srgb(exposed.y), srgb(exposed.z));
}

// The sRGB code of a linear value, as a part of 255. Devices round pow as they like: the table of the least value of each
// code puts right what it misses.
fn srgb(linear: f32) -> f32 {
    let v = clamp(linear, 0.0, 1.0);
    let guess = select(1.055 * pow(v, 1.0 / 2.4) - 0.055, 12.92 * v, v <= 0.0031308);
    var code = u32(clamp(guess * 255.0 + 0.5, 0.0, 255.0));
    if v < steps[code] {
        code -= 1u;
    } else if code < 255u && v >= steps[code + 1u] {
        code += 1u;
    }
    return f32(code) / 255.0;
}

// What AovKind::preview shows, in its order of kinds from 1.
fn false_colour(pixel: vec2u) -> vec3f {
    let film = look.film;
    let kind = look.kind;
    let at = record(film, pixel);
    let samples = samples_of(pixel);
    // Weights and bounds are sums until the film is finished.
    let share = select(1.0 / f32(samples), 1.0, samples == film.samples);
    if kind <= 4u {
        return first_hit(kind, film, at);
    }
    if kind == DIFFERENCE {
        return difference(film, pixel, at);
    }
    switch kind {
        case 5u: { return counts(words[at + 5u], ranges.rays); }
        case 6u: {
            if film.statistics_at != 0u {
                return counts(words[at + film.statistics_at + 4u], ranges.samples);
            }
            return counts(samples, max(ranges.samples, film.samples));
        }
        case 7u: { return decades(real(at + 3u) * share, bitcast<f32>(ranges.dropped)); }
        case 8u: { return decades(real(at + 4u) * share, bitcast<f32>(ranges.bound)); }
        case 9u: { return palette(words[at + 6u]); }
        default: { return palette(words[at + 7u]); }
    }
}

// Depth, normal, body or medium of the first hit; black where the film was traced without them, or nothing was met.
fn first_hit(kind: u32, film: Reel, at: u32) -> vec3f {
    if film.aov_at == 0u {
        return vec3f(0.0);
    }
    let aov = at + film.aov_at;
    let body = words[aov + 4u];
    if body == NONE {
        return vec3f(0.0);
    }
    switch kind {
        case 1u: {
            let near = bitcast<f32>(ranges.near);
            let span = max(bitcast<f32>(ranges.far) - near, LEAST_NORMAL);
            return vec3f(1.0 - 0.85 * (real(aov + 3u) - near) / span);
        }
        case 2u: {
            return vec3f(real(aov), real(aov + 1u), real(aov + 2u)) * 0.5 + 0.5;
        }
        case 3u: { return palette(body); }
        default: {
            let medium = words[aov + 5u];
            if medium == 0u {
                return vec3f(40.0 / 255.0);
            }
            return palette(medium);
        }
    }
}

// Black where every bit of the radiance is that of the CPU's picture; dark grey where there is none. See
// film::difference_preview.
fn difference(film: Reel, pixel: vec2u, at: u32) -> vec3f {
    if look.reference.width != film.width || look.reference.height != film.height {
        return vec3f(40.0 / 255.0);
    }
    let other = record(look.reference, pixel);
    var most = 0.0;
    var is_same = true;
    for (var channel = 0u; channel < 3u; channel++) {
        let bits = words[at + channel];
        is_same = is_same && bits == reference[other + channel];
        most = max(most, abs(bitcast<f32>(bits) - bitcast<f32>(reference[other + channel])));
    }
    if is_same {
        return vec3f(0.0);
    }
    return viridis(1.0 + log(max(most, 1e-30)) / (log(10.0) * 7.0));
}

fn counts(count: u32, most: u32) -> vec3f {
    return viridis(log(1.0 + f32(count)) / log(1.0 + f32(max(most, 1u))));
}

fn decades(value: f32, most: f32) -> vec3f {
    if !(value > 0.0) {
        return vec3f(0.0);
    }
    return viridis(1.0 + log(value / most) / (log(10.0) * DECADES));
}

// See src/film/colormap.rs.
fn viridis(at: f32) -> vec3f {
    let t = clamp(at, 0.0, 1.0);
    var color = vec3f(-5.435456, 4.6458526, 26.312435);
    color = color * t + vec3f(4.7763850, -13.745145, -65.353030);
    color = color * t + vec3f(6.2282700, 14.179933, 56.690550);
    color = color * t + vec3f(-4.6342305, -5.7991010, -19.332441);
    color = color * t + vec3f(-0.33086183, 0.21484756, 0.095095160);
    color = color * t + vec3f(0.10509304, 1.4046135, 1.3845902);
    color = color * t + vec3f(0.27772733, 0.0054073445, 0.33409980);
    return color;
}

// See src/film/colormap.rs.
fn palette(id: u32) -> vec3f {
    let hue = f32((id * 0x9E3779B9u) >> 8u) / 16777216.0;
    var values = array<f32, 3>(0.95, 0.75, 0.55);
    let value = values[((id * 0x85EBCA6Bu) >> 16u) % 3u];
    let k = (vec3f(5.0, 3.0, 1.0) + hue * 6.0) % 6.0;
    return value - value * 0.65 * clamp(min(k, 4.0 - k), vec3f(0.0), vec3f(1.0));
}

// The ranges of the finished film.
@compute @workgroup_size(BLOCK, BLOCK)
fn measure(@builtin(global_invocation_id) id: vec3u) {
    let film = look.film;
    if id.x >= film.width || id.y >= film.height {
        return;
    }
    let at = record(film, id.xy);
    atomicMax(&measured[2], words[at + 5u]);
    atomicMax(&measured[4], finite(words[at + 3u]));
    atomicMax(&measured[5], finite(words[at + 4u]));
    if film.statistics_at != 0u {
        atomicMax(&measured[3], words[at + film.statistics_at + 4u]);
    } else {
        atomicMax(&measured[3], film.samples);
    }
    if film.aov_at != 0u && words[at + film.aov_at + 4u] != NONE {
        atomicMin(&measured[0], words[at + film.aov_at + 3u]);
        atomicMax(&measured[1], words[at + film.aov_at + 3u]);
    }
}

// The bits of a float, or of 0 where it is infinite or none.
fn finite(bits: u32) -> u32 {
    return select(0u, bits, bits < 0x7f800000u);
}
