//! Plane-parallel plates.

use std::f64::consts::FRAC_PI_4;

use glam::DVec3;

use crate::scene::{Material, Scene};
use crate::selftest::paper::{
    ICE, WATER, narrow, narrow3, normal_reflectance, refract, refraction_error, start_error, unit, widen3,
};
use crate::selftest::props::{LIGHT_ABOVE, body, camera, centred, square};
use crate::selftest::solids::placed;
use crate::selftest::{Bend, Bent, Case, Device, DeviceError, Effort, Ending, Finding, Stage};

/// Slabs with all reflections in between.
pub(super) const C4: Case = Case {
    id: "C4",
    title: "slab and stack",
    claim: "with all internal reflections a slab transmits 2n/(n²+1) (0.964618 for ice, 0.960067 for water), and a stack \
            1/T = 1 + ΣRᵢ/(1−Rᵢ)",
    run: c4,
};

/// The image behind a window.
pub(super) const C5: Case = Case {
    id: "C5",
    title: "sideways shift of a slab",
    claim: "a slab of thickness t shifts a ray by t·sin θ·(1 − cos θ/√(n² − sin²θ)): 0.25370·t at 45° and 0.42548·t at 60° \
            for ice, and does not turn it",
    run: c5,
};

/// The coin in the pool.
pub(super) const C6: Case = Case {
    id: "C6",
    title: "apparent depth",
    claim: "from straight above, what lies at depth d in water or ice is seen at d/n",
    run: c6,
};

/// Light in coloured matter.
pub(super) const C10: Case = Case {
    id: "C10",
    title: "Beer–Lambert",
    claim: "a slab of thickness t lets exp(−σ·t/cos θt) through",
    run: c10,
};

/// What lies behind the slab's depth of 48 levels is R^24; a stack's tree is cut at 1e-8, and the error of cut rays is
/// below their number times that. The sum of the light that gets through is rounded at every level, but each level
/// carries a fiftieth of the one before: 24 roundoffs.
fn c4(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let plate = |middle: f64, material| {
        body(placed(centred(DVec3::new(4.0, 0.5, 4.0)), 1.0, DVec3::Y * middle), material, 0)
    };
    let mut findings = Vec::new();
    for (name, depth, cutoff, models, interfaces) in [
        ("ice", 48, 0.0, vec![plate(0.0, 0)], vec![ICE; 2]),
        ("water", 48, 0.0, vec![plate(0.0, 1)], vec![WATER; 2]),
        ("two of ice", 40, 1e-8, vec![plate(0.0, 0), plate(1.0, 0)], vec![ICE; 4]),
        ("ice on water", 40, 1e-8, vec![plate(0.0, 1), plate(0.5, 0)], vec![WATER, WATER / ICE, ICE]),
    ] {
        let mut scene = Scene::of(materials(), models);
        scene.background = LIGHT_ABOVE;
        scene.camera = camera(DVec3::new(0.1, -3.0, 0.05), DVec3::new(0.1, 0.0, 0.05), 1.0);
        scene.render = square(1, depth, cutoff);
        let stage = Stage::new(&scene)?;
        let texels = device.picture(&stage, &stage.settings)?.texels;
        let figure = texels.first().map_or(f64::NAN, |texel| f64::from(texel.radiance[0]));
        let odds = |&n: &f64| normal_reflectance(n) / (1.0 - normal_reflectance(n));
        let expected = 1.0 / (1.0 + interfaces.iter().map(odds).sum::<f64>());
        let cut = texels.first().map_or(0.0, |texel| f64::from(texel.dropped));
        let within = 24.0 * unit(device) + cut;
        findings.push(Finding::near(
            format!("transmittance, {name}"),
            figure,
            expected,
            within,
            texels.len(),
        ));
    }
    Ok(findings)
}

/// The shift is a length of the path inside times the sine of what the ray is turned by: the start and the end of the
/// path are off as any start is, and the direction inside by that of one refraction over a length of up to 1.2.
fn c5(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, n, degrees) in [
        ("ice at 45°", ICE, 45f64),
        ("ice at 60°", ICE, 60.0),
        ("water at 45°", WATER, 45.0),
        ("water at 60°", WATER, 60.0),
    ] {
        let (ray, bent) = through_plate(device, n, degrees, DVec3::ZERO)?;
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (origin, direction) = (widen3(ray.origin), widen3(ray.direction));
        let shift = (widen3(bent.origin) - origin).cross(direction).length();
        let expected = sin * (1.0 - cos / (n * n - sin * sin).sqrt());
        let unit = unit(device);
        let within = 2.0 * start_error(13.0, unit) + 1.2 * refraction_error(1, cos, unit);
        findings.push(Finding::near(format!("shift by {name}"), shift, expected, within, 1));
        let turned = crate::selftest::paper::angle(direction, widen3(bent.direction));
        let what = format!("direction turned by {name}");
        findings.push(Finding::at_most(what, turned, refraction_error(2, cos, unit), 1));
    }
    Ok(findings)
}

/// The ray meets the face at a height of d·tan θ beside the axis, and leaves at θt to it: its line back meets the axis at
/// d·tan θ/tan θt = (d/n)·cos θt/cos θ. That factor is known, and goes into the expected value; slopes of 1/32 are off
/// by the error of a direction, relative to them.
fn c6(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, n) in [("ice", ICE), ("water", WATER)] {
        let pool = body(placed(centred(DVec3::new(1.0, 4.0, 1.0)), 1.0, DVec3::Y * -2.0), 0, 0);
        let stage = Stage::new(&Scene::of(vec![Material::clear(name, n)], vec![pool]))?;
        let up = DVec3::new(1.0 / 32.0, 1.0, 0.0).normalize();
        let ray = Bend { media: 1, limit: 1, ..Bend::through(DVec3::new(0.0, -1.0, 0.0), up) };
        let bent = device.bend(&stage, &[ray])?;
        let Some(bent) = bent.first() else { continue };
        let (point, direction) = (widen3(bent.origin), widen3(bent.direction));
        let depth = point.x * direction.y / direction.x - point.y;
        let inside = widen3(ray.direction).normalize().y;
        let outside = refract(inside, 1.0 / narrow(n)).unwrap_or(f64::NAN);
        let expected = outside / inside / n;
        let unit = unit(device);
        let within = 32.0 * (start_error(4.0, unit) + refraction_error(1, 1.0, unit));
        findings.push(Finding::near(format!("apparent depth, {name}"), depth, expected, within, 1));
    }
    Ok(findings)
}

/// The logarithm of what is left is off by σ times the error of the path, and the exponential by 2 ULP, 4 roundoffs.
fn c10(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let sigma = DVec3::new(0.35, 1.0, 4.0);
    let mut findings = Vec::new();
    for degrees in [0.0f64, 30.0, 60.0, 80.0] {
        let (_, bent) = through_plate(device, ICE, degrees, sigma)?;
        let behind = refract(degrees.to_radians().cos(), ICE).unwrap_or(f64::NAN);
        let unit = unit(device);
        let path = 2.0 * start_error(13.0, unit) / behind + refraction_error(1, 1.0, unit);
        for (channel, weight) in ["0.35", "1", "4"].into_iter().zip(bent.weight).enumerate() {
            let (name, weight) = weight;
            let sigma = narrow(sigma[channel]);
            let expected = (-sigma / behind).exp();
            let within = expected * (sigma * path + 4.0 * unit);
            let what = format!("transmittance at σ = {name}, {degrees}°");
            findings.push(Finding::near(what, f64::from(weight), expected, within, 1));
        }
    }
    Ok(findings)
}

/// A ray down through a plate of thickness 1, and where it comes out. The plate has classic weights of 1.
fn through_plate(
    device: &mut dyn Device,
    n: f64,
    degrees: f64,
    absorption: DVec3,
) -> Result<(Bend, Bent), DeviceError> {
    let matter =
        Material { fresnel: false, reflection: DVec3::ZERO, absorption, ..Material::clear("matter", n) };
    let plate = body(centred(DVec3::new(4.0, 1.0, 4.0)), 0, 0);
    let stage = Stage::new(&Scene::of(vec![matter], vec![plate]))?;
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (z, x) = FRAC_PI_4.sin_cos();
    let direction = DVec3::new(sin * x, -cos, sin * z);
    let ray = Bend::through(DVec3::new(-0.35, 0.5, -0.3) - direction * 0.25, direction);
    let bent = device.bend(&stage, &[ray])?;
    let lost = Bent {
        end: Ending::Limit,
        surfaces: 0,
        reflected: 0,
        media: 0,
        ids: [0; Bend::LIMIT as usize],
        origin: narrow3(DVec3::NAN),
        direction: narrow3(DVec3::NAN),
        weight: narrow3(DVec3::NAN),
    };
    Ok((ray, bent.into_iter().find(|bent| bent.end == Ending::Free && bent.surfaces == 2).unwrap_or(lost)))
}

fn materials() -> Vec<Material> {
    vec![Material::clear("ice", ICE), Material::clear("water", WATER)]
}
