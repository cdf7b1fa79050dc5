//! Rays of one octant and axis, which meet a node together.

use super::layout::{Axis, Leaf, Node, Row, WIDTH};
use super::packet::{Packet, load};
use super::simd::Simd;
use super::triangle::{self, Crossings};

/// The rays of one group: what they have in common, and bounds on what they have not.
pub(super) struct Beam<'a, const N: usize, F> {
    packet: &'a Packet<N>,
    near: [Row; 3],
    axes: [Axis; 3],
    /// The origins' coordinates that make the entry least and the exit greatest, and both ends of the reciprocals.
    near_origin: [F; 3],
    far_origin: [F; 3],
    least: [F; 3],
    greatest: [F; 3],
}

impl<'a, const N: usize, F: Copy> Beam<'a, N, F> {
    #[inline(always)]
    pub(super) fn new<W: Simd<WIDTH, F = F>, S: Simd<N>>(
        w: W,
        s: S,
        packet: &'a Packet<N>,
        lanes: u32,
    ) -> Self {
        let first = lanes.trailing_zeros() as usize;
        let falls = |axis: usize| packet.falls(first, axis);
        let ends = |values: &[f32; N]| {
            let values = s.load(values);
            (s.least_of(values, lanes), s.greatest_of(values, lanes))
        };
        let hi = [ends(&packet.origin_hi[0]), ends(&packet.origin_hi[1]), ends(&packet.origin_hi[2])];
        let lo = [ends(&packet.origin_lo[0]), ends(&packet.origin_lo[1]), ends(&packet.origin_lo[2])];
        let r = [ends(&packet.reciprocal[0]), ends(&packet.reciprocal[1]), ends(&packet.reciprocal[2])];
        let near = |i: usize| if falls(i) { lo[i].0 } else { hi[i].1 };
        let far = |i: usize| if falls(i) { hi[i].1 } else { lo[i].0 };
        Self {
            packet,
            near: [
                Row::near(Axis::ALL[0], falls(0)),
                Row::near(Axis::ALL[1], falls(1)),
                Row::near(Axis::ALL[2], falls(2)),
            ],
            axes: Axis::sheared(packet.axis(first)),
            near_origin: [w.splat(near(0)), w.splat(near(1)), w.splat(near(2))],
            far_origin: [w.splat(far(0)), w.splat(far(1)), w.splat(far(2))],
            least: [w.splat(r[0].0), w.splat(r[1].0), w.splat(r[2].0)],
            greatest: [w.splat(r[0].1), w.splat(r[1].1), w.splat(r[2].1)],
        }
    }

    /// The children that some ray of the beam may enter, and where the first may.
    #[inline(always)]
    pub(super) fn meet<W: Simd<WIDTH, F = F>>(&self, w: W, node: &Node, limit: f32) -> (u32, F) {
        let plane = |axis: usize| (node.plane(self.near[axis]), node.plane(self.near[axis].other()));
        let (x, y, z) = (plane(0), plane(1), plane(2));
        let x = self.bounds(w, w.load(x.0), w.load(x.1), 0);
        let y = self.bounds(w, w.load(y.0), w.load(y.1), 1);
        let z = self.bounds(w, w.load(z.0), w.load(z.1), 2);
        let entry = w.greatest(w.greatest(x.0, y.0), w.greatest(z.0, w.splat(0.0)));
        let exit = w.least(w.least(x.1, y.1), w.least(z.1, w.splat(limit)));
        (w.bits(w.le(entry, exit)), entry)
    }

    /// The triangles whose own boxes some ray of the beam may enter.
    #[inline(always)]
    pub(super) fn touch<W: Simd<WIDTH, F = F>>(&self, w: W, leaf: &Leaf, limit: f32) -> u32 {
        let [x, y, z] = Axis::ALL;
        let x = self.extent(w, leaf, x, 0);
        let y = self.extent(w, leaf, y, 1);
        let z = self.extent(w, leaf, z, 2);
        let entry = w.greatest(w.greatest(x.0, y.0), w.greatest(z.0, w.splat(0.0)));
        let exit = w.least(w.least(x.1, y.1), w.least(z.1, w.splat(limit)));
        w.bits(w.le(entry, exit))
    }

    #[inline(always)]
    fn extent<W: Simd<WIDTH, F = F>>(&self, w: W, leaf: &Leaf, axis: Axis, number: usize) -> (F, F) {
        let [a, b, c] = leaf.corners(axis);
        let [a, b, c] = [w.load(a), w.load(b), w.load(c)];
        let (lo, hi) = (w.least(w.least(a, b), c), w.greatest(w.greatest(a, b), c));
        let (near, far) = if self.near[number].is_upper() { (hi, lo) } else { (lo, hi) };
        self.bounds(w, near, far, number)
    }

    /// The least distance to one plane and the greatest to the other, along an axis.
    #[inline(always)]
    fn bounds<W: Simd<WIDTH, F = F>>(&self, w: W, near: F, far: F, axis: usize) -> (F, F) {
        let (least, greatest) = (self.least[axis], self.greatest[axis]);
        let near = w.sub(near, self.near_origin[axis]);
        let far = w.sub(far, self.far_origin[axis]);
        (
            w.least(w.mul(near, least), w.mul(near, greatest)),
            w.greatest(w.mul(far, least), w.mul(far, greatest)),
        )
    }

    /// The rays that enter one child's box, not beyond their limits.
    #[inline(always)]
    pub(super) fn enter<S: Simd<N>>(&self, s: S, node: &Node, lane: usize, limit: S::F) -> u32 {
        let x = self.span(s, node, lane, 0);
        let y = self.span(s, node, lane, 1);
        let z = self.span(s, node, lane, 2);
        let entry = s.greatest(s.greatest(x.0, y.0), s.greatest(z.0, s.splat(0.0)));
        let exit = s.least(s.least(x.1, y.1), s.least(z.1, limit));
        s.bits(s.le(entry, exit))
    }

    #[inline(always)]
    fn span<S: Simd<N>>(&self, s: S, node: &Node, lane: usize, axis: usize) -> (S::F, S::F) {
        let row = self.near[axis];
        let (near, far) = self.origins(axis);
        let reciprocal = s.load(&self.packet.reciprocal[axis]);
        let near = s.sub(s.splat(node.plane(row)[lane]), s.load(near));
        let far = s.sub(s.splat(node.plane(row.other())[lane]), s.load(far));
        (s.mul(near, reciprocal), s.mul(far, reciprocal))
    }

    /// What is subtracted from near planes and from far ones.
    #[inline(always)]
    fn origins(&self, axis: usize) -> (&'a [f32; N], &'a [f32; N]) {
        let (hi, lo) = (&self.packet.origin_hi[axis], &self.packet.origin_lo[axis]);
        if self.near[axis].is_upper() { (lo, hi) } else { (hi, lo) }
    }

    /// The rays' crossings with one triangle of a leaf.
    #[inline(always)]
    pub(super) fn cross<S: Simd<N>>(
        &self,
        s: S,
        leaf: &Leaf,
        lane: usize,
        lanes: u32,
        limit: S::F,
    ) -> Option<Crossings<S::F>> {
        let x = triangle::seen(
            s,
            splat(s, leaf, self.axes[0], lane),
            s.load(self.axes[0].of(&self.packet.origin)),
        );
        let y = triangle::seen(
            s,
            splat(s, leaf, self.axes[1], lane),
            s.load(self.axes[1].of(&self.packet.origin)),
        );
        let z = triangle::seen(
            s,
            splat(s, leaf, self.axes[2], lane),
            s.load(self.axes[2].of(&self.packet.origin)),
        );
        let mut found = triangle::watertight(s, [x, y, z], load(s, &self.packet.shear), limit)?;
        found.bits &= lanes & !s.equal(&self.packet.origin_face, leaf.ids[lane]);
        if found.bits == 0 {
            return None;
        }
        let [x, y, z] = Axis::ALL;
        let corners = [splat(s, leaf, x, lane), splat(s, leaf, y, lane), splat(s, leaf, z, lane)];
        let (x, y, z) = (self.origins(0), self.origins(1), self.origins(2));
        let near = [s.load(x.0), s.load(y.0), s.load(z.0)];
        let far = [s.load(x.1), s.load(y.1), s.load(z.1)];
        found.raise(s, corners, &self.near, near, far, load(s, &self.packet.reciprocal));
        (found.bits != 0).then_some(found)
    }
}

/// The coordinates of one triangle's corners on one axis, for every ray.
#[inline(always)]
fn splat<const N: usize, S: Simd<N>>(s: S, leaf: &Leaf, axis: Axis, lane: usize) -> [S::F; 3] {
    let [a, b, c] = leaf.corners(axis);
    [s.splat(a[lane]), s.splat(b[lane]), s.splat(c[lane])]
}
