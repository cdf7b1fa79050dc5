//! Inside or outside: winding numbers and the media at the eye.

use std::f64::consts::TAU;

use glam::DVec3;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use rayon::slice::ParallelSlice;

use super::faces::corners;
use super::number::widen3;
use super::place::bounds;
use crate::layout::constants::MAX_MEDIA;
use crate::layout::{Attribute, FlatScene, Triangle};

/// Triangles that one thread sums up at a time. Fixed, so that the sum does not depend on the threads.
const CHUNK: usize = 4096;

/// Triple products below this part of the product of the lengths are rounding (their bound is a few 2^-53).
const IN_PLANE: f64 = 1e-14;

/// The signed solid angle of a triangle seen from a point, in (−2π, 2π): positive where its back is seen, as
/// from inside a body (van Oosterom and Strackee 1983, "The solid angle of a plane triangle", equation 8).
/// From a point in its plane nothing is seen of it, so that the points of a closed surface lie half inside.
pub(super) fn solid_angle(point: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - point);
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let sine = a.dot(b.cross(c));
    let product = la * lb * lc;
    if sine.abs() <= IN_PLANE * product {
        return 0.0;
    }
    let cosine = product + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * sine.atan2(cosine)
}

/// How often a surface winds around a point: 1 inside a body, 0 outside, in between near holes (Jacobson,
/// Kavan, Sorkine-Hornung 2013, "Robust inside-outside segmentation using generalized winding numbers").
pub(super) fn winding_number(point: DVec3, faces: impl Iterator<Item = [DVec3; 3]>) -> f64 {
    faces.map(|corners| solid_angle(point, corners)).sum::<f64>() / (2.0 * TAU)
}

/// The media mask at a point: the bit of each transmissive body that holds it. A point on a face counts as
/// outside.
#[must_use]
pub fn start_media(scene: &FlatScene, eye: [f64; 3]) -> u32 {
    let (count, eye) = (scene.transmissive_bodies.min(MAX_MEDIA) as usize, DVec3::from_array(eye));
    if count == 0 || !holds(scene.bounds.map(widen3), eye) {
        return 0;
    }
    let candidates = boxes(scene, count).map(|bounds| holds(bounds, eye));
    if !candidates.contains(&true) {
        return 0;
    }
    let numbers = winding_numbers(scene, eye, &candidates);
    (0..count).filter(|&body| numbers[body] > 0.5).fold(0, |mask, body| mask | 1 << body)
}

/// The box of each transmissive body.
fn boxes(scene: &FlatScene, count: usize) -> [[DVec3; 2]; MAX_MEDIA as usize] {
    const EMPTY: [[DVec3; 2]; MAX_MEDIA as usize] = [[DVec3::MAX, DVec3::MIN]; MAX_MEDIA as usize];
    let grow = |mut boxes: [[DVec3; 2]; MAX_MEDIA as usize], triangle: &Triangle| {
        for (body, _) in walls(scene, triangle).into_iter().flatten().filter(|&(body, _)| body < count) {
            let [lo, hi] = bounds(&corners(triangle));
            boxes[body] = [boxes[body][0].min(lo), boxes[body][1].max(hi)];
        }
        boxes
    };
    let merge = |a: [[DVec3; 2]; MAX_MEDIA as usize], b: [[DVec3; 2]; MAX_MEDIA as usize]| {
        std::array::from_fn(|body| [a[body][0].min(b[body][0]), a[body][1].max(b[body][1])])
    };
    scene.triangles.par_iter().fold(|| EMPTY, grow).reduce(|| EMPTY, merge)
}

/// The winding number of each candidate body around a point; 0 for the others.
fn winding_numbers(scene: &FlatScene, eye: DVec3, candidates: &[bool]) -> [f64; MAX_MEDIA as usize] {
    let sum_up = |triangles: &[Triangle]| {
        let mut numbers = [0.0; MAX_MEDIA as usize];
        for triangle in triangles {
            for (body, sign) in walls(scene, triangle).into_iter().flatten() {
                if candidates.get(body).is_some_and(|&candidate| candidate) {
                    numbers[body] += sign * solid_angle(eye, corners(triangle)) / (2.0 * TAU);
                }
            }
        }
        numbers
    };
    let parts: Vec<[f64; MAX_MEDIA as usize]> = scene.triangles.par_chunks(CHUNK).map(sum_up).collect();
    parts
        .iter()
        .fold([0.0; MAX_MEDIA as usize], |sum, part| std::array::from_fn(|body| sum[body] + part[body]))
}

/// The bodies whose surface a triangle belongs to, each with 1 where the face looks out of its matter, else −1.
fn walls(scene: &FlatScene, triangle: &Triangle) -> [Option<(usize, f64)>; 2] {
    let face = &scene.attributes[triangle.id as usize];
    let other = (face.other != Attribute::NONE).then(|| {
        let sign = if face.other & Attribute::OPPOSITE == 0 { 1.0 } else { -1.0 };
        ((face.other & !Attribute::OPPOSITE) as usize, sign)
    });
    [Some((face.body as usize, 1.0)), other]
}

fn holds([lo, hi]: [DVec3; 2], point: DVec3) -> bool {
    point.cmpge(lo).all() && point.cmple(hi).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octant_is_an_eighth_of_the_sphere() {
        let angle = solid_angle(DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::Z]);
        assert!((angle - TAU / 4.0).abs() < 1e-15);
        assert!((solid_angle(DVec3::ZERO, [DVec3::X, DVec3::Z, DVec3::Y]) + TAU / 4.0).abs() < 1e-15);
    }

    #[test]
    fn a_face_is_half_inside() {
        let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let faces = [[o, y, x], [o, z, y], [o, x, z], [x, y, z]];
        for point in [DVec3::new(0.2, 0.3, 0.0), DVec3::new(0.0, 0.1, 0.7), DVec3::splat(1.0 / 3.0)] {
            assert!((winding_number(point, faces.into_iter()) - 0.5).abs() < 1e-12, "{point}");
        }
    }

    #[test]
    fn a_tetrahedron_winds_once_around_its_inside_at_any_scale() {
        let faces = |scale: f64| {
            let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|v| v * scale);
            [[o, y, x], [o, z, y], [o, x, z], [x, y, z]]
        };
        for scale in [1e-15, 1.0, 1e18] {
            let at = |part: f64| winding_number(DVec3::splat(part * scale), faces(scale).into_iter());
            assert!((at(0.1) - 1.0).abs() < 1e-12, "{scale}");
            assert!(at(-0.1).abs() < 1e-12 && at(0.5).abs() < 1e-12, "{scale}");
        }
    }
}
