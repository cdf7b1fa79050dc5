//! Holds dumped hits against brute force: every ray against every triangle in f64, without a tree, by plain linear algebra.
//!
//! `snellius bench --rays MESH.obj --dump DIR`, then `cargo run --release --example brute_force -- MESH.obj DIR`. A ray agrees
//! if both name the same face. It is a *tie* if it passes so near to an edge, or to another face at the same distance, that
//! rounding to f32 decides: each is listed. Anything else is a disagreement, and the exit code is 1. A minute on two cores
//! for 10⁶ rays and 10⁴ triangles.

#[path = "shared/verdict.rs"]
mod verdict;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use glam::DVec3;
use rayon::prelude::*;
use snellius::bench::rays::{RayAnswer, RayRecord, read_answers, read_rays};
use snellius::layout::constants::NONE;
use snellius::scene::Scene;

use crate::verdict::verdict;

/// Compare dumped hits with brute force in f64
#[derive(Debug, Parser)]
struct Arguments {
    /// The mesh that was traced
    mesh: PathBuf,
    /// Folder of MESH.{P,R,D,S}.rays and .hits
    folder: PathBuf,
    /// What rounding may decide: of barycentric weights, and of the distance from the mesh's farthest corner
    #[arg(long, default_value_t = 1e-5)]
    tolerance: f64,
    /// Ties to list, at most
    #[arg(long, default_value_t = 100)]
    list: usize,
}

fn main() -> ExitCode {
    verdict(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let faces = faces(&Scene::load(&arguments.mesh)?);
    let judge = Judge::new(&faces, arguments.tolerance);
    println!("{}: {} triangles", arguments.mesh.display(), faces.len());
    println!("| rays | of them | hits | agree | ties | disagree |\n|---|--:|--:|--:|--:|--:|");
    let (mut agree_everywhere, mut listed) = (true, Vec::new());
    for set in ["P", "R", "D", "S"] {
        let file = |end: &str| file(&arguments.mesh, &arguments.folder, set, end);
        let (rays, answers) = (read_rays(&file("rays"))?, read_answers(&file("hits"))?);
        if rays.len() != answers.len() {
            return Err(format!("{set}: {} rays, but {} hits", rays.len(), answers.len()).into());
        }
        let verdicts: Vec<Verdict> = rays
            .par_iter()
            .zip(&answers)
            .map(|(ray, answer)| judge.verdict(ray, answer, set == "S"))
            .collect();
        let count = |wanted: fn(&Verdict) -> bool| verdicts.iter().filter(|verdict| wanted(verdict)).count();
        let (ties, disagree) =
            (count(|v| matches!(v, Verdict::Tie(_))), count(|v| matches!(v, Verdict::Disagree(_))));
        let (of, hits) = (rays.len(), answers.iter().filter(|answer| answer.is_hit()).count());
        println!("| {set} | {of} | {hits} | {} | {ties} | {disagree} |", of - ties - disagree);
        agree_everywhere &= disagree == 0;
        listed.extend(verdicts.iter().enumerate().filter_map(|(ray, verdict)| match verdict {
            Verdict::Agree => None,
            Verdict::Tie(why) => Some(format!("tie: {set} {ray}: {why}")),
            Verdict::Disagree(why) => Some(format!("disagree: {set} {ray}: {why}")),
        }));
    }
    println!();
    listed.sort();
    listed.iter().take(arguments.list).for_each(|line| println!("{line}"));
    if listed.len() > arguments.list {
        println!("… and {} more: --list N", listed.len() - arguments.list);
    }
    Ok(agree_everywhere)
}

/// `DIR/MESH.SET.END`.
fn file(mesh: &Path, folder: &Path, set: &str, end: &str) -> PathBuf {
    let stem = mesh.file_stem().unwrap_or(mesh.as_os_str()).to_string_lossy();
    folder.join(format!("{stem}.{set}.{end}"))
}

/// A triangle as a corner, two edges.
struct Face {
    corner: DVec3,
    edges: [DVec3; 2],
}

/// All triangles as they are traced: with corners in f32.
fn faces(scene: &Scene) -> Vec<Face> {
    let meshes = scene.models.iter().map(|model| &model.mesh);
    let triangles = meshes.flat_map(|mesh| {
        mesh.triangles.iter().map(|triangle| {
            triangle.positions.map(|index| mesh.positions[index as usize].as_vec3().as_dvec3())
        })
    });
    triangles.map(|[a, b, c]| Face { corner: a, edges: [b - a, c - a] }).collect()
}

enum Verdict {
    Agree,
    Tie(String),
    Disagree(String),
}

/// Where a ray crosses a triangle's plane.
#[derive(Clone, Copy)]
struct Crossing {
    t: f64,
    /// The least barycentric weight: negative outside.
    inside: f64,
}

/// Every ray against every triangle.
struct Judge<'a> {
    faces: &'a [Face],
    tolerance: f64,
    /// The greatest coordinate.
    extent: f64,
}

impl<'a> Judge<'a> {
    fn new(faces: &'a [Face], tolerance: f64) -> Self {
        let corners = faces
            .iter()
            .flat_map(|face| [face.corner, face.corner + face.edges[0], face.corner + face.edges[1]]);
        let extent = corners.map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        Self { faces, tolerance, extent }
    }

    fn verdict(&self, ray: &RayRecord, answer: &RayAnswer, any: bool) -> Verdict {
        let [origin, direction] = [ray.origin, ray.direction].map(|v| DVec3::from(v.map(f64::from)));
        let limit = f64::from(ray.tmax);
        let mut best = (f64::INFINITY, NONE);
        for (index, face) in self.faces.iter().enumerate() {
            let crossing = cross(face, origin, direction);
            if crossing.inside >= 0.0 && crossing.t > 0.0 && crossing.t < limit && crossing.t < best.0 {
                best = (crossing.t, index as u32);
            }
        }
        let same = if any { answer.is_hit() == (best.1 != NONE) } else { answer.face == best.1 };
        if same {
            return Verdict::Agree;
        }
        let words = format!("face {}, in f64 {} at {}", name(answer.face), name(best.1), best.0);
        if self.is_tie(origin, direction, limit, answer, best, any) {
            Verdict::Tie(words)
        } else {
            Verdict::Disagree(words)
        }
    }

    /// Whether faces that the ray crosses within rounding, at the least distance within rounding, explain both answers.
    fn is_tie(
        &self,
        origin: DVec3,
        direction: DVec3,
        limit: f64,
        answer: &RayAnswer,
        best: (f64, u32),
        any: bool,
    ) -> bool {
        let slack = self.tolerance * (self.extent + origin.abs().max_element());
        let near = |crossing: &Crossing| {
            crossing.inside >= -self.tolerance && crossing.t > -slack && crossing.t < limit + slack
        };
        let sure = |crossing: &Crossing| {
            crossing.inside >= self.tolerance && crossing.t > slack && crossing.t < limit - slack
        };
        let crossings = || self.faces.iter().map(|face| cross(face, origin, direction));
        // The nearest that no rounding loses: whatever lies clearly behind it is wrong.
        let end = crossings().filter(sure).map(|crossing| crossing.t).fold(f64::INFINITY, f64::min);
        let possible = |face: u32| {
            face == NONE && end == f64::INFINITY
                || self.faces.get(face as usize).is_some_and(|face| {
                    let crossing = cross(face, origin, direction);
                    near(&crossing) && crossing.t <= end + slack
                })
        };
        if any {
            // One of them says that nothing is hit, the other that something is.
            return end == f64::INFINITY && crossings().any(|crossing| near(&crossing));
        }
        possible(answer.face) && possible(best.1)
    }
}

/// By Cramer's rule (Möller and Trumbore 1997, section 2); nowhere near for a ray along the plane.
fn cross(face: &Face, origin: DVec3, direction: DVec3) -> Crossing {
    let [e1, e2] = face.edges;
    let p = direction.cross(e2);
    let determinant = e1.dot(p);
    let s = origin - face.corner;
    let q = s.cross(e1);
    let (u, v, t) = (s.dot(p) / determinant, direction.dot(q) / determinant, e2.dot(q) / determinant);
    let inside = u.min(v).min(1.0 - u - v);
    if inside.is_nan() { Crossing { t: f64::INFINITY, inside: -1.0 } } else { Crossing { t, inside } }
}

fn name(face: u32) -> String {
    if face == NONE { "none".to_owned() } else { face.to_string() }
}
