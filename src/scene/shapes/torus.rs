//! The torus.

use std::f64::consts::TAU;

use glam::DVec3;

use super::builder::{Builder, Corner};
use crate::scene::document::TorusTable;
use crate::scene::{Diagnostic, Mesh};

/// Tessellate with n = 2^level: 8·n steps around the axis, 4·n around the tube, 64·n² triangles.
pub(super) fn mesh(table: &TorusTable) -> Result<Mesh, Diagnostic> {
    let (major, minor) = (table.major.value, table.minor.value);
    if minor >= major {
        let message = format!("the torus runs into itself: minor {minor} is not below major {major}");
        return Err(Diagnostic::error(message)
            .hint("`major` reaches to the middle of the tube, `minor` is the tube's radius"));
    }
    let (around, tube) = (8 << table.level.0, 4 << table.level.0);
    let mut builder = Builder::default();
    for step in 0..around {
        let (x, z) = angle(step, around).sin_cos();
        let outward = DVec3::new(x, 0.0, z);
        for turn in 0..tube {
            let (up, out) = angle(turn, tube).sin_cos();
            let normal = (outward * out + DVec3::Y * up).normalize();
            builder.position(outward * major + normal * minor);
            builder.normal(normal);
        }
    }
    for step in 0..=around {
        for turn in 0..=tube {
            builder.uv(f64::from(step) / f64::from(around), f64::from(turn) / f64::from(tube));
        }
    }
    for step in 0..around {
        for turn in 0..tube {
            let corner = |step: u32, turn: u32| {
                let position = step % around * tube + turn % tube;
                Corner { position, normal: position, uv: step * (tube + 1) + turn }
            };
            builder.quad([
                corner(step, turn),
                corner(step + 1, turn),
                corner(step + 1, turn + 1),
                corner(step, turn + 1),
            ]);
        }
    }
    Ok(builder.mesh)
}

fn angle(step: u32, steps: u32) -> f64 {
    TAU * f64::from(step) / f64::from(steps)
}
