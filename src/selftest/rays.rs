//! Rays through the scene, whole. Twin of `shaders/probe_rays.wgsl`.

use super::{Escape, Leave, Left, Walk, Walked};
use crate::kernel::bvh::{Hit, far, intersect, make_ray};
use crate::kernel::hash::mix_hash;
use crate::kernel::math::dot3;
use crate::kernel::media::{cross_face, set_body};
use crate::kernel::surface::{resolve, spawn_before, spawn_behind};
use crate::kernel::{Real, Vec3, World};
use crate::layout::constants::NONE;

/// A straight ray from face to face: where it goes, and what it met.
pub(super) fn walk<R: Real>(world: &World, query: &Walk) -> Walked {
    let mut origin = Vec3::<R>::load(query.origin);
    let mut origin_face = NONE;
    let direction = Vec3::load(query.direction);
    let mut walked = Walked {
        escape: Escape::Limit,
        faces: 0,
        idle: 0,
        media: query.media,
        hash: 0,
        first: NONE,
        distance: 0.0,
        point: [0.0; 3],
    };
    while walked.faces < query.limit {
        let ray = make_ray(world, origin, direction, origin_face);
        let hit = intersect(world, &ray, far());
        if hit.id == NONE {
            walked.escape = Escape::Free;
            break;
        }
        let surface = resolve(world, &ray, &hit);
        if walked.faces == 0 {
            walked.first = hit.id;
            walked.distance = hit.t.to_f32();
            walked.point = store(surface.point);
        }
        walked.faces += 1;
        walked.hash = mix_hash(walked.hash, hit.id);
        if set_body(world, walked.media, surface.body, hit.front) == walked.media {
            walked.idle += 1;
        }
        walked.media = cross_face(world, walked.media, hit.id, hit.front);
        origin = spawn_behind(&surface);
        origin_face = hit.id;
    }
    walked
}

/// A ray that leaves a given point of the face at `index`, and what it meets first.
pub(super) fn leave<R: Real>(world: &World, index: u32, query: &Leave) -> Left {
    let [b1, b2] = query.barycentrics.map(R::real);
    let arriving = Vec3::<R>::load(query.arriving);
    let outward = Vec3::load(world.scene.attributes[query.id as usize].normal);
    let front = dot3(outward, arriving) < R::ZERO;
    let ray = make_ray(world, Vec3::zero(), arriving, NONE);
    let surface = resolve(world, &ray, &Hit { t: R::ZERO, id: query.id, index, b1, b2, front });
    let origin = if query.behind { spawn_behind(&surface) } else { spawn_before(&surface) };
    let hit = intersect(world, &make_ray(world, origin, Vec3::load(query.leaving), query.id), far());
    Left { origin: store(origin), met: hit.id, distance: hit.t.to_f32() }
}

fn store<R: Real>(v: Vec3<R>) -> [f32; 3] {
    [v.x, v.y, v.z].map(R::to_f32)
}
