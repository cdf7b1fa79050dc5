//! How close a light is to the nearest surface.

use glam::DVec3;

use super::faces::corners;
use super::number::widen3;
use crate::layout::constants::{ROUNDOFF_F32, SPAWN_ROUNDOFFS};
use crate::layout::{FlatScene, Node, Triangle};

/// The least distance at which a point light may find itself from a shaded point, in f64.
///
/// Shading happens at points of the triangles, but shadow rays start up to [`greatest_lift`] off them.
pub(super) fn least_distance(scene: &FlatScene, light: DVec3, lift: f64) -> f64 {
    let mut best = f64::INFINITY;
    // Boxes to look into: their distance, then what they hold as in a node.
    let mut stack = vec![(0.0, 0, 0)];
    while let Some((distance, first, count)) = stack.pop() {
        if distance >= best {
            continue;
        }
        if count > 0 {
            let leaf = &scene.triangles[first as usize..(first + count) as usize];
            best = leaf.iter().map(|triangle| to_triangle(light, corners(triangle))).fold(best, f64::min);
            continue;
        }
        // The nearer child is looked into first: it lies on top.
        let mut children = children(&scene.nodes[first as usize])
            .map(|(lo, hi, first, count)| (to_box(light, lo, hi), first, count));
        children.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        stack.extend(children);
    }
    (best - lift).max(0.0)
}

/// How far from its triangle a shadow ray may start (see the kernel's stop "surface"): the height of the tangent
/// planes of a smooth triangle's corners above its points, and the bound on rounding that keeps it off the face.
pub(super) fn greatest_lift(scene: &FlatScene) -> f64 {
    let [lo, hi] = scene.bounds.map(widen3);
    // The point, and half the extent of two edges, each of them at most twice as long as the greatest coordinate.
    let roundoffs = SPAWN_ROUNDOFFS * (1.0 + 2.0);
    let rounding = roundoffs * ROUNDOFF_F32 * lo.abs().max(hi.abs()).length();
    rounding + scene.triangles.iter().map(|triangle| lift(scene, triangle)).fold(0.0, f64::max)
}

/// The greatest height of a corner's tangent plane above the triangle. A height is linear over the triangle, so
/// that it is greatest at a corner; the starting point is a mean of three lifted points.
fn lift(scene: &FlatScene, triangle: &Triangle) -> f64 {
    let face = &scene.attributes[triangle.id as usize];
    if !face.is_smooth() {
        return 0.0;
    }
    let points = corners(triangle);
    // From the back the normals are negated: heights of either sign count.
    let heights =
        points.iter().zip([face.normal0, face.normal1, face.normal2]).flat_map(|(&corner, normal)| {
            points.iter().map(move |&point| (point - corner).dot(widen3(normal)).abs())
        });
    heights.fold(0.0, f64::max)
}

fn children(node: &Node) -> [([f32; 3], [f32; 3], u32, u32); 2] {
    [(node.a_lo, node.a_hi, node.a_first, node.a_count), (node.b_lo, node.b_hi, node.b_first, node.b_count)]
}

/// Distance from a point to a box; 0 inside.
fn to_box(point: DVec3, lo: [f32; 3], hi: [f32; 3]) -> f64 {
    point.distance(point.clamp(widen3(lo), widen3(hi)))
}

/// Distance from a point to a triangle, by the Voronoi region that the point lies in (Ericson 2005, "Real-Time
/// Collision Detection", section 5.1.5).
fn to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let (ab, ac) = (b - a, c - a);
    let (d1, d2) = (ab.dot(p - a), ac.dot(p - a));
    let (d3, d4) = (ab.dot(p - b), ac.dot(p - b));
    let (d5, d6) = (ab.dot(p - c), ac.dot(p - c));
    // Corners.
    if d1 <= 0.0 && d2 <= 0.0 {
        return p.distance(a);
    }
    if d3 >= 0.0 && d4 <= d3 {
        return p.distance(b);
    }
    if d6 >= 0.0 && d5 <= d6 {
        return p.distance(c);
    }
    // Sides.
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return p.distance(a + ab * (d1 / (d1 - d3)));
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return p.distance(a + ac * (d2 / (d2 - d6)));
    }
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return p.distance(b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    }
    // The face.
    p.distance(a + (ab * vb + ac * vc) / (va + vb + vc))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_region_of_a_triangle() {
        let triangle = [DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0];
        let cases = [
            (DVec3::new(0.5, 0.5, 3.0), 3.0),
            (DVec3::new(-3.0, -4.0, 0.0), 5.0),
            (DVec3::new(5.0, 0.0, 4.0), 5.0),
            (DVec3::new(-3.0, 6.0, 0.0), 5.0),
            (DVec3::new(1.0, -2.0, 0.0), 2.0),
            (DVec3::new(-2.0, 1.0, 0.0), 2.0),
            (DVec3::new(2.0, 2.0, 1.0), 3.0_f64.sqrt()),
        ];
        for (point, expected) in cases {
            assert!((to_triangle(point, triangle) - expected).abs() < 1e-14, "{point}");
        }
    }

    #[test]
    fn a_box_is_no_distance_from_its_inside() {
        assert_eq!(to_box(DVec3::splat(0.5), [0.0; 3], [1.0; 3]), 0.0);
        assert_eq!(to_box(DVec3::new(4.0, 0.5, -4.0), [0.0; 3], [1.0; 3]), 5.0);
    }
}
