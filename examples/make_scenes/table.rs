//! A table of weathered oak boards.

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

use crate::field::smoothstep;
use crate::mesh::Mesh;
use crate::noise::{Random, tiled_noise};
use crate::product::{Make, Product};
use crate::shapes::prism;

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
        Product::solid("ice/table.obj", "The table top: 28 × 0.4 × 13.5 units, its surface at y = 0.", top),
    ]
}

/// A slab with a bevelled rim.
fn top() -> Mesh {
    let (half, low) = (12.0, -0.4);
    let bevel = 0.03;
    let outline =
        [(-5.5, low), (5.5, low), (5.5, -bevel), (5.5 - bevel, 0.0), (bevel - 5.5, 0.0), (-5.5, -bevel)];
    let outline = outline.map(|(z, y)| DVec2::new(z, y));
    // The prism runs along z; turn it about y so that it runs along x.
    let mut mesh = prism(&outline, 2.0 * half).mapped(|p| DVec3::new(p.z, p.y, -p.x));
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
    let light = DVec3::new(0.55, 0.49, 0.44);
    let dark = DVec3::new(0.27, 0.235, 0.21);
    let colour = light.lerp(dark, 0.3 + 0.2 * late + 0.12 * fine(6.0, 5.0, 23));
    let seam = smoothstep(0.006, 0.016, f.min(1.0 - f));
    colour * (0.72 + 0.42 * tone) * (1.0 - 0.75 * pores) * (0.4 + 0.6 * seam)
}
