//! The sphere: an octahedron whose rows of points lie on circles of latitude, evenly spaced.

use std::f64::consts::TAU;

use glam::DVec3;

use super::builder::{Builder, Corner};
use crate::scene::Mesh;
use crate::scene::document::SphereTable;

/// Tessellate with n = 2^level rows from pole to equator: 8·n² triangles.
pub(super) fn mesh(table: &SphereTable) -> Mesh {
    let rows = 1 << table.level.0;
    let mut sphere =
        Sphere { rows, radius: table.radius.value, builder: Builder::default(), rings: Vec::new() };
    sphere.rings = (0..=2 * rows).map(|ring| sphere.ring(ring)).collect();
    for ring in 0..2 * rows {
        sphere.band(ring);
    }
    sphere.builder.mesh
}

/// A circle of latitude: the first of its points, and of its texture coordinates (one more, for the seam).
#[derive(Clone, Copy)]
struct Ring {
    first: u32,
    first_uv: u32,
    quarter: u32,
}

struct Sphere {
    rows: u32,
    radius: f64,
    builder: Builder,
    rings: Vec<Ring>,
}

impl Sphere {
    /// Points of a circle of latitude, eastwards from +Z; ring 0 is the north pole.
    fn ring(&mut self, ring: u32) -> Ring {
        let quarter = ring.min(2 * self.rows - ring);
        let count = (4 * quarter).max(1);
        let (first, first_uv) =
            (self.builder.mesh.positions.len() as u32, self.builder.mesh.uvs.len() as u32);
        for step in 0..count {
            let normal = self.direction(ring, f64::from(step) / f64::from(count));
            self.builder.position(normal * self.radius);
            self.builder.normal(normal);
        }
        // A pole has a texture coordinate for each of its faces, in the middle of the face.
        let (uvs, shift) = if quarter == 0 { (4, 0.5) } else { (count, 0.0) };
        let v = 1.0 - f64::from(ring) / f64::from(2 * self.rows);
        for step in 0..=uvs {
            self.builder.uv((f64::from(step) + shift) / f64::from(uvs), v);
        }
        Ring { first, first_uv, quarter }
    }

    /// The unit vector of a ring at a fraction of a turn from +Z towards +X.
    fn direction(&self, ring: u32, turn: f64) -> DVec3 {
        if ring == 0 {
            return DVec3::Y;
        }
        if ring == 2 * self.rows {
            return DVec3::NEG_Y;
        }
        let (sin, cos) = (TAU / 4.0 * f64::from(ring) / f64::from(self.rows)).sin_cos();
        let (east, south) = (TAU * turn).sin_cos();
        DVec3::new(sin * east, cos, sin * south).normalize()
    }

    /// The point number `step` of quadrant `quadrant`.
    fn corner(&self, ring: u32, quadrant: u32, step: u32) -> Corner {
        let Ring { first, first_uv, quarter } = self.rings[ring as usize];
        let along = quadrant * quarter + step;
        let position = first + along % (4 * quarter).max(1);
        let uv = if quarter == 0 { first_uv + quadrant } else { first_uv + along };
        Corner { position, normal: position, uv }
    }

    /// The faces between a ring and the next one to the south.
    fn band(&mut self, north: u32) {
        let south = north + 1;
        let [above, below] = [north, south].map(|ring| self.rings[ring as usize].quarter);
        for quadrant in 0..4 {
            for step in 0..above.max(below) {
                let corner = |ring, step| self.corner(ring, quadrant, step);
                let (wide, narrow) = if above < below {
                    (
                        [corner(north, step), corner(south, step), corner(south, step + 1)],
                        [corner(north, step), corner(south, step + 1), corner(north, step + 1)],
                    )
                } else {
                    (
                        [corner(north, step), corner(south, step), corner(north, step + 1)],
                        [corner(north, step + 1), corner(south, step), corner(south, step + 1)],
                    )
                };
                self.builder.triangle(wide);
                if step < above.min(below) {
                    self.builder.triangle(narrow);
                }
            }
        }
    }
}
