//! What cases put in front of the camera.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::scene::{Background, Camera, Material, MaterialId, Mesh, Model, Normals, RenderDefaults};

/// White light straight from above, none from the horizon and below.
pub(super) const LIGHT_ABOVE: Background = Background::Gradient { zenith: DVec3::ONE, horizon: DVec3::ZERO };
/// White light from everywhere.
pub(super) const WHITE: Background = Background::Color(DVec3::ONE);

/// One sample a pixel of a square picture, to a depth and a cut-off.
pub(super) fn square(pixels: u32, depth: u32, cutoff: f64) -> RenderDefaults {
    RenderDefaults { size: [pixels; 2], depth, cutoff, samples: 1, adaptive: None }
}

/// A camera at a place that looks at another, `fov_y` degrees high; which side is up does not matter.
pub(super) fn camera(eye: DVec3, target: DVec3, fov_y: f64) -> Camera {
    let forward = (target - eye).normalize();
    let (up, right) = forward.any_orthonormal_pair();
    Camera { eye, right, up, forward, target_distance: eye.distance(target), fov_y }
}

/// A body of the material of that index; the lower `rank` wins where bodies overlap.
pub(super) fn body(mesh: Mesh, material: usize, rank: i32) -> Model {
    Model { priority: -rank, ..Model::of("body", mesh, MaterialId(material)) }
}

/// The same with the normals of its mesh.
pub(super) fn smooth_body(mesh: Mesh, material: usize, rank: i32) -> Model {
    Model { normals: Normals::File, ..body(mesh, material, rank) }
}

/// A perfect mirror.
pub(super) fn mirror() -> Material {
    Material { reflection: DVec3::ONE, ..Material::black("mirror") }
}

/// A box around the origin.
pub(super) fn centred(size: DVec3) -> Mesh {
    Mesh::cuboid(-size / 2.0, size / 2.0)
}

/// A cube around the origin.
pub(super) fn cube(size: f64) -> Mesh {
    centred(DVec3::splat(size))
}

/// Two triangles over four corners.
pub(super) fn quad(corners: [DVec3; 4]) -> Mesh {
    Mesh::of(corners.to_vec(), &[[0, 1, 2], [0, 2, 3]])
}

/// The solid over a convex outline in the plane z = 0, counter-clockwise seen from +z, from −`half` to `half`.
pub(super) fn extruded(outline: &[DVec2], half: f64) -> Mesh {
    let count = outline.len() as u32;
    let middle = outline.iter().sum::<DVec2>() / f64::from(count);
    // 2k and 2k + 1 are the lower and upper end of edge k; the last two are the middles.
    let ends = outline.iter().chain([&middle]).flat_map(|p| [p.extend(-half), p.extend(half)]);
    let mut triangles = Vec::new();
    for k in 0..count {
        let (low, high) = (2 * k, 2 * k + 1);
        let (next_low, next_high) = (2 * ((k + 1) % count), 2 * ((k + 1) % count) + 1);
        triangles.extend([
            [low, next_low, next_high],
            [low, next_high, high],
            [2 * count, next_low, low],
            [2 * count + 1, high, next_high],
        ]);
    }
    Mesh::of(ends.collect(), &triangles)
}

/// A rod along z of radius 1, with the normals of a round one.
pub(super) fn rod(sides: u32, half: f64) -> Mesh {
    let around = |k: u32| DVec2::from_angle(TAU * f64::from(k) / f64::from(sides));
    let outline: Vec<DVec2> = (0..sides).map(around).collect();
    let mut mesh = extruded(&outline, half);
    mesh.normals = outline.iter().map(|normal| normal.extend(0.0)).collect();
    for triangle in &mut mesh.triangles {
        // The caps stay flat: they touch a middle.
        if triangle.positions.iter().all(|&position| position < 2 * sides) {
            triangle.normals = triangle.positions.map(|position| position / 2);
        }
    }
    mesh
}

/// How much nearer to its axis than 1 a rod's faces are in their middle.
pub(super) fn flatness(sides: u32) -> f64 {
    1.0 - (TAU / (2.0 * f64::from(sides))).cos()
}

/// A mesh around the origin with the normals of a sphere.
pub(super) fn round(mut mesh: Mesh) -> Mesh {
    mesh.normals = mesh.positions.iter().map(|position| position.normalize()).collect();
    for triangle in &mut mesh.triangles {
        triangle.normals = triangle.positions;
    }
    mesh
}
