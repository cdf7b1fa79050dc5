//! Prisms.

use glam::DVec2;

use crate::scene::{Material, Scene};
use crate::selftest::paper::{ICE, angle, refraction_error, unit, widen3};
use crate::selftest::props::{body, extruded};
use crate::selftest::{Bend, Case, Device, DeviceError, Effort, Ending, Finding, Stage};

/// The halos.
pub(super) const C8: Case = Case {
    id: "C8",
    title: "minimum deviation of prisms",
    claim: "through two faces of ice at 60° light is turned by no less than 21.84° (the 22° halo), at 90° by no less than \
            45.73°",
    run,
};

/// Rays over a range of 0.04 rad around the symmetrical one.
const RAYS: usize = 512;

/// The deviation is stationary there, so that the spacing of the rays does not count: half of it, squared, times a
/// curvature below 4 is 1e-8. Each ray is turned by the error of two refractions; inside it is far from grazing, and
/// on leaving cos θ is that of entering.
fn run(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, wedge) in [("60°", 60f64), ("90°", 90.0)] {
        let half = wedge.to_radians() / 2.0;
        // The edge at the top, symmetric about x = 0.
        let (x, y) = half.sin_cos();
        let outline = [DVec2::ZERO, DVec2::new(-x, -y), DVec2::new(x, -y)];
        let scene = Scene::of(vec![Material::clear("ice", ICE)], vec![body(extruded(&outline, 1.0), 0, 0)]);
        let stage = Stage::new(&scene)?;
        // At minimum deviation the ray is level inside, and refracted at half the wedge.
        let incidence = (ICE * half.sin()).asin();
        let middle = DVec2::new(-x, -y) / 2.0;
        let rays: Vec<Bend> = (0..RAYS)
            .map(|k| {
                let angle = incidence + 0.04 * (k as f64 / RAYS as f64 - 0.5);
                // From the normal of the left face, which leans up by half the wedge.
                let direction = DVec2::from_angle(angle - half);
                Bend::through((middle - direction).extend(0.1), direction.extend(0.0))
            })
            .collect();
        let bent = device.bend(&stage, &rays)?;
        let through =
            rays.iter().zip(&bent).filter(|(_, bent)| bent.end == Ending::Free && bent.surfaces == 2);
        let deviation = |(ray, bent): (&Bend, &crate::selftest::Bent)| {
            angle(widen3(ray.direction), widen3(bent.direction))
        };
        let trials = through.clone().count();
        let least = through.map(deviation).fold(f64::INFINITY, f64::min).to_degrees();
        let expected = (2.0 * (incidence - half)).to_degrees();
        let within = refraction_error(2, (incidence + 0.02).cos(), unit(device)) + 1e-8;
        let what = format!("least deviation in degrees, {name}");
        findings.push(Finding::near(what, least, expected, within.to_degrees(), trials));
    }
    Ok(findings)
}
