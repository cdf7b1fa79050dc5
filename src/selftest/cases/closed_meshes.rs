//! T1 and T2: nothing gets through the edges and corners of a closed mesh.
//!
//! A ray from inside must meet the surface, and must be outside when it meets no more of it: the bound is 0, for any
//! rounding, since two triangles compare the same products for their common edge and so cannot both call a ray outside
//! (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection", JCGT 2(1), section 3.3).
//!
//! At an edge a ray may meet two faces, one or, where it goes on behind one of them, jump over the other. Events are
//! idempotent, so that the next face mends it; how often it happens is reported.

use std::sync::Arc;

use glam::DVec3;

use crate::layout::constants::NONE;
use crate::layout::{FlatScene, Triangle};
use crate::scene::{Material, MaterialId, Mesh, Model, Scene};
use crate::selftest::{
    Case, Device, DeviceError, Effort, Escape, Finding, Random, Stage, Walk, Walked, solids,
};

/// Random, vertex and edge rays out of closed meshes.
pub(super) const T1: Case = Case {
    id: "T1",
    title: "closed meshes do not leak",
    claim: "no ray from inside a closed mesh gets out without meeting it: random rays, rays aimed at its exact vertices \
            and at points of its edges, near the origin and far from it",
    run: leaks,
};

/// The same under all orders of a triangle's corners.
pub(super) const T2: Case = Case {
    id: "T2",
    title: "in any order of corners",
    claim: "closed meshes do not leak whichever of its three corners each triangle begins with, and whichever way round \
            it names them",
    run: leaks_in_any_order,
};

/// Where meshes stand, and how large: around the origin, and where f32 has 1/64 between numbers.
const PLACES: [(&str, f64, DVec3); 2] =
    [("", 1.0, DVec3::ZERO), (" far out", 2.0, DVec3::new(148_376.0, 1_234.0, -223_423.0))];
/// Circles of latitude and longitude of a sphere.
const CIRCLES: u32 = 50;
/// Rays that are made at a time.
const BATCH: usize = 1 << 20;
/// Most faces that a ray may cross.
const LIMIT: u32 = 16;
/// The six orders of three corners: three that keep the winding, three that turn it.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// A closed mesh, and where rays start in it.
struct Subject {
    name: String,
    stage: Stage,
    centre: DVec3,
    /// Rays start within this distance of the centre.
    radius: f64,
    /// Media mask there, and outside.
    inside: u32,
    outside: u32,
    /// The faces that a ray meets first have lower ids.
    first_wall: u32,
}

fn leaks(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    // Eight meshes share the short run's time; a million rays each would take most of its minute.
    let rays = match effort {
        Effort::Quick => 12_500,
        Effort::Short => 250_000,
        Effort::Long => 10_000_000,
    };
    let mut findings = Vec::new();
    for (suffix, scale, centre) in PLACES {
        for subject in subjects(suffix, scale, centre)? {
            findings.extend(measure(device, &subject, rays)?);
        }
    }
    Ok(findings)
}

fn leaks_in_any_order(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let rays = effort.rays(5_000);
    let mut findings = Vec::new();
    for (suffix, scale, centre) in PLACES {
        for subject in subjects(suffix, scale, centre)? {
            for order in 0..ORDERS.len() {
                findings.extend(measure(device, &subject.reordered(order), rays)?);
            }
        }
    }
    Ok(findings)
}

/// The closed meshes at one place.
fn subjects(suffix: &str, scale: f64, centre: DVec3) -> Result<[Subject; 4], DeviceError> {
    let (ice, first_wall) = solids::hollow_ice(CIRCLES);
    let jittered = solids::jittered_sphere(CIRCLES, &mut Random::new("jittered sphere"));
    let subject = |name: &str, mesh: Mesh, first_wall: u32| {
        let model = Model::of(name, solids::placed(mesh, scale, centre), MaterialId(0));
        Ok::<_, DeviceError>(Subject {
            name: format!("{name}{suffix}"),
            stage: Stage::new(&Scene::of(vec![Material::clear("ice", 1.31)], vec![model]))?,
            centre,
            radius: 0.5 * scale,
            inside: u32::from(first_wall == NONE),
            outside: 0,
            first_wall,
        })
    };
    Ok([
        subject("cube", solids::cube(), NONE)?,
        subject("sphere", solids::sphere(CIRCLES), NONE)?,
        subject("jittered sphere", jittered, NONE)?,
        subject("hollow ice", ice, first_wall)?,
    ])
}

impl Subject {
    /// The same with the corners of each triangle in another order: over the six orders each triangle takes each of them,
    /// and neighbours begin differently. Where the winding is turned, inside and outside change places.
    fn reordered(&self, order: usize) -> Self {
        let turned = order >= 3;
        let mut random = Random::new("orders");
        let mut flat = self.stage.flat.clone();
        for triangle in Arc::make_mut(&mut flat.triangles) {
            let shift = random.below(3) as usize;
            let corners = [triangle.v0, triangle.v1, triangle.v2];
            let [a, b, c] = ORDERS[order / 3 * 3 + (order + shift) % 3];
            *triangle = Triangle { v0: corners[a], v1: corners[b], v2: corners[c], ..*triangle };
        }
        let (mut inside, mut outside) = (self.inside, self.outside);
        if turned {
            turn_normals(&mut flat);
            (inside, outside) = (1 - inside, 1 - outside);
        }
        Self {
            name: format!("{}, order {order}", self.name),
            stage: Stage { flat, ..self.stage.clone() },
            inside,
            outside,
            ..*self
        }
    }

    /// A ray from inside: in three equal parts random, at a vertex and at a point of an edge.
    fn ray(&self, kind: usize, random: &mut Random) -> Walk {
        let origin = self.centre + random.direction() * (self.radius * random.fraction());
        let origin = origin.as_vec3();
        let triangles = &self.stage.flat.triangles;
        let triangle = &triangles[random.below(triangles.len() as u32) as usize];
        let corners =
            [triangle.v0, triangle.v1, triangle.v2].map(|corner| glam::Vec3::from(corner).as_dvec3());
        let along = if kind % 3 == 1 { 0.0 } else { random.fraction() };
        let aim = corners[0].lerp(corners[1], along);
        let direction =
            if kind.is_multiple_of(3) { random.direction() } else { (aim - origin.as_dvec3()).normalize() };
        Walk {
            origin: origin.to_array(),
            direction: direction.as_vec3().to_array(),
            media: self.inside,
            limit: LIMIT,
        }
    }

    /// Whether a ray got through the wall around it.
    fn leaks(&self, walked: &Walked) -> bool {
        walked.first >= self.first_wall
    }

    /// Whether a ray has lost count of the faces that it crossed.
    fn is_lost(&self, walked: &Walked) -> bool {
        walked.escape == Escape::Limit || walked.media != self.outside
    }
}

fn turn_normals(flat: &mut FlatScene) {
    for face in Arc::make_mut(&mut flat.attributes) {
        face.normal = face.normal.map(|x| 0.0 - x);
    }
}

/// Leaks, double hits and lost rays among so many.
fn measure(device: &mut dyn Device, subject: &Subject, rays: usize) -> Result<[Finding; 3], DeviceError> {
    let mut random = Random::new(&subject.name);
    let (mut leaks, mut twice, mut lost) = (0usize, 0usize, 0usize);
    for first in (0..rays).step_by(BATCH) {
        let batch: Vec<_> =
            (first..rays.min(first + BATCH)).map(|kind| subject.ray(kind, &mut random)).collect();
        for walked in device.walk(&subject.stage, &batch)? {
            leaks += usize::from(subject.leaks(&walked));
            twice += usize::from(walked.idle > 0);
            lost += usize::from(subject.is_lost(&walked));
        }
    }
    let per_million = |count: usize| count as f64 * 1e6 / rays as f64;
    let name = &subject.name;
    Ok([
        Finding::at_most(format!("leaks of the {name}"), leaks as f64, 0.0, rays),
        Finding::reported(
            format!("rays per million that meet an edge of the {name} twice or never"),
            per_million(twice),
            rays,
        ),
        Finding::reported(
            format!("rays per million that leave the {name} in the wrong medium"),
            per_million(lost),
            rays,
        ),
    ])
}
