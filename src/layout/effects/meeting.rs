//! Whether transmissive bodies overlap, touch or hold each other.
//!
//! Two bodies between which a plane stands are apart. Thirteen directions of planes are tried, those between opposite
//! faces, edges and corners of a cube (the 26-DOPs of Klosowski et al. 1998, "Efficient collision detection using
//! bounding volume hierarchies of k-DOPs"); what none of them parts is taken to meet. So a scene may be given a list of
//! interiors that it could do without, but never the other way round.

use crate::layout::constants::MAX_MEDIA;
use crate::layout::{Attribute, FlatScene, Triangle};

/// The axes of boxes.
const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Between edges, then between corners of a cube.
const DIAGONALS: [[f64; 3]; 10] = [
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// Bodies that are nearer than this part of the scene's greatest coordinate touch: many times the rounding by which rays
/// leave a surface (some 2^-20 of it), so that no ray is behind the next body's face before it has met it.
const CONTACT: f64 = 1.0 / 65536.0;

/// Which transmissive bodies meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Meeting {
    /// The first two that do.
    pub(super) pair: Option<[u32; 2]>,
    /// Most bodies that a point may be in at once: the greatest number of them that hang together.
    pub(super) most: u32,
}

/// Find out which transmissive bodies meet.
pub(super) fn meeting(scene: &FlatScene) -> Meeting {
    let count = scene.transmissive_bodies.min(MAX_MEDIA);
    let mut meet = Pairs::all(count);
    for directions in [&AXES[..], &DIAGONALS[..]] {
        if meet.first().is_none() {
            break;
        }
        meet.part(&extents(scene, count as usize, directions), CONTACT * greatest_coordinate(scene));
    }
    Meeting { pair: meet.first(), most: meet.largest_group() }
}

/// For each body, the other bodies that it may meet, a bit for each.
struct Pairs(Vec<u32>);

impl Pairs {
    fn all(count: u32) -> Self {
        let everyone = u32::MAX.checked_shr(u32::BITS - count).unwrap_or(0);
        Self((0..count).map(|body| everyone & !(1 << body)).collect())
    }

    /// Strike out the pairs that some direction parts.
    fn part(&mut self, extents: &[Vec<Extent>], contact: f64) {
        for (a, meets) in self.0.iter_mut().enumerate() {
            let apart = |b: usize| extents[a].iter().zip(&extents[b]).any(|(a, b)| a.is_apart(b, contact));
            let parted = (0..extents.len()).filter(|&b| *meets >> b & 1 == 1 && apart(b));
            *meets &= parted.fold(u32::MAX, |rest, b| rest & !(1 << b));
        }
    }

    fn first(&self) -> Option<[u32; 2]> {
        let (a, meets) = (0..).zip(&self.0).find(|(_, meets)| **meets != 0)?;
        Some([a, meets.trailing_zeros()])
    }

    /// How many bodies hang together, each meeting another of them.
    fn largest_group(&self) -> u32 {
        let group = |body: usize| {
            let mut group = 1 << body;
            loop {
                let members = (0..self.0.len()).filter(|&member| group >> member & 1 == 1);
                let grown = members.fold(group, |group, member| group | self.0[member]);
                if grown == group {
                    return group.count_ones();
                }
                group = grown;
            }
        };
        (0..self.0.len()).map(group).max().unwrap_or(0)
    }
}

/// How far a body reaches along a direction, and against it.
#[derive(Clone, Copy)]
struct Extent {
    lo: f64,
    hi: f64,
}

impl Extent {
    const EMPTY: Self = Self { lo: f64::MAX, hi: f64::MIN };

    fn include(&mut self, at: f64) {
        (self.lo, self.hi) = (self.lo.min(at), self.hi.max(at));
    }

    fn is_apart(&self, other: &Self, contact: f64) -> bool {
        self.lo - other.hi > contact || other.lo - self.hi > contact
    }
}

/// The extents of each of the first `count` bodies along some directions.
fn extents(scene: &FlatScene, count: usize, directions: &[[f64; 3]]) -> Vec<Vec<Extent>> {
    let mut extents = vec![vec![Extent::EMPTY; directions.len()]; count];
    for triangle in &*scene.triangles {
        for body in bodies_of(scene, triangle) {
            let Some(body) = extents.get_mut(body) else { continue };
            for (extent, direction) in body.iter_mut().zip(directions) {
                for corner in [triangle.v0, triangle.v1, triangle.v2] {
                    extent.include((0..3).map(|axis| f64::from(corner[axis]) * direction[axis]).sum());
                }
            }
        }
    }
    extents
}

/// The bodies whose surface a triangle belongs to.
fn bodies_of(scene: &FlatScene, triangle: &Triangle) -> impl Iterator<Item = usize> {
    let face = &scene.attributes[triangle.id as usize];
    let other = (face.other != Attribute::NONE).then_some(face.other & !Attribute::OPPOSITE);
    [Some(face.body), other].into_iter().flatten().map(|body| body as usize)
}

fn greatest_coordinate(scene: &FlatScene) -> f64 {
    scene.bounds.iter().flatten().map(|x| f64::from(x.abs())).fold(0.0, f64::max)
}
