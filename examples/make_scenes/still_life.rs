//! A bare OBJ with an MTL: a board with a pear, an apple, a pewter cup and a glass ball.

use glam::{DVec2, DVec3};

use crate::mesh::Mesh;
use crate::noise::noise;
use crate::obj::{Part, rounded, text_with_materials};
use crate::product::{Make, Product};
use crate::shapes::{icosphere, lathe, prism, spline};

/// The OBJ and its MTL.
pub(crate) fn products() -> Vec<Product> {
    vec![
        Product { path: "still_life.obj", make: Make::Text(still_life) },
        Product { path: "still_life.mtl", make: Make::Text(materials) },
    ]
}

fn still_life() -> String {
    let bodies = [
        ("board", board()),
        ("pear", pear().mapped(|p| DVec3::new(p.x - 0.75, p.y, p.z - 0.25))),
        ("apple", apple().mapped(|p| DVec3::new(p.x + 0.05, p.y, p.z - 0.55))),
        ("pewter", cup().mapped(|p| DVec3::new(p.x + 0.95, p.y, p.z - 0.15))),
        ("glass", icosphere(4).mapped(|p| 0.34 * p + DVec3::new(0.18, 0.338, 0.5))),
    ]
    .map(|(name, mesh)| (name, rounded(&mesh)));
    let parts = bodies.each_ref().map(|(name, mesh)| Part { name, mesh, smooth: *name != "board" });
    text_with_materials(
        "A still life; every object is in the material of its name.",
        "still_life.mtl",
        &parts,
    )
}

fn materials() -> String {
    "# Materials of the still life.
newmtl board
Ka 0.5 0.42 0.34
Kd 1 0.85 0.7
map_Kd textures/oak.png
illum 1

newmtl pear
Ka 0.12 0.13 0.03
Kd 0.55 0.56 0.12
Ks 0.25 0.25 0.25
Ns 30
illum 2

newmtl apple
Ka 0.13 0.02 0.02
Kd 0.55 0.06 0.05
Ks 0.5 0.5 0.5
Ns 90
illum 2

newmtl pewter
Ka 0.02 0.02 0.02
Kd 0.10 0.10 0.11
Ks 0.62 0.62 0.65
Ns 120
illum 3

newmtl glass
Ka 0 0 0
Kd 0 0 0
Ks 1 1 1
Ns 400
Ni 1.52
Tf 0.96 0.99 0.97
illum 7
"
    .to_owned()
}

/// A board whose top is at y = 0.
fn board() -> Mesh {
    let outline = [(-1.5, -0.16), (1.5, -0.16), (1.5, -0.02), (1.48, 0.0), (-1.48, 0.0), (-1.5, -0.02)];
    let mut mesh = prism(&outline.map(|(x, y)| DVec2::new(x, y)), 2.0);
    mesh.uvs = mesh.positions.iter().map(|p| DVec2::new(p.z, p.x) / 3.0).collect();
    mesh
}

fn pear() -> Mesh {
    let profile = [
        [0.0, 1.02],
        [0.12, 1.0],
        [0.2, 0.9],
        [0.25, 0.74],
        [0.34, 0.56],
        [0.42, 0.36],
        [0.38, 0.15],
        [0.22, 0.03],
        [0.0, 0.04],
    ];
    lathe(&spline(&profile, 2), 36)
        .mapped(|p| p + DVec3::new(0.05 * p.y * p.y, 0.0, 0.012 * noise(p * 3.0, 81)))
}

fn apple() -> Mesh {
    let profile = [
        [0.0, 0.62],
        [0.06, 0.67],
        [0.16, 0.74],
        [0.3, 0.72],
        [0.42, 0.55],
        [0.42, 0.34],
        [0.34, 0.12],
        [0.2, 0.01],
        [0.08, 0.03],
        [0.0, 0.08],
    ];
    lathe(&spline(&profile, 2), 36)
}

/// Hollow and open at the top.
fn cup() -> Mesh {
    let profile = [
        [0.0, 0.1],
        [0.24, 0.12],
        [0.33, 0.3],
        [0.35, 0.6],
        [0.38, 0.86],
        [0.40, 0.88],
        [0.42, 0.86],
        [0.39, 0.6],
        [0.37, 0.3],
        [0.3, 0.1],
        [0.32, 0.02],
        [0.3, 0.0],
        [0.0, 0.0],
    ];
    lathe(&spline(&profile, 2), 44)
}
