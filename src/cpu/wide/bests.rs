//! The nearest crossings of a packet.

use super::layout::WIDTH;
use super::packet::Packet;
use super::simd::Simd;
use super::single::{self, Best};
use super::tree::Tree;
use super::triangle::Crossings;
use crate::kernel::bvh::Hit;
use crate::layout::constants::NONE;

/// The nearest crossings of a packet so far.
#[repr(align(64))]
pub(super) struct Bests<const N: usize> {
    pub(super) t: [f32; N],
    pub(super) b1: [f32; N],
    pub(super) b2: [f32; N],
    det: [f32; N],
    /// As [`Best::place`].
    pub(super) place: [u32; N],
}

impl<const N: usize> Bests<N> {
    #[inline(always)]
    pub(super) fn none(packet: &Packet<N>) -> Self {
        Self { t: packet.limit, b1: [0.0; N], b2: [0.0; N], det: [0.0; N], place: [NONE; N] }
    }

    /// What a lane's ray meets.
    #[inline(always)]
    pub(super) fn hit(&self, tree: &Tree, packet: &Packet<N>, lane: usize) -> Hit<f32> {
        let place = self.place[lane];
        if place == NONE {
            return Hit { t: packet.limit[lane], id: NONE, index: NONE, b1: 0.0, b2: 0.0, front: false };
        }
        Hit {
            t: self.t[lane],
            id: self.id(tree, lane),
            index: tree.index(place),
            b1: self.b1[lane],
            b2: self.b2[lane],
            front: (self.det[lane] > 0.0) == (packet.shear[2][lane] > 0.0),
        }
    }

    /// Primitive id, 0 for a miss.
    #[inline(always)]
    pub(super) fn id(&self, tree: &Tree, lane: usize) -> u32 {
        let place = self.place[lane];
        if place == NONE { 0 } else { tree.leaves[place as usize / WIDTH].ids[place as usize % WIDTH] }
    }

    #[inline(always)]
    pub(super) fn take<S: Simd<N>>(&mut self, s: S, tree: &Tree, found: &Crossings<S::F>, place: usize) {
        let old = s.load(&self.t);
        let mut wins = found.bits & s.bits(s.lt(found.t, old));
        let mut ties = found.bits & !wins & s.bits(s.le(found.t, old));
        while ties != 0 {
            let lane = ties.trailing_zeros() as usize % N;
            ties &= ties - 1;
            if tree.leaves[place / WIDTH].ids[place % WIDTH] < self.id(tree, lane) {
                wins |= 1 << lane;
            }
        }
        keep(s, wins, found.t, &mut self.t);
        keep(s, wins, found.b1, &mut self.b1);
        keep(s, wins, found.b2, &mut self.b2);
        keep(s, wins, found.det, &mut self.det);
        while wins != 0 {
            self.place[wins.trailing_zeros() as usize % N] = place as u32;
            wins &= wins - 1;
        }
    }

    /// One ray alone, from a child on.
    #[inline(always)]
    pub(super) fn alone<W: Simd<WIDTH>>(
        &mut self,
        w: W,
        tree: &Tree,
        packet: &Packet<N>,
        lane: usize,
        from: u32,
    ) {
        let before = Best {
            t: self.t[lane],
            id: self.id(tree, lane),
            place: self.place[lane],
            b1: self.b1[lane],
            b2: self.b2[lane],
            turns: self.det[lane] > 0.0,
        };
        let mut best = before;
        single::closest(w, tree, &packet.spread(w, lane), from, &mut best);
        if best.place != before.place {
            (self.t[lane], self.b1[lane], self.b2[lane]) = (best.t, best.b1, best.b2);
            (self.place[lane], self.det[lane]) = (best.place, if best.turns { 1.0 } else { -1.0 });
        }
    }
}

/// Write the lanes that win.
#[inline(always)]
fn keep<const N: usize, S: Simd<N>>(s: S, wins: u32, new: S::F, old: &mut [f32; N]) {
    let kept = s.select(wins, new, s.load(old));
    s.store(kept, old);
}
