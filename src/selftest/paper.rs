//! Optics on paper: the textbook's formulae in f64, and how far rounding may put a device off them.

use glam::DVec3;

use super::Device;
use crate::layout::constants::ROUNDOFF_F32;

/// Refractive index of ice in the visible.
pub(super) const ICE: f64 = 1.31;
/// Refractive index of water in the visible.
pub(super) const WATER: f64 = 1.333;

/// By how many roundoffs one refraction at a flat face may turn a ray, for indices up to 4/3 and g = η cos θt of 1. To
/// first order: c = −d·n is off by 4 (three products, their sums, the rounded normal); the square of η by 2η² (its
/// own rounding), (η−1)(η+1) by 3 times itself, c² by 9; so g by 16.8/(2g) + g; the bend g − c by that, 4, and 3 times
/// itself; d − n·bend by that and 2; all is divided by η, and normalising adds 4.
const REFRACTION_ROUNDOFFS: f64 = 20.0;
/// By how many roundoffs one reflection turns a ray: twice the 4 of c, then 4 for c + c, the product, the sum and the
/// rounded normal that it is multiplied with.
const REFLECTION_ROUNDOFFS: f64 = 12.0;
/// By how many roundoffs of a face's extent a hit point, and the start of a ray there, are off: 7 for the point from
/// barycentrics (Pharr, Jakob, Humphreys, 4th ed., section 6.8.5), and 16 for leaving it.
const START_ROUNDOFFS: f64 = 24.0;

/// The roundoff that shows in a device's answers: its own, or that of the f32 that it answers in.
pub(super) fn unit(device: &dyn Device) -> f64 {
    device.roundoff().max(ROUNDOFF_F32)
}

/// How far so many refractions may turn a ray of which g = η cos θt is never below `least_g`, in radians.
pub(super) fn refraction_error(refractions: u32, least_g: f64, unit: f64) -> f64 {
    f64::from(refractions) * REFRACTION_ROUNDOFFS * unit / least_g.min(1.0)
}

/// How far so many reflections may turn a ray, in radians.
pub(super) fn reflection_error(reflections: u32, unit: f64) -> f64 {
    f64::from(reflections) * REFLECTION_ROUNDOFFS * unit
}

/// How far the start of a ray on a face may be off: `extent` is that of the face along all three axes, its edges and its
/// distance from the origin together.
pub(super) fn start_error(extent: f64, unit: f64) -> f64 {
    START_ROUNDOFFS * unit * extent
}

/// A number as devices get it.
pub(super) fn narrow(x: f64) -> f64 {
    f64::from(x as f32)
}

/// A vector as devices get it.
pub(super) fn narrow3(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

/// A device's vector.
pub(super) fn widen3(v: [f32; 3]) -> DVec3 {
    glam::Vec3::from_array(v).as_dvec3()
}

/// The angle between two vectors in radians, good for small ones too (Kahan 2006, "How futile are mindless
/// assessments of roundoff", section 12).
pub(super) fn angle(a: DVec3, b: DVec3) -> f64 {
    let (a, b) = (a.normalize(), b.normalize());
    2.0 * (a - b).length().atan2((a + b).length())
}

/// The cosine behind an interface of η = n₂/n₁, for the cosine before it; none for total reflection (Snell).
pub(super) fn refract(c: f64, eta: f64) -> Option<f64> {
    let squared = 1.0 - (1.0 - c * c) / (eta * eta);
    (squared >= 0.0).then(|| squared.sqrt())
}

/// Fresnel reflectance of unpolarised light, each polarisation for itself (Born and Wolf, section 1.5.2).
pub(super) fn reflectance(c: f64, eta: f64) -> f64 {
    let Some(behind) = refract(c, eta) else { return 1.0 };
    let across = (c - eta * behind) / (c + eta * behind);
    let along = (eta * c - behind) / (eta * c + behind);
    0.5 * (across * across + along * along)
}

/// Reflectance at normal incidence.
pub(super) fn normal_reflectance(eta: f64) -> f64 {
    ((eta - 1.0) / (eta + 1.0)).powi(2)
}

/// The largest of many; not a number if one of them is none.
pub(super) fn greatest(figures: impl IntoIterator<Item = f64>) -> f64 {
    let mut worst = 0.0;
    for figure in figures {
        if figure.is_nan() {
            return figure;
        }
        worst = f64::max(worst, figure);
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_textbook_gives_the_known_values() {
        let close = |a: f64, b: f64, digits: f64| assert!((a - b).abs() <= digits, "{a} is not {b}");
        close(normal_reflectance(ICE), 0.018_009_4, 1e-7);
        close(normal_reflectance(WATER), 0.020_373_2, 1e-7);
        close(normal_reflectance(WATER / ICE), 7.573e-5, 1e-8);
        close(reflectance(1.0, ICE), normal_reflectance(ICE), 1e-15);
        close(reflectance(0.5, 1.0 / ICE), 1.0, 1e-15);
    }

    #[test]
    fn one_figure_that_is_no_number_spoils_the_greatest() {
        assert_eq!(greatest([1.0, 3.0, 2.0]), 3.0);
        assert!(greatest([1.0, f64::NAN]).is_nan());
        assert!(greatest([f64::NAN, 1.0]).is_nan());
    }
}
