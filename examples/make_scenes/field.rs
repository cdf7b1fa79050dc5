//! Signed fields: negative inside the matter, about the distance to its surface nearby.

use glam::DVec3;

/// A field over space.
pub(crate) trait Field: Fn(DVec3) -> f64 + Sync {}
impl<F: Fn(DVec3) -> f64 + Sync> Field for F {}

/// Gradient by central differences; the step suits fields that vary over hundredths of a unit.
pub(crate) fn gradient(field: &impl Field, p: DVec3) -> DVec3 {
    const STEP: f64 = 1e-4;
    let along = |axis: DVec3| (field(p + STEP * axis) - field(p - STEP * axis)) / (2.0 * STEP);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
}

/// The greater of two fields with its crease rounded over `width` (Quilez, smooth minimum, polynomial form).
pub(crate) fn smooth_max(a: f64, b: f64, width: f64) -> f64 {
    let overlap = (width - (a - b).abs()).max(0.0);
    a.max(b) + overlap * overlap / (4.0 * width)
}

/// The half space on the far side of a plane at `distance` from the origin along `normal`.
pub(crate) fn half_space(p: DVec3, normal: DVec3, distance: f64) -> f64 {
    p.dot(normal.normalize()) - distance
}

/// 0 below `lo`, 1 above `hi`, smooth between.
pub(crate) fn smoothstep(lo: f64, hi: f64, x: f64) -> f64 {
    let t = ((x - lo) / (hi - lo)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
