//! Fresnel reflectance where its value is known on paper.

use crate::selftest::paper::{ICE, WATER, greatest, narrow, reflectance, unit};
use crate::selftest::{Case, Device, DeviceError, Effort, Finding};

/// Reflectances at angles with a name.
pub(super) const C1: Case = Case {
    id: "C1",
    title: "normal incidence",
    claim: "R = ((n−1)/(n+1))²: 0.0180094 for ice, 0.0203732 for water, 7.573e-5 between both",
    run: c1,
};

/// Brewster's angle.
pub(super) const C3: Case = Case {
    id: "C3",
    title: "Brewster's angle",
    claim: "where tan θ = n (52.643° for ice, 53.123° for water) one polarisation is not reflected at all, so that \
            R = ½((n²−1)/(n²+1))²",
    run: c3,
};

/// Roundoffs of a reflectance, of itself: (g−c)/(g+c) is off by 12, its square by 25; 1 + k² by as much again where
/// both polarisations count alike.
const REFLECTANCE_ROUNDOFFS: f64 = 50.0;

fn c1(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let interfaces = [("air to ice", ICE), ("air to water", WATER), ("ice to water", WATER / ICE)];
    let mut findings = Vec::new();
    for (name, eta) in interfaces {
        let found = device.fresnel(&[[1.0, eta as f32]])?;
        // The rounding of η is magnified by η/(η−1) where it is near 1: expect what the rounded one reflects.
        let expected = reflectance(1.0, narrow(eta));
        let within = REFLECTANCE_ROUNDOFFS * unit(device) * expected;
        let figure = found.first().copied().flatten().map_or(f64::NAN, f64::from);
        findings.push(Finding::near(format!("reflectance, {name}"), figure, expected, within, found.len()));
    }
    Ok(findings)
}

/// At the angle itself the reflectance is not stationary: the rounding of the cosine, u of it, counts by the slope, which
/// is below 1/4 in this range of indices.
fn c3(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, n) in [("ice", ICE), ("water", WATER)] {
        let cosine = 1.0 / (1.0 + n * n).sqrt();
        let found = device.fresnel(&[[cosine as f32, n as f32]])?;
        let expected = 0.5 * ((n * n - 1.0) / (n * n + 1.0)).powi(2);
        let within = unit(device) * (REFLECTANCE_ROUNDOFFS * expected + 0.5);
        let figure = found.first().copied().flatten().map_or(f64::NAN, f64::from);
        let what = format!("reflectance at {:.3}°, {name}", n.atan().to_degrees());
        findings.push(Finding::near(what, figure, expected, within, found.len()));
    }
    Ok(findings)
}

/// Light that only just touches a surface.
pub(super) const T8: Case = Case {
    id: "T8",
    title: "grazing reflectance",
    claim: "for cosines c ≤ 1e-3 from air, abs(R − (1 − 2c(1+n²)/√(n²−1))) ≤ 25c² + 5e-7",
    run: t8,
};

/// The next term of the expansion is 2(c(1+n²)/√(n²−1))² plus what the slope of cos θt adds: below 25c² for water and
/// ice. 5e-7 is 8u for the rounding of R.
fn t8(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let mut findings = Vec::new();
    for (name, n) in [("ice", ICE), ("water", WATER)] {
        let cosines: Vec<f32> = (0..=256).map(|k| 10f32.powf(-3.0 - k as f32 / 32.0)).collect();
        let queries: Vec<_> = cosines.iter().map(|&cosine| [cosine, n as f32]).collect();
        let answers = device.fresnel(&queries)?;
        let excess = cosines.iter().zip(answers).map(|(&c, answer)| {
            let c = f64::from(c);
            let expansion = 1.0 - 2.0 * c * (1.0 + n * n) / (n * n - 1.0).sqrt();
            (f64::from(answer.unwrap_or(f32::NAN)) - expansion).abs() - 25.0 * c * c
        });
        let what = format!("off the expansion by more than 25c², air to {name}");
        findings.push(Finding::at_most(what, greatest(excess), 5e-7, cosines.len()));
    }
    Ok(findings)
}
