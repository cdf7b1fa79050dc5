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
