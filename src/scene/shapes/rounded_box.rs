//! The rounded box: a box whose edges and corners are a ball's.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_4;

use glam::{DVec3, IVec3};

use super::builder::{Builder, Corner};
use super::cuboid::{FACES, Face};
use crate::scene::document::RoundedBoxTable;
use crate::scene::{Diagnostic, Mesh};

/// Tessellate with n = 2^level steps for each 45°: 12·(2n + 1)² triangles.
///
/// Each face of a box carries a grid of n rounded cells, one flat cell and n rounded cells in both directions;
/// its points are then drawn in to the distance `radius` from the inner box.
pub(super) fn mesh(table: &RoundedBoxTable) -> Result<Mesh, Diagnostic> {
    let (size, radius) = (DVec3::from(table.size), table.radius.value);
    if 2.0 * radius >= size.min_element() {
        let message = format!("radius {radius} is not below half of the least size, {}", size.min_element());
        return Err(Diagnostic::error(message).hint("a box that is all roundness is a sphere or a cylinder"));
    }
    let grid = Grid { steps: 1 << table.level.0, radius, inner: size / 2.0 - radius };
    let mut rounded = Rounded { grid, builder: Builder::default(), index_of: HashMap::new() };
    for face in &FACES {
        rounded.face(face);
    }
    Ok(rounded.builder.mesh)
}

/// Grid lines on one axis: −(n + 1) … −1 and 1 … n + 1. The lines ±1 bound the flat cell; there is no line 0.
struct Grid {
    steps: i32,
    radius: f64,
    /// Half the size of the box of the balls' centres.
    inner: DVec3,
}

impl Grid {
    fn lines(&self) -> Vec<i32> {
        (-self.steps - 1..=self.steps + 1).filter(|&line| line != 0).collect()
    }

    /// How far outside the flat cell a line lies, in radii: evenly spaced in angle, 1 at the outermost.
    fn overhang(&self, line: i32) -> f64 {
        let angle = FRAC_PI_4 * f64::from(line.abs() - 1) / f64::from(self.steps);
        f64::from(line.signum()) * angle.tan()
    }

    /// The outward direction and the place of a point on the surface.
    fn point(&self, lines: IVec3) -> (DVec3, DVec3) {
        let direction = DVec3::from_array(lines.to_array().map(|line| self.overhang(line))).normalize();
        (direction, self.inner * lines.signum().as_dvec3() + direction * self.radius)
    }

    /// Where a line lies on a face whose inner half size is given, from 0 to 1.
    fn fraction(&self, line: i32, inner: f64) -> f64 {
        let half = inner + self.radius;
        let along = f64::from(line.signum()) * inner + self.overhang(line) * self.radius;
        (along / half + 1.0) / 2.0
    }
}

struct Rounded {
    grid: Grid,
    builder: Builder,
    /// Positions and normals by their grid lines: faces share the points of their common edges.
    index_of: HashMap<IVec3, u32>,
}

impl Rounded {
    fn face(&mut self, face: &Face) {
        let lines = self.grid.lines();
        for rows in lines.windows(2) {
            for columns in lines.windows(2) {
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
                    .map(|(column, row)| self.corner(face, columns[column], rows[row]));
                self.builder.quad(corners);
            }
        }
    }

    fn corner(&mut self, face: &Face, column: i32, row: i32) -> Corner {
        let outermost = self.grid.steps + 1;
        let lines =
            face.out.as_ivec3() * outermost + face.right.as_ivec3() * column + face.up.as_ivec3() * row;
        let index = match self.index_of.get(&lines) {
            Some(&index) => index,
            None => {
                let (normal, position) = self.grid.point(lines);
                self.builder.normal(normal);
                let index = self.builder.position(position);
                self.index_of.insert(lines, index);
                index
            }
        };
        let along = |axis: DVec3| self.grid.inner.dot(axis.abs());
        let (u, v) = (self.grid.fraction(column, along(face.right)), self.grid.fraction(row, along(face.up)));
        Corner { position: index, normal: index, uv: self.builder.uv(u, v) }
    }
}
