//! In which media the rays of a picture leave the scene.

use snellius::kernel::bvh::{far, intersect, make_ray};
use snellius::kernel::camera::primary_ray;
use snellius::kernel::media::cross_face;
use snellius::kernel::surface::{resolve, spawn_behind};
use snellius::kernel::whitted::{Branch, find_surface, follow, start_tree, worth_tracing};
use snellius::kernel::{Real, World};
use snellius::layout::constants::NONE;
use snellius::layout::{EffectSet, Intersector};
use snellius::selftest::Stage;

/// Rays that leave the scene.
#[derive(Debug, Default)]
pub(super) struct Exits {
    /// All of them.
    pub(super) rays: u64,
    /// Those that do not leave through air.
    pub(super) unbalanced: u64,
}

/// Trace the picture's trees through the middles of its pixels, and see their rays off.
pub(super) fn exits<R: Real>(stage: &Stage) -> Exits {
    let world = World {
        scene: &stage.flat,
        view: &stage.view,
        intersector: Intersector::Watertight,
        effects: EffectSet::ALL,
    };
    let [_, _, width, height] = stage.view.crop;
    let mut exits = Exits::default();
    for pixel in 0..width * height {
        let [x, y] = [pixel % width, pixel / width].map(|at| R::from_i32(at as i32) + R::of(0.5));
        tree(&world, primary_ray(&world, x, y), &mut exits);
    }
    exits
}

/// Follow every branch of a tree.
fn tree<R: Real>(world: &World, direction: snellius::kernel::Vec3<R>, exits: &mut Exits) {
    let mut stack = Vec::new();
    let mut sample = start_tree(world, &mut stack, direction);
    while let Some(branch) = stack.pop() {
        let mut next = Some(branch);
        while let Some(current) = next {
            if worth_tracing(world, &current) {
                see_off(world, &current, exits);
            }
            next = follow(world, &mut sample, &mut stack, &current);
        }
    }
}

/// Count a branch that meets no surface that matters.
fn see_off<R: Real>(world: &World, branch: &Branch<R>, exits: &mut Exits) {
    let landing = find_surface(world, branch);
    if landing.found || landing.stuck {
        return;
    }
    // Through interfaces that change no medium, as `find_surface` goes.
    let (mut origin, mut face, mut media) = (branch.origin, branch.origin_face, branch.media);
    loop {
        let ray = make_ray(world, origin, branch.direction, face);
        let hit = intersect(world, &ray, far());
        if hit.id == NONE {
            break;
        }
        media = cross_face(world, media, hit.id, hit.front);
        face = hit.id;
        origin = spawn_behind(&resolve(world, &ray, &hit));
    }
    exits.rays += 1;
    exits.unbalanced += u64::from(media != 0);
}
