//! Stop 3 of 7: triangle. Twin of `shaders/triangle.wgsl`.

use crate::layout::{Intersector, Triangle};

use super::math::{cross3, dot3};
use super::{Real, Vec3};

/// A ray's shear: the axis it mostly follows, and what turns it into that axis at unit length.
#[derive(Debug, Clone, Copy)]
pub struct Shear<R> {
    /// 0, 1 or 2: the largest component of the direction; ties go to the lowest.
    pub axis: u32,
    /// Shears of the two other axes, then the scale of this one.
    pub by: Vec3<R>,
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy)]
pub struct Crossing<R> {
    /// Distance in units of the direction's length, > 0.
    pub t: R,
    /// Barycentric weight of the second corner.
    pub b1: R,
    /// Barycentric weight of the third corner.
    pub b2: R,
    /// Whether the ray comes from the side where the corners turn counter-clockwise.
    pub front: bool,
}

/// v with `axis` last, the others in cyclic order.
#[inline]
pub fn permute<R: Real>(v: Vec3<R>, axis: u32) -> Vec3<R> {
    match axis {
        0 => Vec3::new(v.y, v.z, v.x),
        1 => Vec3::new(v.z, v.x, v.y),
        _ => v,
    }
}

/// The shear of a direction (Woop, Benthin, Wald 2013, section 3.1).
#[inline]
pub fn shear_of<R: Real>(direction: Vec3<R>) -> Shear<R> {
    let a = direction.abs();
    let mut axis = if a.y > a.x { 1 } else { 0 };
    if a.z > a.x.greatest(a.y) {
        axis = 2;
    }
    let d = permute(direction, axis);
    Shear { axis, by: Vec3::new(d.x / d.z, d.y / d.z, R::ONE / d.z) }
}

/// The test of Woop, Benthin, Wald 2013, in the form that survives contraction: products are compared, not
/// subtracted, so two triangles never disagree about their common edge. Divided first, so that no term has degree 3.
/// A ray in the triangle's plane misses it.
pub fn watertight<R: Real>(origin: Vec3<R>, shear: &Shear<R>, tri: &Triangle) -> Option<Crossing<R>> {
    // Corners as seen from the ray.
    let a = permute(Vec3::load(tri.v0) - origin, shear.axis);
    let b = permute(Vec3::load(tri.v1) - origin, shear.axis);
    let c = permute(Vec3::load(tri.v2) - origin, shear.axis);
    let ax = a.x - shear.by.x * a.z;
    let ay = a.y - shear.by.y * a.z;
    let bx = b.x - shear.by.x * b.z;
    let by = b.y - shear.by.y * b.z;
    let cx = c.x - shear.by.x * c.z;
    let cy = c.y - shear.by.y * c.z;
    // On which side of each edge does the ray pass?
    let (u1, u2) = (cx * by, cy * bx);
    let (v1, v2) = (ax * cy, ay * cx);
    let (w1, w2) = (bx * ay, by * ax);
    if (u1 < u2 || v1 < v2 || w1 < w2) && (u1 > u2 || v1 > v2 || w1 > w2) {
        return None;
    }
    // Barycentric weights and distance.
    let (u, v, w) = (u1 - u2, v1 - v2, w1 - w2);
    let det = u + v + w;
    if det == R::ZERO {
        return None;
    }
    let (b0, b1, b2) = (u / det, v / det, w / det);
    let t = (b0 * a.z + b1 * b.z + b2 * c.z) * shear.by.z;
    // Seen along a positive axis, corners that turn counter-clockwise from the front turn clockwise.
    let front = (det > R::ZERO) == (shear.by.z > R::ZERO);
    (t > R::ZERO).then_some(Crossing { t, b1, b2, front })
}

/// The test of Möller and Trumbore 1997, the textbook's, kept so that its cost and its leaks can be shown.
pub fn moller_trumbore<R: Real>(origin: Vec3<R>, direction: Vec3<R>, tri: &Triangle) -> Option<Crossing<R>> {
    let v0 = Vec3::load(tri.v0);
    let e1 = Vec3::load(tri.v1) - v0;
    let e2 = Vec3::load(tri.v2) - v0;
    let p = cross3(direction, e2);
    let det = dot3(e1, p);
    if det == R::ZERO {
        return None;
    }
    let s = origin - v0;
    let b1 = dot3(s, p) / det;
    let q = cross3(s, e1);
    let b2 = dot3(direction, q) / det;
    if b1 < R::ZERO || b2 < R::ZERO || b1 + b2 > R::ONE {
        return None;
    }
    let t = dot3(e2, q) / det;
    (t > R::ZERO).then_some(Crossing { t, b1, b2, front: det > R::ZERO })
}

/// The test that the settings ask for.
pub fn intersect_triangle<R: Real>(
    intersector: Intersector,
    origin: Vec3<R>,
    direction: Vec3<R>,
    shear: &Shear<R>,
    tri: &Triangle,
) -> Option<Crossing<R>> {
    match intersector {
        Intersector::Watertight => watertight(origin, shear, tri),
        Intersector::MollerTrumbore => moller_trumbore(origin, direction, tri),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    fn unit_triangle() -> Triangle {
        Triangle { v0: [0.0, 0.0, 0.0], v1: [1.0, 0.0, 0.0], v2: [0.0, 1.0, 0.0], ..Triangle::zeroed() }
    }

    #[test]
    fn both_tests_agree_on_distance_weights_and_side_from_every_axis() {
        // The same triangle turned cyclically, met from its front and from its back.
        for turn in 0..3 {
            let rotate = |v: [f32; 3]| [v[(3 - turn) % 3], v[(4 - turn) % 3], v[(5 - turn) % 3]];
            let t = unit_triangle();
            let tri = Triangle { v0: rotate(t.v0), v1: rotate(t.v1), v2: rotate(t.v2), ..t };
            for (z, dz) in [(2.0, -1.0), (-2.0, 1.0)] {
                let o = Vec3::<f64>::load(rotate([0.25, 0.5, z]));
                let d = Vec3::<f64>::load(rotate([0.0, 0.0, dz]));
                let w = watertight(o, &shear_of(d), &tri).expect("inside");
                let m = moller_trumbore(o, d, &tri).expect("inside");
                assert_eq!((w.t, w.b1, w.b2, w.front), (2.0, 0.25, 0.5, z > 0.0));
                assert_eq!((m.t, m.b1, m.b2, m.front), (2.0, 0.25, 0.5, z > 0.0));
            }
        }
    }

    #[test]
    fn a_ray_in_the_plane_misses() {
        let d = Vec3::new(1.0f32, 0.0, 0.0);
        assert!(watertight(Vec3::new(-1.0, 0.25, 0.0), &shear_of(d), &unit_triangle()).is_none());
    }
}
