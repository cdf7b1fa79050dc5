//! Functions that look at the scene. Twin of shaders/probe_scene.wgsl.

use crate::kernel::background::background;
use crate::kernel::bvh::{far, intersect, make_ray, occluded, slabs};
use crate::kernel::camera::primary_ray;
use crate::kernel::light::{direct, transmittance};
use crate::kernel::material::{scatter, shadow_transmission};
use crate::kernel::math::length3;
use crate::kernel::media::{attenuation, cross_face, current_medium};
use crate::kernel::surface::{Surface, resolve, spawn_before, spawn_behind};
use crate::kernel::texture::texture_color;
use crate::kernel::{Vec3, World};
use crate::layout::constants::NONE;

use super::Probe;
use super::inputs::Input::{Direction, Number, Point, Positive, Word};
use super::record::Record;
use super::soup::{MATERIALS, MEDIA_MASKS, TRIANGLES};

pub(super) const PROBES: &[Probe] = &[
    Probe {
        name: "primary_ray",
        inputs: &[Number, Number],
        outputs: 3,
        run: |world, io| {
            let (x, y) = (io.take(), io.take());
            io.put3(primary_ray(world, x, y));
        },
    },
    Probe {
        name: "make_ray",
        inputs: &[Point, Direction],
        outputs: 9,
        run: |world, io| {
            let (origin, direction) = (io.take3(), io.take3());
            let ray = make_ray(world, origin, direction, NONE);
            io.put3(ray.reciprocal);
            io.put3(ray.origin_hi);
            io.put3(ray.origin_lo);
        },
    },
    Probe {
        name: "slabs",
        inputs: &[Point, Direction, Point, Point],
        outputs: 2,
        run: |world, io| {
            let (origin, direction) = (io.take3(), io.take3());
            let lo = io.take3();
            let span = slabs(&make_ray(world, origin, direction, NONE), lo, lo + io.take3().abs());
            io.put(span.entry);
            io.put(span.exit);
        },
    },
    Probe {
        name: "intersect",
        inputs: &[Point, Direction, Word(TRIANGLES)],
        outputs: 5,
        run: |world, io| {
            let (origin, direction) = (io.take3(), io.take3());
            let hit = intersect(world, &make_ray(world, origin, direction, io.take_word()), far());
            io.put_word(hit.id);
            io.put(hit.t);
            io.put(hit.b1);
            io.put(hit.b2);
            io.put_flag(hit.front);
        },
    },
    Probe {
        name: "occluded",
        inputs: &[Point, Direction, Positive, Word(TRIANGLES)],
        outputs: 1,
        run: |world, io| {
            let (origin, direction) = (io.take3(), io.take3());
            let limit = io.take();
            let ray = make_ray(world, origin, direction, io.take_word());
            io.put_flag(occluded(world, &ray, limit));
        },
    },
    Probe {
        name: "resolve",
        inputs: &[Point, Direction],
        outputs: 15,
        run: |world, io| {
            let (_, surface) = take_meeting(world, io);
            io.put_flag(surface.is_some());
            if let Some(s) = surface {
                io.put3(s.normal);
                io.put3(s.shadow_point);
                io.put(s.uv[0]);
                io.put(s.uv[1]);
                io.put3(spawn_before(&s));
                io.put3(spawn_behind(&s));
            }
        },
    },
    Probe {
        name: "scatter",
        inputs: &[Point, Direction, Word(MATERIALS), Word(MATERIALS)],
        outputs: 15,
        run: |world, io| {
            let (direction, surface) = take_meeting(world, io);
            let (before, behind) = (io.take_word(), io.take_word());
            io.put_flag(surface.is_some());
            if let Some(surface) = surface {
                let s = scatter(world, &surface, direction, before, behind);
                io.put3(s.reflected);
                io.put3(s.reflection);
                io.put3(s.refracted);
                io.put3(s.transmission);
                io.put_flag(s.reflects);
                io.put_flag(s.transmits);
            }
        },
    },
    Probe {
        name: "shadow_transmission",
        inputs: &[Point, Direction, Word(MATERIALS), Word(MATERIALS)],
        outputs: 4,
        run: |world, io| {
            let (direction, surface) = take_meeting(world, io);
            let (before, behind) = (io.take_word(), io.take_word());
            io.put_flag(surface.is_some());
            if let Some(surface) = surface {
                io.put3(shadow_transmission(world, &surface, direction, before, behind));
            }
        },
    },
    Probe {
        name: "direct",
        inputs: &[Point, Direction, Word(MEDIA_MASKS)],
        outputs: 6,
        run: |world, io| {
            let (direction, surface) = take_meeting(world, io);
            let media = io.take_word();
            io.put_flag(surface.is_some());
            if let Some(surface) = surface {
                let local = direct(world, &surface, direction, media);
                io.put3(local.radiance);
                io.put_word(local.seen);
                io.put_word(local.shadow_rays);
            }
        },
    },
    Probe {
        name: "transmittance",
        inputs: &[Point, Point, Word(MEDIA_MASKS)],
        outputs: 3,
        run: |world, io| {
            let (origin, light) = (io.take3(), io.take3());
            let path = light - origin;
            let distance = length3(path);
            let l = Vec3::new(path.x / distance, path.y / distance, path.z / distance);
            let media = io.take_word();
            io.put3(transmittance(world, origin, l, distance, light, NONE, media));
        },
    },
    Probe {
        name: "current_medium",
        inputs: &[Word(MEDIA_MASKS)],
        outputs: 1,
        run: |world, io| {
            let mask = io.take_word();
            io.put_word(current_medium(world, mask));
        },
    },
    Probe {
        name: "cross_face",
        inputs: &[Word(MEDIA_MASKS), Word(TRIANGLES), Word(2)],
        outputs: 1,
        run: |world, io| {
            let (mask, face) = (io.take_word(), io.take_word());
            let front = io.take_word() == 1;
            io.put_word(cross_face(world, mask, face, front));
        },
    },
    Probe {
        name: "attenuation",
        inputs: &[Word(MATERIALS), Positive],
        outputs: 3,
        run: |world, io| {
            let medium = io.take_word();
            let t = io.take();
            io.put3(attenuation(world, medium, t));
        },
    },
    Probe {
        name: "texture_color",
        inputs: &[Number, Number, Word(MATERIALS)],
        outputs: 3,
        run: |world, io| {
            let uv = [io.take(), io.take()];
            let material = io.take_word();
            io.put3(texture_color(world, material, uv));
        },
    },
    Probe {
        name: "background",
        inputs: &[Direction],
        outputs: 3,
        run: |world, io| {
            let direction = io.take3();
            io.put3(background(world, direction));
        },
    },
];

/// Where a ray goes, and the surface that it meets.
fn take_meeting(world: &World, io: &mut Record) -> (Vec3<f32>, Option<Surface<f32>>) {
    let (origin, direction) = (io.take3(), io.take3());
    let ray = make_ray(world, origin, direction, NONE);
    let hit = intersect(world, &ray, far());
    (direction, (hit.id != NONE).then(|| resolve(world, &ray, &hit)))
}
