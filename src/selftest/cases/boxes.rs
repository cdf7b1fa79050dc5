//! T3: boxes are never missed.
//!
//! The judge is exact. All coordinates are multiples of 2^-10 below 2^4, so that their differences are exact, and a
//! difference times a direction's component takes 14 + 24 bits: f64 holds it. A ray meets a box in the interval in which it is
//! between all three pairs of planes, and two of its ends, fractions of exact numbers, are compared by exact products.
//!
//! A device must meet every box that the exact ray meets, unless rounding may decide: it may where the exact ray passes
//! nearer to the box's silhouette than 2^-16 of the distance, which is above all rounding of the triangle test (16 roundoffs
//! where the driver may rewrite). Rays along an axis, up to what vanishes in any sum, are not rounded at all: those must
//! meet whatever they exactly touch. The bound is 0.

use glam::DVec3;

use crate::scene::{Material, MaterialId, Mesh, Model, Scene};
use crate::selftest::{Case, Device, DeviceError, Effort, Escape, Finding, Random, Stage, Walk};

/// Flat boxes and boxes that a ray starts on, against exact arithmetic.
pub(super) const T3: Case = Case {
    id: "T3",
    title: "boxes are never missed",
    claim: "no box that the exact ray meets is missed, flat ones too, by rays that start on a face, an edge or a corner and \
            have components of 0, -0, 1e-40 and 1e-38",
    run: false_misses,
};

/// Components that are 0, vanish, or are flushed by some devices.
const TINY: [f32; 6] = [0.0, -0.0, 1e-40, -1e-40, 1e-38, -1e-38];
/// How near the silhouette rounding may decide, relative to the distance.
const MARGIN: f64 = 1.0 / 65_536.0;
/// Coordinates are multiples of this.
const GRID: f64 = 1.0 / 1024.0;

/// An axis-aligned box; flat where `lo` equals `hi` on an axis.
#[derive(Debug, Clone, Copy)]
struct Cuboid {
    lo: DVec3,
    hi: DVec3,
}

fn false_misses(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let boxes = match effort {
        Effort::Quick => 12,
        Effort::Short => 40,
        Effort::Long => 400,
    };
    let mut random = Random::new("boxes");
    let (mut missed, mut tried) = ([0usize; 2], [0usize; 2]);
    for index in 0..boxes {
        // Three flat ones, one for each axis, to one with a volume.
        let flat = index % 4;
        let cuboid = Cuboid::random(flat, &mut random);
        let stage = Stage::new(&scene(cuboid, flat))?;
        let rays: Vec<_> =
            (0..2000).map(|_| cuboid.ray(&mut random)).filter(|ray| cuboid.must_be_met(ray)).collect();
        let kind = usize::from(flat == 3);
        for walked in device.walk(&stage, &rays)? {
            missed[kind] += usize::from(walked.escape == Escape::Free && walked.faces == 0);
        }
        tried[kind] += rays.len();
    }
    let finding = |what, kind: usize| Finding::at_most(what, missed[kind] as f64, 0.0, tried[kind]);
    Ok(vec![finding("flat boxes missed", 0), finding("boxes with a volume missed", 1)])
}

/// The box alone, opaque; of a flat one only the two triangles that have an area.
fn scene(cuboid: Cuboid, flat: usize) -> Scene {
    let mut mesh = Mesh::cuboid(cuboid.lo, cuboid.hi);
    if flat < 3 {
        mesh.triangles = mesh.triangles[4 * flat..4 * flat + 2].to_vec();
    }
    Scene::of(vec![Material::black("paper")], vec![Model::of("box", mesh, MaterialId(0))])
}

impl Cuboid {
    /// Anywhere, of any size between 1/1024 and 4; without thickness along the axis `flat` if that is below 3.
    fn random(flat: usize, random: &mut Random) -> Self {
        let mut on_grid =
            |most: f64| DVec3::from_array([0; 3].map(|_| (random.between(0.0, most) / GRID).floor() * GRID));
        let lo = on_grid(8.0) - DVec3::splat(4.0);
        let mut size = on_grid(4.0) + DVec3::splat(GRID);
        if flat < 3 {
            size[flat] = 0.0;
        }
        Self { lo, hi: lo + size }
    }

    /// A ray from a corner, an edge, a face or elsewhere, along an axis, in a plane of two or anywhere.
    fn ray(self, random: &mut Random) -> Walk {
        let mut origin = DVec3::ZERO;
        let mut direction = random.direction().as_vec3();
        for axis in 0..3 {
            origin[axis] = match random.below(4) {
                0 => self.lo[axis],
                1 => self.hi[axis],
                2 => self.lo[axis] + (random.fraction() * (self.hi - self.lo)[axis] / GRID).floor() * GRID,
                _ => self.lo[axis] + (random.between(-2.0, 2.0) / GRID).floor() * GRID,
            };
            if random.below(2) == 0 {
                direction[axis] = TINY[random.below(TINY.len() as u32) as usize];
            }
        }
        if direction.abs().max_element() < 0.01 {
            direction[random.below(3) as usize] = 1.0;
        }
        // Of unit length in all that counts; tiny components stay as they are.
        let length = direction.as_dvec3().length();
        let direction =
            direction.to_array().map(|d| if d.abs() > 1e-30 { (f64::from(d) / length) as f32 } else { d });
        Walk { origin: origin.as_vec3().to_array(), direction, media: 0, limit: 1 }
    }

    /// Whether the exact ray meets the box beyond its start, and rounding cannot say otherwise.
    fn must_be_met(self, ray: &Walk) -> bool {
        let (origin, direction) = (ray.origin.map(f64::from), ray.direction.map(f64::from));
        if direction.iter().filter(|d| d.abs() > 1e-30).count() == 1 {
            return self.is_met(origin, direction);
        }
        // Smaller by more than rounding; a flat side has nothing to lose.
        let reach =
            (0..3).map(|axis| (origin[axis] - self.lo[axis]).abs().max((origin[axis] - self.hi[axis]).abs()));
        let margin = MARGIN * reach.sum::<f64>();
        let margin = (margin / GRID).ceil() * GRID;
        let flat = (self.hi - self.lo).to_array().map(|size| size == 0.0);
        let shrink = DVec3::from_array(flat.map(|flat| if flat { 0.0 } else { margin }));
        let inner = Self { lo: self.lo + shrink, hi: self.hi - shrink };
        inner.lo.cmple(inner.hi).all() && inner.is_met(origin, direction) && !self.is_along_flat(direction)
    }

    /// Whether a direction lies in the plane of a flat box, or nearly so: it then has no crossing.
    fn is_along_flat(self, direction: [f64; 3]) -> bool {
        (0..3).any(|axis| self.lo[axis] == self.hi[axis] && direction[axis].abs() < 1e-3)
    }

    /// Whether the exact ray meets the box beyond its start.
    fn is_met(self, origin: [f64; 3], direction: [f64; 3]) -> bool {
        // Ends of the interval as fractions with a denominator above 0.
        let (mut entry, mut exit) = ((0.0, 1.0), None);
        for axis in 0..3 {
            let (lo, hi, d) = (self.lo[axis] - origin[axis], self.hi[axis] - origin[axis], direction[axis]);
            if d == 0.0 {
                if lo > 0.0 || hi < 0.0 {
                    return false;
                }
                continue;
            }
            let (near, far) = if d > 0.0 { ((lo, d), (hi, d)) } else { ((-hi, -d), (-lo, -d)) };
            if less(entry, near) {
                entry = near;
            }
            if exit.is_none_or(|exit| less(far, exit)) {
                exit = Some(far);
            }
        }
        // A flat box that the ray starts on is not met again.
        exit.is_some_and(|exit| exit.0 > 0.0 && !less(exit, entry)) && !self.is_along_flat(direction)
    }
}

/// Whether a/b < c/d, for b and d above 0: exact, since the products are.
fn less((a, b): (f64, f64), (c, d): (f64, f64)) -> bool {
    a * d < c * b
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Cuboid = Cuboid { lo: DVec3::ZERO, hi: DVec3::ONE };

    #[test]
    fn the_judge_counts_boundaries_and_not_what_lies_behind() {
        assert!(UNIT.is_met([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]));
        assert!(UNIT.is_met([0.0, 0.0, 0.0], [0.0, 1e-40, 1.0]));
        assert!(!UNIT.is_met([0.0, 0.0, -1.0], [0.0, -1e-40, 1.0]));
        assert!(!UNIT.is_met([0.5, 0.5, 1.0], [0.0, 0.0, 1.0]));
        let flat = Cuboid { hi: DVec3::new(1.0, 1.0, 0.0), ..UNIT };
        assert!(flat.is_met([0.0, 1.0, -1.0], [0.0, -0.0, 1.0]));
        assert!(!flat.is_met([0.0, 0.5, 0.0], [1.0, 0.0, 0.0]));
    }
}
