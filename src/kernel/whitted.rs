//! The itinerary: the whole ray tree of a sample (Whitted 1980), one loop with an explicit stack. Twin of
//! `shaders/whitted.wgsl`.

use crate::layout::constants::{
    MAX_DEPTH, MAX_PASSES, NONE, RAY_PRIMARY, RAY_REFLECTION, RAY_REFRACTION, RAY_SHADOW,
};
use crate::layout::{Aov, Effect, Statistics, Texel};

use super::adaptive::tally;
use super::background::background;
use super::bvh::{far, make_ray};
use super::camera::primary_ray;
use super::film::{self, Sample};
use super::hash::{mix_hash, sample_offset};
use super::light::direct;
use super::material::{is_transmissive, scatter};
use super::math::max3;
use super::media::{attenuation, cross_face, current_medium};
use super::record::{record_end, record_surface};
use super::surface::{Surface, resolve, spawn_before, spawn_behind};
use super::{Real, Simulation, Vec3, World};

/// A ray of the tree that is still to be traced.
#[derive(Debug, Clone, Copy)]
pub struct Branch<R> {
    /// Where it starts.
    pub origin: Vec3<R>,
    /// Media mask there.
    pub media: u32,
    /// Unit direction.
    pub direction: Vec3<R>,
    /// 0 for the primary ray.
    pub depth: u32,
    /// What its radiance counts for in the pixel, per channel.
    pub weight: Vec3<R>,
    /// What made it: `RAY_PRIMARY`, `RAY_REFLECTION` or `RAY_REFRACTION`.
    pub kind: u32,
    /// Primitive id of the face that it leaves; `NONE` for the primary ray.
    pub origin_face: u32,
}

/// How a branch ends: where it meets a surface that matters, or `found` false where it meets none.
#[derive(Debug, Clone, Copy)]
pub struct Landing<R> {
    /// Whether there is a surface.
    pub found: bool,
    /// Whether the ray was stuck between interfaces without effect.
    pub stuck: bool,
    /// The surface.
    pub surface: Surface<R>,
    /// Distance travelled.
    pub distance: R,
    /// Media mask on arrival.
    pub media: u32,
    /// Media mask behind the surface.
    pub media_behind: u32,
}

/// Trace samples [first, first + count) of a pixel of the whole picture onto its texel. The AOV is that of sample 0.
///
/// With statistics (adaptive antialiasing) sums are left as they are, else the last of the view's samples settles them.
pub fn trace_pixel<R: Real>(
    world: &World<impl Simulation>,
    stack: &mut Vec<Branch<R>>,
    pixel: [u32; 2],
    samples: std::ops::Range<u32>,
    texel: &mut Texel,
    aov: &mut Aov,
    mut statistics: Option<&mut Statistics>,
) -> [u32; 4] {
    let mut rays = [0; 4];
    for i in samples {
        let [dx, dy] = sample_offset::<R>(i);
        let x = R::from_i32(pixel[0] as i32) + dx;
        let y = R::from_i32(pixel[1] as i32) + dy;
        let mut sample = start_tree(world, stack, primary_ray(world, x, y));
        trace_tree(world, stack, &mut sample);
        film::add(texel, &sample, i);
        match &mut statistics {
            Some(statistics) => tally(statistics, film::flush3(sample.radiance), sample.first_body),
            None => {
                let is_last = i > 0 && i + 1 == world.view.samples;
                if is_last && world.simulates(Effect::Antialiasing) {
                    film::settle(texel, i + 1);
                }
            }
        }
        for (sum, n) in rays.iter_mut().zip(sample.rays_by_kind) {
            *sum += n;
        }
        if i == 0 {
            *aov = sample.aov;
        }
    }
    rays
}

/// Begin the tree of one primary ray.
pub fn start_tree<R: Real>(
    world: &World<impl Simulation>,
    stack: &mut Vec<Branch<R>>,
    direction: Vec3<R>,
) -> Sample<R> {
    let mut media = 0;
    if world.view.start_media != media && world.simulates(Effect::Transmission) {
        media = world.view.start_media;
    }
    stack.clear();
    push(
        stack,
        Branch {
            origin: Vec3::load(world.view.eye),
            media,
            direction,
            depth: 0,
            weight: Vec3::one(),
            kind: RAY_PRIMARY,
            origin_face: NONE,
        },
    );
    Sample {
        radiance: Vec3::zero(),
        dropped: R::ZERO,
        bound: R::ZERO,
        rays: 0,
        rays_by_kind: [0; 4],
        primitive_hash: 0,
        body_hash: 0,
        aov: Aov { body: NONE, medium: NONE, ..Aov::default() },
        first_body: NONE,
    }
}

/// Leave a branch for later.
pub fn push<R: Real>(stack: &mut Vec<Branch<R>>, branch: Branch<R>) {
    stack.push(branch);
}

/// Trace what is left of the tree.
pub fn trace_tree<R: Real>(
    world: &World<impl Simulation>,
    stack: &mut Vec<Branch<R>>,
    sample: &mut Sample<R>,
) {
    while let Some(branch) = stack.pop() {
        // Refraction goes on, reflection waits: one entry a branching level.
        let mut next = Some(branch);
        while let Some(current) = next {
            next = follow(world, sample, stack, &current);
        }
    }
}

/// Trace one branch, if that is worth it, and shade what it meets; returns the child to go on with.
pub fn follow<R: Real>(
    world: &World<impl Simulation>,
    sample: &mut Sample<R>,
    stack: &mut Vec<Branch<R>>,
    branch: &Branch<R>,
) -> Option<Branch<R>> {
    let mut cut = !worth_tracing(world, branch);
    if !cut {
        count_ray(sample, branch.kind);
        let landing = find_surface(world, branch);
        if landing.found {
            return shade(world, sample, stack, branch, &landing);
        }
        cut = landing.stuck;
    }
    see_background(world, sample, branch, cut);
    None
}

/// Whether a branch is traced: it is neither too deep nor too faint.
pub fn worth_tracing<R: Real>(world: &World<impl Simulation>, branch: &Branch<R>) -> bool {
    branch.depth <= world.view.depth && max3(branch.weight) >= R::real(world.view.cutoff)
}

/// Count a traced ray.
pub fn count_ray<R: Real>(sample: &mut Sample<R>, kind: u32) {
    sample.rays += 1;
    sample.rays_by_kind[kind as usize] += 1;
}

/// Follow a branch through interfaces that change no medium to the first surface that matters.
pub fn find_surface<R: Real>(world: &World<impl Simulation>, branch: &Branch<R>) -> Landing<R> {
    let mut origin = branch.origin;
    let mut origin_face = branch.origin_face;
    let mut media = branch.media;
    let mut distance = R::ZERO;
    let mut landing = Landing {
        found: false,
        stuck: false,
        surface: Surface::default(),
        distance,
        media,
        media_behind: media,
    };
    for _ in 0..MAX_PASSES {
        let ray = make_ray(world, origin, branch.direction, origin_face);
        let hit = world.effects.intersect(world, &ray, far());
        if hit.id == NONE {
            return landing;
        }
        distance = distance + hit.t;
        let surface = resolve(world, &ray, &hit);
        let behind = cross_face(world, media, hit.id, hit.front);
        let opaque = !is_transmissive(world, surface.material);
        if opaque || current_medium(world, behind) != current_medium(world, media) {
            return Landing { found: true, stuck: false, surface, distance, media, media_behind: behind };
        }
        media = behind;
        origin = spawn_behind(&surface);
        origin_face = surface.id;
    }
    landing.stuck = true;
    landing
}

/// A branch that meets nothing sees the background. A cut one takes it too, and is accounted for.
pub fn see_background<R: Real>(
    world: &World<impl Simulation>,
    sample: &mut Sample<R>,
    branch: &Branch<R>,
    cut: bool,
) {
    let light = branch.weight * background(world, branch.direction);
    sample.radiance = sample.radiance + light;
    record_end(world, branch, light, cut);
    if !cut {
        sample.primitive_hash = mix_hash(sample.primitive_hash, branch.kind);
        sample.body_hash = mix_hash(sample.body_hash, branch.kind);
        return;
    }
    let weight = max3(branch.weight);
    sample.dropped = sample.dropped + weight;
    // The true tree goes down to MAX_DEPTH, that is MAX_DEPTH + 1 − depth levels from here.
    if branch.depth <= MAX_DEPTH {
        let levels = MAX_DEPTH + 1 - branch.depth;
        let row = world.view.radiance_bound[(levels >> 2) as usize];
        sample.bound = sample.bound + weight * R::real(row[(levels & 3) as usize]);
    }
}

/// Add a surface's local light, and make its children: the one to go on with is returned, the other waits on the stack.
pub fn shade<R: Real>(
    world: &World<impl Simulation>,
    sample: &mut Sample<R>,
    stack: &mut Vec<Branch<R>>,
    branch: &Branch<R>,
    landing: &Landing<R>,
) -> Option<Branch<R>> {
    let surface = &landing.surface;
    let before = current_medium(world, landing.media);
    let behind = current_medium(world, landing.media_behind);
    let weight = branch.weight * attenuation(world, before, landing.distance);
    // Local light.
    let local = direct(world, surface, branch.direction, landing.media);
    let light = weight * local.radiance;
    sample.radiance = sample.radiance + light;
    sample.rays += local.shadow_rays;
    sample.rays_by_kind[RAY_SHADOW as usize] += local.shadow_rays;
    note_path(sample, branch.kind, surface, local.seen);
    if branch.depth == 0 && world.simulates(Effect::Aovs) {
        sample.aov = Aov {
            normal: film::flush3(surface.normal),
            depth: film::flush(landing.distance),
            body: surface.body,
            medium: behind,
            reserved: [0; 2],
        };
    }
    if branch.depth == 0 && world.simulates(Effect::Adaptive) {
        sample.first_body = surface.body;
    }
    // Children: where there are two, reflection waits.
    let mut next = None;
    let scattered = scatter(world, surface, branch.direction, before, behind);
    record_surface(world, branch, landing, weight, light, &local, &scattered);
    if scattered.reflects {
        next = Some(Branch {
            origin: spawn_before(surface),
            media: landing.media,
            direction: scattered.reflected,
            depth: branch.depth + 1,
            weight: weight * scattered.reflection,
            kind: RAY_REFLECTION,
            origin_face: surface.id,
        });
    }
    if scattered.transmits {
        if let Some(reflection) = next {
            push(stack, reflection);
        }
        next = Some(Branch {
            origin: spawn_behind(surface),
            media: landing.media_behind,
            direction: scattered.refracted,
            depth: branch.depth + 1,
            weight: weight * scattered.transmission,
            kind: RAY_REFRACTION,
            origin_face: surface.id,
        });
    }
    next
}

/// Enter a surface into both path hashes.
pub fn note_path<R: Real>(sample: &mut Sample<R>, kind: u32, surface: &Surface<R>, seen: u32) {
    let side = if surface.front { 4 } else { 8 };
    sample.primitive_hash = mix_hash(mix_hash(mix_hash(sample.primitive_hash, surface.id), kind), seen);
    sample.body_hash = mix_hash(mix_hash(mix_hash(sample.body_hash, surface.body), kind + side), seen);
}
