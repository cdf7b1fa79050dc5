//! Media through edges and corners.

use glam::DVec3;

use crate::flatten::start_media;
use crate::layout::{FlatScene, Triangle};
use crate::scene::{Material, Scene};
use crate::selftest::paper::{ICE, WATER, widen3};
use crate::selftest::props::{body, cube};
use crate::selftest::random::Random;
use crate::selftest::{
    Bend, Case, Device, DeviceError, Effort, Ending, Escape, Finding, Stage, Walk, solids,
};

/// T13.
pub(super) const T13: Case = Case {
    id: "T13",
    title: "media at edges and corners",
    claim: "rays at the edges and corners of nested cubes end in air; from an eye in air, ice and water, all rays out agree \
            with the media found there",
    run,
};

/// Water in ice in a jar of air-filled glass: three cubes, tilted by their corners' rounding only.
const GLASS: f64 = 1.5;
/// Most faces that a straight ray may cross: each of six walls in, six out, and edges twice.
const LIMIT: u32 = 32;

/// All bounds are 0: whatever an edge gives, one event or two, sets or clears bits that stay so.
fn run(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let stage = Stage::new(&nested_cubes())?;
    let count = effort.rays(1 << 16);
    let mut findings = straight(device, &stage, count)?;
    findings.extend(bent(device, &stage, count)?);
    findings.extend(from_inside(device, &stage, count)?);
    Ok(findings)
}

/// A jar of glass around ice around water. The ice fills the jar: they share their faces, cut alike.
fn nested_cubes() -> Scene {
    let materials =
        vec![Material::clear("water", WATER), Material::clear("ice", ICE), Material::clear("glass", GLASS)];
    let jar = solids::joined(cube(2.0), super::hollow_cube::inside_out(&cube(1.5)));
    Scene::of(materials, vec![body(cube(1.0), 0, 0), body(cube(1.5), 1, 1), body(jar, 2, 1)])
}

/// Rays from outside at points of edges and at corners, straight on.
fn straight(device: &mut dyn Device, stage: &Stage, count: usize) -> Result<Vec<Finding>, DeviceError> {
    let mut random = Random::new("straight through edges");
    let rays: Vec<Walk> = (0..count)
        .map(|_| {
            let (origin, direction) = aim(&stage.flat, &mut random);
            let narrow = |v: DVec3| v.as_vec3().to_array();
            Walk { origin: narrow(origin), direction: narrow(direction), media: 0, limit: LIMIT }
        })
        .collect();
    let walked = device.walk(stage, &rays)?;
    let astray = walked.iter().filter(|w| w.escape == Escape::Free && w.media != 0).count();
    let endless = walked.iter().filter(|w| w.escape == Escape::Limit).count();
    let healed: u32 = walked.iter().map(|w| w.idle).sum();
    Ok(vec![
        Finding::at_most("straight rays at edges that end in matter", astray as f64, 0.0, count),
        Finding::at_most("straight rays at edges without end", endless as f64, 0.0, count),
        Finding::reported("doubled or missing faces, healed", f64::from(healed), count),
    ])
}

/// The same, refracted wherever they can be.
fn bent(device: &mut dyn Device, stage: &Stage, count: usize) -> Result<Vec<Finding>, DeviceError> {
    let mut random = Random::new("bent at edges");
    let rays: Vec<Bend> = (0..count)
        .map(|_| {
            let (origin, direction) = aim(&stage.flat, &mut random);
            Bend::through(origin, direction)
        })
        .collect();
    let bent = device.bend(stage, &rays)?;
    let free = bent.iter().filter(|bent| bent.end == Ending::Free);
    let astray = free.clone().filter(|bent| bent.media != 0).count();
    Ok(vec![Finding::at_most("bent rays at edges that end in matter", astray as f64, 0.0, free.count())])
}

/// Rays from points in each medium, with the media that `flatten` finds there.
fn from_inside(device: &mut dyn Device, stage: &Stage, count: usize) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, eye, bodies) in [
        ("air", DVec3::new(1.3, 0.1, 0.2), 0),
        ("glass", DVec3::new(0.85, 0.1, 0.2), 1),
        ("ice", DVec3::new(0.6, 0.1, 0.2), 1),
        ("water", DVec3::new(0.1, 0.2, 0.3), 2),
    ] {
        let media = start_media(&stage.flat, eye.as_vec3().as_dvec3().to_array());
        let mut random = Random::new(name);
        let origin = eye.as_vec3().to_array();
        let rays: Vec<Walk> = (0..count / 4)
            .map(|_| Walk { origin, direction: random.direction().as_vec3().to_array(), media, limit: LIMIT })
            .collect();
        let walked = device.walk(stage, &rays)?;
        let astray = walked.iter().filter(|w| w.escape == Escape::Limit || w.media != 0).count();
        findings.push(Finding::at_most(
            format!("rays from {name} that do not end in air"),
            astray as f64,
            0.0,
            rays.len(),
        ));
        let found = f64::from(media.count_ones());
        findings.push(Finding::near(
            format!("bodies around an eye in {name}"),
            found,
            f64::from(bodies),
            0.0,
            1,
        ));
    }
    Ok(findings)
}

/// A ray from outside at a random corner, or at a random point of an edge, of a random triangle.
fn aim(scene: &FlatScene, random: &mut Random) -> (DVec3, DVec3) {
    let triangle: &Triangle = &scene.triangles[random.below(scene.triangles.len() as u32) as usize];
    let corners = [triangle.v0, triangle.v1, triangle.v2].map(widen3);
    let at = random.below(3) as usize;
    let share = if random.below(4) == 0 { 0.0 } else { random.fraction() };
    let target = corners[at].lerp(corners[(at + 1) % 3], share);
    let origin = (random.direction() * 4.0).as_vec3().as_dvec3();
    (origin, (target - origin).normalize())
}
