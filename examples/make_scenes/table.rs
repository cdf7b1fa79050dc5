//! A table of weathered oak boards.

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

use crate::field::smoothstep;
use crate::mesh::Mesh;
use crate::noise::{Random, tiled_noise};
use crate::product::{Make, Product};

/// Scene units that one copy of the texture covers.
const TILE: f64 = 4.0;
/// Turn of the boards against the table's depth, in degrees.
const BOARDS_TURN: f64 = 22.0;
/// Boards across one copy.
const BOARDS: i64 = 5;
/// Pixels along one side of the texture.
const PIXELS: u32 = 1024;

/// The table and its texture.
pub(crate) fn products() -> Vec<Product> {
    vec![
        Product { path: "textures/oak.png", make: Make::Png(oak) },
        Product::solid("ice/table.obj", "The table top: 28 × 0.4 × 12 units, its surface at y = 0.", top),
    ]
}

/// A slab with a bevelled rim: its outline along z, in cells of a unit so that hits on it are exact, run along x.
fn top() -> Mesh {
    const HALF: i32 = 14;
    const BEVEL: f64 = 0.03;
    let (front, back, low) = (6, -6, -0.4);
    let mut outline = vec![DVec2::new(f64::from(back), low), DVec2::new(f64::from(front), low)];
    outline.push(DVec2::new(f64::from(front), -BEVEL));
    outline.push(DVec2::new(f64::from(front) - BEVEL, 0.0));
    outline.extend((back + 1..front).rev().map(|z| DVec2::new(f64::from(z), 0.0)));
    outline.push(DVec2::new(f64::from(back) + BEVEL, 0.0));
    outline.push(DVec2::new(f64::from(back), -BEVEL));
    let mut mesh = Mesh::default();
    for x in -HALF..=HALF {
        outline.iter().for_each(|p| mesh.positions.push(DVec3::new(f64::from(x), p.y, p.x)));
    }
    let n = outline.len() as u32;
    for strip in (0..2 * HALF as u32).map(|i| i * n) {
        for i in 0..n {
            let j = (i + 1) % n;
            mesh.quad([strip + i, strip + n + i, strip + n + j, strip + j]);
        }
    }
    for i in 1..n - 1 {
        let last = 2 * HALF as u32 * n;
        mesh.triangles.extend([[0, i, i + 1], [last, last + i + 1, last + i]]);
    }
    let grain = DVec2::from_angle(BOARDS_TURN.to_radians());
    mesh.uvs = mesh.positions.iter().map(|p| grain.rotate(DVec2::new(p.x, -p.z)) / TILE).collect();
    mesh
}

/// Boards side by side along u, grain along v; repeats both ways.
fn oak() -> RgbImage {
    RgbImage::from_fn(PIXELS, PIXELS, |x, y| {
        let uv = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / f64::from(PIXELS);
        Rgb(wood(uv).to_array().map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8))
    })
}

/// sRGB of the wood at texture coordinates in [0, 1).
fn wood(uv: DVec2) -> DVec3 {
    let across = uv.x * BOARDS as f64;
    let board = across.floor();
    let mut random = Random::new(board as u32 + 40);
    let [tone, shift, knot] = [random.unit(), random.unit(), random.unit()];
    let f = across - board;
    // Grain: rings cut lengthwise, bent by slow noise, around a heart that wanders along the board.
    let along = |stretch: f64, seed: u32| {
        let period = [BOARDS * 64, stretch as i64, 1 << 20];
        tiled_noise(DVec3::new(across * 1.0 + 17.0 * shift, uv.y * stretch, 0.5), period, seed + board as u32)
    };
    let heart = 0.5 + 0.35 * (knot - 0.5) + 0.16 * along(3.0, 11);
    let rings = ((f - heart).powi(2) + 0.012 * (1.0 + along(4.0, 5))).sqrt() * 30.0 + 0.25 * along(7.0, 3);
    let ring = rings - rings.floor();
    let late = smoothstep(0.1, 0.8, ring) * (1.0 - smoothstep(0.8, 1.0, ring));
    // Pores: short dark dashes along the grain.
    let fine = |width: f64, stretch: f64, seed: u32| {
        let period = [(BOARDS as f64 * width) as i64, stretch as i64, 1 << 20];
        tiled_noise(DVec3::new(across * width, uv.y * stretch, 0.25), period, seed)
    };
    let pores = smoothstep(0.35, 0.8, fine(34.0, 24.0, 21)) * 0.35
        + smoothstep(0.0, 1.0, fine(60.0, 12.0, 22)) * 0.18;
    let light = DVec3::new(0.53, 0.475, 0.43);
    let dark = DVec3::new(0.23, 0.195, 0.17);
    let colour = light.lerp(dark, 0.3 + 0.1 * late + 0.16 * fine(6.0, 5.0, 23) + 0.1 * fine(14.0, 3.0, 24));
    let seam = smoothstep(0.006, 0.016, f.min(1.0 - f));
    colour * (0.72 + 0.42 * tone) * (1.0 - 0.75 * pores) * (0.4 + 0.6 * seam)
}
