//! T17: far from the origin the error is that of the coordinates, and no axis is special.
//!
//! A hit point is three corners times weights, and their sums: 7 roundoffs of the coordinates at most on each axis (Pharr,
//! Jakob, Humphreys, 4th ed., section 6.8.5), which is 3.5 units in the last place; one is added for the judge's
//! rounding to f32. The weights are off by roundoffs times the distance over the edge, which is a few times the distance in the
//! plane: 8 units at the origin, where nothing else counts. So 12 units of the largest of position and distance; twice that
//! where the driver may rewrite.
//!
//! The error then grows as the position does: slope 1 in a log-log plot, from 10² on, where the position outweighs the distance.

use glam::DVec3;

use crate::layout::{Intersector, Precision};
use crate::scene::{Material, MaterialId, Model, Scene};
use crate::selftest::{Case, CpuDevice, Device, DeviceError, Effort, Finding, Random, Stage, Walk, solids};

/// Moved far away, and turned by exchanging axes.
pub(super) const T17: Case = Case {
    id: "T17",
    title: "every place and axis alike",
    claim: "moved by 1 to 10^6 and with axes exchanged, hit points are off by a fixed number of units in the last place of their \
            coordinates",
    run: places,
};

/// Powers of ten by which the ball is moved.
const POWERS: std::ops::RangeInclusive<i32> = 0..=6;
/// Units in the last place by which a point may be off.
const UNITS: f64 = 12.0;
/// Distance from which rays are aimed.
const DISTANCE: f64 = 3.0;

fn places(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let rays = effort.rays(2000);
    let units = UNITS * device.roundoff().max(2f64.powi(-24)) / 2f64.powi(-24);
    let mut findings = Vec::new();
    let mut errors = Vec::new();
    for axis in 0..3 {
        let (mut worst, mut tried) = (0.0f64, 0);
        for power in POWERS {
            let place = turned(DVec3::new(1.0, 0.7, -1.3) * 10f64.powi(power), axis);
            let (error, met) = error(device, place, axis, rays)?;
            worst = worst.max(error / unit_in_last_place(place.abs().max_element().max(DISTANCE)));
            tried += met;
            errors.push((power, error));
        }
        let what = format!("error of hit points with axes shifted by {axis}, in units in the last place");
        findings.push(Finding::at_most(what, worst, units, tried));
    }
    if let Some(slope) = slope(&errors) {
        findings.push(Finding::near(
            "slope of error against position, both logarithmic",
            slope,
            1.0,
            0.2,
            errors.len(),
        ));
    }
    Ok(findings)
}

/// Greatest distance of hit points from where f64 has them, and how many rays met the same face.
fn error(
    device: &mut dyn Device,
    place: DVec3,
    axis: usize,
    rays: usize,
) -> Result<(f64, usize), DeviceError> {
    let mut mesh = solids::sphere(16);
    for position in &mut mesh.positions {
        *position = turned(*position, axis) + place;
    }
    let model = Model::of("ball", mesh, MaterialId(0));
    let stage = Stage::new(&Scene::of(vec![Material::black("paper")], vec![model]))?;
    let mut random = Random::new("places");
    let rays: Vec<_> = (0..rays).map(|_| towards(place, &stage, axis, &mut random)).collect();
    let judged = CpuDevice::new(Precision::F64, Intersector::Watertight).walk(&stage, &rays)?;
    let (mut worst, mut met) = (0.0f64, 0);
    for (found, judge) in device.walk(&stage, &rays)?.iter().zip(&judged) {
        if found.first == judge.first {
            met += 1;
            let off = glam::Vec3::from(found.point).as_dvec3() - glam::Vec3::from(judge.point).as_dvec3();
            worst = worst.max(off.abs().max_element());
        }
    }
    Ok((worst, met))
}

/// A ray at the middle of a face: near an edge points are moved off it, which is no error (`EDGE_OFFSETS`).
fn towards(place: DVec3, stage: &Stage, axis: usize, random: &mut Random) -> Walk {
    let triangles = &stage.flat.triangles;
    let triangle = &triangles[random.below(triangles.len() as u32) as usize];
    let corners = [triangle.v0, triangle.v1, triangle.v2].map(|corner| glam::Vec3::from(corner).as_dvec3());
    let aim = (corners[0] + corners[1] + corners[2]) / 3.0;
    let from = (aim - place).normalize_or(DVec3::X) + turned(random.direction(), axis) * 0.3;
    let origin = (aim + from * DISTANCE).as_vec3();
    let direction = (aim - origin.as_dvec3()).normalize();
    Walk { origin: origin.to_array(), direction: direction.as_vec3().to_array(), media: 0, limit: 1 }
}

/// The axes exchanged in a circle.
fn turned(v: DVec3, axis: usize) -> DVec3 {
    let [x, y, z] = v.to_array();
    DVec3::from_array([[x, y, z], [y, z, x], [z, x, y]][axis])
}

/// Of an f32 of that magnitude.
fn unit_in_last_place(x: f64) -> f64 {
    2f64.powf(x.log2().floor() - 23.0)
}

/// Of the line through log error against log position, from 10² on; none where there is no error.
fn slope(errors: &[(i32, f64)]) -> Option<f64> {
    let points: Vec<_> = errors
        .iter()
        .filter(|(power, _)| *power >= 2)
        .map(|&(power, e)| (f64::from(power), e.log10()))
        .collect();
    if points.is_empty() || points.iter().any(|(_, y)| !y.is_finite()) {
        return None;
    }
    let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / points.len() as f64;
    let (x0, y0) = (mean(&mut points.iter().map(|p| p.0)), mean(&mut points.iter().map(|p| p.1)));
    let spread: f64 = points.iter().map(|(x, _)| (x - x0).powi(2)).sum();
    Some(points.iter().map(|(x, y)| (x - x0) * (y - y0)).sum::<f64>() / spread)
}
