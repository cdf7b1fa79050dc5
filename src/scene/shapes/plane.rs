//! The plane: a rectangle at y = 0 that faces up.

use glam::{DVec2, DVec3};

use super::builder::{Builder, Corner};
use crate::scene::Mesh;
use crate::scene::document::PlaneTable;

/// Two triangles; seen from above with +Z towards the viewer, the texture stands upright.
pub(super) fn mesh(table: &PlaneTable) -> Mesh {
    let (size, repeat) = (DVec2::from(table.size), DVec2::from(table.uv_repeat));
    let mut builder = Builder::default();
    let normal = builder.normal(DVec3::Y);
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| Corner {
        position: builder.position(DVec3::new((u - 0.5) * size.x, 0.0, (0.5 - v) * size.y)),
        normal,
        uv: builder.uv(u * repeat.x, v * repeat.y),
    });
    builder.quad(corners);
    builder.mesh
}
