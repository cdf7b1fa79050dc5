//! One ray in every lane, against eight boxes or triangles.

use super::layout::{Axis, Leaf, Node, Row, WIDTH};
use super::simd::Simd;
use super::triangle::{self, Crossings};
use crate::kernel::Vec3;
use crate::kernel::bvh::Ray;

/// A ray in every lane.
#[derive(Clone, Copy)]
pub(super) struct Spread<F> {
    /// The planes that it meets first, by axis.
    pub(super) near: [Row; 3],
    /// What is subtracted from them, and from the other ones.
    pub(super) near_origin: [F; 3],
    pub(super) far_origin: [F; 3],
    pub(super) reciprocal: [F; 3],
    /// Axes of the sheared space.
    pub(super) axes: [Axis; 3],
    /// Origin and shear by those.
    pub(super) origin: [F; 3],
    pub(super) shear: [F; 3],
    /// The face that it leaves.
    pub(super) origin_face: u32,
}

impl<F: Copy> Spread<F> {
    #[inline(always)]
    pub(super) fn new<S: Simd<WIDTH, F = F>>(s: S, ray: &Ray<f32>) -> Self {
        let three = |v: Vec3<f32>| [v.x, v.y, v.z];
        Self::from_parts(
            s,
            three(ray.origin),
            three(ray.origin_hi),
            three(ray.origin_lo),
            three(ray.reciprocal),
            (ray.shear.axis, three(ray.shear.by)),
            ray.origin_face,
        )
    }

    /// As [`Ray`] has them.
    #[inline(always)]
    pub(super) fn from_parts<S: Simd<WIDTH, F = F>>(
        s: S,
        origin: [f32; 3],
        hi: [f32; 3],
        lo: [f32; 3],
        r: [f32; 3],
        (last, shear): (u32, [f32; 3]),
        origin_face: u32,
    ) -> Self {
        let axes = Axis::sheared(last);
        let falls = [r[0] < 0.0, r[1] < 0.0, r[2] < 0.0];
        let [x, y, z] = Axis::ALL;
        let near = |i: usize| if falls[i] { lo[i] } else { hi[i] };
        let far = |i: usize| if falls[i] { hi[i] } else { lo[i] };
        Self {
            near: [Row::near(x, falls[0]), Row::near(y, falls[1]), Row::near(z, falls[2])],
            near_origin: [s.splat(near(0)), s.splat(near(1)), s.splat(near(2))],
            far_origin: [s.splat(far(0)), s.splat(far(1)), s.splat(far(2))],
            reciprocal: [s.splat(r[0]), s.splat(r[1]), s.splat(r[2])],
            axes,
            origin: [
                s.splat(*axes[0].of(&origin)),
                s.splat(*axes[1].of(&origin)),
                s.splat(*axes[2].of(&origin)),
            ],
            shear: [s.splat(shear[0]), s.splat(shear[1]), s.splat(shear[2])],
            origin_face,
        }
    }

    /// Which children's boxes the ray enters, not beyond `limit`, and where: [`slabs`](crate::kernel::bvh::slabs), with
    /// the nearer plane known from the direction instead of compared.
    #[inline(always)]
    pub(super) fn meet<S: Simd<WIDTH, F = F>>(&self, s: S, node: &Node, limit: F) -> (u32, F) {
        let x = self.span(s, node, 0);
        let y = self.span(s, node, 1);
        let z = self.span(s, node, 2);
        let entry = s.greatest(s.greatest(x.0, y.0), s.greatest(z.0, s.splat(0.0)));
        let exit = s.least(s.least(x.1, y.1), s.least(z.1, limit));
        (s.bits(s.le(entry, exit)), entry)
    }

    #[inline(always)]
    fn span<S: Simd<WIDTH, F = F>>(&self, s: S, node: &Node, axis: usize) -> (F, F) {
        let row = self.near[axis];
        let near = s.sub(s.load(node.plane(row)), self.near_origin[axis]);
        let far = s.sub(s.load(node.plane(row.other())), self.far_origin[axis]);
        (s.mul(near, self.reciprocal[axis]), s.mul(far, self.reciprocal[axis]))
    }

    /// The crossings with a leaf's triangles that come not after `limit`, raised to their own boxes.
    #[inline(always)]
    pub(super) fn cross<S: Simd<WIDTH, F = F>>(&self, s: S, leaf: &Leaf, limit: F) -> Option<Crossings<F>> {
        let x = triangle::seen(s, load(s, leaf, self.axes[0]), self.origin[0]);
        let y = triangle::seen(s, load(s, leaf, self.axes[1]), self.origin[1]);
        let z = triangle::seen(s, load(s, leaf, self.axes[2]), self.origin[2]);
        let mut found = triangle::watertight(s, [x, y, z], self.shear, limit)?;
        found.bits &= !s.equal(&leaf.ids, self.origin_face);
        let [x, y, z] = Axis::ALL;
        let corners = [load(s, leaf, x), load(s, leaf, y), load(s, leaf, z)];
        found.raise(s, corners, &self.near, self.near_origin, self.far_origin, self.reciprocal);
        (found.bits != 0).then_some(found)
    }
}

#[inline(always)]
fn load<S: Simd<WIDTH>>(s: S, leaf: &Leaf, axis: Axis) -> [S::F; 3] {
    let [a, b, c] = leaf.corners(axis);
    [s.load(a), s.load(b), s.load(c)]
}
