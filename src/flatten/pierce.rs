//! Which surfaces hold a point: what a line from it pierces.
//!
//! One line answers for every shell of a body at once and visits few faces, where a winding number would ask
//! every face. No line slips through between two faces: a side that they share puts it on the same hand of both,
//! since the same numbers decide.

use glam::{DVec2, DVec3, swizzles::Vec3Swizzles};

use super::faces::corners;
use super::number::widen3;
use crate::bvh::{self, Bvh, BvhError, Preset};
use crate::layout::{Node, Triangle};

/// A point this close to a face touches it: this part of the largest coordinate, a few f32 roundoffs.
const TOUCH: f64 = 1e-6;

/// y and z of a step along every line, for one of x: slanted, so that walls along the axes are not seen edge-on.
const SLANT: DVec2 = DVec2::new(391.0 / 1024.0, 242.0 / 1024.0);

/// Faces of several shells; the id of a triangle is its shell.
pub(super) struct Lines<'a> {
    faces: &'a [Triangle],
    tree: Bvh,
    tolerance: f64,
}

/// What a line from a point met of one shell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Crossing {
    pub(super) shell: u32,
    /// How often the shell winds around the point.
    pub(super) winding: i32,
    /// Whether the point lies on the shell.
    pub(super) touches: bool,
}

impl<'a> Lines<'a> {
    /// Prepare at least two faces.
    pub(super) fn new(faces: &'a [Triangle]) -> Result<Self, BvhError> {
        let largest =
            faces.iter().flat_map(|t| [t.v0, t.v1, t.v2]).flatten().fold(0.0, |m: f32, x| m.max(x.abs()));
        let tree = bvh::build(faces, Preset::Fast)?;
        Ok(Self { faces, tree, tolerance: f64::from(largest) * TOUCH })
    }

    /// What the line from a point meets, by ascending shell.
    pub(super) fn pierce(&self, point: DVec3) -> Vec<Crossing> {
        let mut found = Vec::new();
        let mut stack = vec![(0, 0)];
        while let Some((first, count)) = stack.pop() {
            if count == 0 {
                let children = children(&self.tree.nodes[first as usize]);
                stack.extend(
                    children.into_iter().filter(|child| self.meets(point, child)).map(|c| (c.2, c.3)),
                );
                continue;
            }
            let leaf = &self.tree.order[first as usize..(first + count) as usize];
            found.extend(leaf.iter().filter_map(|&face| self.cross(point, &self.faces[face as usize])));
        }
        found.sort_unstable_by_key(|crossing| crossing.shell);
        found.chunk_by(|a, b| a.shell == b.shell).map(sum).collect()
    }

    /// Whether the line may meet a child's box.
    fn meets(&self, point: DVec3, (lo, hi, ..): &([f32; 3], [f32; 3], u32, u32)) -> bool {
        let (lo, hi) = (widen3(*lo) - self.tolerance, widen3(*hi) + self.tolerance);
        // Where the line, which goes up in y and z, enters and leaves the box's range of x.
        let at = |x: f64| point.yz() + SLANT * (x - point.x);
        let (enters, leaves) = (at(lo.x.max(point.x - self.tolerance)), at(hi.x));
        hi.x >= point.x && enters.cmple(hi.yz()).all() && leaves.cmpge(lo.yz()).all()
    }

    /// What the line meets of one face.
    fn cross(&self, point: DVec3, face: &Triangle) -> Option<Crossing> {
        let [a, b, c] = corners(face);
        // Along the line everything falls onto one point of the plane x = 0.
        let along = |p: DVec3| p.yz() - SLANT * p.x;
        let (flat, target) = ([a, b, c].map(along), along(point));
        let sides =
            [[flat[1], flat[2]], [flat[2], flat[0]], [flat[0], flat[1]]].map(|[u, v]| side(u, v, target));
        let left = sides.map(|(_, left)| left);
        if left != [left[0]; 3] {
            return None;
        }
        // The parts that the sides cut off are barycentric coordinates of the crossing.
        let parts = sides.map(|(part, _)| part);
        let x = (parts[0] * a.x + parts[1] * b.x + parts[2] * c.x) / (parts[0] + parts[1] + parts[2]);
        let beyond = x - point.x;
        if beyond < -self.tolerance {
            return None;
        }
        // A face seen edge-on gives no number.
        let touches = beyond.is_nan() || beyond <= self.tolerance;
        Some(Crossing { shell: face.id, winding: if left[0] { 1 } else { -1 }, touches })
    }
}

/// Twice the signed area of the triangle u, v, p, and whether p lies to the left of the line from u to v. Of
/// points on the line the answer is that for the line from v to u, inverted: each belongs to one side.
fn side(u: DVec2, v: DVec2, p: DVec2) -> (f64, bool) {
    let forward = (u.x, u.y) < (v.x, v.y);
    let (from, to) = if forward { (u, v) } else { (v, u) };
    let area = (to - from).perp_dot(p - from);
    if forward { (area, area >= 0.0) } else { (-area, area < 0.0) }
}

fn sum(crossings: &[Crossing]) -> Crossing {
    let winding = crossings.iter().map(|crossing| crossing.winding).sum();
    let touches = crossings.iter().any(|crossing| crossing.touches);
    Crossing { shell: crossings[0].shell, winding, touches }
}

fn children(node: &Node) -> [([f32; 3], [f32; 3], u32, u32); 2] {
    [(node.a_lo, node.a_hi, node.a_first, node.a_count), (node.b_lo, node.b_hi, node.b_first, node.b_count)]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::flatten::number::narrow3;
    use crate::flatten::samples::cuboid;

    /// The faces of cuboids, each a shell of its own.
    fn cuboids(boxes: &[[DVec3; 2]]) -> Vec<Triangle> {
        let faces = |(id, &[lo, hi]): (u32, &[DVec3; 2])| {
            let mesh = cuboid(lo, hi);
            let triangles = mesh.triangles.clone().into_iter();
            triangles.map(move |triangle| {
                let [v0, v1, v2] = triangle.positions.map(|index| narrow3(mesh.positions[index as usize]));
                Triangle { v0, id, v1, reserved1: 0, v2, reserved2: 0 }
            })
        };
        (0..).zip(boxes).flat_map(faces).collect()
    }

    /// The shells that hold a point.
    fn holders(lines: &Lines, point: DVec3) -> Vec<u32> {
        lines.pierce(point).iter().filter(|found| found.winding == 1).map(|found| found.shell).collect()
    }

    #[test]
    fn lines_through_corners_sides_and_diagonals_count_once() {
        let boxes = [[DVec3::splat(-4.0), DVec3::splat(4.0)], [DVec3::splat(-2.0), DVec3::splat(2.0)]];
        let faces = cuboids(&boxes);
        let lines = Lines::new(&faces).unwrap();
        // Aim at every point of a lattice on the walls, with their sides, diagonals and corners, from before it.
        let lattice = (-5..=5).flat_map(|y| (-5..=5).map(move |z| (f64::from(y), f64::from(z))));
        for (x, (y, z)) in
            [-4.0, -2.0, 2.0, 4.0].into_iter().flat_map(|x| lattice.clone().map(move |at| (x, at)))
        {
            for steps in [0.5, 1.0, 3.0, 7.0] {
                let point = DVec3::new(x, y, z) - DVec3::new(1.0, SLANT.x, SLANT.y) * steps;
                let (reach, found) = (point.abs().max_element(), holders(&lines, point));
                let expected: Vec<u32> =
                    [(0, 4.0), (1, 2.0)].iter().filter(|s| reach < s.1).map(|s| s.0).collect();
                assert!([2.0, 4.0].contains(&reach) || found == expected, "{point} {found:?}");
            }
        }
    }

    #[test]
    fn a_point_on_a_shell_touches_it() {
        let faces = cuboids(&[[DVec3::ZERO, DVec3::ONE], [DVec3::splat(3.0), DVec3::splat(4.0)]]);
        let lines = Lines::new(&faces).unwrap();
        let touches = |x: f64| lines.pierce(DVec3::new(x, 0.3, 0.4)).iter().any(|found| found.touches);
        assert!(touches(0.0) && touches(1.0) && touches(1.0 + 1e-7));
        assert!(!touches(0.5) && !touches(-0.5) && !touches(1.001));
    }
}
