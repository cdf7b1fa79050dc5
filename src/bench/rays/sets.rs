//! The rays that a picture of a mesh would trace.

use glam::DVec3;
use rayon::prelude::*;

use super::{RayRecord, RayStage};
use crate::cpu::{Cast, morton_order};
use crate::kernel::Vec3;
use crate::kernel::bvh::make_ray;
use crate::layout::constants::{FAR, NONE};

/// Width and height of the picture in pixels.
pub const SIDE: u32 = 1024;

/// By this part of the scene's diagonal rays that leave a face start above it, on the side they came from: other engines
/// cannot be told which face a ray leaves.
const LIFT: f64 = 1e-5;

/// This much of the way to the light counts: a light may stand on a face.
const WAY_TO_LIGHT: f64 = 0.9999;

/// The four sets, in the order of the pixels along a Morton curve.
#[derive(Debug, Clone)]
pub struct RaySets {
    /// P: one through the middle of every pixel.
    pub primary: Vec<RayRecord>,
    /// R: mirrored off what those hit.
    pub reflected: Vec<RayRecord>,
    /// D: off the same points, distributed by the cosine. The two numbers of pixel i are PCG's (O'Neill 2014, its 32-bit
    /// output function as in Jarzynski and Olano 2020) from the seed i · 2654435761 + 12345, i counted along rows.
    pub diffuse: Vec<RayRecord>,
    /// S: from the same points to the light.
    pub shadow: Vec<RayRecord>,
}

impl RaySets {
    /// Of a stage's picture of `side` by `side` pixels: [`SIDE`], but for tests.
    #[must_use]
    pub fn of(stage: &RayStage, side: u32) -> Self {
        let pixels = morton_order(side, side);
        let primary: Vec<RayRecord> = pixels.par_iter().map(|&pixel| primary(stage, side, pixel)).collect();
        let off: Vec<[RayRecord; 3]> = primary
            .par_iter()
            .zip(&pixels)
            .filter_map(|(ray, &pixel)| secondary(stage, ray, pixel[1] * side + pixel[0]))
            .collect();
        let set = |index: usize| off.iter().map(|rays| rays[index]).collect();
        Self { reflected: set(0), diffuse: set(1), shadow: set(2), primary }
    }

    /// The sets by their letters, and whether only any hit is asked for.
    #[must_use]
    pub fn by_letter(&self) -> [(&'static str, &[RayRecord], super::Query); 4] {
        use super::Query::{Any, Nearest};
        [
            ("P", &self.primary, Nearest),
            ("R", &self.reflected, Nearest),
            ("D", &self.diffuse, Nearest),
            ("S", &self.shadow, Any),
        ]
    }
}

fn record(origin: DVec3, direction: DVec3, tmax: f64) -> RayRecord {
    RayRecord {
        origin: origin.as_vec3().to_array(),
        tmin: 0.0,
        direction: direction.as_vec3().to_array(),
        tmax: tmax as f32,
    }
}

fn primary(stage: &RayStage, side: u32, [column, row]: [u32; 2]) -> RayRecord {
    let middle = |pixel: u32| (f64::from(pixel) + 0.5) / f64::from(side) * 2.0 - 1.0;
    let direction = stage.forward + stage.right * middle(column) - stage.up * middle(row);
    record(stage.eye, direction.normalize(), FAR)
}

/// The mirrored, the scattered and the shadow ray where a primary one hits.
fn secondary(stage: &RayStage, ray: &RayRecord, pixel: u32) -> Option<[RayRecord; 3]> {
    let [origin, direction] = [ray.origin, ray.direction].map(Vec3::load);
    let hit = stage.wide.intersect(&make_ray(&stage.world(), origin, direction, NONE), ray.tmax);
    if hit.id == NONE {
        return None;
    }
    let tri = &stage.scene.triangles[hit.index as usize];
    let [a, b, c] = [tri.v0, tri.v1, tri.v2].map(|v| DVec3::from(v.map(f64::from)));
    let d = DVec3::from(ray.direction.map(f64::from));
    let across = (b - a).cross(c - a).normalize_or_zero();
    let normal = if across.dot(d) > 0.0 { -across } else { across };
    let [lo, hi] = [stage.view.scene_lo, stage.view.scene_hi].map(|v| DVec3::from(v.map(f64::from)));
    let point = DVec3::from(ray.origin.map(f64::from)) + d * f64::from(hit.t);
    let start = point + normal * (LIFT * (hi - lo).length());
    let to_light = stage.light - start;
    let distance = to_light.length();
    Some([
        record(start, (d - normal * (2.0 * normal.dot(d))).normalize_or(normal), FAR),
        record(start, scattered(normal, pixel), FAR),
        record(start, to_light / distance.max(f64::MIN_POSITIVE), distance * WAY_TO_LIGHT),
    ])
}

/// A direction about a normal by the cosine: the normal plus a point of the unit sphere.
fn scattered(normal: DVec3, pixel: u32) -> DVec3 {
    let mut state = pixel.wrapping_mul(2_654_435_761).wrapping_add(12345);
    pcg(&mut state);
    let height = 2.0 * pcg(&mut state) - 1.0;
    let turn = std::f64::consts::TAU * pcg(&mut state);
    let radius = (1.0 - height * height).max(0.0).sqrt();
    let point = DVec3::new(radius * turn.cos(), radius * turn.sin(), height);
    (normal + point).try_normalize().unwrap_or(normal)
}

/// The next number in [0, 1), of 24 bits.
fn pcg(state: &mut u32) -> f64 {
    let old = *state;
    *state = old.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((old >> ((old >> 28) + 4)) ^ old).wrapping_mul(277_803_737);
    f64::from(((word >> 22) ^ word) >> 8) / f64::from(1 << 24)
}

impl From<&RayRecord> for Cast {
    fn from(ray: &RayRecord) -> Self {
        Self { origin: ray.origin, limit: ray.tmax, direction: ray.direction, origin_face: NONE }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scattered_rays_are_distributed_by_the_cosine() {
        let heights: Vec<f64> = (0..10_000).map(|pixel| scattered(DVec3::Z, pixel).z).collect();
        let mean = heights.iter().sum::<f64>() / 10_000.0;
        // ∫ cos² over the hemisphere ÷ π.
        assert!((mean - 2.0 / 3.0).abs() < 0.01 && heights.iter().all(|&z| z >= 0.0), "{mean}");
    }
}
