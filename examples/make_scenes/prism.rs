//! Glass prisms and the chart that is seen through them.

use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

use crate::field::smoothstep;
use crate::mesh::Mesh;
use crate::product::{Make, Product};
use crate::shapes;

/// The meshes and the chart of the scene.
pub(crate) fn products() -> Vec<Product> {
    vec![
        Product::solid(
            "prism/right_angle.obj",
            "A 90° prism: its legs are 1, its axis is z, its long face is down.",
            right,
        ),
        Product::solid(
            "prism/equilateral.obj",
            "A 60° prism: its sides are 1, its axis is z, a face is down.",
            equal,
        ),
        Product { path: "textures/chart.png", make: Make::Png(chart) },
    ]
}

fn right() -> Mesh {
    let half = 0.5_f64.sqrt();
    shapes::prism(&[DVec2::new(-half, 0.0), DVec2::new(half, 0.0), DVec2::new(0.0, half)], 1.5)
}

fn equal() -> Mesh {
    let height = 0.75_f64.sqrt();
    shapes::prism(&[DVec2::new(-0.5, 0.0), DVec2::new(0.5, 0.0), DVec2::new(0.0, height)], 1.5)
}

/// Eight columns of a rainbow over eight rows: columns tell left from right, an arrow in each field up from down.
fn chart() -> RgbImage {
    const PIXELS: u32 = 512;
    const FIELDS: f64 = 8.0;
    const SOFT: f64 = 2.0 * FIELDS / PIXELS as f64;
    const HUES: [[f64; 3]; 8] = [
        [196.0, 40.0, 52.0],
        [222.0, 108.0, 34.0],
        [236.0, 186.0, 48.0],
        [120.0, 170.0, 60.0],
        [40.0, 146.0, 124.0],
        [38.0, 120.0, 190.0],
        [72.0, 70.0, 170.0],
        [136.0, 56.0, 148.0],
    ];
    RgbImage::from_fn(PIXELS, PIXELS, |x, y| {
        let p = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / f64::from(PIXELS) * FIELDS;
        let f = p - p.floor();
        // Distances outwards, in fields: from an arrowhead that points up, from its stem, from the field's frame.
        let from_middle = (f.x - 0.5).abs();
        let head = (0.78 * (from_middle - 0.8 * (f.y - 0.2))).max(f.y - 0.52);
        let stem = (from_middle - 0.09).max(0.5 - f.y).max(f.y - 0.8);
        let frame = f.min(1.0 - f).min_element() - 0.03;
        // Edges are soft over four pixels, so that a texture coordinate's last bit stays invisible.
        let cover = |distance: f64| 1.0 - smoothstep(-SOFT, SOFT, distance);
        let colour = DVec3::from_array(HUES[p.x as usize % HUES.len()])
            .lerp(DVec3::new(244.0, 242.0, 234.0), cover(head.min(stem)))
            .lerp(DVec3::new(30.0, 32.0, 38.0), cover(frame));
        Rgb(colour.to_array().map(|c| c.round() as u8))
    })
}
