//! The box: six flat faces.

use glam::DVec3;

use super::builder::{Builder, Corner};
use crate::scene::Mesh;
use crate::scene::document::BoxTable;

/// A face: its outward axis, and the axes along which its texture runs to the right and up.
pub(super) struct Face {
    pub(super) out: DVec3,
    pub(super) right: DVec3,
    pub(super) up: DVec3,
}

/// The faces of a box; `right × up = out`.
pub(super) const FACES: [Face; 6] = [
    Face { out: DVec3::X, right: DVec3::NEG_Z, up: DVec3::Y },
    Face { out: DVec3::NEG_X, right: DVec3::Z, up: DVec3::Y },
    Face { out: DVec3::Y, right: DVec3::X, up: DVec3::NEG_Z },
    Face { out: DVec3::NEG_Y, right: DVec3::X, up: DVec3::Z },
    Face { out: DVec3::Z, right: DVec3::X, up: DVec3::Y },
    Face { out: DVec3::NEG_Z, right: DVec3::NEG_X, up: DVec3::Y },
];

/// Twelve triangles; the texture covers each face once.
pub(super) fn mesh(table: &BoxTable) -> Mesh {
    let half = DVec3::from(table.size) / 2.0;
    let mut builder = Builder::default();
    for corner in 0..8 {
        let sign = |axis: u32| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
        builder.position(half * DVec3::new(sign(0), sign(1), sign(2)));
    }
    let uvs = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| builder.uv(u, v));
    for face in &FACES {
        let normal = builder.normal(face.out);
        let mut uv = uvs.into_iter();
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(right, up)| Corner {
            position: corner_index(face.out + right * face.right + up * face.up),
            normal,
            uv: uv.next().unwrap_or_default(),
        });
        builder.quad(corners);
    }
    builder.mesh
}

/// The index of the corner whose signs these are.
fn corner_index(signs: DVec3) -> u32 {
    u32::from(signs.x > 0.0) | u32::from(signs.y > 0.0) << 1 | u32::from(signs.z > 0.0) << 2
}
