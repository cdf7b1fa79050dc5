//! Triangle meshes with welded vertices.

use glam::{DVec2, DVec3};

/// Triangles, counter-clockwise seen from outside the matter, over shared vertices.
#[derive(Debug, Clone, Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<DVec3>,
    /// One for each position, or empty.
    pub(crate) uvs: Vec<DVec2>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds a vertex and returns its index.
    pub(crate) fn vertex(&mut self, position: DVec3) -> u32 {
        self.positions.push(position);
        self.positions.len() as u32 - 1
    }

    /// Adds the quadrilateral `a b c d`, cut along its shorter diagonal; a side of no length leaves a triangle.
    pub(crate) fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        let length = |i: u32, j: u32| self.positions[i as usize].distance(self.positions[j as usize]);
        let halves =
            if length(a, c) <= length(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        self.triangles.extend(halves.into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
    }

    /// Adds another mesh as further shells.
    pub(crate) fn append(&mut self, other: &Mesh) {
        let base = self.positions.len() as u32;
        self.positions.extend_from_slice(&other.positions);
        self.uvs.extend_from_slice(&other.uvs);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + base)));
    }

    /// The same surface around the matter outside: a bubble.
    pub(crate) fn inverted(mut self) -> Self {
        self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        self
    }

    /// Every vertex moved.
    pub(crate) fn mapped(mut self, map: impl Fn(DVec3) -> DVec3) -> Self {
        self.positions.iter_mut().for_each(|p| *p = map(*p));
        self
    }

    /// Corner positions of a triangle.
    pub(crate) fn corners(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        triangle.map(|i| self.positions[i as usize])
    }

    /// One unit normal for each vertex: the mean of its faces', weighted by area.
    pub(crate) fn smooth_normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for &t in &self.triangles {
            let [a, b, c] = self.corners(t);
            t.iter().for_each(|&i| normals[i as usize] += (b - a).cross(c - a));
        }
        normals.into_iter().map(DVec3::normalize_or_zero).collect()
    }

    /// Enclosed volume by the divergence theorem: positive for a solid, negative for a bubble.
    pub(crate) fn volume(&self) -> f64 {
        self.triangles.iter().map(|t| self.corners(*t)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }
}
