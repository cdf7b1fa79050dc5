//! Meshes that need no grid: spheres, surfaces of revolution, star-shaped solids, prisms.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::mesh::Mesh;

/// A unit sphere: an icosahedron whose triangles are cut in four `level` times.
pub(crate) fn icosphere(level: u32) -> Mesh {
    let mut mesh = icosahedron();
    for _ in 0..level {
        mesh = subdivided(&mesh);
    }
    mesh
}

fn icosahedron() -> Mesh {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for (s, t) in [(1.0, g), (-1.0, g), (1.0, -g), (-1.0, -g)] {
        positions.extend([DVec3::new(0.0, s, t), DVec3::new(s, t, 0.0), DVec3::new(t, 0.0, s)]);
    }
    let mut mesh = Mesh { positions, ..Mesh::default() };
    let count = mesh.positions.len() as u32;
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                let [p, q, r] = mesh.corners([a, b, c]);
                let is_face = [p.distance(q), q.distance(r), r.distance(p)].iter().all(|d| *d < 2.1);
                if is_face {
                    let outward = (q - p).cross(r - p).dot(p) > 0.0;
                    mesh.triangles.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    mesh.mapped(DVec3::normalize)
}

/// Each triangle cut in four, the new vertices pushed out onto the unit sphere.
fn subdivided(mesh: &Mesh) -> Mesh {
    let mut finer = Mesh { positions: mesh.positions.clone(), ..Mesh::default() };
    let mut middles = HashMap::new();
    for &[a, b, c] in &mesh.triangles {
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[i, j]| {
            *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                let sum = finer.positions[i as usize] + finer.positions[j as usize];
                finer.vertex(sum.normalize())
            })
        });
        finer.triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    finer
}

/// A closed solid between two poles: `point(ring, turn)` for rings 1..rings and turn in [0, 1), from the
/// pole `point(0, 0)` to the pole `point(rings, 0)`. Turns go anticlockwise seen from the first pole.
pub(crate) fn between_poles(rings: usize, sides: usize, point: impl Fn(usize, f64) -> DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    let first = mesh.vertex(point(0, 0.0));
    for ring in 1..rings {
        for side in 0..sides {
            mesh.vertex(point(ring, side as f64 / sides as f64));
        }
    }
    let last = mesh.vertex(point(rings, 0.0));
    let index = |ring: usize, side: usize| match ring {
        0 => first,
        _ if ring == rings => last,
        _ => (1 + (ring - 1) * sides + side % sides) as u32,
    };
    for ring in 0..rings {
        for side in 0..sides {
            let (a, b) = (index(ring, side), index(ring, side + 1));
            let (c, d) = (index(ring + 1, side + 1), index(ring + 1, side));
            mesh.quad([a, d, c, b]);
        }
    }
    mesh
}

/// The solid of revolution about +Y of a profile of (radius, height) from its top on the axis, outside, to its
/// bottom on the axis. Only the first and the last radius may be 0.
pub(crate) fn lathe(profile: &[DVec2], sides: usize) -> Mesh {
    between_poles(profile.len() - 1, sides, |ring, turn| around(profile[ring].x, profile[ring].y, turn))
}

/// A curve through all points (Catmull and Rom 1974), `steps` pieces for each of their intervals.
pub(crate) fn spline(points: &[[f64; 2]], steps: usize) -> Vec<DVec2> {
    let at = |i: isize| DVec2::from_array(points[i.clamp(0, points.len() as isize - 1) as usize]);
    let mut curve = Vec::new();
    for i in 0..points.len() as isize - 1 {
        let [a, b, c, d] = [i - 1, i, i + 1, i + 2].map(at);
        for step in 0..steps {
            let t = step as f64 / steps as f64;
            let cubic = (3.0 * (b - c) + d - a) * t + 2.0 * a - 5.0 * b + 4.0 * c - d;
            curve.push(0.5 * ((cubic * t + c - a) * t + 2.0 * b));
        }
    }
    curve.push(at(points.len() as isize - 1));
    curve
}

/// The point at a radius, height and turn anticlockwise about +Y, starting towards +X.
pub(crate) fn around(radius: f64, height: f64, turn: f64) -> DVec3 {
    let (sin, cos) = (TAU * turn).sin_cos();
    DVec3::new(radius * cos, height, -radius * sin)
}

/// The right prism over a convex polygon in the plane z = 0, anticlockwise seen from +Z, centred on that plane.
pub(crate) fn prism(polygon: &[DVec2], length: f64) -> Mesh {
    let mut mesh = Mesh::default();
    for z in [length / 2.0, -length / 2.0] {
        polygon.iter().for_each(|p| mesh.positions.push(p.extend(z)));
    }
    let n = polygon.len() as u32;
    for i in 1..n - 1 {
        mesh.triangles.extend([[0, i, i + 1], [n, n + i + 1, n + i]]);
    }
    for i in 0..n {
        let j = (i + 1) % n;
        mesh.quad([i, n + i, n + j, j]);
    }
    mesh
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::topology::Topology;

    const SPHERE: Topology = Topology { shells: 1, euler: 2 };

    #[test]
    fn shapes_are_solids() {
        let cone = lathe(&[DVec2::new(0.0, 1.0), DVec2::new(1.0, 0.0), DVec2::new(0.0, 0.0)], 12);
        let wedge = prism(&[DVec2::ZERO, DVec2::X, DVec2::Y], 2.0);
        assert_eq!(Topology::of(&cone).unwrap(), SPHERE);
        assert_eq!(Topology::of(&wedge).unwrap(), SPHERE);
        assert!((wedge.volume() - 1.0).abs() < 1e-12);
        assert_eq!(icosphere(3).triangles.len(), 1280);
    }
}
