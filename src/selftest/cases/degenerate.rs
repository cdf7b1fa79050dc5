//! T15: triangles that are hardly any.
//!
//! With the edge functions of relative error e (three roundoffs each: shear, product, difference) a barycentric weight of a
//! triangle that is seen with height h and length L is off by about e·L²/(L·h): the point slides along the triangle by that
//! part of its length, so that it stays on the triangle, but leaves the ray by up to aspect·L·3 roundoffs. Bound: 4 of
//! them, with the distance for the length where that is greater. The aspect is that of the triangle as the ray sees it: one
//! that is met at a grazing angle is foreshortened, and hides more of its height than of its length.

use glam::DVec3;

use crate::layout::constants::NONE;
use crate::scene::{Material, MaterialId, Mesh, Model, Scene};
use crate::selftest::{Case, Device, DeviceError, Effort, Finding, Random, Stage, Walk, Walked};

/// Slivers, needles, and triangles without area.
pub(super) const T15: Case = Case {
    id: "T15",
    title: "hardly any triangles",
    claim: "triangles without area, with a repeated corner, a million times as long as high or with almost collinear corners \
            are missed or met where the exact ray meets them, and nothing is NaN",
    run: degenerate,
};

/// Distance from which rays are aimed.
const DISTANCE: f64 = 4.0;
/// Roundoffs of aspect times length by which a point may be off its ray.
const ROUNDOFFS: f64 = 4.0;

/// A triangle.
struct Sliver {
    corners: [DVec3; 3],
    has_area: bool,
}

fn degenerate(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let rays_each = effort.rays(64);
    let mut random = Random::new("slivers");
    let (mut broken, mut ghosts, mut off, mut met, mut tried) = (0, 0, 0.0f64, 0usize, 0usize);
    for kind in 0..4 {
        let slivers: Vec<_> = (0..100).map(|_| Sliver::random(kind, &mut random)).collect();
        let stage = stage(&slivers)?;
        let rays: Vec<_> = (0..100 * rays_each).map(|index| slivers[index % 100].ray(&mut random)).collect();
        let roundoff = device.roundoff().max(2f64.powi(-24));
        for (index, (ray, walked)) in rays.iter().zip(device.walk(&stage, &rays)?).enumerate() {
            let sliver = &slivers[index % 100];
            broken +=
                usize::from(!walked.point.iter().all(|x| x.is_finite()) || !walked.distance.is_finite());
            tried += 1;
            if walked.first != NONE {
                met += 1;
                ghosts += usize::from(!sliver.has_area);
                off = off.max(distance_off(ray, &walked) / (roundoff * sliver.aspect(ray) * DISTANCE));
            }
        }
    }
    Ok(vec![
        Finding::at_most("answers that are no numbers", broken as f64, 0.0, tried),
        Finding::at_most("hits on triangles without area", ghosts as f64, 0.0, tried),
        Finding::at_most(
            "distance of hit points from their rays, in roundoffs × aspect",
            off,
            ROUNDOFFS,
            met,
        ),
    ])
}

/// How far the hit point is off the ray.
fn distance_off(ray: &Walk, walked: &Walked) -> f64 {
    let from_start = widen(walked.point) - widen(ray.origin);
    let direction = widen(ray.direction).normalize();
    (from_start - direction * from_start.dot(direction)).length()
}

fn widen(v: [f32; 3]) -> DVec3 {
    glam::Vec3::from(v).as_dvec3()
}

/// The slivers far from each other, so that each ray has one to meet.
fn stage(slivers: &[Sliver]) -> Result<Stage, DeviceError> {
    let positions = slivers.iter().flat_map(|sliver| sliver.corners).collect();
    let triangles: Vec<_> = (0..slivers.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let model = Model::of("slivers", Mesh::of(positions, &triangles), MaterialId(0));
    Stage::new(&Scene::of(vec![Material::black("paper")], vec![model]))
}

impl Sliver {
    /// One of about unit size: without area, with a repeated corner, of aspect 1e6, or almost collinear.
    fn random(kind: u32, random: &mut Random) -> Self {
        let round = |v: DVec3| v.as_vec3().as_dvec3();
        let a = round(random.direction());
        let along = random.direction();
        let across = along.any_orthonormal_vector();
        let b = round(a + along);
        let c = match kind {
            0 => round(a.midpoint(b)),
            1 => a,
            2 => round(a + across * 1e-6),
            _ => round(a + along * random.fraction() + across * 10f64.powf(random.between(-7.0, -3.0))),
        };
        Self { corners: [a, b, c], has_area: kind != 1 && (b - a).cross(c - a) != DVec3::ZERO }
    }

    /// How many times it is as long as high, seen along a ray.
    fn aspect(&self, ray: &Walk) -> f64 {
        let direction = widen(ray.direction).normalize();
        let [a, b, c] = self.corners.map(|corner| corner - direction * corner.dot(direction));
        let length = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
        length / (b - a).cross(c - a).length()
    }

    /// A ray at a point of it.
    fn ray(&self, random: &mut Random) -> Walk {
        let [a, b, c] = self.corners;
        let [s, t] = random.barycentrics();
        let aim = a + (b - a) * s + (c - a) * t;
        let origin = (aim + random.direction() * DISTANCE).as_vec3();
        let direction = (aim - origin.as_dvec3()).normalize();
        Walk { origin: origin.to_array(), direction: direction.as_vec3().to_array(), media: 0, limit: 1 }
    }
}
