//! From what a person wrote to what renderers read.
//!
//! [`flatten`] puts every model into world space, decides what is inside of what, merges faces that coincide,
//! gives all ids, and builds the hierarchy. [`view`] adds a camera.
//!
//! Ids follow the scene file: triangles are numbered model by model, copy by copy, in the order of the mesh.
//! Bodies are numbered transmissive first, by priority, so that a low id wins where bodies overlap.

use std::time::{Duration, Instant};

use crate::bvh::{self, Preset, Statistics};
use crate::layout::{FlatScene, FlatTexture, Light, Node, Triangle};
use crate::scene::{Background, Diagnostic, Falloff, Model, Scene, SceneError};

mod bodies;
mod copies;
mod coplanar;
mod distance;
mod edges;
mod faces;
mod materials;
mod merge;
mod normals;
mod number;
mod orient;
mod place;
mod radiance;
mod shells;
mod texels;
mod view;
mod winding;

pub use merge::Merged;
pub use view::view;
pub use winding::start_media;

use bodies::Bodies;
use faces::Faces;
use materials::Rows;
use number::{MAX_COORDINATE, narrow, narrow3};
use place::Placed;
use texels::Texels;

/// A flattened scene, and what there is to say about it.
#[derive(Debug, Clone)]
pub struct Flattened {
    /// The renderers' input.
    pub scene: FlatScene,
    /// What is legal but suspicious, in the order of the scene file.
    pub warnings: Vec<Diagnostic>,
    /// Triangles left out because they have no area in f32.
    pub without_area: usize,
    /// What became of coincident faces.
    pub merged: Merged,
    /// The hierarchy's measures.
    pub bvh: Statistics,
    /// How long it took to build.
    pub bvh_time: Duration,
}

/// Flatten a scene.
///
/// # Errors
/// What the scene file's reader cannot see: a transmissive mesh that is open or bounds no solid, one body of
/// several media, more transmissive bodies than the media mask holds, coordinates beyond 2^60. The message
/// names the model and its place in the file.
pub fn flatten(scene: &Scene) -> Result<Flattened, SceneError> {
    let rows = Rows::new(scene);
    let mut bodies = Bodies::new(scene, &rows)?;
    let mut warnings = Vec::new();
    let mut faces = Faces::default();
    let mut without_area = 0;
    for (model, &body) in scene.models.iter().zip(&bodies.of_model) {
        let mut placed = Placed::new(model)?;
        if bodies.is_transmissive(body) {
            warnings.extend(orient::orient(&mut placed)?);
            warnings.extend(copies::overlap(&placed));
        }
        let normals = normals::shading_normals(&placed);
        without_area += faces.append(&placed, &normals, body, &rows);
    }
    let mut texels = Texels::new();
    let (materials, material_names) = materials::table(scene, &rows, &mut texels);
    let merged = merge::merge(&mut faces, &bodies, &materials);
    warnings.extend(suspicions(scene, &faces, &bodies, without_area, merged));
    count_triangles(&mut bodies, &faces);
    if faces.triangles.is_empty() {
        faces.append_nothing();
    }
    let lights = scene.lights.iter().enumerate().map(light).collect::<Result<_, _>>()?;
    let (horizon, zenith, environment) = background(scene, &mut texels);
    let start = Instant::now();
    let tree =
        bvh::build(&faces.triangles, Preset::default()).map_err(|e| Diagnostic::error(e.to_string()))?;
    let bvh_time = start.elapsed();
    let triangles: Vec<Triangle> = tree.order.iter().map(|&id| faces.triangles[id as usize]).collect();
    let bvh = Statistics::of(&tree);
    let mut scene = FlatScene {
        bounds: bounds(&tree.nodes[0]),
        nodes: tree.nodes,
        triangles,
        attributes: faces.attributes,
        corners: faces.corners,
        materials,
        material_names,
        lights,
        texels: texels.into_words(),
        transmissive_bodies: bodies.transmissive,
        bodies: bodies.bodies,
        bvh_depth: tree.depth,
        ambient: narrow3(scene.ambient),
        horizon,
        zenith,
        environment,
        radiance_bound: vec![],
    };
    scene.radiance_bound = radiance::bounds(&scene);
    Ok(Flattened { scene, warnings, without_area, merged, bvh, bvh_time })
}

/// A message about a model, at its place in the scene file.
fn at(diagnostic: Diagnostic, model: &Model) -> Diagnostic {
    Diagnostic { location: model.location.clone(), ..diagnostic }
}

/// What is legal, but may not be what was meant.
fn suspicions(
    scene: &Scene,
    faces: &Faces,
    bodies: &Bodies,
    without_area: usize,
    merged: Merged,
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    if without_area > 0 {
        let triangles = if without_area == 1 { "triangle has" } else { "triangles have" };
        found.push(Diagnostic::warning(format!("{without_area} {triangles} no area and cannot be seen")));
    }
    if merged.crowded > 0 {
        let message = format!("more than two transmissive bodies share {} faces", merged.crowded);
        let hint =
            "only pairs of bodies make an interface: let some of them overlap instead, with priorities";
        found.push(Diagnostic::warning(message).hint(hint));
    }
    for pair in coplanar::overlapping_bodies(faces, bodies) {
        let [a, b] = pair.map(|body| &scene.models[bodies.models[body as usize]]);
        let message =
            format!("faces of `{}` and `{}` overlap in one plane without coinciding", a.name, b.name);
        let hint =
            "rays there meet the two in any order: cut the faces alike, or let the bodies overlap in depth";
        found.push(at(Diagnostic::warning(message), b).hint(hint));
    }
    found
}

/// The scene's box is that of the root's children.
fn bounds(root: &Node) -> [[f32; 3]; 2] {
    [
        std::array::from_fn(|axis| root.a_lo[axis].min(root.b_lo[axis])),
        std::array::from_fn(|axis| root.a_hi[axis].max(root.b_hi[axis])),
    ]
}

fn count_triangles(bodies: &mut Bodies, faces: &Faces) {
    for attribute in &faces.attributes {
        bodies.bodies[attribute.body as usize].triangles += 1;
    }
}

fn light((index, light): (usize, &crate::scene::Light)) -> Result<Light, SceneError> {
    if light.position.abs().max_element() > MAX_COORDINATE {
        let message = format!("light {} stands beyond ±{MAX_COORDINATE:.2e}", index + 1);
        return Err(Diagnostic::error(message).hint("bring it nearer").into());
    }
    Ok(Light {
        position: narrow3(light.position),
        inverse_square: u32::from(light.falloff == Falloff::InverseSquare),
        intensity: narrow3(light.intensity),
        reserved: 0,
    })
}

/// A background picture, its turn and its intensity.
type Environment = (FlatTexture, f32, f32);

/// Radiance at the horizon and at the zenith (black behind a picture), and the picture.
fn background(scene: &Scene, texels: &mut Texels) -> ([f32; 3], [f32; 3], Option<Environment>) {
    match scene.background {
        Background::Color(color) => (narrow3(color), narrow3(color), None),
        Background::Gradient { zenith, horizon } => (narrow3(horizon), narrow3(zenith), None),
        Background::Image { texture, rotation_y, intensity } => {
            let turn = narrow((rotation_y / 360.0).rem_euclid(1.0));
            // Rounding may reach 1, which is no turn at all.
            let turn = if turn < 1.0 { turn } else { 0.0 };
            let picture = texels.environment(scene, texture);
            ([0.0; 3], [0.0; 3], Some((picture, turn, narrow(intensity))))
        }
    }
}
