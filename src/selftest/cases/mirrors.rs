//! Plane mirrors.

use std::f64::consts::TAU;

use glam::{DAffine3, DQuat, DVec2, DVec3, EulerRot};

use crate::scene::{Material, Model, Scene};
use crate::selftest::paper::{angle, greatest, reflection_error, unit, widen3};
use crate::selftest::props::{body, centred, mirror, quad};
use crate::selftest::random::Random;
use crate::selftest::solids::placed;
use crate::selftest::{Bend, Bent, Case, Device, DeviceError, Effort, Ending, Finding, Stage};

/// The cat's eye.
pub(super) const C11: Case = Case {
    id: "C11",
    title: "corner cube",
    claim: "three mirrors at right angles send every ray back where it came from: d_out = −d_in",
    run: c11,
};

/// The kaleidoscope.
pub(super) const C12: Case = Case {
    id: "C12",
    title: "images in two mirrors",
    claim: "between two mirrors at 360°/N there are N−1 images of an object (N even, or the object on the bisector)",
    run: c12,
};

/// Each of three reflections turns the ray by its error; the normals of the tilted mirrors are rounded, and so are not at
/// right angles to each other, by u each: 2u more for each reflection.
fn c11(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let tilt = DQuat::from_euler(EulerRot::XYZ, 0.3, 0.5, 0.7);
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let walls = [[x, y], [y, z], [z, x]].map(|[a, b]| Model {
        world_from_object: DAffine3::from_quat(tilt),
        ..body(quad([DVec3::ZERO, a * 2.0, (a + b) * 2.0, b * 2.0]), 0, 0)
    });
    let stage = Stage::new(&Scene::of(vec![mirror()], walls.to_vec()))?;
    let mut random = Random::new("corner cube");
    let rays: Vec<Bend> = (0..effort.rays(4096))
        .map(|_| {
            let [from, to] = [3.0, 0.5].map(|reach| {
                DVec3::new(random.between(0.0, reach), random.between(0.0, reach), random.between(0.0, reach))
            });
            Bend::back(tilt * (from + DVec3::ONE * 3.0), tilt * (to - from - DVec3::ONE * 3.0))
        })
        .collect();
    let bent = device.bend(&stage, &rays)?;
    let back: Vec<_> = rays.iter().zip(&bent).filter(|(_, bent)| bent.surfaces == 3).collect();
    let turned = back.iter().map(|(ray, bent)| angle(-widen3(ray.direction), widen3(bent.direction)));
    let unit = unit(device);
    let bound = reflection_error(3, unit) + 6.0 * unit;
    Ok(vec![Finding::at_most("rays off their way back, in radians", greatest(turned), bound, back.len())])
}

/// Rays all around, in the plane across both mirrors: each time that they begin to end on the object there is an image
/// more, or the object itself. The count is exact: the object is as wide as many rays, and stands free.
fn c12(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    // N, and where the object and the eye stand between the mirrors: so that no image hides another.
    for (n, share, eye) in
        [(3, 0.5, 0.55), (4, 0.3, 0.8), (5, 0.5, 0.55), (6, 0.4, 0.8), (8, 0.6, 0.7), (12, 0.35, 0.62)]
    {
        let wedge = TAU / f64::from(n);
        let at = |share: f64, radius: f64| (DVec2::from_angle(wedge * share) * radius).extend(0.0);
        // The mirrors reach to the edge that they share, along z.
        let wall = |share: f64| {
            let [near, far] = [DVec3::ZERO, at(share, 4.0)];
            body(quad([near - DVec3::Z, far - DVec3::Z, far + DVec3::Z, near + DVec3::Z]), 0, 0)
        };
        let object = body(placed(centred(DVec3::new(0.01, 0.01, 1.0)), 1.0, at(share, 1.0)), 1, 0);
        let materials = vec![mirror(), Material::black("object")];
        let stage = Stage::new(&Scene::of(materials, vec![wall(0.0), wall(1.0), object]))?;
        let eye = at(eye, 2.0);
        let count = effort.rays(16384);
        let rays: Vec<Bend> = (0..count)
            .map(|k| {
                let around = DVec2::from_angle(TAU * (k as f64 + 0.5) / count as f64);
                Bend::back(eye, around.extend(0.0))
            })
            .collect();
        let bent = device.bend(&stage, &rays)?;
        let sees = |bent: &Bent| bent.end == Ending::Absorbed;
        let begins = (0..count).filter(|&k| sees(&bent[k]) && !sees(&bent[(k + count - 1) % count])).count();
        let images = begins as f64 - 1.0;
        let what = format!("images between mirrors at {}°", 360 / n);
        findings.push(Finding::near(what, images, f64::from(n - 1), 0.0, count));
    }
    Ok(findings)
}
