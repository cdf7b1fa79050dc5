//! Gathers the faces of a solid.

use glam::{DVec2, DVec3};

use crate::scene::{Mesh, Triangle};

/// A corner: indices of its position, normal and texture coordinate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) normal: u32,
    pub(super) uv: u32,
}

/// A mesh under construction.
#[derive(Debug, Default)]
pub(super) struct Builder {
    pub(super) mesh: Mesh,
}

impl Builder {
    pub(super) fn position(&mut self, position: DVec3) -> u32 {
        self.mesh.positions.push(position);
        self.mesh.positions.len() as u32 - 1
    }

    pub(super) fn normal(&mut self, normal: DVec3) -> u32 {
        self.mesh.normals.push(normal);
        self.mesh.normals.len() as u32 - 1
    }

    pub(super) fn uv(&mut self, u: f64, v: f64) -> u32 {
        self.mesh.uvs.push(DVec2::new(u, v));
        self.mesh.uvs.len() as u32 - 1
    }

    /// Add a face, counter-clockwise seen from outside.
    pub(super) fn triangle(&mut self, corners: [Corner; 3]) {
        self.mesh.triangles.push(Triangle {
            positions: corners.map(|corner| corner.position),
            normals: corners.map(|corner| corner.normal),
            uvs: corners.map(|corner| corner.uv),
            material: 0,
        });
    }

    /// Add two faces, counter-clockwise seen from outside.
    pub(super) fn quad(&mut self, [a, b, c, d]: [Corner; 4]) {
        self.triangle([a, b, c]);
        self.triangle([a, c, d]);
    }
}
