//! As many rays as there are lanes, side by side.

use bytemuck::{Pod, Zeroable};

use super::layout::WIDTH;
use super::ray::Spread;
use super::simd::Simd;
use super::tree::Tree;
use crate::layout::constants::{LEAST_DIRECTION, MOST_REACH, NONE, ORIGIN_PADDING, SLAB_PADDING};

/// A ray as the kernel is asked for it.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Cast {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Crossings at this distance and beyond do not count.
    pub limit: f32,
    /// Unit direction.
    pub direction: [f32; 3],
    /// Primitive id of the face that it leaves, `NONE` for none.
    pub origin_face: u32,
}

/// Three coordinates of every lane.
pub(super) type Lanes<const N: usize> = [[f32; N]; 3];

/// Rays side by side.
#[repr(align(64))]
pub(super) struct Packet<const N: usize> {
    pub(super) origin: Lanes<N>,
    pub(super) reciprocal: Lanes<N>,
    pub(super) origin_hi: Lanes<N>,
    pub(super) origin_lo: Lanes<N>,
    /// Shears of the two other axes, then the scale of this one.
    pub(super) shear: Lanes<N>,
    pub(super) limit: [f32; N],
    pub(super) origin_face: [u32; N],
    /// Lanes whose direction falls along each axis, and those that mostly follow y or z.
    falls: [u32; 3],
    mostly: [u32; 2],
    /// Lanes with a ray that a scene can make.
    usable: u32,
}

impl<const N: usize> Packet<N> {
    /// Prepare rays as [`make_ray`](crate::kernel::bvh::make_ray) does, up to N of them.
    #[inline(always)]
    pub(super) fn new<S: Simd<N>>(s: S, casts: &[Cast], tree: &Tree) -> Self {
        let mut direction = [[0.0; N]; 3];
        let mut packet = Self {
            origin: [[0.0; N]; 3],
            reciprocal: [[1.0; N]; 3],
            origin_hi: [[0.0; N]; 3],
            origin_lo: [[0.0; N]; 3],
            shear: [[0.0; N]; 3],
            limit: [0.0; N],
            origin_face: [NONE; N],
            falls: [0; 3],
            mostly: [0; 2],
            usable: 0,
        };
        for (lane, cast) in casts.iter().enumerate().take(N) {
            packet.origin.iter_mut().zip(cast.origin).for_each(|(row, x)| row[lane] = x);
            direction.iter_mut().zip(cast.direction).for_each(|(row, x)| row[lane] = x);
            packet.limit[lane] = cast.limit;
            packet.origin_face[lane] = cast.origin_face;
        }
        packet.prepare(s, &direction, &tree.bounds);
        packet.usable &= u32::MAX.checked_shr(32 - casts.len().min(N) as u32).unwrap_or(0);
        packet
    }

    #[inline(always)]
    fn prepare<S: Simd<N>>(&mut self, s: S, direction: &Lanes<N>, bounds: &[[f32; 3]; 2]) {
        let (o, d) = (load(s, &self.origin), load(s, direction));
        let x = reach(s, o[0], bounds[0][0], bounds[1][0]);
        let y = reach(s, o[1], bounds[0][1], bounds[1][1]);
        let z = reach(s, o[2], bounds[0][2], bounds[1][2]);
        let padding = s.mul(s.add(s.add(x, y), z), s.splat(SLAB_PADDING as f32));
        let a = [abs(s, d[0]), abs(s, d[1]), abs(s, d[2])];
        for axis in 0..3 {
            let delta = s.add(s.mul(abs(s, o[axis]), s.splat(ORIGIN_PADDING as f32)), padding);
            s.store(s.add(o[axis], delta), &mut self.origin_hi[axis]);
            s.store(s.sub(o[axis], delta), &mut self.origin_lo[axis]);
            let least = s.splat(LEAST_DIRECTION as f32);
            let clamped = s.select(s.bits(s.lt(a[axis], least)), least, d[axis]);
            let reciprocal = s.div(s.splat(1.0), clamped);
            s.store(reciprocal, &mut self.reciprocal[axis]);
            self.falls[axis] = s.bits(s.lt(reciprocal, s.splat(0.0)));
        }
        // The longest axis last, the others in cyclic order.
        let is_z = s.bits(s.lt(s.greatest(a[0], a[1]), a[2]));
        let is_y = s.bits(s.lt(a[0], a[1])) & !is_z;
        self.mostly = [is_y, is_z];
        let first = s.select(is_z, d[0], s.select(is_y, d[2], d[1]));
        let second = s.select(is_z, d[1], s.select(is_y, d[0], d[2]));
        let longest = s.select(is_z, d[2], s.select(is_y, d[1], d[0]));
        s.store(s.div(first, longest), &mut self.shear[0]);
        s.store(s.div(second, longest), &mut self.shear[1]);
        s.store(s.div(s.splat(1.0), longest), &mut self.shear[2]);
        let hi = abs(s, s.load(&self.origin_hi[0]));
        let reached = s.add(s.add(s.add(hi, a[0]), a[1]), a[2]);
        self.usable = s.bits(s.lt(reached, s.splat(MOST_REACH as f32)));
    }

    /// The rays of one octant and axis among `lanes`: those of the lowest one.
    #[inline(always)]
    pub(super) fn group(&self, lanes: u32) -> u32 {
        let first = lanes.trailing_zeros();
        let alike = |bits: &u32| if bits >> first & 1 == 1 { *bits } else { !bits };
        self.falls.iter().chain(&self.mostly).map(alike).fold(lanes, |group, alike| group & alike)
    }

    /// Whether a lane's direction falls along an axis.
    #[inline(always)]
    pub(super) fn falls(&self, lane: usize, axis: usize) -> bool {
        self.falls[axis] >> lane & 1 == 1
    }

    /// The axis that a lane's direction mostly follows.
    #[inline(always)]
    pub(super) fn axis(&self, lane: usize) -> u32 {
        let [y, z] = self.mostly.map(|bits| bits >> lane & 1);
        y + 2 * z
    }

    /// One lane's ray for eight boxes or triangles.
    #[inline(always)]
    pub(super) fn spread<W: Simd<WIDTH>>(&self, w: W, lane: usize) -> Spread<W::F> {
        let lane = lane % N;
        let pick = |three: &Lanes<N>| [three[0][lane], three[1][lane], three[2][lane]];
        Spread::from_parts(
            w,
            pick(&self.origin),
            pick(&self.origin_hi),
            pick(&self.origin_lo),
            pick(&self.reciprocal),
            (self.axis(lane), pick(&self.shear)),
            self.origin_face[lane],
        )
    }

    /// Lanes with a ray that a scene can make.
    pub(super) fn usable(&self) -> u32 {
        self.usable
    }
}

/// |x|, without touching bits: the greater of x and −x.
#[inline(always)]
fn abs<const N: usize, S: Simd<N>>(s: S, x: S::F) -> S::F {
    s.greatest(x, s.sub(s.splat(0.0), x))
}

/// How far the farther end of the scene's box is along one axis.
#[inline(always)]
fn reach<const N: usize, S: Simd<N>>(s: S, origin: S::F, lo: f32, hi: f32) -> S::F {
    s.greatest(abs(s, s.sub(origin, s.splat(lo))), abs(s, s.sub(origin, s.splat(hi))))
}

#[inline(always)]
pub(super) fn load<const N: usize, S: Simd<N>>(s: S, three: &Lanes<N>) -> [S::F; 3] {
    [s.load(&three[0]), s.load(&three[1]), s.load(&three[2])]
}
