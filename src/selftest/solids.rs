//! Closed meshes for the cases.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::Random;
use crate::scene::{Mesh, Triangle};

/// A cube around the origin with sides of length 2.
#[must_use]
pub fn cube() -> Mesh {
    Mesh::cuboid(DVec3::NEG_ONE, DVec3::ONE)
}

/// A ball of radius 1 around the origin, with as many circles of latitude as of longitude.
#[must_use]
pub fn sphere(circles: u32) -> Mesh {
    star(circles, |_| 1.0)
}

/// The same with every vertex moved along its radius, by up to a tenth of it.
#[must_use]
pub fn jittered_sphere(circles: u32, random: &mut Random) -> Mesh {
    star(circles, |_| random.between(0.9, 1.1))
}

/// A hollow, bumpy shell like a piece of ice: radius about 1 outside and about 0.75 inside. The triangles of the cavity's
/// wall come first; how many there are.
#[must_use]
pub fn hollow_ice(circles: u32) -> (Mesh, u32) {
    let bumps = |v: DVec3, phase: f64| {
        ((5.0 * v.x + phase).sin() + (7.0 * v.y - phase).sin() + (6.0 * v.z + 2.0 * phase).sin()) / 3.0
    };
    let mut wall = star(circles, |v| 0.75 + 0.04 * bumps(v, 1.0));
    for triangle in &mut wall.triangles {
        triangle.positions.swap(1, 2);
    }
    let count = wall.triangles.len() as u32;
    (joined(wall, star(circles, |v| 1.0 + 0.06 * bumps(v, 0.0))), count)
}

/// Two meshes as one.
#[must_use]
pub fn joined(mut first: Mesh, second: Mesh) -> Mesh {
    let shift = first.positions.len() as u32;
    first.positions.extend(second.positions);
    first.triangles.extend(
        second.triangles.iter().map(|t| Triangle { positions: t.positions.map(|index| index + shift), ..*t }),
    );
    first
}

/// The mesh scaled, then moved.
#[must_use]
pub fn placed(mut mesh: Mesh, scale: f64, centre: DVec3) -> Mesh {
    for position in &mut mesh.positions {
        *position = *position * scale + centre;
    }
    mesh
}

/// A surface that each ray from the origin meets once, at a radius that depends on its direction.
fn star(circles: u32, mut radius: impl FnMut(DVec3) -> f64) -> Mesh {
    let mut positions = Vec::new();
    let mut vertex = |direction: DVec3| {
        positions.push(direction * radius(direction));
        positions.len() as u32 - 1
    };
    let north = vertex(DVec3::Y);
    for ring in 1..circles {
        let (sin, cos) = (PI * f64::from(ring) / f64::from(circles)).sin_cos();
        for step in 0..circles {
            let (east, south) = (TAU * f64::from(step) / f64::from(circles)).sin_cos();
            vertex(DVec3::new(sin * east, cos, sin * south));
        }
    }
    let south = vertex(DVec3::NEG_Y);
    let at = |ring: u32, step: u32| match ring {
        0 => north,
        ring if ring == circles => south,
        ring => north + 1 + (ring - 1) * circles + step % circles,
    };
    let mut triangles = Vec::new();
    for (ring, step) in (0..circles).flat_map(|ring| (0..circles).map(move |step| (ring, step))) {
        let [a, b, c, d] = [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)];
        triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && a != c));
    }
    Mesh::of(positions, &triangles)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::flatten::{flatten, start_media};
    use crate::scene::{Material, MaterialId, Model, Scene};

    /// Media at each point along x.
    fn media(mesh: Mesh, xs: [f64; 3]) -> [u32; 3] {
        let model = Model::of("it", mesh, MaterialId(0));
        let flat = flatten(&Scene::of(vec![Material::clear("ice", 1.31)], vec![model])).unwrap();
        assert_eq!(flat.warnings.len(), 0, "{:?}", flat.warnings);
        xs.map(|x| start_media(&flat.scene, [x, 0.01, 0.02]))
    }

    #[test]
    fn solids_are_closed_and_face_outwards() {
        let xs = [0.0, 0.85, 1.2];
        assert_eq!(media(cube(), xs), [1, 1, 0]);
        assert_eq!(media(sphere(50), xs), [1, 1, 0]);
        assert_eq!(media(jittered_sphere(50, &mut Random::new("jitter")), xs), [1, 1, 0]);
        assert_eq!(media(hollow_ice(50).0, xs), [0, 1, 0]);
    }
}
