//! A packet's way through the tree: as a beam, and each ray for itself where the beam has come apart.

use super::beam::Beam;
use super::bests::Bests;
use super::layout::{Child, WIDTH};
use super::packet::Packet;
use super::simd::Simd;
use super::single;
use super::stack::{Stack, child, distance};
use super::tree::Tree;

/// Fewer rays than this that are still together go on one by one.
const LEAST_TOGETHER: u32 = 3;

/// Find the nearest crossings of the packet's `lanes`, which are one group.
#[inline(always)]
pub(super) fn closest<const N: usize, W: Simd<WIDTH>, S: Simd<N>>(
    w: W,
    s: S,
    tree: &Tree,
    packet: &Packet<N>,
    lanes: u32,
    bests: &mut Bests<N>,
) {
    let beam = Beam::new(w, s, packet, lanes);
    let mut farthest = greatest_of(s, &bests.t, lanes);
    // A child waits as its node's index times [`WIDTH`], plus its lane.
    let mut stack = Stack::new();
    let (mut current, mut active) = (Tree::ROOT, lanes);
    loop {
        match Child::unpack(current) {
            _ if active.count_ones() < LEAST_TOGETHER => {
                for lane in bits_of(active) {
                    bests.alone(w, tree, packet, lane % N, current);
                }
                farthest = greatest_of(s, &bests.t, lanes);
            }
            Child::Node(index) => {
                let node = &tree.nodes[index];
                let (bits, entry) = beam.meet(w, node, farthest);
                if bits != 0 {
                    let places = std::array::from_fn(|lane| (index * WIDTH + lane) as u32);
                    let nearest = stack.nearest(w, entry, &places, bits);
                    stack.push(nearest);
                }
            }
            Child::Leaf { index, .. } => {
                let leaf = &tree.leaves[index];
                let bits = beam.touch(w, leaf, farthest);
                if active.count_ones() < bits.count_ones() {
                    for lane in bits_of(active) {
                        bests.alone(w, tree, packet, lane % N, current);
                    }
                } else {
                    for lane in bits_of(bits) {
                        if let Some(found) = beam.cross(s, leaf, lane % WIDTH, active, s.load(&bests.t)) {
                            bests.take(s, tree, &found, index * WIDTH + lane);
                        }
                    }
                }
                farthest = greatest_of(s, &bests.t, lanes);
            }
        }
        // The next child that one of the rays enters.
        loop {
            let Some(key) = stack.pop() else { return };
            if distance(key) <= farthest {
                let (node, lane) = (&tree.nodes[child(key) as usize / WIDTH], child(key) as usize % WIDTH);
                active = lanes & beam.enter(s, node, lane, s.load(&bests.t));
                if active != 0 {
                    current = node.children[lane];
                    break;
                }
            }
        }
    }
}

/// Which of the packet's `lanes`, which are one group, cross anything before their limits.
#[inline(always)]
pub(super) fn any<const N: usize, W: Simd<WIDTH>, S: Simd<N>>(
    w: W,
    s: S,
    tree: &Tree,
    packet: &Packet<N>,
    lanes: u32,
) -> u32 {
    let beam = Beam::new(w, s, packet, lanes);
    let farthest = greatest_of(s, &packet.limit, lanes);
    let limits = s.load(&packet.limit);
    let mut stack = Stack::new();
    let (mut current, mut active, mut blocked) = (Tree::ROOT, lanes, 0);
    loop {
        match Child::unpack(current) {
            _ if active.count_ones() < LEAST_TOGETHER => {
                for lane in bits_of(active) {
                    let lane = lane % N;
                    let hit = single::any(w, tree, &packet.spread(w, lane), current, packet.limit[lane]);
                    blocked |= u32::from(hit) << lane;
                }
            }
            Child::Node(index) => {
                let (bits, _) = beam.meet(w, &tree.nodes[index], farthest);
                for lane in bits_of(bits) {
                    stack.push((index * WIDTH + lane) as u64);
                }
            }
            Child::Leaf { index, .. } => {
                let leaf = &tree.leaves[index];
                for lane in bits_of(beam.touch(w, leaf, farthest)) {
                    if let Some(found) = beam.cross(s, leaf, lane % WIDTH, active & !blocked, limits) {
                        blocked |= found.bits & s.bits(s.lt(found.t, limits));
                    }
                }
            }
        }
        if lanes & !blocked == 0 {
            return blocked;
        }
        loop {
            let Some(place) = stack.pop() else { return blocked };
            let (node, lane) = (&tree.nodes[place as usize / WIDTH], place as usize % WIDTH);
            active = lanes & !blocked & beam.enter(s, node, lane, limits);
            if active != 0 {
                current = node.children[lane];
                break;
            }
        }
    }
}

/// The numbers of the bits that are set.
#[inline(always)]
fn bits_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = bits.trailing_zeros() as usize;
        (bits != 0).then(|| {
            bits &= bits - 1;
            bit
        })
    })
}

/// The greatest of the lanes' values; limits may be no numbers.
#[inline(always)]
fn greatest_of<const N: usize, S: Simd<N>>(s: S, values: &[f32; N], lanes: u32) -> f32 {
    let values = s.load(values);
    s.greatest_of(values, lanes & s.bits(s.le(values, values)))
}
