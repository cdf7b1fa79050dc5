//! The flagship's piece of ice: a hand-cut block, half melted, with a cavity, bubbles, cracks and a drink inside.

use glam::{DQuat, DVec2, DVec3};

use crate::field::{Field, half_space, smooth_max, smoothstep};
use crate::mesh::Mesh;
use crate::noise::{Random, hollows, noise};
use crate::product::Product;
use crate::shapes::{around, between_poles, icosphere};
use crate::surface_nets::surface;

/// Height of the drink.
const LEVEL: f64 = 0.98;
/// How far the drink reaches into the wall of the cavity, where the ice's priority hides it.
const OVERLAP: f64 = 0.07;
/// Middle of the cavity.
const CAVITY: DVec3 = DVec3::new(0.02, 0.97, 0.0);

/// The meshes of the scene.
pub(crate) fn products() -> Vec<Product> {
    vec![
        Product::solid(
            "ice/ice.obj",
            "A piece of ice: its outside, its cavity, bubbles and cracks as shells of one solid.",
            ice,
        ),
        Product::solid(
            "ice/liquid.obj",
            "The drink in the cavity; it reaches into the ice, which hides its sides.",
            liquid,
        ),
        Product::solid(
            "ice/puddle.obj",
            "Melt water around the foot and drops; it reaches into the table, which hides its bottom.",
            puddle,
        ),
    ]
}

fn ice() -> Mesh {
    let mut mesh = surface(&block, DVec3::new(-1.4, -0.2, -1.3), DVec3::new(1.4, 2.3, 1.3), 0.036);
    mesh.append(&surface(&cavity, CAVITY - 0.95, CAVITY + 0.95, 0.03).inverted());
    for bubble in bubbles() {
        mesh.append(&bubble.inverted());
    }
    for crack in cracks() {
        mesh.append(&crack.inverted());
    }
    mesh
}

/// Planes of the saw and the chisel: normal, distance from the middle of the block.
const CUTS: [([f64; 3], f64); 11] = [
    ([1.0, 0.03, 0.10], 1.00),
    ([-1.0, 0.08, 0.02], 0.98),
    ([0.05, 1.0, 0.04], 0.93),
    ([0.10, 0.04, 1.0], 0.86),
    ([-0.08, 0.05, -1.0], 0.84),
    ([0.9, 0.35, 0.8], 1.09),
    ([-0.8, 0.75, 0.5], 1.05),
    ([0.75, 0.9, 0.1], 1.12),
    ([-0.9, -0.3, 0.8], 1.14),
    ([0.5, -0.8, 0.7], 1.22),
    ([-0.6, 0.2, -0.9], 1.15),
];

/// The outside of the block, standing in a film of water just below the table's surface.
fn block(p: DVec3) -> f64 {
    let centred = p - DVec3::new(0.0, 0.93, 0.0);
    let cut = CUTS.iter().fold(f64::MIN, |field, &(normal, distance)| {
        smooth_max(field, half_space(centred, DVec3::from_array(normal), distance), 0.18)
    });
    let free = smoothstep(-0.02, 0.25, p.y);
    smooth_max(cut + free * melt(p), -0.02 - p.y, 0.12)
}

/// What the chisel and the thaw leave: shallow hollows with soft ridges, over broad waves.
fn melt(p: DVec3) -> f64 {
    0.045 * noise(p * 1.5, 1) - 0.13 * (hollows(p * DVec3::new(2.5, 2.1, 2.5), 10.0, 6) - 0.2)
}

/// The hollow: a rounded box with a wavy wall.
fn cavity(p: DVec3) -> f64 {
    let q = (p - CAVITY) / DVec3::new(0.60, 0.56, 0.50);
    let superellipsoid = (q.abs().powf(3.0).element_sum().powf(1.0 / 3.0) - 1.0) * 0.5;
    superellipsoid + 0.035 * noise(p * 2.3, 3) + 0.008 * noise(p * 6.0, 4)
}

/// Whether a sphere lies in the ice with room to spare.
fn inside_ice(centre: DVec3, radius: f64) -> bool {
    block(centre) < -radius - 0.03 && cavity(centre) > radius + 0.03 + OVERLAP && centre.y > radius + 0.03
}

/// Air caught while the block froze: needles that point at the core, where the last water froze, and beads.
fn bubbles() -> Vec<Mesh> {
    let mut placed = Vec::new();
    let mut meshes = Vec::new();
    let mut random = Random::new(5);
    for _ in 0..6000 {
        let size = random.within(0.02, 0.045);
        let bead =
            Bubble { centre: random.point(LO, HI), half: DVec3::new(size, 1.3 * size, size), axis: DVec3::Y };
        if meshes.len() < 16 && bead.fits(&mut placed) {
            meshes.push(bead.mesh(2));
        }
    }
    for _ in 0..30_000 {
        let centre = random.point(LO, HI);
        let spoke = centre - CORE;
        let thick = random.within(0.004, 0.009);
        let long = thick * random.within(1.0, 7.0);
        // Ever fewer away from the core.
        let rare = (spoke.length() / 0.62).powi(2);
        let needle = Bubble { centre, half: DVec3::new(thick, long, thick), axis: spoke.normalize() };
        if meshes.len() < 420 && random.unit() > rare && needle.fits(&mut placed) {
            meshes.push(needle.mesh(if long > 3.0 * thick { 1 } else { 0 }));
        }
    }
    meshes
}

/// The last water froze here, below the hollow.
const CORE: DVec3 = DVec3::new(0.05, 0.22, 0.0);
/// The box in which bubbles are sought.
const LO: DVec3 = DVec3::new(-0.95, 0.04, -0.85);
const HI: DVec3 = DVec3::new(0.95, 1.8, 0.85);

/// An ellipsoid whose second half-axis points along `axis`.
struct Bubble {
    centre: DVec3,
    half: DVec3,
    axis: DVec3,
}

impl Bubble {
    /// Claims the room if the bubble lies in the ice apart from all others.
    fn fits(&self, placed: &mut Vec<(DVec3, f64)>) -> bool {
        let reach = self.half.max_element();
        let apart = placed.iter().all(|(c, r)| c.distance(self.centre) > r + reach + 0.005);
        let free = apart && inside_ice(self.centre, reach) && !cracks_near(self.centre, reach);
        if free {
            placed.push((self.centre, reach));
        }
        free
    }

    fn mesh(&self, level: u32) -> Mesh {
        let turn = DQuat::from_rotation_arc(DVec3::Y, self.axis);
        icosphere(level).mapped(|p| self.centre + turn * (p * self.half))
    }
}

/// A thin lens of air along an inner break.
struct Crack {
    centre: DVec3,
    normal: DVec3,
    radius: f64,
    seed: u32,
}

const CRACKS: [Crack; 1] = [Crack {
    centre: DVec3::new(0.72, 1.2, -0.2),
    normal: DVec3::new(-0.7, 0.35, 0.75),
    radius: 0.24,
    seed: 52,
}];

fn cracks_near(centre: DVec3, reach: f64) -> bool {
    CRACKS.iter().any(|crack| crack.centre.distance(centre) < crack.radius * 1.4 + reach)
}

fn cracks() -> Vec<Mesh> {
    CRACKS.iter().map(Crack::mesh).collect()
}

impl Crack {
    fn mesh(&self) -> Mesh {
        const RINGS: usize = 40;
        let turn = DQuat::from_rotation_arc(DVec3::Y, self.normal.normalize());
        between_poles(RINGS, 48, |ring, t| {
            // From the middle of one face over the rim to the middle of the other.
            let s = 2.0 * ring as f64 / RINGS as f64 - 1.0;
            let rim = 1.0 - s.abs();
            let outline = 1.0 + 0.25 * noise(around(1.2, 0.0, t), self.seed);
            let flat = around(self.radius * outline * rim.powf(0.8), 0.0, t);
            let bend = 0.02 * noise(flat * 5.0, self.seed + 7);
            let half = 0.003 * (1.0 - rim * rim).max(0.0) * -s.signum();
            self.centre + turn * (flat + DVec3::Y * (bend + half))
        })
    }
}

/// Flat on top but for the meniscus, which climbs the wall by a little.
fn liquid() -> Mesh {
    const RIM: usize = 26;
    const RINGS: usize = 44;
    let centre = DVec3::new(CAVITY.x, LEVEL, CAVITY.z);
    let reach = |p: DVec3| cavity(p) - OVERLAP;
    between_poles(RINGS, 144, |ring, turn| {
        if ring <= RIM {
            // Rings crowd towards the wall.
            let s = 1.0 - (1.0 - ring as f64 / RIM as f64).powf(1.8);
            let flat = around(s * extent(&reach, centre, around(1.0, 0.0, turn)), 0.0, turn) + centre;
            flat + DVec3::Y * meniscus(cavity(flat))
        } else {
            let angle = std::f64::consts::FRAC_PI_2 * (ring - RIM) as f64 / (RINGS - RIM) as f64;
            let direction = around(angle.cos(), -angle.sin(), turn);
            centre + direction * extent(&reach, centre, direction)
        }
    })
}

/// Height above the level at a distance from the wall, negative in the cavity.
fn meniscus(wall: f64) -> f64 {
    0.03 * (wall.min(0.0) / 0.03).exp()
}

/// Distance from `origin`, inside the field, to its surface along `direction`.
fn extent(field: &impl Field, origin: DVec3, direction: DVec3) -> f64 {
    let (mut near, mut far) = (0.0, 2.0);
    for _ in 0..60 {
        let middle = (near + far) / 2.0;
        if field(origin + direction * middle) < 0.0 { near = middle } else { far = middle }
    }
    near
}

/// A low dome of water with a wandering outline around the foot, and drops beside it.
fn puddle() -> Mesh {
    let mut mesh = drop(DVec2::ZERO, 0.03, 12, 200, |turn| {
        let shore = around(1.0, 0.0, turn);
        1.28 + 0.34 * noise(shore * 1.4, 61) + 0.16 * noise(shore * 3.1, 64) + 0.05 * noise(shore * 7.0, 62)
    });
    let mut random = Random::new(9);
    let mut placed: Vec<(DVec2, f64)> = Vec::new();
    for _ in 0..400 {
        if placed.len() == 26 {
            break;
        }
        let radius = 0.02 + 0.07 * random.unit().powi(3);
        let (turn, away) = (random.unit(), random.within(1.45, 2.3));
        let p = around(away, 0.0, turn);
        let centre = DVec2::new(p.x, p.z);
        if placed.iter().all(|(c, r)| c.distance(centre) > r + radius + 0.03) {
            placed.push((centre, radius));
            let seed = placed.len() as u32 + 70;
            mesh.append(&drop(centre, 0.45 * radius, 6, 20, |turn| {
                radius * (1.0 + 0.25 * noise(around(0.9, 0.0, turn), seed))
            }));
        }
    }
    mesh
}

/// A drop of water: a cap with a steep shore, its bottom below the table's surface.
fn drop(centre: DVec2, height: f64, rings: usize, sides: usize, shore: impl Fn(f64) -> f64) -> Mesh {
    let below = -0.03;
    between_poles(rings + 2, sides, |ring, turn| {
        let s = (ring as f64 / rings as f64).min(1.0);
        // The profile (1 − s⁴) meets the table at a contact angle; the last rings go straight down and close.
        let (reach, y) = match ring {
            _ if ring <= rings => {
                ((s * std::f64::consts::FRAC_PI_2).sin(), height * (1.0 - s.powi(4)) - 0.001)
            }
            _ if ring == rings + 1 => (1.0, below),
            _ => (0.0, below),
        };
        around(shore(turn) * reach, y, turn) + DVec3::new(centre.x, 0.0, centre.y)
    })
}
