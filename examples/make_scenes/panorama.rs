//! Equirectangular pictures of flat, softly edged lamps before a gradient.
//! +Y is up, the picture's centre looks towards −Z, +X lies to the right of that.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use image::{Rgb, Rgb32FImage};

use crate::field::smoothstep;

/// A rectangle of light, seen from the origin.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Panel {
    /// Towards its middle, its length the distance.
    pub(crate) centre: DVec3,
    /// Half its width and height, at that distance.
    pub(crate) half: DVec2,
    /// How far the light fades inwards from the edge.
    pub(crate) softness: f64,
    /// Radiance in the middle.
    pub(crate) radiance: DVec3,
}

impl Panel {
    /// Where a ray meets the panel, its middle the origin, x to the right and y up as seen from the origin.
    pub(crate) fn at(&self, direction: DVec3) -> Option<DVec2> {
        let normal = self.centre.normalize();
        let cos = direction.dot(normal);
        if cos <= 0.0 {
            return None;
        }
        let across = direction * (self.centre.length() / cos) - self.centre;
        let right = if normal.y.abs() < 0.99 { normal.cross(DVec3::Y).normalize() } else { DVec3::X };
        Some(DVec2::new(across.dot(right), across.dot(right.cross(normal))))
    }

    /// Its light along a direction.
    pub(crate) fn light(&self, direction: DVec3) -> DVec3 {
        let Some(p) = self.at(direction) else { return DVec3::ZERO };
        let inside = self.half - p.abs();
        let fade = |x: f64| smoothstep(0.0, self.softness, x);
        self.radiance * fade(inside.x) * fade(inside.y)
    }
}

/// Azimuth (0 towards −Z, positive towards +X) and elevation in degrees as a unit vector.
pub(crate) fn towards(azimuth: f64, elevation: f64) -> DVec3 {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
    DVec3::new(sin_a * cos_e, sin_e, -cos_a * cos_e)
}

/// Samples a radiance over all directions.
pub(crate) fn render(width: u32, radiance: impl Fn(DVec3) -> DVec3) -> Rgb32FImage {
    let height = width / 2;
    Rgb32FImage::from_fn(width, height, |x, y| {
        let azimuth = ((f64::from(x) + 0.5) / f64::from(width) - 0.5) * TAU;
        let elevation = (0.5 - (f64::from(y) + 0.5) / f64::from(height)) * PI;
        let light = radiance(towards(azimuth.to_degrees(), elevation.to_degrees()));
        Rgb(light.as_vec3().to_array())
    })
}
