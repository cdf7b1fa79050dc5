//! Which models are bodies of which id, and what they are made of.

use super::materials::Rows;
use crate::layout::Body;
use crate::layout::constants::MAX_MEDIA;
use crate::scene::{Diagnostic, Material, MaterialId, Model, Scene, SceneError};

/// The bodies of a scene.
pub(super) struct Bodies {
    /// By body id.
    pub(super) bodies: Vec<Body>,
    /// The body id of each model.
    pub(super) of_model: Vec<u32>,
    /// The model of each body.
    pub(super) models: Vec<usize>,
    /// How many bodies are transmissive; they come first.
    pub(super) transmissive: u32,
}

impl Bodies {
    /// Sort the models: transmissive ones by priority, equal ones and the opaque rest as in the file.
    ///
    /// # Errors
    /// More transmissive bodies than the media mask holds, or one made of several media.
    pub(super) fn new(scene: &Scene, rows: &Rows) -> Result<Self, SceneError> {
        let matter: Vec<Option<MaterialId>> =
            scene.models.iter().map(|model| medium(scene, model)).collect::<Result<_, _>>()?;
        let mut models: Vec<usize> = (0..scene.models.len()).collect();
        // Stable: the file's order decides between equals.
        models.sort_by_key(|&model| match matter[model] {
            Some(_) => (false, -i64::from(scene.models[model].priority)),
            None => (true, 0),
        });
        let transmissive = matter.iter().flatten().count();
        if let Some(&first_too_many) = models[..transmissive].get(MAX_MEDIA as usize) {
            return Err(too_many(transmissive, &scene.models[first_too_many]));
        }
        let mut of_model = vec![0; models.len()];
        models.iter().zip(0..).for_each(|(&model, body)| of_model[model] = body);
        let bodies = models.iter().map(|&model| body(&scene.models[model], matter[model], rows)).collect();
        Ok(Self { bodies, of_model, models, transmissive: transmissive as u32 })
    }

    /// Whether a body's matter transmits light.
    pub(super) fn is_transmissive(&self, body: u32) -> bool {
        body < self.transmissive
    }
}

fn body(model: &Model, medium: Option<MaterialId>, rows: &Rows) -> Body {
    let material = medium.or_else(|| worn(model).next());
    Body {
        name: model.name.clone(),
        material: material.map_or(0, |id| rows.row(id)),
        transmissive: medium.is_some(),
        priority: model.priority,
        triangles: 0,
    }
}

/// The materials of a model's triangles, one after the other.
fn worn(model: &Model) -> impl Iterator<Item = MaterialId> {
    model.mesh.triangles.iter().map(|triangle| model.materials[triangle.material as usize])
}

/// The material that a model's matter is made of: the one that transmits light, if any.
fn medium(scene: &Scene, model: &Model) -> Result<Option<MaterialId>, SceneError> {
    let mut first: Option<MaterialId> = None;
    for id in worn(model).filter(|id| scene.materials[id.0].is_transmissive()) {
        let chosen = *first.get_or_insert(id);
        let (a, b) = (&scene.materials[chosen.0], &scene.materials[id.0]);
        if id != chosen && !same_matter(a, b) {
            return Err(several_media(model, a, b));
        }
    }
    Ok(first)
}

fn same_matter(a: &Material, b: &Material) -> bool {
    a.ior == b.ior && a.absorption == b.absorption
}

fn several_media(model: &Model, a: &Material, b: &Material) -> SceneError {
    let message = format!(
        "`{}` is one body, but is made of two media: `{}` and `{}` differ in ior or absorption",
        model.name, a.name, b.name
    );
    super::at(Diagnostic::error(message), model)
        .hint("split the mesh into one closed model for each medium")
        .into()
}

fn too_many(count: usize, model: &Model) -> SceneError {
    let message = format!("{count} bodies transmit light, but at most {MAX_MEDIA} can");
    super::at(Diagnostic::error(message), model)
        .hint("join bodies of the same material into one mesh, or use `repeat`: its copies are one body")
        .into()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::flatten::samples::{ICE, STONE, WATER, cube, cuboid, flattened, joined, model};

    #[test]
    fn transmissive_bodies_come_first_by_priority_then_by_the_file() {
        let named = |name: &str, priority: i32, material: MaterialId| {
            let place = DVec3::X * f64::from(name.as_bytes()[0]) * 4.0;
            Model { priority, ..model(name, cuboid(place, place + 1.0), material) }
        };
        let models = vec![
            named("a", 9, STONE),
            named("b", 0, ICE),
            named("c", 2, WATER),
            named("d", 0, WATER),
            named("e", 10, STONE),
            named("f", 2, ICE),
        ];
        let scene = flattened(models).unwrap().scene;
        let names: Vec<&str> = scene.bodies.iter().map(|body| body.name.as_str()).collect();
        assert_eq!((names.join(""), scene.transmissive_bodies), ("cfbdae".to_owned(), 4));
        // Triangles are still numbered as in the file.
        let bodies: Vec<u32> = scene.attributes.iter().step_by(12).map(|face| face.body).collect();
        assert_eq!(bodies, [4, 2, 0, 3, 5, 1]);
        assert_eq!(scene.bodies[0].material, scene.attributes[24].material);
    }

    #[test]
    fn one_body_of_two_media_is_an_error() {
        let mut mixed =
            model("mixed", joined(&[cube(1.0), cuboid(DVec3::splat(3.0), DVec3::splat(4.0))]), ICE);
        mixed.materials.push(WATER);
        std::sync::Arc::make_mut(&mut mixed.mesh).triangles[12..].iter_mut().for_each(|t| t.material = 1);
        let error = flattened(vec![mixed.clone()]).unwrap_err();
        assert!(error.diagnostics()[0].message.contains("`ice` and `water`"));
        // A painted part is fine.
        mixed.materials[1] = STONE;
        assert_eq!(flattened(vec![mixed]).unwrap().scene.transmissive_bodies, 1);
    }

    #[test]
    fn more_media_than_the_mask_holds_are_refused() {
        let row = |count: u32| -> Vec<Model> {
            let place = |k: u32| DVec3::X * 3.0 * f64::from(k);
            (0..count).map(|k| model("drop", cuboid(place(k), place(k) + 1.0), WATER)).collect()
        };
        assert_eq!(flattened(row(MAX_MEDIA)).unwrap().scene.transmissive_bodies, MAX_MEDIA);
        let error = flattened(row(MAX_MEDIA + 1)).unwrap_err();
        assert!(error.diagnostics()[0].message.contains("33 bodies transmit light"));
    }
}
