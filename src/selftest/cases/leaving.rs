//! T4: what a ray leaves, it does not meet again.
//!
//! The bound is 0: a straight ray does not return to a plane, so a face that is left is not tested again, whatever rounding
//! would say of it. An offset alone cannot do it: the test of a triangle a million times as long as high errs by more than
//! the triangle's height. Directions go away from the exact face by an angle of at
//! least 1e-6: nearer, the rounded direction itself may point into it.

use glam::DVec3;

use crate::scene::{Material, MaterialId, Mesh, Model, Scene};
use crate::selftest::{Case, Device, DeviceError, Effort, Finding, Leave, Random, Stage};

/// Rays off triangles of every size, form and place.
pub(super) const T4: Case = Case {
    id: "T4",
    title: "what is left is not met again",
    claim: "no ray that leaves a triangle meets it, before or behind, at any angle down to 1e-6, for triangles with coordinates \
            of every magnitude from 1e-8 to 1e8",
    run: self_hits,
};

/// Least cosine to the normal, as a power of ten.
const GRAZING: f64 = -6.0;

fn self_hits(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let triangles = 1000;
    let per_triangle = effort.rays(100);
    let mut random = Random::new("leaving");
    let stage = soup(triangles, &mut random)?;
    let rays: Vec<_> = stage
        .flat
        .triangles
        .iter()
        .flat_map(|triangle| {
            let corners = [triangle.v0, triangle.v1, triangle.v2].map(|v| glam::Vec3::from(v).as_dvec3());
            let id = triangle.id;
            (0..per_triangle).filter_map(|_| leaving(id, corners, &mut random)).collect::<Vec<_>>()
        })
        .collect();
    let (mut hits, mut tried) = ([0usize; 2], [0usize; 2]);
    for (ray, left) in rays.iter().zip(device.leave(&stage, &rays)?) {
        let side = usize::from(ray.behind);
        hits[side] += usize::from(left.met == ray.id);
        tried[side] += 1;
    }
    let finding = |what, side: usize| Finding::at_most(what, hits[side] as f64, 0.0, tried[side]);
    Ok(vec![finding("self-hits on the same side", 0), finding("self-hits behind", 1)])
}

/// Triangles with coordinates ±10^U(−8, 8).
fn soup(count: u32, random: &mut Random) -> Result<Stage, DeviceError> {
    let positions =
        (0..3 * count).map(|_| DVec3::from_array([0; 3].map(|_| random.log_uniform(-8.0, 8.0)))).collect();
    let triangles: Vec<_> = (0..count).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]).collect();
    let model = Model::of("soup", Mesh::of(positions, &triangles), MaterialId(0));
    Stage::new(&Scene::of(vec![Material::black("paper")], vec![model]))
}

/// A ray off a point of a triangle, if its rounded direction is off the exact face.
fn leaving(id: u32, corners: [DVec3; 3], random: &mut Random) -> Option<Leave> {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    let side = if random.word() & 1 == 0 { normal } else { -normal };
    let tangent = side.cross(random.direction()).try_normalize()?;
    let cosine = 10f64.powf(random.between(GRAZING, 0.0));
    let leaving = (side * cosine + tangent * (1.0 - cosine * cosine).sqrt()).as_vec3();
    if leaving.as_dvec3().dot(side) < 0.5 * 10f64.powf(GRAZING) {
        return None;
    }
    let behind = random.word() & 1 == 0;
    let arriving = if behind { side } else { -side };
    let [b1, b2] = random.barycentrics();
    let arriving = arriving.as_vec3().to_array();
    Some(Leave { id, barycentrics: [b1 as f32, b2 as f32], arriving, leaving: leaving.to_array(), behind })
}
