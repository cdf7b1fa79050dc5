//! Few triangles with the normals of a sphere.

use glam::DVec3;

use crate::layout::{Aov, Intersector, Precision, Settings};
use crate::scene::{Background, Falloff, Light, Material, Scene};
use crate::selftest::paper::{ICE, widen3};
use crate::selftest::props::{camera, round, smooth_body, square};
use crate::selftest::random::Random;
use crate::selftest::solids::sphere;
use crate::selftest::{Bend, Bent, Case, CpuDevice, Device, DeviceError, Effort, Finding, Stage};

/// T19.
pub(super) const T19: Case = Case {
    id: "T19",
    title: "a smooth sphere of 8×8 faces",
    claim: "at grazing light reflected rays leave the faces (n_g·r > 0) and meet the sphere no more; no point that its \
            shading normal turns to the lamp is black",
    run,
};

/// Circles of latitude and longitude.
const CIRCLES: u32 = 8;

fn run(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = reflections(device, effort.rays(1 << 16))?;
    findings.push(band(device)?);
    Ok(findings)
}

/// Rays that only just touch the sphere, reflected.
///
/// The bounds are 0: a mirror direction that points into the face is mirrored out of it, and what leaves a face of a
/// convex body outwards meets no other. In the plane of the face itself, n_g·r = 0, rounding decides: two roundoffs for
/// each of the five operations of n_g·r are allowed below 0.
fn reflections(device: &mut dyn Device, count: usize) -> Result<Vec<Finding>, DeviceError> {
    let stage = Stage::new(&Scene::of(
        vec![Material::clear("ice", ICE)],
        vec![smooth_body(round(sphere(CIRCLES)), 0, 0)],
    ))?;
    let mut random = Random::new("grazing");
    let rays: Vec<Bend> = (0..count)
        .map(|_| {
            // Past the centre at a distance between that of the faces and that of the corners.
            let direction = random.direction();
            let aside = direction.cross(random.direction()).normalize() * random.between(0.7, 1.0);
            Bend { limit: 2, ..Bend::back(aside - direction * 3.0, direction) }
        })
        .collect();
    let bent = device.bend(&stage, &rays)?;
    let met: Vec<_> = bent.iter().filter(|bent| bent.surfaces > 0).collect();
    let rise = |bent: &&&Bent| {
        let normal = stage.flat.attributes[bent.ids[0] as usize].normal;
        widen3(normal).dot(widen3(bent.direction))
    };
    let again = met.iter().filter(|bent| bent.surfaces > 1).count();
    let least = met.iter().filter(|bent| bent.surfaces == 1).map(|bent| rise(&bent)).fold(1.0, f64::min);
    let allowed = -10.0 * device.roundoff().max(2f64.powi(-24));
    Ok(vec![
        Finding::at_most("reflected rays that meet the sphere again", again as f64, 0.0, met.len()),
        Finding::at_least("least n_g·r of reflected rays", least, allowed, met.len()),
    ])
}

/// A white sphere under one lamp from the side: how many of its points are black though their shading normal turns to
/// the lamp by more than 2^-10. A shadow ray that starts on the flat face meets the next face before it gets out; from
/// the curved surface that the normals stand for it meets none.
fn band(device: &mut dyn Device) -> Result<Finding, DeviceError> {
    let chalk = Material { diffuse: DVec3::ONE, ..Material::black("chalk") };
    let mut scene = Scene::of(vec![chalk], vec![smooth_body(round(sphere(CIRCLES)), 0, 0)]);
    let lamp = DVec3::new(4000.0, 1500.0, 500.0);
    scene.lights = vec![Light { position: lamp, intensity: DVec3::ONE, falloff: Falloff::None }];
    scene.background = Background::Color(DVec3::ZERO);
    scene.camera = camera(DVec3::new(0.4, 0.6, 4.0), DVec3::ZERO, 30.0);
    scene.render = square(96, 0, 0.0);
    let stage = Stage::new(&scene)?;
    let frame = device.picture(&stage, &stage.settings)?;
    // The normals come from the CPU: auxiliary pictures would cost an adapter a second compilation.
    let with_normals = Settings { aovs: true, ..stage.settings };
    let judge = CpuDevice::new(Precision::F64, Intersector::default()).picture(&stage, &with_normals)?;
    let aovs: &[Aov] = judge.aovs.as_deref().unwrap_or_default();
    let is_lit = |aov: &Aov| widen3(aov.normal).dot(lamp.normalize()) > 2f64.powi(-10);
    let lit = frame.texels.iter().zip(aovs).filter(|(_, aov)| is_lit(aov));
    let black = lit.clone().filter(|(texel, _)| texel.radiance[0] <= 0.0).count();
    Ok(Finding::at_most("black pixels that face the lamp", black as f64, 0.0, lit.count()))
}
