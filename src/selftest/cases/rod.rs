//! A round rod: its cross-section is a great circle of a ball, and a drop.

use glam::DVec3;

use crate::scene::{Material, Scene};
use crate::selftest::paper::{ICE, WATER, angle, refraction_error, start_error, unit, widen3};
use crate::selftest::props::{flatness, rod, smooth_body};
use crate::selftest::{Bend, Bent, Case, Device, DeviceError, Effort, Ending, Finding, Stage};

/// The ball lens.
pub(super) const C7: Case = Case {
    id: "C7",
    title: "ball lens",
    claim: "near the axis a ball focuses at nR/(2(n−1)) from its centre: 2.1129·R for ice, 2.0015·R for water",
    run: c7,
};

/// The rainbow.
pub(super) const C9: Case = Case {
    id: "C9",
    title: "rainbow",
    claim: "light that a drop (n = 1.333) reflects once inside comes back at 42.078° at most",
    run: c9,
};

/// Sides of the rod: so many that its faces lie within 3e-7 of the circle.
const SIDES: u32 = 4096;
/// Rays of the rainbow.
const RAYS: usize = 512;

/// A ray's angle to the smooth normal at a surface: the normal is that of the circle through the very point, but the
/// point lies on a flat face, up to the rod's flatness nearer to the axis, and as far off as any start. So the sine of
/// the angle is off by both, and the angle by that over the cosine.
fn surface_error(cosine: f64, unit: f64) -> f64 {
    (flatness(SIDES) + start_error(4.0, unit)) / cosine
}

/// A ray at height h enters at θ = asin h, is turned by 2(θ − θt) = δ, and its line passes the centre at h again: it
/// meets the axis at h/sin δ. Two such heights, a quarter and an eighth, are extrapolated to the axis; what is left is
/// of the fourth power of the height, below 0.4·h⁴ for these indices. The error of δ counts relative to it.
fn c7(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, n) in [("ice", ICE), ("water", WATER)] {
        let stage = stage(n)?;
        let heights = [1.0 / 8.0, 1.0 / 16.0];
        let rays = heights.map(|h| Bend::through(DVec3::new(-2.0, h, 0.01), DVec3::X));
        let bent = device.bend(&stage, &rays)?;
        let focus: Vec<f64> = bent.iter().map(|bent| axis_crossing(bent, 2)).collect();
        let expected = |h: f64| h / (2.0 * (h.asin() - (h / n).asin())).sin();
        let unit = unit(device);
        let bend = 2.0 * surface_error(1.0, unit) + refraction_error(2, 1.0, unit);
        let mut errors = Vec::new();
        for (&h, &found) in heights.iter().zip(&focus) {
            let deviation = 2.0 * (h.asin() - (h / n).asin());
            let within = expected(h) * (bend / deviation + (flatness(SIDES) + start_error(4.0, unit)) / h);
            let what = format!("crossing of the axis from a height of {h}, {name}");
            findings.push(Finding::near(what, found, expected(h), within, 1));
            errors.push(within);
        }
        let &[far, near] = focus.as_slice() else { continue };
        let paraxial = (4.0 * near - far) / 3.0;
        let within = (4.0 * errors[1] + errors[0]) / 3.0 + 0.4 * heights[0].powi(4);
        let what = format!("paraxial focal length, {name}");
        findings.push(Finding::near(what, paraxial, n / (2.0 * (n - 1.0)), within, 1));
    }
    Ok(findings)
}

/// Descartes' ray: its impact is √((4−n²)/3), and the deviation is stationary there. Rays within 0.01 of it are sent, so
/// that their spacing counts by its square: 1e-8. Three surfaces count, none steeper than the first.
fn c9(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let stage = stage(WATER)?;
    let descartes = ((4.0 - WATER * WATER) / 3.0).sqrt();
    let rays: Vec<Bend> = (0..RAYS)
        .map(|k| {
            let height = descartes + 0.02 * (k as f64 / RAYS as f64 - 0.5);
            Bend { reflect: 0b010, ..Bend::through(DVec3::new(-2.0, height, 0.01), DVec3::X) }
        })
        .collect();
    let bent = device.bend(&stage, &rays)?;
    let back =
        bent.iter().filter(|bent| bent.end == Ending::Free && bent.surfaces == 3 && bent.reflected == 0b010);
    let bow = |bent: &Bent| angle(DVec3::NEG_X, widen3(bent.direction)).to_degrees();
    let greatest = back.clone().map(bow).fold(0.0, f64::max);
    let [before, behind] = [descartes.asin(), (descartes / WATER).asin()];
    let expected = (4.0 * behind - 2.0 * before).to_degrees();
    let unit = unit(device);
    let cosine = (descartes + 0.01).asin().cos();
    let within = 3.0 * surface_error(cosine, unit) + refraction_error(3, cosine, unit) + 1e-8;
    Ok(vec![Finding::near("rainbow in degrees", greatest, expected, within.to_degrees(), back.count())])
}

fn stage(n: f64) -> Result<Stage, DeviceError> {
    Stage::new(&Scene::of(vec![Material::clear("rod", n)], vec![smooth_body(rod(SIDES, 1.0), 0, 0)]))
}

/// Where the line of a ray that met so many surfaces crosses y = 0.
fn axis_crossing(bent: &Bent, surfaces: u32) -> f64 {
    if bent.end != Ending::Free || bent.surfaces != surfaces {
        return f64::NAN;
    }
    let (point, direction) = (widen3(bent.origin), widen3(bent.direction));
    point.x - point.y * direction.x / direction.y
}
