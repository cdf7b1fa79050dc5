//! Where total internal reflection sets in.

use crate::selftest::paper::{ICE, WATER, greatest, reflectance, unit};
use crate::selftest::{Case, Device, DeviceError, Effort, Finding};

/// T6.
pub(super) const T6: Case = Case {
    id: "T6",
    title: "at the critical angle",
    claim: "within 64 ULP of the critical angle reflectance is in [0, 1], turns total once, and is that of a cosine \
            within 2 ULP (8 where the driver rewrites sums)",
    run: t6,
};

/// The critical angles of hard-cases.md.
pub(super) const C2: Case = Case {
    id: "C2",
    title: "critical angles",
    claim: "total reflection sets in at asin(1/n): 49.761° from ice to air, 48.607° from water to air (Snell's window), \
            79.341° from water to ice",
    run: c2,
};

/// From a denser medium to a rarer one.
const INTERFACES: [(&str, f64, f64); 3] =
    [("ice to air", ICE, 1.0), ("water to air", WATER, 1.0), ("water to ice", WATER, ICE)];
/// Neighbours of the critical cosine on either side.
const NEIGHBOURS: i32 = 64;

/// The answers of a device around a critical angle.
struct Onset {
    /// n₂/n₁ as devices divide it.
    eta: f32,
    /// Cosines, each the next number after the one before.
    cosines: Vec<f32>,
    /// Reflectances; none where total.
    answers: Vec<Option<f32>>,
}

impl Onset {
    fn ask(device: &mut dyn Device, denser: f64, rarer: f64) -> Result<Self, DeviceError> {
        let eta = rarer as f32 / denser as f32;
        let critical = (1.0 - f64::from(eta).powi(2)).sqrt() as f32;
        let cosines: Vec<f32> = (-NEIGHBOURS..=NEIGHBOURS).map(|k| step(critical, k)).collect();
        let queries: Vec<_> = cosines.iter().map(|&cosine| [cosine, eta]).collect();
        let answers = device.fresnel(&queries)?;
        Ok(Self { eta, cosines, answers })
    }

    /// How often the answer turns from total to partial or back.
    fn turns(&self) -> usize {
        self.answers.windows(2).filter(|pair| pair[0].is_some() != pair[1].is_some()).count()
    }

    /// Answers outside of [0, 1].
    fn absurd(&self) -> usize {
        self.answers.iter().flatten().filter(|&&r| !(0.0..=1.0).contains(&r)).count()
    }

    /// How far the answers are off a reflectance of any cosine within `ulps`: it falls with the cosine, so those at both
    /// ends hold the others between them.
    fn error(&self, ulps: i32) -> f64 {
        let eta = f64::from(self.eta);
        let truth = |cosine: f32, k: i32| reflectance(f64::from(step(cosine, k)), eta);
        greatest(self.cosines.iter().zip(&self.answers).map(|(&cosine, answer)| {
            let found = f64::from(answer.unwrap_or(1.0));
            (found - found.clamp(truth(cosine, ulps), truth(cosine, -ulps))).abs()
        }))
    }

    /// The angle of the last total reflection, in degrees.
    fn angle(&self) -> f64 {
        let mut total = self.cosines.iter().zip(&self.answers).filter(|(_, answer)| answer.is_none());
        total.next_back().map_or(f64::NAN, |(&cosine, _)| f64::from(cosine).acos().to_degrees())
    }
}

/// The k-th f32 after a positive one.
fn step(x: f32, k: i32) -> f32 {
    f32::from_bits(x.to_bits().wrapping_add_signed(k))
}

/// g² = (η−1)(η+1) + c² is the difference of two nearly equal numbers. η − 1 is exact there (Sterbenz), so the
/// product is off by 2u and c² and the sum by u each: 4u of c², which is what a change of c by 2u of itself makes of it,
/// and that is 2 ULP at most. A driver that rewrites the sum, at twice that u, as η² − 1 + c² gets 8. For a cosine so
/// near the reflectance of the device's own c is then rounded like any other: 3e-7 is 5u.
fn t6(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let ulps = if device.is_exact() { 2 } else { 8 };
    let mut findings = Vec::new();
    for (name, denser, rarer) in INTERFACES {
        let onset = Onset::ask(device, denser, rarer)?;
        let trials = onset.cosines.len();
        let absurd = onset.absurd() as f64;
        findings.extend([
            Finding::at_most(format!("reflectances outside of [0, 1], {name}"), absurd, 0.0, trials),
            Finding::near(
                format!("onsets of total reflection, {name}"),
                onset.turns() as f64,
                1.0,
                0.0,
                trials,
            ),
            Finding::at_most(
                format!("reflectance off that of any cosine within {ulps} ULP, {name}"),
                onset.error(ulps),
                3e-7,
                trials,
            ),
        ]);
    }
    Ok(findings)
}

/// A cosine that is off by δ puts the angle off by δ/sin θ. It is found to one ULP, at most 2u of it, and is itself off
/// by 4u as in T6 (8 ULP where the driver rewrites sums); η is off by its own u.
fn c2(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let roundoffs = if device.is_exact() { 6.0 } else { 18.0 };
    let mut findings = Vec::new();
    for (name, denser, rarer) in INTERFACES {
        let onset = Onset::ask(device, denser, rarer)?;
        let (sine, trials) = (rarer / denser, onset.cosines.len());
        let cosine = (1.0 - sine * sine).sqrt();
        let within = unit(device) * (roundoffs * cosine / sine + 2.0 * sine / cosine);
        let expected = sine.asin().to_degrees();
        let what = format!("critical angle in degrees, {name}");
        findings.push(Finding::near(what, onset.angle(), expected, within.to_degrees(), trials));
    }
    Ok(findings)
}
