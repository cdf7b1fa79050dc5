//! A goblet of wine with an ice cube and bubbles.

use glam::{DVec2, DVec3};

use crate::field::smooth_max;
use crate::mesh::Mesh;
use crate::noise::{Random, noise};
use crate::product::Product;
use crate::shapes::{around, icosphere, lathe, spline};
use crate::surface_nets::surface;

/// Steps around the axis.
const SIDES: usize = 80;
/// Height of the wine.
const LEVEL: f64 = 1.92;
/// How far the wine reaches into the glass, whose priority hides it; less than the wall's thickness.
const OVERLAP: f64 = 0.015;
/// Middle of the ice cube, which floats with a corner up.
const CUBE: DVec3 = DVec3::new(0.12, 1.83, 0.06);

/// The meshes of the scene.
pub(crate) fn products() -> Vec<Product> {
    vec![
        Product::solid("goblet/goblet.obj", "A goblet: bowl, stem and foot.", goblet),
        Product::solid("goblet/wine.obj", "Wine that reaches into the glass of the bowl.", wine),
        Product::solid("goblet/cube.obj", "A half melted ice cube, afloat.", cube),
        Product::solid(
            "goblet/bubbles.obj",
            "Bubbles of air on the glass, on the ice and in the wine.",
            bubbles,
        ),
    ]
}

/// The inside of the bowl from its lowest point on the axis to the rim: (radius, height).
const INSIDE: [[f64; 2]; 9] = [
    [0.0, 1.14],
    [0.16, 1.155],
    [0.34, 1.24],
    [0.50, 1.42],
    [0.575, 1.62],
    [0.585, 1.82],
    [0.55, 2.06],
    [0.495, 2.30],
    [0.455, 2.50],
];

/// From the rim over the outside of the bowl, stem and foot to the axis.
const OUTSIDE: [[f64; 2]; 17] = [
    [0.462, 2.516],
    [0.476, 2.505],
    [0.525, 2.30],
    [0.582, 2.06],
    [0.618, 1.82],
    [0.61, 1.61],
    [0.535, 1.39],
    [0.37, 1.19],
    [0.17, 1.05],
    [0.07, 0.94],
    [0.048, 0.74],
    [0.05, 0.36],
    [0.075, 0.17],
    [0.20, 0.085],
    [0.40, 0.05],
    [0.53, 0.022],
    [0.545, 0.004],
];

fn goblet() -> Mesh {
    let mut profile = spline(&INSIDE, 4);
    profile.extend(spline(&OUTSIDE, 3));
    profile.extend([DVec2::new(0.5, -0.004), DVec2::new(0.0, -0.004)]);
    lathe(&profile, SIDES)
}

fn wine() -> Mesh {
    let wall: Vec<DVec2> = outward(&spline(&INSIDE, 4)).into_iter().filter(|p| p.y < LEVEL).collect();
    let shore = wall.iter().fold(0.0_f64, |reach, p| if p.y > LEVEL - 0.08 { reach.max(p.x) } else { reach });
    let mut profile: Vec<DVec2> = (0..=8).map(|i| DVec2::new(shore * f64::from(i) / 8.0, LEVEL)).collect();
    profile.extend(wall.iter().rev());
    lathe(&profile, SIDES)
}

/// The inner wall, moved into the glass.
fn outward(wall: &[DVec2]) -> Vec<DVec2> {
    let moved = |i: usize| {
        let along = wall[(i + 1).min(wall.len() - 1)] - wall[i.saturating_sub(1)];
        let into_glass = DVec2::new(along.y, -along.x).normalize();
        if i == 0 { wall[0] - OVERLAP * DVec2::Y } else { wall[i] + OVERLAP * into_glass }
    };
    (0..wall.len()).map(moved).collect()
}

fn cube() -> Mesh {
    surface(&cube_field, CUBE - 0.52, CUBE + 0.52, 0.025)
}

fn cube_field(p: DVec3) -> f64 {
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.5, 0.4, 0.35);
    let q = (turn.inverse() * (p - CUBE)).abs() - DVec3::new(0.25, 0.24, 0.22);
    let sides = smooth_max(smooth_max(q.x, q.y, 0.14), q.z, 0.14);
    sides + 0.018 * noise(p * 5.0, 31)
}

/// On the ice, clinging to the glass, and rising.
fn bubbles() -> Mesh {
    let mut random = Random::new(12);
    let mut mesh = Mesh::default();
    let mut placed: Vec<(DVec3, f64)> = Vec::new();
    let wall = spline(&INSIDE, 4);
    for attempt in 0..4000 {
        let radius = random.within(0.009, 0.026);
        let turn = random.unit();
        let centre = match attempt % 3 {
            // Half in the glass.
            0 => {
                let foot = wall[(random.unit() * wall.len() as f64) as usize];
                around(foot.x, foot.y, turn)
            }
            // Rising.
            1 => around(random.within(0.0, 0.35), random.within(1.2, LEVEL), turn),
            // Half in the ice.
            _ => {
                let towards = random.point(DVec3::splat(-1.0), DVec3::splat(1.0)).normalize();
                (0..200)
                    .map(|i| CUBE + towards * (0.002 * f64::from(i)))
                    .find(|p| cube_field(*p) > -0.002)
                    .unwrap_or(CUBE)
            }
        };
        let apart = placed.iter().all(|(c, r)| c.distance(centre) > r + radius + 0.01);
        if apart && placed.len() < 48 && centre.y < LEVEL - 2.0 * radius && centre.y > 1.16 {
            placed.push((centre, radius));
            mesh.append(&icosphere(1).mapped(|p| centre + radius * p));
        }
    }
    mesh
}
