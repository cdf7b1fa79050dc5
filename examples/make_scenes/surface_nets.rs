//! Closed meshes of fields: surface nets (Gibson, Constrained Elastic Surface Nets, MICCAI 1998) on a grid,
//! then relaxation along the surface and projection onto it.

use glam::{DVec3, UVec3};
use rayon::prelude::*;

use crate::field::{Field, gradient};
use crate::mesh::Mesh;

/// Rounds of relaxation and projection: enough for triangles of even size.
const ROUNDS: usize = 8;

/// The surface where `field` is 0 in the box from `lo` to `hi`, with edges of about `step`.
/// The field must be positive on the whole boundary of the box.
pub(crate) fn surface(field: &impl Field, lo: DVec3, hi: DVec3, step: f64) -> Mesh {
    let grid = Grid::sample(field, lo, hi, step);
    let mut mesh = grid.net();
    for _ in 0..ROUNDS {
        relax(&mut mesh, field);
    }
    mesh
}

struct Grid {
    lo: DVec3,
    step: f64,
    /// Samples along each axis.
    size: UVec3,
    values: Vec<f64>,
}

/// Absent vertex of a cell that the surface does not cross.
const NONE: u32 = u32::MAX;

impl Grid {
    fn sample(field: &impl Field, lo: DVec3, hi: DVec3, step: f64) -> Self {
        let size = ((hi - lo) / step).ceil().as_uvec3() + 2;
        let values = (0..size.z)
            .into_par_iter()
            .flat_map_iter(|z| (0..size.y).flat_map(move |y| (0..size.x).map(move |x| UVec3::new(x, y, z))))
            .map(|cell| field(lo + cell.as_dvec3() * step))
            .collect();
        Self { lo, step, size, values }
    }

    fn index(&self, cell: UVec3) -> usize {
        ((cell.z * self.size.y + cell.y) * self.size.x + cell.x) as usize
    }

    fn cells(&self) -> impl Iterator<Item = UVec3> {
        let size = self.size;
        (0..size.z)
            .flat_map(move |z| (0..size.y).flat_map(move |y| (0..size.x).map(move |x| UVec3::new(x, y, z))))
    }

    /// One vertex in each crossed cell, one quadrilateral across each crossed edge.
    fn net(&self) -> Mesh {
        let mut mesh = Mesh::default();
        let mut vertex = vec![NONE; self.values.len()];
        for cell in self.cells().filter(|c| c.cmplt(self.size - 1).all()) {
            if let Some(centre) = self.centre(cell) {
                vertex[self.index(cell)] = mesh.vertex(centre);
            }
        }
        for cell in self.cells().filter(|c| c.cmpgt(UVec3::ZERO).all()) {
            for axis in 0..3 {
                self.face(cell, axis, &vertex, &mut mesh);
            }
        }
        mesh
    }

    /// The mean of the surface's crossings with the cell's twelve edges.
    fn centre(&self, cell: UVec3) -> Option<DVec3> {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for axis in 0..3 {
            let (u, v) = (UVec3::AXES[(axis + 1) % 3], UVec3::AXES[(axis + 2) % 3]);
            for base in [cell, cell + u, cell + v, cell + u + v] {
                let (a, b) =
                    (self.values[self.index(base)], self.values[self.index(base + UVec3::AXES[axis])]);
                if (a < 0.0) != (b < 0.0) {
                    sum += base.as_dvec3() + UVec3::AXES[axis].as_dvec3() * (a / (a - b));
                    count += 1.0;
                }
            }
        }
        (count > 0.0).then(|| self.lo + self.step * sum / count)
    }

    /// Joins the four cells around the edge from `cell` along `axis` where the surface crosses it.
    fn face(&self, cell: UVec3, axis: usize, vertex: &[u32], mesh: &mut Mesh) {
        let next = cell + UVec3::AXES[axis];
        if next[axis] >= self.size[axis] {
            return;
        }
        let inside = [cell, next].map(|c| self.values[self.index(c)] < 0.0);
        if inside[0] == inside[1] {
            return;
        }
        let (u, v) = (UVec3::AXES[(axis + 1) % 3], UVec3::AXES[(axis + 2) % 3]);
        let [a, b, c, d] = [cell - u - v, cell - v, cell, cell - u].map(|c| vertex[self.index(c)]);
        mesh.quad(if inside[0] { [a, b, c, d] } else { [d, c, b, a] });
    }
}

/// Moves each vertex along the surface towards the mean of its neighbours, then by Newton onto the surface.
fn relax(mesh: &mut Mesh, field: &impl Field) {
    let mut sums = vec![(DVec3::ZERO, 0.0); mesh.positions.len()];
    for t in &mesh.triangles {
        for (i, j) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            let sum = &mut sums[i as usize];
            *sum = (sum.0 + mesh.positions[j as usize], sum.1 + 1.0);
        }
    }
    mesh.positions.par_iter_mut().zip(&sums).for_each(|(p, (sum, count))| {
        let normal = gradient(field, *p).normalize_or_zero();
        let pull = *sum / *count - *p;
        let moved = *p + 0.6 * (pull - normal * pull.dot(normal));
        let slope = gradient(field, moved);
        *p = moved - slope * (field(moved) / slope.length_squared().max(1e-6));
    });
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::topology::Topology;

    #[test]
    fn the_net_of_a_sphere_is_closed_and_lies_on_it() {
        let sphere = |p: DVec3| p.length() - 1.0;
        let mesh = surface(&sphere, DVec3::splat(-1.3), DVec3::splat(1.3), 0.1);
        assert_eq!(Topology::of(&mesh).unwrap(), Topology { shells: 1, euler: 2 });
        assert!(mesh.positions.iter().all(|p| (p.length() - 1.0).abs() < 1e-4));
        assert!((mesh.volume() - 4.0 / 3.0 * std::f64::consts::PI).abs() < 0.05);
    }
}
