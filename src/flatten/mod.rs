//! From what a person wrote to what renderers read.
//!
//! [`flatten`] puts every model into world space, decides what is inside of what, merges faces that coincide,
//! gives all ids, and builds the hierarchy. [`view`] adds a camera.
//!
//! Ids follow the scene file: triangles are numbered model by model, copy by copy, in the order of the mesh.
//! Bodies are numbered transmissive first, by priority, so that a low id wins where bodies overlap.

use std::time::{Duration, Instant};

use crate::bvh::{self, Preset, Statistics};
use crate::layout::{FlatScene, Node, Triangle};
use crate::scene::{Diagnostic, Model, Scene, SceneError};

mod bodies;
mod copies;
mod coplanar;
mod distance;
mod edges;
mod faces;
mod flood;
mod materials;
mod merge;
mod normals;
mod number;
mod orient;
mod pierce;
mod place;
mod radiance;
#[cfg(test)]
mod samples;
mod shells;
mod surroundings;
mod texels;
mod view;
mod winding;

pub use merge::Merged;
pub use view::view;
pub use winding::start_media;

use bodies::Bodies;
use faces::Faces;
use materials::Rows;
use number::narrow3;
use place::Placed;
use surroundings::{background, check_range, light};
use texels::Texels;

/// A flattened scene, and what there is to say about it.
#[derive(Debug, Clone)]
pub struct Flattened {
    /// The renderers' input.
    pub scene: FlatScene,
    /// What is legal but suspicious: model by model, then what concerns several.
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
    check_range("the camera", scene.camera.eye)?;
    let rows = Rows::new(scene);
    let mut bodies = Bodies::new(scene, &rows)?;
    let mut texels = Texels::new();
    let (materials, material_names) = materials::table(scene, &rows, &mut texels);
    let (horizon, zenith, environment) = background(scene, &mut texels);
    let lights = scene.lights.iter().enumerate().map(light).collect::<Result<_, _>>()?;
    let (mut faces, without_area, mut warnings) = faces_of_models(scene, &bodies, &rows)?;
    let merged = merge::merge(&mut faces, &bodies, &materials);
    warnings.extend(suspicions(scene, &faces, &bodies, without_area, merged));
    count_triangles(&mut bodies, &faces);
    if faces.triangles.is_empty() {
        faces.append_nothing();
    }
    let start = Instant::now();
    let tree =
        bvh::build(&faces.triangles, Preset::default()).map_err(|e| Diagnostic::error(e.to_string()))?;
    let bvh_time = start.elapsed();
    let triangles: Vec<Triangle> = tree.order.iter().map(|&id| faces.triangles[id as usize]).collect();
    let bvh = Statistics::of(&tree);
    let mut scene = FlatScene {
        bounds: bounds(&tree.nodes[0]),
        nodes: tree.nodes.into(),
        triangles: triangles.into(),
        attributes: faces.attributes.into(),
        uvs: faces.uvs.into(),
        materials,
        material_names,
        lights,
        texels: texels.into_words().into(),
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

/// Put a scene's changed lights and materials in place of those of its flat form, which is quick: no geometry is looked
/// at but for a light's distance. False, and nothing of use, where a material became transmissive or ceased to be: then
/// bodies and interfaces are others, and the scene is to be flattened anew.
///
/// # Errors
/// A light beyond 2^60.
pub fn revise(scene: &Scene, flat: &mut FlatScene) -> Result<bool, SceneError> {
    flat.lights = scene.lights.iter().enumerate().map(light).collect::<Result<_, _>>()?;
    if !materials::revise(scene, &mut flat.materials) {
        return Ok(false);
    }
    flat.radiance_bound = radiance::bounds(flat);
    Ok(true)
}

/// The triangles of all models, how many have no area and are left out, and what is suspicious about them.
fn faces_of_models(
    scene: &Scene,
    bodies: &Bodies,
    rows: &Rows,
) -> Result<(Faces, usize, Vec<Diagnostic>), SceneError> {
    let (mut faces, mut without_area, mut warnings) = (Faces::default(), 0, Vec::new());
    for (model, &body) in scene.models.iter().zip(&bodies.of_model) {
        let mut placed = Placed::new(model)?;
        if bodies.is_transmissive(body) {
            warnings.extend(orient::orient(&mut placed)?);
            warnings.extend(copies::overlap(&placed));
        }
        let normals = normals::shading_normals(&placed);
        without_area += faces.append(&placed, &normals, body, rows);
    }
    Ok((faces, without_area, warnings))
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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::{DAffine3, DVec2, DVec3};

    use super::*;

    use crate::scene::{Background, Falloff, MaterialId, Pixels, Texture, TextureId};
    use samples::{ICE, STONE, cube, cuboid, empty_scene, flattened, lamp, mesh, model, scene_of};

    #[test]
    fn an_empty_scene_holds_one_triangle_without_area() {
        let scene = flattened(vec![]).unwrap().scene;
        assert_eq!((scene.triangles.len(), scene.attributes.len(), scene.nodes.len()), (1, 1, 1));
        assert_eq!((scene.bounds, scene.materials.len()), ([[0.0; 3]; 2], 1));
        assert_eq!(start_media(&scene, [0.0; 3]), 0);
    }

    #[test]
    fn the_tree_is_sound_and_the_triangles_stand_in_its_order() {
        let flat = flattened(vec![model("a", cube(1.0), ICE), model("b", cube(3.0), STONE)]).unwrap();
        let tree = bvh::Bvh {
            nodes: flat.scene.nodes.to_vec(),
            order: (0..24).collect(),
            depth: flat.scene.bvh_depth,
        };
        assert_eq!(bvh::check(&tree, &flat.scene.triangles), Ok(()));
        assert_eq!(flat.scene.bounds, [[-3.0; 3], [3.0; 3]]);
    }

    #[test]
    fn triangles_without_area_are_left_out_and_counted() {
        let thin = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0, DVec3::Y];
        let flat =
            flattened(vec![model("thin", mesh(&thin, &[[0, 1, 2], [0, 2, 3], [1, 1, 3]]), STONE)]).unwrap();
        assert_eq!((flat.scene.attributes.len(), flat.without_area), (1, 2));
        assert!(flat.warnings[0].message.contains("2 triangles have no area"));
    }

    #[test]
    fn no_subnormal_and_no_negative_zero_gets_through() {
        let tiny = |x: f64| cuboid(DVec3::new(-0.0, -1e-40, x), DVec3::ONE);
        let scene = flattened(vec![model("tiny", tiny(1e-42), STONE)]).unwrap().scene;
        for x in scene.triangles.iter().flat_map(|t| [t.v0, t.v1, t.v2]).flatten() {
            assert!(x.to_bits() == 0 || x.is_normal(), "{x:e}");
        }
    }

    #[test]
    fn what_lies_beyond_2_to_the_60_is_an_error() {
        let far = |half: f64, scale: f64| Model {
            world_from_object: DAffine3::from_scale(DVec3::splat(scale)),
            ..model("far", cube(half), STONE)
        };
        assert!(flattened(vec![far(1.0, 1e18)]).is_ok());
        for (half, scale) in [(1.0, 1e19), (1e300, 1e300)] {
            let error = flattened(vec![far(half, scale)]).unwrap_err();
            assert!(error.diagnostics()[0].message.contains("`far` reaches beyond"));
        }
        let mut scene = scene_of(vec![]);
        scene.lights = vec![lamp(DVec3::splat(1e30), 1.0, Falloff::None)];
        assert!(flatten(&scene).unwrap_err().diagnostics()[0].message.starts_with("light 1 stands beyond"));
        let mut scene = scene_of(vec![]);
        scene.camera.eye.y = -1e19;
        assert!(
            flatten(&scene).unwrap_err().diagnostics()[0].message.starts_with("the camera stands beyond")
        );
    }

    #[test]
    fn only_materials_that_are_worn_have_rows() {
        let scene = flattened(vec![model("a", cube(1.0), STONE)]).unwrap().scene;
        assert_eq!(scene.material_names, ["air", "stone"]);
        assert_eq!((scene.materials[0].ior, scene.materials[0].transmission), (1.0, [1.0; 3]));
        assert!(scene.attributes.iter().all(|face| face.material == 1));
    }

    #[test]
    fn a_textured_face_has_coordinates_and_copies_share_them() {
        let mut scene = empty_scene();
        let pixels = Pixels::Srgb8(vec![[9, 8, 7]]);
        scene.textures.push(Texture { path: "dot.png".into(), width: 1, height: 1, pixels });
        scene.materials[STONE.0].texture = Some(TextureId(0));
        let mut square = mesh(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]);
        square.uvs = vec![DVec2::ZERO, DVec2::new(1.0, 0.0), DVec2::new(0.0, 1.0)];
        square.triangles[0].uvs = [0, 1, 2];
        let repeat = crate::scene::Repeat { count: [4, 1, 1], step: DVec3::X * 2.0 };
        scene.models.push(Model { repeat, ..model("square", square, STONE) });
        let flat = flatten(&scene).unwrap().scene;
        assert_eq!(flat.uvs[..], [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(flat.attributes.len(), 4);
        assert!(flat.attributes.iter().all(|face| face.uvs == 0 && !face.is_smooth()));
        assert_eq!((flat.materials[1].texture, flat.texels[256]), (256, 0x0007_0809));
    }

    #[test]
    fn a_turn_of_the_background_is_within_one() {
        for (degrees, expected) in [(0.0, 0.0), (90.0, 0.25), (-90.0, 0.75), (360.0, 0.0), (-1e-9, 0.0)] {
            let mut scene = empty_scene();
            let pixels = Pixels::Linear(vec![[1.0, 2.0, 3.0]]);
            scene.textures.push(Texture { path: "sky.hdr".into(), width: 1, height: 1, pixels });
            scene.background =
                Background::Image { texture: TextureId(0), rotation_y: degrees, intensity: 0.5 };
            let flat = flatten(&scene).unwrap().scene;
            assert_eq!(flat.environment.unwrap().1, expected, "{degrees}");
            assert_eq!(flat.radiance_bound[0], 1.5);
        }
    }

    #[test]
    fn errors_stand_at_their_model() {
        let location = crate::scene::Location {
            file: "a.toml".into(),
            line: 3,
            column: 1,
            length: 5,
            text: "[[model]]".into(),
        };
        let mut open = cube(1.0);
        open.triangles.pop();
        let located = Model { location: Some(location.clone()), ..model("open", open, MaterialId(0)) };
        let error = flattened(vec![located]).unwrap_err();
        assert_eq!(error.diagnostics()[0].location, Some(location));
        assert_eq!(error.diagnostics()[0].severity, crate::scene::Severity::Error);
    }
}
