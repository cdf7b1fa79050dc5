//! Liquid in ice, modelled in three ways.

use glam::DVec3;

use crate::layout::{Settings, Texel};
use crate::scene::{Material, Mesh, Model, Scene};
use crate::selftest::paper::{ICE, WATER, angle, greatest, normal_reflectance, unit, widen3};
use crate::selftest::props::{LIGHT_ABOVE, body, camera, centred, square};
use crate::selftest::solids::joined;
use crate::selftest::{Bend, Bent, Case, Device, DeviceError, Effort, Ending, Finding, Stage};

/// T12.
pub(super) const T12: Case = Case {
    id: "T12",
    title: "liquid in ice",
    claim: "a hollow cube of ice with water in it transmits 0.964477 by shared faces and by overlap, 0.896899 with an air \
            gap (±2e-6), and turns no ray by more than 1.2e-6 to 60°, 3e-6 at 80°, 3e-5 at 89°",
    run: t12,
};

/// The ray trees.
pub(super) const C13: Case = Case {
    id: "C13",
    title: "ray trees of the hollow cube",
    claim: "at normal incidence the tree has 5167, 36, 14 and 10 rays at cut-offs of 0, 1e-6, 1e-4 and 1/255, and cutting \
            changes the transmittance by 6.3e-10, 2.7e-6 and 3.1e-6",
    run: c13,
};

/// How the water meets the ice.
#[derive(Clone, Copy)]
enum Modelling {
    /// The ice has a cavity of the water's very faces.
    Shared,
    /// The water lies in solid ice, and wins.
    Overlapping,
    /// A gap of air lies between them.
    Gap,
}

const MODELLINGS: [(&str, Modelling); 3] =
    [("shared faces", Modelling::Shared), ("overlap", Modelling::Overlapping), ("air gap", Modelling::Gap)];

/// A box of ice with water in it, both of one shape: `width` and 2 high outside.
fn models(modelling: Modelling, width: f64) -> Vec<Model> {
    let of = |height: f64| centred(DVec3::new(width - (2.0 - height), height, width - (2.0 - height)));
    let inner = of(1.2);
    match modelling {
        Modelling::Shared => {
            vec![body(joined(of(2.0), inside_out(&inner)), 0, 1), body(inner, 1, 1)]
        }
        Modelling::Overlapping => vec![body(of(2.0), 0, 1), body(inner, 1, 0)],
        Modelling::Gap => vec![body(of(2.0), 0, 2), body(inner, 2, 1), body(of(1.1), 1, 0)],
    }
}

/// The faces of a cavity.
pub(super) fn inside_out(mesh: &Mesh) -> Mesh {
    let mut turned = mesh.clone();
    turned.triangles.iter_mut().for_each(|triangle| triangle.positions.reverse());
    turned
}

/// One pixel straight up, off the diagonals of the faces; light comes from above only.
fn scene(models: Vec<Model>) -> Scene {
    let materials =
        vec![Material::clear("ice", ICE), Material::clear("water", WATER), Material::clear("air", 1.0)];
    let mut scene = Scene::of(materials, models);
    scene.background = LIGHT_ABOVE;
    scene.camera = camera(DVec3::new(0.1, -5.0, 0.05), DVec3::new(0.1, 0.0, 0.05), 1.0);
    scene.render = square(1, 16, 0.0);
    scene
}

fn t12(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, modelling) in MODELLINGS {
        findings.push(transmittance(device, name, modelling)?);
        findings.extend(turns(device, effort, name, modelling)?);
    }
    Ok(findings)
}

/// With all reflections in between 1/T = 1 + Σ Rᵢ/(1−Rᵢ) over the interfaces, whatever their order. What the depth of 16
/// leaves out is of the order of R⁸; the tolerance of 2e-6 is 32 roundoffs for a sum of some thousand rays, of which
/// the one that goes straight through carries nearly all.
fn transmittance(device: &mut dyn Device, name: &str, modelling: Modelling) -> Result<Finding, DeviceError> {
    let odds = |eta: f64| normal_reflectance(eta) / (1.0 - normal_reflectance(eta));
    let interfaces = match modelling {
        Modelling::Shared | Modelling::Overlapping => [(ICE, 2.0), (WATER / ICE, 2.0)],
        Modelling::Gap => [(ICE, 4.0), (WATER, 2.0)],
    };
    let expected = 1.0 / (1.0 + interfaces.map(|(eta, count)| count * odds(eta)).iter().sum::<f64>());
    let stage = Stage::new(&scene(models(modelling, 2.0)))?;
    let texels = device.picture(&stage, &stage.settings)?.texels;
    let figure = texels.first().map_or(f64::NAN, |texel| f64::from(texel.radiance[0]));
    Ok(Finding::near(format!("transmittance, {name}"), figure, expected, 2e-6, texels.len()))
}

/// Rays through the same in a wide box, so that they meet the upper and lower faces only.
///
/// At an interface of parallel faces the errors of one refraction are undone by the next but for their rounding; it is
/// the last one, into the air, that counts: 20 roundoffs over g = cos θ (see `paper`) are 1.2e-6 upright, 2.4e-6 at 60°,
/// 7e-5 at 89°. The bounds are tighter than this, and hold.
fn turns(
    device: &mut dyn Device,
    effort: Effort,
    name: &str,
    modelling: Modelling,
) -> Result<Vec<Finding>, DeviceError> {
    let stage = Stage::new(&scene(models(modelling, 64.0)))?;
    let mut findings = Vec::new();
    for (from, to, bound) in [(0.0, 60.0, 1.2e-6), (60.0, 80.0, 3e-6), (80.0, 89.0, 3e-5)] {
        let rays: Vec<Bend> = fan(from, to, effort.rays(512)).collect();
        let bent = device.bend(&stage, &rays)?;
        let turned = rays.iter().zip(&bent).map(|(ray, bent)| turned(ray, bent));
        let factor = if device.is_exact() { 1.0 } else { 2.0 };
        let what = format!("rays at {from}° to {to}° turned by, {name}");
        findings.push(Finding::at_most(what, greatest(turned), factor * bound, rays.len()));
    }
    Ok(findings)
}

/// Rays upwards through the middle of the lower face, at angles between two in degrees.
fn fan(from: f64, to: f64, count: usize) -> impl Iterator<Item = Bend> {
    (0..count).map(move |k| {
        let share = (k as f64 + 0.5) / count as f64;
        let (sin, cos) = (from + (to - from) * share).to_radians().sin_cos();
        let (z, x) = (2.4 * k as f64).sin_cos();
        let direction = DVec3::new(sin * x, cos, sin * z);
        Bend::through(DVec3::new(0.1, -1.0, 0.05) - direction * 0.5, direction)
    })
}

/// By how much a ray that came through is turned; not a number for others.
fn turned(ray: &Bend, bent: &Bent) -> f64 {
    let through = bent.end == Ending::Free && bent.reflected == 0 && bent.surfaces >= 4 && bent.media == 0;
    if through { angle(widen3(ray.direction), widen3(bent.direction)) } else { f64::NAN }
}

/// The differences of transmittances are rounded to 4 roundoffs each, and their values in the claim to 5e-8.
fn c13(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let stage = Stage::new(&scene(models(Modelling::Shared, 2.0)))?;
    let mut trace = |cutoff: f32| -> Result<Texel, DeviceError> {
        let frame = device.picture(&stage, &Settings { cutoff, ..stage.settings })?;
        Ok(frame.texels.first().copied().unwrap_or_default())
    };
    let whole = trace(0.0)?;
    let mut cut = Vec::new();
    for (name, cutoff) in [("1e-6", 1e-6), ("1e-4", 1e-4), ("1/255", 1.0 / 255.0), ("0.1", 0.1)] {
        let texel = trace(cutoff)?;
        cut.push((name, texel, f64::from(texel.radiance[0] - whole.radiance[0]).abs()));
    }
    let rounding = 8.0 * unit(device);
    let rays = |name: &str, texel: &Texel, expected: f64| {
        Finding::near(format!("rays at a cut-off of {name}"), f64::from(texel.rays), expected, 0.0, 1)
    };
    let mut findings = vec![rays("0", &whole, 5167.0)];
    for ((name, texel, change), (count, error)) in
        cut.iter().zip([(36.0, 6.3e-10), (14.0, 2.7e-6), (10.0, 3.1e-6)])
    {
        findings.push(rays(name, texel, count));
        let what = format!("change by a cut-off of {name}");
        findings.push(Finding::near(what, *change, error, rounding + 5e-8, 1));
    }
    for (name, texel, change) in &cut {
        let what = format!("change beyond its certified bound, cut-off {name}");
        findings.push(Finding::at_most(what, change - f64::from(texel.bound), rounding, 1));
    }
    Ok(findings)
}
