//! The scenes that growth is measured in: each asks for one thing only, in any amount.

use std::fmt::Write;
use std::path::Path;

use glam::DVec3;

use crate::scene::{Camera, Material, MaterialId, Mesh, Model, Scene, SceneError};

/// Hills of 2·`side`² triangles that fill the picture, under ambient light alone: primary rays, and every one hits. The
/// hills are the same for any number.
pub(super) fn terrain(side: u32) -> Scene {
    let lit = Material { ambient: DVec3::ONE, ..Material::black("ground") };
    let mut scene = Scene::of(vec![lit], vec![Model::of("ground", hills(side), MaterialId(0))]);
    scene.ambient = DVec3::splat(0.5);
    // Tilted by 15° from straight down, so that no ray is parallel to an axis.
    let forward = DVec3::new(0.0, -1.3, -0.35).normalize();
    scene.camera = Camera {
        eye: DVec3::new(0.0, 1.3, 0.35),
        right: DVec3::X,
        up: DVec3::X.cross(forward),
        forward,
        target_distance: 1.3,
        fov_y: 40.0,
    };
    scene
}

/// A grid over [−1, 1]² of sums of sines.
fn hills(side: u32) -> Mesh {
    let place = |i: u32| f64::from(i) / f64::from(side) * 2.0 - 1.0;
    let height = |x: f64, z: f64| {
        0.05 * (7.0 * x).sin() * (5.0 * z).cos()
            + 0.02 * (23.0 * x).sin() * (19.0 * z).sin()
            + 0.008 * (61.0 * x).cos() * (67.0 * z).sin()
    };
    let rows = 0..=side;
    let positions = rows.flat_map(|row| (0..=side).map(move |column| [place(column), place(row)]));
    let positions = positions.map(|[x, z]| DVec3::new(x, height(x, z), z)).collect();
    let corner = |row: u32, column: u32| row * (side + 1) + column;
    let cells = (0..side).flat_map(|row| (0..side).map(move |column| (row, column)));
    let triangles: Vec<[u32; 3]> = cells
        .flat_map(|(row, column)| {
            let [a, b] = [corner(row, column), corner(row, column + 1)];
            let [c, d] = [corner(row + 1, column), corner(row + 1, column + 1)];
            [[a, c, b], [b, c, d]]
        })
        .collect();
    Mesh::of(positions, &triangles)
}

/// A closed room of perfect mirrors, seen from within: a path ends at its greatest depth, and nowhere else.
pub(super) fn mirrors() -> Scene {
    let mirror = Material { reflection: DVec3::ONE, ..Material::black("mirror") };
    let room = Mesh::cuboid(DVec3::new(-3.0, -2.0, -4.0), DVec3::new(3.1, 2.2, 4.3));
    let mut scene = Scene::of(vec![mirror], vec![Model::of("room", room, MaterialId(0))]);
    scene.camera.eye = DVec3::new(0.1, 0.2, 1.0);
    scene.render.cutoff = 0.0;
    scene
}

/// A ball on a floor under so many lamps in a row.
pub(super) fn lamps(count: u32) -> Result<Scene, SceneError> {
    let mut text = STAGE.to_owned() + PAINT;
    for lamp in 0..count {
        let x = f64::from(lamp) / f64::from(count) * 6.0 - 3.0;
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "[[light]]\nposition = [{x:?}, 5.0, 2.0]\nintensity = {:?}\n",
            1.0 / f64::from(count)
        );
    }
    Scene::parse(Path::new("lamps"), &text)
}

/// A ball of glass on the floor under one lamp.
pub(super) fn glass() -> Result<Scene, SceneError> {
    Scene::parse(Path::new("glass"), &format!("{STAGE}{GLASS}[[light]]\nposition = [2.0, 5.0, 2.0]\n"))
}

/// A ball of the material `ball` on a floor.
const STAGE: &str = r##"
[camera]
eye = [2.0, 1.6, 4.0]
target = [0.0, 0.8, 0.0]

[background]
zenith = "#4060a0"
horizon = "#d8dde2"

[material.floor]
diffuse = { color = "#c0b090" }

[[model]]
shape = { sphere = { radius = 1.0 } }
material = "ball"
translate = [0, 1.01, 0]

[[model]]
shape = { plane = { size = [20, 20] } }
material = "floor"
"##;

const PAINT: &str = r##"
[material.ball]
diffuse = { color = "#c04030" }
"##;

const GLASS: &str = r#"
[material.ball]
specular = { k = 0.5, shininess = 200 }
reflection = 1.0
transmission = 1.0
fresnel = true
ior = 1.5
"#;
