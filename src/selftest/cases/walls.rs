//! T5: thin walls have two faces.
//!
//! A ray that crosses a face starts behind it, off by 8 roundoffs of the point and 4 of the face's extent
//! (`SPAWN_ROUNDOFFS`); a wall that is thinner is jumped over. On the wall of half-width 1 at
//! distance 1 from the origin |p|·|n| is at most 1.8 and the extent at most 5: 35 roundoffs. Twice that, 64 as a power of two,
//! leaves room for the rounding of corners and origin: 2^-18 in f32, 2^-17 where the driver may rewrite, and all walls in f64.

use glam::{DMat3, DVec3};

use crate::scene::{Material, MaterialId, Mesh, Model, Scene};
use crate::selftest::{Case, Device, DeviceError, Effort, Escape, Finding, Random, Stage, Walk};

/// Walls of thickness 2^-k.
pub(super) const T5: Case = Case {
    id: "T5",
    title: "thin walls have two faces",
    claim: "a ray through a wall of thickness 2^-k crosses two faces and ends in the air, down to a wall that can be resolved",
    run: resolved,
};

/// Thinnest wall: 2^-22. Thinner ones are no walls: their corners are rounded to f32, whose unit there is 2^-23.
const THINNEST: i32 = 22;
/// Walls of so many roundoffs are resolved.
const RESOLVABLE: f64 = 64.0;
/// Most faces that a ray may cross.
const LIMIT: u32 = 8;

fn resolved(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let rays = effort.rays(1000);
    let turns = [
        ("along an axis", DMat3::IDENTITY),
        ("askew", DMat3::from_rotation_x(0.7) * DMat3::from_rotation_y(0.4)),
    ];
    let stated = (1.0 / (RESOLVABLE * device.roundoff())).log2().floor().min(f64::from(THINNEST));
    let mut findings = Vec::new();
    for (what, turn) in turns {
        let mut thinnest = -1;
        let mut wrong = 0;
        for k in 0..=THINNEST {
            let count = wrong_counts(device, turn, k, rays)?;
            if count == 0 && thinnest == k - 1 {
                thinnest = k;
            }
            if f64::from(k) <= stated {
                wrong += count;
            }
        }
        let tried = rays * (stated as usize + 1);
        findings.push(Finding::at_most(
            format!("wrong counts through walls {what}"),
            wrong as f64,
            0.0,
            tried,
        ));
        let what = format!("k of the thinnest wall 2^-k {what} that is crossed rightly");
        findings.push(Finding::at_least(what, f64::from(thinnest), stated, tried));
    }
    Ok(findings)
}

/// Rays that do not cross exactly two faces of the wall, and from and to the air.
fn wrong_counts(device: &mut dyn Device, turn: DMat3, k: i32, rays: usize) -> Result<usize, DeviceError> {
    let stage = Stage::new(&wall(turn, 2f64.powi(-k)))?;
    let mut random = Random::new("walls");
    let rays: Vec<_> = (0..rays).map(|_| through(turn, &mut random)).collect();
    let walked = device.walk(&stage, &rays)?;
    let is_right = |faces: u32, idle: u32, media: u32| (faces, idle, media) == (2, 0, 0);
    Ok(walked.iter().filter(|w| w.escape == Escape::Limit || !is_right(w.faces, w.idle, w.media)).count())
}

/// A square wall of half-width 1 whose near side is at distance 1 from the origin.
fn wall(turn: DMat3, thickness: f64) -> Scene {
    let mut mesh = Mesh::cuboid(DVec3::new(-1.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 1.0 + thickness));
    for position in &mut mesh.positions {
        *position = turn * *position;
    }
    Scene::of(vec![Material::clear("glass", 1.5)], vec![Model::of("wall", mesh, MaterialId(0))])
}

/// A ray through the middle of the wall, from either side, up to 75° off its normal.
fn through(turn: DMat3, random: &mut Random) -> Walk {
    let aim = DVec3::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5), 1.0);
    let angle = random.between(0.0, 75f64.to_radians());
    let (sin, cos) = random.between(0.0, std::f64::consts::TAU).sin_cos();
    let towards = if random.word() & 1 == 0 { 1.0 } else { -1.0 };
    let direction = DVec3::new(angle.sin() * cos, angle.sin() * sin, towards * angle.cos());
    Walk {
        origin: (turn * (aim - direction * 3.0)).as_vec3().to_array(),
        direction: (turn * direction).as_vec3().to_array(),
        media: 0,
        limit: LIMIT,
    }
}
