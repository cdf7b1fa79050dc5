//! The cylinder: a smooth side and two flat caps.

use std::f64::consts::TAU;

use glam::DVec3;

use super::builder::{Builder, Corner};
use crate::scene::Mesh;
use crate::scene::document::CylinderTable;

/// Tessellate with 4·2^level sides: 16·2^level triangles. The texture goes round the side once, eastwards from
/// +Z, and covers each cap's square once.
pub(super) fn mesh(table: &CylinderTable) -> Mesh {
    let sides = 4 << table.level.0;
    let (radius, half_height) = (table.radius.value, table.height.value / 2.0);
    let mut builder = Builder::default();
    // Positions 2k and 2k + 1 are the lower and upper end of side k's first edge; normals k belong to it.
    for side in 0..sides {
        let normal = direction(side, sides);
        builder.position(normal * radius - DVec3::Y * half_height);
        builder.position(normal * radius + DVec3::Y * half_height);
        builder.normal(normal);
    }
    for side in 0..=sides {
        let u = f64::from(side) / f64::from(sides);
        builder.uv(u, 0.0);
        builder.uv(u, 1.0);
    }
    for side in 0..sides {
        let corner = |side: u32, end: u32| {
            let normal = side % sides;
            Corner { position: 2 * normal + end, normal, uv: 2 * side + end }
        };
        builder.quad([corner(side, 0), corner(side + 1, 0), corner(side + 1, 1), corner(side, 1)]);
    }
    cap(&mut builder, sides, 0, DVec3::NEG_Y, half_height);
    cap(&mut builder, sides, 1, DVec3::Y, half_height);
    builder.mesh
}

/// The horizontal unit vector of an edge, eastwards from +Z.
fn direction(side: u32, sides: u32) -> DVec3 {
    let (x, z) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
    DVec3::new(x, 0.0, z).normalize()
}

/// The fan around the centre of an end: 0 is the lower, 1 the upper one.
fn cap(builder: &mut Builder, sides: u32, end: u32, out: DVec3, half_height: f64) {
    let normal = builder.normal(out);
    let middle = Corner { position: builder.position(out * half_height), normal, uv: builder.uv(0.5, 0.5) };
    let first_uv = builder.mesh.uvs.len() as u32;
    for side in 0..sides {
        let direction = direction(side, sides);
        builder.uv(0.5 + 0.5 * direction.x, 0.5 - 0.5 * direction.z * out.y);
    }
    for side in 0..sides {
        let rim = |side: u32| Corner { position: 2 * side + end, normal, uv: first_uv + side };
        let (here, there) = (rim(side), rim((side + 1) % sides));
        builder.triangle(if end == 1 { [middle, here, there] } else { [middle, there, here] });
    }
}
