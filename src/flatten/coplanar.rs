//! Faces of two transmissive bodies that overlap in one plane without coinciding.
//!
//! A ray meets such faces in an order that rounding decides, so that the picture there is unreliable. The
//! search is a help, not a proof: it looks where the boxes of two bodies meet, at faces whose planes agree to
//! a few roundoffs, and gives up after a bounded number of comparisons.

use std::collections::HashSet;

use glam::{DVec2, DVec3};

use super::bodies::Bodies;
use super::faces::{Faces, corners};
use super::number::widen3;
use super::place::bounds;
use crate::layout::Triangle;
use crate::layout::constants::MAX_MEDIA;

/// Planes are equal that differ by less than this part of the largest coordinate: a few f32 roundoffs.
const SAME_PLANE: f64 = 1e-6;

/// Cells of a normal's components.
const NORMAL_CELLS: f64 = 4096.0;

/// Faces overlap that reach this part of their size into each other.
const LEAST_OVERLAP: f64 = 1e-4;

/// Comparisons of two faces, at most.
const MAX_COMPARISONS: usize = 1 << 22;

/// A face in its plane.
struct Flat {
    body: u32,
    /// Cell of the normal, turned so that its first component that is not 0 is positive.
    normal: [i32; 3],
    /// Distance of the plane from the origin along that normal.
    distance: f64,
    corners: [DVec3; 3],
}

/// Pairs of bodies, lower id first, with such faces.
pub(super) fn overlapping_bodies(faces: &Faces, bodies: &Bodies) -> Vec<[u32; 2]> {
    let mut flats = candidates(faces, bodies);
    flats.sort_unstable_by(|a, b| a.normal.cmp(&b.normal).then(a.distance.total_cmp(&b.distance)));
    let largest = faces
        .triangles
        .iter()
        .flat_map(|t| [t.v0, t.v1, t.v2])
        .flatten()
        .fold(0.0, |m: f32, x| m.max(x.abs()));
    let tolerance = f64::from(largest) * SAME_PLANE;
    let mut found = HashSet::new();
    let mut left = MAX_COMPARISONS;
    let same_plane = |a: &Flat, b: &Flat| a.normal == b.normal && b.distance - a.distance <= tolerance;
    for plane in flats.chunk_by(same_plane) {
        search_plane(plane, tolerance, &mut found, &mut left);
    }
    let mut found: Vec<[u32; 2]> = found.into_iter().collect();
    found.sort_unstable();
    found
}

/// The faces of transmissive bodies that lie within another one's box.
fn candidates(faces: &Faces, bodies: &Bodies) -> Vec<Flat> {
    let count = bodies.transmissive as usize;
    if count < 2 {
        return vec![];
    }
    let mut boxes = [[DVec3::MAX, DVec3::MIN]; MAX_MEDIA as usize];
    let own = || {
        let body = |id: u32| faces.attributes[id as usize].body;
        faces.triangles.iter().map(move |t| (body(t.id) as usize, t)).filter(move |&(body, _)| body < count)
    };
    for (body, triangle) in own() {
        let [lo, hi] = bounds(&corners(triangle));
        boxes[body] = [boxes[body][0].min(lo), boxes[body][1].max(hi)];
    }
    own()
        .filter(|&(body, triangle)| {
            let [lo, hi] = bounds(&corners(triangle));
            let meets = |other: &[DVec3; 2]| lo.cmple(other[1]).all() && hi.cmpge(other[0]).all();
            boxes[..count].iter().enumerate().any(|(other, bounds)| other != body && meets(bounds))
        })
        .map(|(body, triangle)| flat(faces, body as u32, triangle))
        .collect()
}

fn flat(faces: &Faces, body: u32, triangle: &Triangle) -> Flat {
    let normal = widen3(faces.attributes[triangle.id as usize].normal);
    let cells = (normal * NORMAL_CELLS).round().as_ivec3().to_array();
    let turned = cells.iter().find(|&&cell| cell != 0).is_some_and(|&cell| cell < 0);
    let sign = if turned { -1 } else { 1 };
    let distance = normal.dot(corners(triangle)[0]) * f64::from(sign);
    Flat { body, normal: cells.map(|cell| cell * sign), distance, corners: corners(triangle) }
}

/// Search the faces of one plane: along one axis only neighbours are compared.
fn search_plane(plane: &[Flat], tolerance: f64, found: &mut HashSet<[u32; 2]>, left: &mut usize) {
    if plane.iter().all(|face| face.body == plane[0].body) {
        return;
    }
    // Drop the axis that the normal is closest to.
    let normal = plane[0].normal.map(i32::abs);
    let dropped = (0..3).max_by_key(|&axis| normal[axis]).unwrap_or(0);
    let project = |p: DVec3| DVec2::new(p[(dropped + 1) % 3], p[(dropped + 2) % 3]);
    let mut outlines: Vec<(f64, f64, u32, [DVec2; 3])> = plane
        .iter()
        .map(|face| {
            let outline = face.corners.map(project);
            let xs = outline.map(|p| p.x);
            let (lo, hi) = (xs[0].min(xs[1]).min(xs[2]), xs[0].max(xs[1]).max(xs[2]));
            (lo, hi, face.body, outline)
        })
        .collect();
    outlines.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    for (index, (_, hi, body, outline)) in outlines.iter().enumerate() {
        for (_, _, other_body, other) in
            outlines[index + 1..].iter().take_while(|other| other.0 < hi - tolerance)
        {
            if *left == 0 {
                return;
            }
            *left -= 1;
            let pair = [*body.min(other_body), *body.max(other_body)];
            if body != other_body && !found.contains(&pair) && overlap(outline, other, tolerance) {
                found.insert(pair);
            }
        }
    }
}

/// Whether two triangles of a plane have more than an edge in common: no line along a side of one keeps them
/// apart (separating axes; Gottschalk, Lin, Manocha 1996).
fn overlap(a: &[DVec2; 3], b: &[DVec2; 3], tolerance: f64) -> bool {
    let sides = |t: &[DVec2; 3]| [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    sides(a).into_iter().chain(sides(b)).all(|side| {
        let axis = side.perp().normalize_or_zero();
        let extent = |t: &[DVec2; 3]| {
            let along = t.map(|p| p.dot(axis));
            (along[0].min(along[1]).min(along[2]), along[0].max(along[1]).max(along[2]))
        };
        let ((a_lo, a_hi), (b_lo, b_hi)) = (extent(a), extent(b));
        let least = tolerance.max(LEAST_OVERLAP * (a_hi - a_lo).min(b_hi - b_lo));
        a_hi.min(b_hi) - a_lo.max(b_lo) > least
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::flatten::samples::{ICE, STONE, WATER, cuboid, flattened, model};
    use crate::scene::{MaterialId, Mesh};

    /// Whether a unit cube and another mesh are reported.
    fn reported(other: Mesh, material: MaterialId) -> bool {
        let models = vec![model("a", cuboid(DVec3::ZERO, DVec3::ONE), ICE), model("b", other, material)];
        flattened(models)
            .unwrap()
            .warnings
            .iter()
            .any(|w| w.message.contains("`a` and `b` overlap in one plane"))
    }

    #[test]
    fn walls_that_overlap_in_part_are_reported() {
        let beside = |y: f64| cuboid(DVec3::new(1.0, y, 0.0), DVec3::new(2.0, y + 1.0, 1.0));
        assert!(reported(beside(0.25), WATER));
        assert!(!reported(beside(0.25), STONE));
        // Merged, apart, and touching along an edge.
        assert!(!reported(beside(0.0), WATER));
        assert!(!reported(beside(5.0), WATER));
        assert!(!reported(beside(1.0), WATER));
    }

    #[test]
    fn bodies_that_overlap_in_depth_are_fine() {
        assert!(!reported(cuboid(DVec3::new(0.5, 0.25, 0.25), DVec3::new(2.0, 0.75, 0.75)), WATER));
    }
}
