//! Glass prisms and the chart that is seen through them.

use glam::DVec2;
use image::{Rgb, RgbImage};

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
    const HUES: [[u8; 3]; 8] = [
        [196, 40, 52],
        [222, 108, 34],
        [236, 186, 48],
        [120, 170, 60],
        [40, 146, 124],
        [38, 120, 190],
        [72, 70, 170],
        [136, 56, 148],
    ];
    RgbImage::from_fn(PIXELS, PIXELS, |x, y| {
        let p = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / f64::from(PIXELS) * FIELDS;
        let f = p - p.floor();
        let edge = f.min(1.0 - f).min_element() < 0.03;
        // An arrowhead that points up over a stem.
        let from_middle = (f.x - 0.5).abs();
        let head = f.y > 0.2 && f.y < 0.52 && from_middle < 0.8 * (f.y - 0.2);
        let stem = f.y >= 0.52 && f.y < 0.8 && from_middle < 0.09;
        Rgb(if edge {
            [30, 32, 38]
        } else if head || stem {
            [244, 242, 234]
        } else {
            HUES[p.x as usize % HUES.len()]
        })
    })
}
