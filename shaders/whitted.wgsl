// The itinerary: the whole ray tree of a sample, one loop with an explicit stack. Twin of src/kernel/whitted.rs.

import package::real::{real, vec3r};
import package::adaptive::{round_end, tally};
import package::background::background;
import package::bvh::{far, intersect, make_ray, steps};
import package::camera::primary_ray;
import package::film::{Sample, add, flush, flush3, settle};
import package::hash::{mix_hash, sample_offset};
import package::light::direct;
import package::material::{is_transmissive, scatter};
import package::math::max3;
import package::media::{attenuation, cross_face, current_medium};
import package::record::{record_end, record_surface};
import package::records::{Aov, Texel};
import package::surface::{Surface, resolve, spawn_before, spawn_behind};
import package::bindings::{film, frame};
import package::constants::{
    AIR, LOOP_STEPS, MAX_DEPTH, MAX_PASSES, NONE, RAY_PRIMARY, RAY_REFLECTION, RAY_REFRACTION, RAY_SHADOW,
};

// A ray of the tree that is still to be traced.
struct Branch {
    origin: vec3r,
    @if(transmission) media: u32,
    direction: vec3r,
    depth: u32,
    weight: vec3r,
    kind: u32,
    origin_face: u32,
}

// How a branch ends: where it meets a surface that matters, or `found` false where it meets none.
struct Landing {
    found: bool,
    surface: Surface,
    distance: real,
    @if(transmission) stuck: bool,
    @if(transmission) media: u32,
    @if(transmission) media_behind: u32,
}

// The branch to go on with, if `found`.
struct Next {
    found: bool,
    @if(bounces) branch: Branch,
}

var<private> sample: Sample;
// The ray in work; those that wait for it lie in the lane.
var<private> current: Branch;
@if(branches) var<private> stack_size: u32;
// Which of the film's lanes is this invocation's: its stack lies there, so that a rest costs nothing.
@if(rests) var<private> lane: u32;

// Trace the tile's samples of a pixel of the whole picture onto texel `slot` of the film; false if it had to rest, to be
// resumed by the next dispatch.
fn trace_pixel(pixel: vec2u, slot: u32) -> bool {
    @if(antialiasing) var i = film.head.tile.first_sample;
    @else var i = 0u;
    @if(antialiasing) var end = i + film.head.tile.sample_count;
    @else let end = 1u;
    @if(adaptive) {
        let start = film.texels[slot].statistics.start;
        i += start;
        end = min(start + end, round_end(start, frame.view.samples));
    }
    // A tree of one ray rests before it begins.
    var resumes = false;
    @if(rests) {
        if film.head.tile.resume != 0u {
            i = film.lanes[lane].sample_index;
            @if(bounces) {
                resumes = true;
                sample = film.lanes[lane].sample;
                current = film.lanes[lane].branch;
            }
            @if(branches) stack_size = film.lanes[lane].stack_size;
        }
    }
    var finished = true;
    for (; i < end; i++) {
        if !resumes {
            let offset = sample_offset(i);
            let x = real(i32(pixel.x)) + offset[0];
            let y = real(i32(pixel.y)) + offset[1];
            start_tree(primary_ray(x, y));
        }
        resumes = false;
        finished = trace_tree();
        if !finished {
            break;
        }
        var before: Texel;
        // A film is not cleared: the first sample of a pixel takes the place of what is there.
        @if(antialiasing) {
            if i > 0u {
                before = film.texels[slot].texel;
            }
        }
        film.texels[slot].texel = add(before, sample, i);
        @if(adaptive) {
            film.texels[slot].statistics =
                tally(film.texels[slot].statistics, flush3(sample.radiance), sample.first_body);
        }
        @if(antialiasing && !adaptive) {
            if i > 0u && i + 1u == frame.view.samples {
                film.texels[slot].texel = settle(film.texels[slot].texel, i + 1u);
            }
        }
        @if(aovs) {
            if i == 0u {
                film.texels[slot].aov = sample.aov;
            }
        }
        atomicAdd(&film.head.primary, sample.rays_by_kind[RAY_PRIMARY]);
        @if(reflection) atomicAdd(&film.head.reflection, sample.rays_by_kind[RAY_REFLECTION]);
        @if(transmission) atomicAdd(&film.head.refraction, sample.rays_by_kind[RAY_REFRACTION]);
        @if(shadows) atomicAdd(&film.head.shadow, sample.rays_by_kind[RAY_SHADOW]);
    }
    @if(rests) film.lanes[lane].sample_index = i;
    @if(bounces) {
        film.lanes[lane].sample = sample;
        film.lanes[lane].branch = current;
    }
    @if(branches) film.lanes[lane].stack_size = stack_size;
    return finished;
}

// Begin the tree of one primary ray in `sample`.
fn start_tree(direction: vec3r) {
    sample.radiance = vec3r(0.0);
    @if(bounces) sample.dropped = 0.0;
    @if(bounces) sample.bound = 0.0;
    sample.rays = 0u;
    sample.rays_by_kind = vec4u(0u);
    sample.primitive_hash = 0u;
    sample.body_hash = 0u;
    @if(aovs) { sample.aov = Aov(vec3f(0.0), 0.0, NONE, NONE, vec2u(0u)); }
    @if(adaptive) { sample.first_body = NONE; }
    @if(branches) stack_size = 0u;
    @if(tree) film.tree.count = 0u;
    current.origin = vec3r(frame.view.eye);
    @if(transmission) current.media = frame.view.start_media;
    current.direction = direction;
    current.depth = 0u;
    current.weight = vec3r(1.0);
    current.kind = RAY_PRIMARY;
    current.origin_face = NONE;
}

// Leave a branch for later.
fn push(branch: Branch) {
    @if(branches) {
        film.lanes[lane].stack[stack_size] = branch;
        stack_size++;
    }
}

// Trace what is left of the tree; false if the steps of this dispatch are used up before it is done.
fn trace_tree() -> bool {
    loop {
        @if(rests) {
            if steps >= film.head.tile.step_budget {
                return false;
            }
            steps += LOOP_STEPS;
        }
        // Refraction goes on, reflection waits: one entry a branching level.
        let next = follow(current);
        @if(bounces) {
            if next.found {
                current = next.branch;
                continue;
            }
        }
        @if(branches) {
            if stack_size > 0u {
                stack_size--;
                current = film.lanes[lane].stack[stack_size];
                continue;
            }
        }
        break;
    }
    return true;
}

// Trace one branch, if that is worth it, and shade what it meets; returns the child to go on with.
fn follow(branch: Branch) -> Next {
    var next: Next;
    var landing: Landing;
    // A ray from the eye always is.
    @if(bounces) var cut = !worth_tracing(branch);
    @else let cut = false;
    if !cut {
        count_ray(branch.kind);
        landing = find_surface(branch);
        @if(transmission) cut = landing.stuck;
    }
    if landing.found {
        next = shade(branch, landing);
    } else {
        see_background(branch, cut);
    }
    return next;
}

// Whether a branch is traced: it is neither too deep nor too faint.
fn worth_tracing(branch: Branch) -> bool {
    return branch.depth <= frame.view.depth && max3(branch.weight) >= real(frame.view.cutoff);
}

// Count a traced ray.
fn count_ray(kind: u32) {
    sample.rays++;
    sample.rays_by_kind[kind]++;
}

// Follow a branch through interfaces that change no medium to the first surface that matters.
fn find_surface(branch: Branch) -> Landing {
    var landing: Landing;
    @if(!transmission) {
        let ray = make_ray(branch.origin, branch.direction, branch.origin_face);
        let hit = intersect(ray, far());
        if hit.id != NONE {
            landing.found = true;
            landing.distance = hit.t;
            landing.surface = resolve(ray, hit);
        }
    }
    @if(transmission) {
        var origin = branch.origin;
        var origin_face = branch.origin_face;
        landing.media = branch.media;
        landing.distance = 0.0;
        for (var i = 0u; i < MAX_PASSES; i++) {
            steps += LOOP_STEPS;
            let ray = make_ray(origin, branch.direction, origin_face);
            let hit = intersect(ray, far());
            if hit.id == NONE {
                return landing;
            }
            landing.distance = landing.distance + hit.t;
            landing.surface = resolve(ray, hit);
            landing.media_behind = cross_face(landing.media, hit.id, hit.front);
            let opaque = !is_transmissive(landing.surface.material);
            if opaque || current_medium(landing.media_behind) != current_medium(landing.media) {
                landing.found = true;
                return landing;
            }
            landing.media = landing.media_behind;
            origin = spawn_behind(landing.surface);
            origin_face = hit.id;
        }
        landing.stuck = true;
    }
    return landing;
}

// A branch that meets nothing sees the background. A cut one takes it too, and is accounted for.
fn see_background(branch: Branch, cut: bool) {
    let light = branch.weight * background(branch.direction);
    sample.radiance = sample.radiance + light;
    @if(tree) record_end(branch, light, cut);
    if !cut {
        sample.primitive_hash = mix_hash(sample.primitive_hash, branch.kind);
        sample.body_hash = mix_hash(sample.body_hash, branch.kind);
        return;
    }
    @if(bounces) {
        let weight = max3(branch.weight);
        sample.dropped = sample.dropped + weight;
        // The true tree goes down to MAX_DEPTH, that is MAX_DEPTH + 1 - depth levels from here.
        if branch.depth <= MAX_DEPTH {
            let levels = MAX_DEPTH + 1u - branch.depth;
            sample.bound = sample.bound + weight * real(frame.view.radiance_bound[levels >> 2][levels & 3]);
        }
    }
}

// Add a surface's local light, and make its children: the one to go on with is returned, the other waits on the stack.
fn shade(branch: Branch, landing: Landing) -> Next {
    let surface = landing.surface;
    @if(transmission) let before = current_medium(landing.media);
    @else let before = AIR;
    @if(transmission) let behind = current_medium(landing.media_behind);
    @else let behind = AIR;
    @if(absorption) let weight = branch.weight * attenuation(before, landing.distance);
    @else let weight = branch.weight;
    // Local light.
    @if(tinted_shadows) let local = direct(surface, branch.direction, landing.media);
    @else let local = direct(surface, branch.direction);
    let light = weight * local.radiance;
    sample.radiance = sample.radiance + light;
    sample.rays += local.shadow_rays;
    sample.rays_by_kind[RAY_SHADOW] += local.shadow_rays;
    note_path(branch.kind, surface, local.seen);
    @if(aovs) {
        if branch.depth == 0u {
            sample.aov = Aov(flush3(surface.normal), flush(landing.distance), surface.body, behind, vec2u(0u));
        }
    }
    @if(adaptive) {
        if branch.depth == 0u {
            sample.first_body = surface.body;
        }
    }
    // Children: where there are two, reflection waits.
    var next: Next;
    @if(bounces) let scattered = scatter(surface, branch.direction, before, behind);
    @if(tree) record_surface(branch, landing, weight, light, local, scattered);
    @if(reflection) {
        if scattered.reflects {
            next.found = true;
            next.branch.origin = spawn_before(surface);
            @if(transmission) next.branch.media = landing.media;
            next.branch.direction = scattered.reflected;
            next.branch.depth = branch.depth + 1u;
            next.branch.weight = weight * scattered.reflection;
            next.branch.kind = RAY_REFLECTION;
            next.branch.origin_face = surface.id;
        }
    }
    @if(transmission) {
        if scattered.transmits {
            @if(branches) {
                if next.found {
                    push(next.branch);
                }
            }
            next.found = true;
            next.branch.origin = spawn_behind(surface);
            next.branch.media = landing.media_behind;
            next.branch.direction = scattered.refracted;
            next.branch.depth = branch.depth + 1u;
            next.branch.weight = weight * scattered.transmission;
            next.branch.kind = RAY_REFRACTION;
            next.branch.origin_face = surface.id;
        }
    }
    return next;
}

// Enter a surface into both path hashes.
fn note_path(kind: u32, surface: Surface, seen: u32) {
    let side = select(8u, 4u, surface.front);
    sample.primitive_hash = mix_hash(mix_hash(mix_hash(sample.primitive_hash, surface.id), kind), seen);
    sample.body_hash = mix_hash(mix_hash(mix_hash(sample.body_hash, surface.body), kind + side), seen);
}
