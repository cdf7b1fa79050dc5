//! The photographer's studio around the ice: a tall window with cross bars, soft boxes, a dark backdrop.

use glam::{DVec2, DVec3};
use image::Rgb32FImage;

use crate::field::smoothstep;
use crate::panorama::{Panel, render, towards};
use crate::product::{Make, Product};

/// The environments made here.
pub(crate) fn products() -> Vec<Product> {
    vec![
        Product { path: "environments/studio.hdr", make: Make::Hdr(studio) },
        Product { path: "environments/bright_field.hdr", make: Make::Hdr(bright_field) },
        Product { path: "environments/dusk.hdr", make: Make::Hdr(dusk) },
    ]
}

fn studio() -> Rgb32FImage {
    render(1024, radiance)
}

/// How glass is photographed: one bright panel behind, black to both sides that draws the outlines dark.
fn bright_field() -> Rgb32FImage {
    let back = Panel {
        centre: 3.0 * towards(0.0, 8.0),
        half: DVec2::new(2.6, 2.4),
        softness: 1.6,
        radiance: DVec3::new(1.02, 1.0, 0.95),
    };
    let side = Panel {
        centre: 3.0 * towards(-108.0, 26.0),
        half: DVec2::new(0.7, 1.5),
        softness: 0.08,
        radiance: DVec3::new(4.6, 4.8, 5.2),
    };
    let dark = DVec3::new(0.022, 0.021, 0.024);
    render(512, |d| dark + back.light(d) + side.light(d) * panes(&side, d))
}

/// The sky half an hour after sunset towards −Z.
fn dusk() -> Rgb32FImage {
    render(512, |d| {
        let elevation = d.y.asin().to_degrees();
        let towards_sun = 0.5 - 0.5 * d.z;
        let glow = DVec3::new(1.05, 0.42, 0.15).lerp(DVec3::new(0.42, 0.24, 0.28), 1.0 - towards_sun.powi(2));
        let low = glow.lerp(DVec3::new(0.26, 0.27, 0.42), smoothstep(0.0, 14.0, elevation));
        let high = low.lerp(DVec3::new(0.035, 0.06, 0.17), smoothstep(6.0, 48.0, elevation));
        high * (0.25 + 0.75 * smoothstep(-8.0, 0.0, elevation))
    })
}

fn radiance(d: DVec3) -> DVec3 {
    let windows = [
        // Key: daylight behind and to the left.
        Panel {
            centre: 3.0 * towards(-62.0, 28.0),
            half: DVec2::new(1.15, 1.5),
            softness: 0.03,
            radiance: DVec3::new(5.4, 6.2, 7.0),
        },
        // Its neighbour, low behind the camera: the wet front mirrors it.
        Panel {
            centre: 3.0 * towards(-164.0, 15.0),
            half: DVec2::new(0.95, 0.8),
            softness: 0.03,
            radiance: DVec3::new(11.0, 12.4, 13.6),
        },
    ];
    let boxes = [
        // Rim: a tall narrow box behind and to the right.
        Panel {
            centre: 3.0 * towards(46.0, 26.0),
            half: DVec2::new(0.38, 1.6),
            softness: 0.2,
            radiance: DVec3::new(6.4, 6.0, 5.4),
        },
        // Back: a scrim above the picture's frame, mirrored by the wet table.
        Panel {
            centre: 3.0 * towards(-8.0, 30.0),
            half: DVec2::new(0.95, 0.75),
            softness: 0.4,
            radiance: DVec3::new(2.3, 2.7, 3.1),
        },
        // Fill: a large dim box in front, to the right.
        Panel {
            centre: 3.0 * towards(112.0, 28.0),
            half: DVec2::new(1.2, 1.0),
            softness: 0.5,
            radiance: DVec3::new(2.2, 2.0, 1.8),
        },
    ];
    let daylight: DVec3 = windows.iter().map(|w| w.light(d) * panes(w, d)).sum();
    backdrop(d) + daylight + boxes.iter().map(|b| b.light(d)).sum::<DVec3>()
}

/// Two by three panes: 0 on the bars, brighter towards the sky.
fn panes(window: &Panel, d: DVec3) -> f64 {
    let Some(p) = window.at(d) else { return 0.0 };
    let panes = DVec2::new(2.0, 3.0);
    let q = (p / window.half + 1.0) / 2.0 * panes;
    let from_bar = (q - q.round()).abs() / panes * 2.0 * window.half;
    smoothstep(0.035, 0.065, from_bar.min_element()) * (0.55 + 0.45 * smoothstep(-1.0, 1.0, p.y))
}

/// A dim room: a cool glow behind the subject, lamps far out of focus, a dark warm floor.
fn backdrop(d: DVec3) -> DVec3 {
    let wall = DVec3::new(0.02, 0.025, 0.035).lerp(DVec3::new(0.07, 0.085, 0.11), smoothstep(-0.2, 0.9, d.y));
    let floor = DVec3::new(0.03, 0.024, 0.018);
    let base = floor.lerp(wall, smoothstep(-0.3, -0.05, d.y));
    let from_subject = d.angle_between(towards(-12.0, -8.0)).to_degrees();
    let glow = (1.0 - smoothstep(0.0, 30.0, from_subject)).powf(1.6);
    base + glow * DVec3::new(0.15, 0.21, 0.26) + lamps(d)
}

/// Discs of light, their edges soft over two pixels: azimuth, elevation and radius in degrees, and radiance.
const LAMPS: [([f64; 3], [f64; 3]); 9] = [
    ([-27.0, -7.2, 1.3], [0.50, 0.29, 0.11]),
    ([-24.4, -6.0, 1.1], [0.30, 0.19, 0.08]),
    ([-22.6, -8.0, 1.2], [0.20, 0.12, 0.05]),
    ([-18.6, -5.4, 1.2], [0.34, 0.20, 0.08]),
    ([1.2, -6.4, 1.3], [0.42, 0.25, 0.10]),
    ([4.0, -8.2, 1.1], [0.22, 0.13, 0.05]),
    ([6.2, -5.8, 1.3], [0.52, 0.29, 0.10]),
    ([9.6, -7.4, 1.2], [0.26, 0.17, 0.08]),
    ([12.0, -5.6, 1.2], [0.38, 0.21, 0.08]),
];

fn lamps(d: DVec3) -> DVec3 {
    let disc = |&([azimuth, elevation, radius], radiance): &([f64; 3], [f64; 3])| {
        let angle = d.angle_between(towards(azimuth, elevation)).to_degrees();
        DVec3::from_array(radiance) * (1.0 - smoothstep(radius - 0.45, radius + 0.45, angle))
    };
    LAMPS.iter().map(disc).sum()
}
