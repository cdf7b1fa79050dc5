//! Office towers for a city at dusk: facades of recessed windows, some of them lit.

use std::fmt::Write as _;

use glam::{DVec2, DVec3};

use crate::mesh::Mesh;
use crate::noise::Random;
use crate::obj::{Part, text_with_materials};
use crate::product::{Make, Product};

/// The towers and their materials.
pub(crate) fn products() -> Vec<Product> {
    let text = |path, make| Product { path, make: Make::Text(make) };
    vec![
        text("city/slab.obj", || tower("slab", 1, &[tier(2.0, 1.0, 8)])),
        text("city/block.obj", || tower("block", 2, &[tier(1.75, 1.75, 5), tier(1.0, 1.25, 2)])),
        text("city/tower.obj", || tower("tower", 3, &[tier(1.5, 1.5, 3), tier(1.0, 1.0, 15)])),
        text("city/stepped.obj", || {
            tower(
                "stepped",
                4,
                &[tier(1.75, 1.75, 6), tier(1.25, 1.25, 6), tier(0.75, 0.75, 6), tier(0.25, 0.25, 3)],
            )
        }),
        text("city/terrace.obj", || {
            tower("terrace", 5, &[tier(2.0, 1.75, 3), tier(1.5, 1.5, 2), tier(0.75, 1.0, 2)])
        }),
        text("city/needle.obj", || {
            tower("needle", 6, &[tier(1.25, 1.25, 12), tier(1.0, 1.0, 10), tier(0.5, 0.5, 4)])
        }),
        text("city/towers.mtl", materials),
    ]
}

/// Width of a bay and height of a storey.
const BAY: f64 = 0.25;
const STOREY: f64 = 0.28;

/// Stone, glass that mirrors the sky, and two kinds of lit rooms. The scene's ambient light makes Ka of a
/// lit room its brightness.
fn materials() -> String {
    let mut out = String::from("# Materials of the towers: stone, Fresnel glass, lit windows.\n");
    for (name, ka, kd, rest) in [
        ("stone", "0.34 0.33 0.36", "0.34 0.31 0.29", "illum 1"),
        ("roof", "0.16 0.16 0.18", "0.12 0.12 0.13", "illum 1"),
        ("glass", "0.05 0.06 0.09", "0.02 0.02 0.03", "Ks 1 1 1\nNs 200\nNi 1.9\nillum 5"),
        ("warm", "22 9.5 2.2", "0.1 0.1 0.1", "illum 1"),
        ("cool", "9 10 9", "0.1 0.1 0.1", "illum 1"),
    ] {
        let _ = write!(out, "\nnewmtl {name}\nKa {ka}\nKd {kd}\n{rest}\n");
    }
    out
}

/// A storey block: width and depth in whole bays, number of storeys.
#[derive(Clone, Copy)]
struct Tier {
    half: DVec2,
    storeys: u32,
}

const fn tier(width: f64, depth: f64, storeys: u32) -> Tier {
    Tier { half: DVec2::new(width / 2.0, depth / 2.0), storeys }
}

/// The surfaces of a building, by material.
#[derive(Default)]
struct Building {
    stone: Mesh,
    roof: Mesh,
    glass: Mesh,
    warm: Mesh,
    cool: Mesh,
}

fn tower(name: &str, seed: u32, tiers: &[Tier]) -> String {
    let mut building = Building::default();
    let mut random = Random::new(seed);
    let mut base = 0.0;
    for tier in tiers {
        building.tier(*tier, base, &mut random);
        base += f64::from(tier.storeys) * STOREY + PARAPET;
    }
    let parts = [
        Part { name: "stone", mesh: &building.stone, smooth: false },
        Part { name: "roof", mesh: &building.roof, smooth: false },
        Part { name: "glass", mesh: &building.glass, smooth: false },
        Part { name: "warm", mesh: &building.warm, smooth: false },
        Part { name: "cool", mesh: &building.cool, smooth: false },
    ];
    text_with_materials(&format!("A building: {name}."), "towers.mtl", &parts)
}

/// Height of the wall above the top storey.
const PARAPET: f64 = 0.08;

impl Building {
    fn tier(&mut self, Tier { half, storeys }: Tier, base: f64, random: &mut Random) {
        let top = base + f64::from(storeys) * STOREY;
        for (normal, across, wide) in [
            (DVec3::Z, half.y, half.x),
            (DVec3::NEG_Z, half.y, half.x),
            (DVec3::X, half.x, half.y),
            (DVec3::NEG_X, half.x, half.y),
        ] {
            let wall = Wall { origin: normal * across, right: DVec3::Y.cross(normal), normal };
            let bays = (2.0 * wide / BAY).round() as u32;
            for storey in 0..storeys {
                for bay in 0..bays {
                    let low = DVec2::new(f64::from(bay) * BAY - wide, base + f64::from(storey) * STOREY);
                    self.window(&wall, low, random);
                }
            }
            let parapet = [(-wide, top), (wide, top), (wide, top + PARAPET), (-wide, top + PARAPET)];
            face(&mut self.stone, parapet.map(|(x, y)| wall.at(DVec2::new(x, y), 0.0)));
        }
        let height = DVec3::Y * (top + PARAPET);
        let corner = |x: f64, z: f64| DVec3::new(x * half.x, 0.0, z * half.y) + height;
        face(&mut self.roof, [corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)]);
    }

    /// One bay of one storey: a frame, the reveal and the pane behind it.
    fn window(&mut self, wall: &Wall, low: DVec2, random: &mut Random) {
        const DEPTH: f64 = -0.035;
        let ring = |inset: DVec2, depth: f64| {
            let (lo, hi) = (low + inset, low + DVec2::new(BAY, STOREY) - inset);
            [lo, DVec2::new(hi.x, lo.y), hi, DVec2::new(lo.x, hi.y)].map(|p| wall.at(p, depth))
        };
        let inset = DVec2::new(0.04, 0.06);
        let [outer, inner, pane] = [ring(DVec2::ZERO, 0.0), ring(inset, 0.0), ring(inset, DEPTH)];
        let rings = [outer, inner, pane].map(|ring| ring.map(|p| self.stone.vertex(p)));
        for i in 0..4 {
            let j = (i + 1) % 4;
            for [near, far] in [[rings[0], rings[1]], [rings[1], rings[2]]] {
                self.stone.quad([near[i], near[j], far[j], far[i]]);
            }
        }
        let light = random.unit();
        face(
            if light < 0.22 {
                &mut self.warm
            } else if light < 0.29 {
                &mut self.cool
            } else {
                &mut self.glass
            },
            pane,
        );
    }
}

/// A vertical plane.
struct Wall {
    origin: DVec3,
    right: DVec3,
    normal: DVec3,
}

impl Wall {
    fn at(&self, p: DVec2, depth: f64) -> DVec3 {
        self.origin + self.right * p.x + DVec3::Y * p.y + self.normal * depth
    }
}

/// A quadrilateral with corners of its own.
fn face(mesh: &mut Mesh, corners: [DVec3; 4]) {
    let indices = corners.map(|p| mesh.vertex(p));
    mesh.quad(indices);
}
