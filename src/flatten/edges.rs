//! Which faces meet at which edge.

use std::f64::consts::TAU;

use glam::DVec3;
use rayon::slice::ParallelSliceMut;

/// No partner.
pub(super) const NONE: u32 = u32::MAX;

/// Side `s` of triangle `t` runs from corner `s` to the next and has the number `3·t + s`.
pub(super) struct Sides {
    /// For each side the side of the neighbour that it is joined to, or [`NONE`].
    pub(super) partner: Vec<u32>,
    /// Sides of edges that belong to one face only: the mesh is open there.
    pub(super) open: Vec<u32>,
    /// One side of each edge that an odd number of faces above 2 share: no solid has such an edge.
    pub(super) odd: Vec<u32>,
}

/// One use of an edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Use {
    lo: u32,
    hi: u32,
    side: u32,
}

/// Join faces across their edges. `triangles` name welded vertices; those with two equal vertices are left
/// out, since the faces beside them then meet directly.
///
/// An edge of four, six, … faces, where solids touch, is cut into wedges of matter: see [`join_crowd`].
pub(super) fn join(triangles: &[[u32; 3]], positions: &[DVec3]) -> Sides {
    let mut uses = list_uses(triangles);
    uses.par_sort_unstable();
    let mut sides = Sides { partner: vec![NONE; triangles.len() * 3], open: vec![], odd: vec![] };
    for group in uses.chunk_by(|a, b| (a.lo, a.hi) == (b.lo, b.hi)) {
        match group {
            [one] => sides.open.push(one.side),
            [a, b] => sides.join(a.side, b.side),
            crowd if crowd.len() % 2 == 1 => sides.odd.push(crowd[0].side),
            crowd => join_crowd(&mut sides, crowd, triangles, positions),
        }
    }
    sides
}

impl Sides {
    fn join(&mut self, a: u32, b: u32) {
        self.partner[a as usize] = b;
        self.partner[b as usize] = a;
    }
}

/// The vertices at the ends of a side.
pub(super) fn ends(triangles: &[[u32; 3]], side: u32) -> [u32; 2] {
    let (triangle, corner) = (triangles[side as usize / 3], side as usize % 3);
    [triangle[corner], triangle[(corner + 1) % 3]]
}

/// Whether two joined sides run in opposite directions, as in a consistently wound mesh.
pub(super) fn agree(triangles: &[[u32; 3]], a: u32, b: u32) -> bool {
    ends(triangles, a)[0] == ends(triangles, b)[1]
}

/// Whether a triangle has three different vertices.
pub(super) fn is_proper([a, b, c]: [u32; 3]) -> bool {
    a != b && b != c && c != a
}

fn list_uses(triangles: &[[u32; 3]]) -> Vec<Use> {
    let proper = (0_u32..).zip(triangles).filter(|&(_, &triangle)| is_proper(triangle));
    proper
        .flat_map(|(index, _)| index * 3..index * 3 + 3)
        .map(|side| {
            let [start, end] = ends(triangles, side);
            Use { lo: start.min(end), hi: start.max(end), side }
        })
        .collect()
}

/// Join the faces around an edge so that each pair bounds one wedge of matter.
///
/// Seen along the edge from its lower vertex, a face that runs upwards has its matter on the clockwise side
/// and ends a wedge; one that runs downwards begins one. Wedges are matched like brackets. Where there are not
/// as many ends as beginnings the winding is inconsistent, and faces are joined in the order of their angles.
fn join_crowd(sides: &mut Sides, crowd: &[Use], triangles: &[[u32; 3]], positions: &[DVec3]) {
    let around = sort_by_angle(crowd, triangles, positions);
    let ends_wedge = |side: u32| ends(triangles, side)[0] == crowd[0].lo;
    let endings = around.iter().filter(|&&side| ends_wedge(side)).count();
    if endings * 2 != around.len() {
        around.chunks_exact(2).for_each(|pair| sides.join(pair[0], pair[1]));
        return;
    }
    // Twice around: endings before any beginning find theirs on the second turn.
    let mut begun: Vec<u32> = Vec::new();
    for &side in around.iter().chain(&around) {
        if sides.partner[side as usize] != NONE {
            continue;
        }
        if !ends_wedge(side) {
            begun.push(side);
        } else if let Some(beginning) = begun.pop() {
            sides.join(beginning, side);
        }
    }
}

/// The sides of an edge by the angle of their faces around it, counter-clockwise seen from above.
fn sort_by_angle(crowd: &[Use], triangles: &[[u32; 3]], positions: &[DVec3]) -> Vec<u32> {
    let at = |vertex: u32| positions[vertex as usize];
    let origin = at(crowd[0].lo);
    let axis = (at(crowd[0].hi) - origin).normalize_or_zero();
    let arm = |side: u32| at(triangles[side as usize / 3][(side as usize + 2) % 3]) - origin;
    let start = arm(crowd[0].side).reject_from(axis).normalize_or_zero();
    let angle = |side: u32| {
        let arm = arm(side);
        arm.dot(axis.cross(start)).atan2(arm.dot(start)).rem_euclid(TAU)
    };
    let mut around: Vec<(f64, u32)> = crowd.iter().map(|used| (angle(used.side), used.side)).collect();
    around.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    around.into_iter().map(|(_, side)| side).collect()
}
