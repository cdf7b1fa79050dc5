//! The watertight test in lanes: the operations of [`kernel::triangle`](crate::kernel::triangle) and
//! [`kernel::bvh::nearer`](crate::kernel::bvh::nearer), in their order.

use super::layout::Row;
use super::simd::Simd;

/// Where lanes cross.
#[derive(Clone, Copy)]
pub(super) struct Crossings<F> {
    /// Lanes that do.
    pub(super) bits: u32,
    pub(super) t: F,
    pub(super) b1: F,
    pub(super) b2: F,
    /// Signed area of the sheared triangle.
    pub(super) det: F,
}

/// [`watertight`](crate::kernel::triangle::watertight) at a distance not beyond `limit`; none where no lane crosses.
/// `seen` holds the coordinates of the three corners as seen from the ray, by axis of the sheared space.
#[inline(always)]
pub(super) fn watertight<const N: usize, S: Simd<N>>(
    s: S,
    seen: [[S::F; 3]; 3],
    shear: [S::F; 3],
    limit: S::F,
) -> Option<Crossings<S::F>> {
    let [x, y, [az, bz, cz]] = seen;
    let ax = s.sub(x[0], s.mul(shear[0], az));
    let ay = s.sub(y[0], s.mul(shear[1], az));
    let bx = s.sub(x[1], s.mul(shear[0], bz));
    let by = s.sub(y[1], s.mul(shear[1], bz));
    let cx = s.sub(x[2], s.mul(shear[0], cz));
    let cy = s.sub(y[2], s.mul(shear[1], cz));
    // With subnormals a difference has the sign of the comparison. Where a product overflows to no number, neither the
    // determinant nor the distance is one.
    let u = s.sub(s.mul(cx, by), s.mul(cy, bx));
    let v = s.sub(s.mul(ax, cy), s.mul(ay, cx));
    let w = s.sub(s.mul(bx, ay), s.mul(by, ax));
    let zero = s.splat(0.0);
    let below = s.bits(s.lt(s.least(s.least(u, v), w), zero));
    let above = s.bits(s.lt(zero, s.greatest(s.greatest(u, v), w)));
    let det = s.add(s.add(u, v), w);
    let bits = !(below & above) & s.bits(s.ne(det, zero));
    if bits == 0 {
        return None;
    }
    let (b0, b1, b2) = (s.div(u, det), s.div(v, det), s.div(w, det));
    let t = s.mul(s.add(s.add(s.mul(b0, az), s.mul(b1, bz)), s.mul(b2, cz)), shear[2]);
    let bits = bits & s.bits(s.and(s.lt(zero, t), s.le(t, limit)));
    (bits != 0).then_some(Crossings { bits, t, b1, b2, det })
}

impl<F: Copy> Crossings<F> {
    /// Raise the distances to the entries into the triangles' own boxes, and drop lanes that miss those. `corners` holds
    /// the coordinates of the three corners, by axis.
    #[inline(always)]
    pub(super) fn raise<const N: usize, S: Simd<N, F = F>>(
        &mut self,
        s: S,
        corners: [[F; 3]; 3],
        near: &[Row; 3],
        near_origin: [F; 3],
        far_origin: [F; 3],
        reciprocal: [F; 3],
    ) {
        let [x, y, z] = corners;
        let x = span(s, x, near[0], near_origin[0], far_origin[0], reciprocal[0]);
        let y = span(s, y, near[1], near_origin[1], far_origin[1], reciprocal[1]);
        let z = span(s, z, near[2], near_origin[2], far_origin[2], reciprocal[2]);
        let entry = s.greatest(s.greatest(x.0, y.0), s.greatest(z.0, s.splat(0.0)));
        let exit = s.least(s.least(x.1, y.1), z.1);
        self.t = s.greatest(self.t, entry);
        self.bits &= s.bits(s.le(entry, exit));
    }
}

/// Where rays enter and leave the triangles' extent along one axis.
#[inline(always)]
fn span<const N: usize, S: Simd<N>>(
    s: S,
    [a, b, c]: [S::F; 3],
    near: Row,
    near_origin: S::F,
    far_origin: S::F,
    reciprocal: S::F,
) -> (S::F, S::F) {
    let lo = s.least(s.least(a, b), c);
    let hi = s.greatest(s.greatest(a, b), c);
    let (first, last) = if near.is_upper() { (hi, lo) } else { (lo, hi) };
    (s.mul(s.sub(first, near_origin), reciprocal), s.mul(s.sub(last, far_origin), reciprocal))
}

/// The corners' coordinates on one axis, as seen from the rays.
#[inline(always)]
pub(super) fn seen<const N: usize, S: Simd<N>>(s: S, [a, b, c]: [S::F; 3], origin: S::F) -> [S::F; 3] {
    [s.sub(a, origin), s.sub(b, origin), s.sub(c, origin)]
}
