//! Nodes and leaves that wait for a ray, nearest on top.

use std::mem::MaybeUninit;

use super::layout::WIDTH;
use super::simd::Simd;
use crate::layout::constants::MAX_BVH_DEPTH;

/// Every level leaves all but one of its children, and in packets those, too.
const MOST: usize = MAX_BVH_DEPTH as usize * WIDTH;

/// Distance and child as one number, in the order of distances, which are not negative.
#[inline(always)]
pub(super) fn key(distance: f32, child: u32) -> u64 {
    u64::from(distance.to_bits()) << 32 | u64::from(child)
}

/// The child of a key.
#[inline(always)]
pub(super) fn child(key: u64) -> u32 {
    key as u32
}

/// The distance of a key.
#[inline(always)]
pub(super) fn distance(key: u64) -> f32 {
    f32::from_bits((key >> 32) as u32)
}

/// Keys of the lanes whose bit is set, to the front of `to`.
#[inline(always)]
pub(super) fn keys_of_lanes<const N: usize>(
    distances: &[f32; N],
    children: &[u32; N],
    mut bits: u32,
    to: &mut [u64; N],
) {
    for slot in to {
        if bits == 0 {
            break;
        }
        let lane = bits.trailing_zeros() as usize % N;
        *slot = key(distances[lane], children[lane]);
        bits &= bits - 1;
    }
}

/// What waits.
pub(super) struct Stack {
    keys: [MaybeUninit<u64>; MOST],
    size: usize,
}

impl Stack {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { keys: [const { MaybeUninit::uninit() }; MOST], size: 0 }
    }

    #[inline(always)]
    pub(super) fn push(&mut self, key: u64) {
        self.keys[self.size].write(key);
        self.size += 1;
    }

    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<u64> {
        self.size = self.size.checked_sub(1)?;
        // SAFETY: `push` is all that makes the stack grow, and it writes what it adds.
        Some(unsafe { self.keys[self.size].assume_init() })
    }

    /// The nearest of the lanes whose bit is set, of which there is one at least; the others are pushed, nearest last.
    #[inline(always)]
    pub(super) fn nearest<S: Simd<WIDTH>>(
        &mut self,
        s: S,
        distance: S::F,
        children: &[u32; WIDTH],
        bits: u32,
    ) -> u64 {
        let mut keys = [0; WIDTH];
        s.keys(distance, children, bits, &mut keys);
        // Numbers of their own, which stay in registers.
        let [mut a, mut b, mut c, mut d, ..] = keys;
        match bits.count_ones() {
            0 | 1 => a,
            2 => {
                order(&mut a, &mut b);
                self.push(b);
                a
            }
            3 => {
                order(&mut a, &mut b);
                order(&mut b, &mut c);
                order(&mut a, &mut b);
                self.push(c);
                self.push(b);
                a
            }
            4 => {
                order(&mut a, &mut b);
                order(&mut c, &mut d);
                order(&mut a, &mut c);
                order(&mut b, &mut d);
                order(&mut b, &mut c);
                self.push(d);
                self.push(c);
                self.push(b);
                a
            }
            count => {
                let sorted = &mut keys[..(count as usize).min(WIDTH)];
                insertion_sort(sorted);
                sorted[1..].iter().rev().for_each(|&key| self.push(key));
                sorted[0]
            }
        }
    }
}

#[inline(always)]
fn order(a: &mut u64, b: &mut u64) {
    (*a, *b) = ((*a).min(*b), (*a).max(*b));
}

/// Few keys, the least first.
#[inline(always)]
fn insertion_sort(keys: &mut [u64]) {
    for end in 1..keys.len() {
        let mut at = end;
        while at > 0 && keys[at - 1] > keys[at] {
            keys.swap(at - 1, at);
            at -= 1;
        }
    }
}
