//! The models: meshes and shapes with their materials, placed in the world.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use toml::Spanned;

use super::document::{ModelTable, RepeatTable, Shape};
use super::material::Materials;
use super::obj::{self, Obj};
use super::source::Source;
use super::table::Table;
use super::texture::Textures;
use super::{Diagnostic, Limits, MaterialId, Mesh, Model, Repeat, SceneError};

/// The models read so far.
#[derive(Debug, Default)]
pub(super) struct Models {
    /// In file order.
    pub(super) list: Vec<Model>,
    meshes: HashMap<PathBuf, LoadedMesh>,
    /// Meshes of shapes, by the shape as it is written.
    shapes: HashMap<String, Arc<Mesh>>,
    /// Models that go by each name, before numbers make them differ.
    namesakes: HashMap<String, u32>,
    triangles: u64,
    limits: Limits,
}

/// A mesh file, read once.
#[derive(Debug, Clone)]
struct LoadedMesh {
    mesh: Arc<Mesh>,
    /// Slots and libraries; its mesh has moved out.
    obj: Arc<Obj>,
}

/// What the parts of a scene file share while they are read.
pub(super) struct Shared<'a> {
    pub(super) source: &'a Source,
    pub(super) directory: &'a Path,
    pub(super) materials: Materials,
    pub(super) textures: Textures,
    /// Steps by which built-in solids are finer than the file says; coarser below 0.
    pub(super) refine: i32,
}

impl Models {
    /// None yet.
    pub(super) fn within(limits: Limits) -> Self {
        Self { limits, ..Self::default() }
    }

    /// Add the model of a table.
    pub(super) fn define(
        &mut self,
        table: &Spanned<Table<ModelTable>>,
        scene: &mut Shared<'_>,
    ) -> Result<(), SceneError> {
        let location = scene.source.locate(table.span());
        let place = location.clone();
        let table = table.get_ref();
        let repeat = repeat(table.repeat.as_ref(), scene.source)?;
        let (name, mesh, materials) = match (&table.mesh, &table.shape) {
            (Some(file), None) => {
                let (name, mesh, materials) = self.of_file(file, table, scene)?;
                self.count(mesh.triangles.len(), repeat).map_err(|fault| fault.at(place.clone()))?;
                (name, mesh, materials)
            }
            (None, Some(shape)) => {
                // Before they are made: a few words ask for many.
                let triangles = shape.get_ref().refined(scene.refine).triangles();
                self.count(triangles, repeat).map_err(|fault| fault.at(place.clone()))?;
                self.of_shape(shape, table, scene)?
            }
            (Some(_), Some(shape)) => {
                let place = scene.source.locate(shape.span());
                return Err(Diagnostic::error("the model has both a mesh and a shape").at(place).into());
            }
            (None, None) => {
                let fault = Diagnostic::error("the model has neither a mesh nor a shape").at(location);
                return Err(fault
                    .hint("give `mesh = \"file.obj\"` or `shape = { sphere = { radius = 1 } }`")
                    .into());
            }
        };
        let model = Model {
            name: self.unique(name),
            mesh,
            materials,
            priority: table.priority,
            world_from_object: transform(table),
            normals: table.normals.0,
            repeat,
            location: Some(location),
        };
        check_placed(&model).map_err(|fault| fault.at(place))?;
        self.list.push(model);
        Ok(())
    }

    /// The mesh files read so far, in order.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let mut files: Vec<_> = self.meshes.keys().cloned().collect();
        files.sort_unstable();
        files
    }

    /// Read a mesh file, or find it among those already read.
    pub(super) fn read(&mut self, path: &Path) -> Result<(Arc<Mesh>, Arc<Obj>), SceneError> {
        if let Some(loaded) = self.meshes.get(path) {
            return Ok((loaded.mesh.clone(), loaded.obj.clone()));
        }
        let source = Source::read_lossy(path)?;
        let mut obj = obj::parse(&source)?;
        drop(source);
        let loaded = LoadedMesh { mesh: Arc::new(std::mem::take(&mut obj.mesh)), obj: Arc::new(obj) };
        self.meshes.insert(path.into(), loaded.clone());
        Ok((loaded.mesh, loaded.obj))
    }

    fn of_file(
        &mut self,
        file: &Spanned<String>,
        table: &ModelTable,
        scene: &mut Shared<'_>,
    ) -> Result<(String, Arc<Mesh>, Vec<MaterialId>), SceneError> {
        let path = scene.directory.join(file.get_ref());
        let place = || scene.source.locate(file.span());
        super::source::check_regular(&path).map_err(|fault| fault.at(place()))?;
        let (mesh, obj) = self.read(&path)?;
        let materials = match &table.material {
            Some(name) => vec![scene.materials.named(name, scene.source)?; obj.slots.len()],
            None => scene.materials.of_mesh(&obj, &path, &mut scene.textures, |_| {
                Err(Diagnostic::error(format!("{} has faces without a material", path.display()))
                    .at(place())
                    .hint("give the model a `material`"))
            })?,
        };
        Ok((stem(&path), mesh, materials))
    }

    fn of_shape(
        &mut self,
        shape: &Spanned<Shape>,
        table: &ModelTable,
        scene: &Shared<'_>,
    ) -> Result<(String, Arc<Mesh>, Vec<MaterialId>), SceneError> {
        let place = || scene.source.locate(shape.span());
        let Some(name) = &table.material else {
            return Err(Diagnostic::error("the shape has no material")
                .at(place())
                .hint("give the model a `material`")
                .into());
        };
        let material = scene.materials.named(name, scene.source)?;
        if matches!(shape.get_ref(), Shape::Plane(_)) && scene.materials.list[material.0].is_transmissive() {
            let fault = Diagnostic::error("a plane bounds no matter, so its material cannot transmit light");
            return Err(fault.at(scene.source.locate(name.span())).hint("use a thin box").into());
        }
        let mesh = match self.shapes.entry(scene.source.text[shape.span()].to_owned()) {
            Entry::Occupied(known) => known.get().clone(),
            Entry::Vacant(new) => {
                let mesh = shape.get_ref().refined(scene.refine).mesh().map_err(|fault| fault.at(place()))?;
                new.insert(Arc::new(mesh)).clone()
            }
        };
        Ok((shape.get_ref().kind().to_owned(), mesh, vec![material]))
    }

    /// The name; the second model of a name and those after it get a number.
    fn unique(&mut self, name: String) -> String {
        let count = self.namesakes.entry(name.clone()).or_default();
        *count += 1;
        if *count == 1 { name } else { format!("{name} {count}") }
    }

    /// Count a model's triangles; refuse more than memory should hold.
    pub(super) fn count(&mut self, triangles: usize, repeat: Repeat) -> Result<(), Diagnostic> {
        let copies = repeat.count.iter().map(|&count| u64::from(count)).fold(1, u64::saturating_mul);
        self.triangles = self.triangles.saturating_add(copies.saturating_mul(triangles as u64));
        let most = self.limits.triangles;
        if self.triangles > most {
            let message = format!("the scene has {} triangles; the most is {most}", self.triangles);
            return Err(Diagnostic::error(message).hint("repeat it less often, or use a lower level"));
        }
        Ok(())
    }
}

/// A file's name without its extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// `world_from_object`: scale, then rotation about x, y and z, then translation.
fn transform(table: &ModelTable) -> DAffine3 {
    let [x, y, z] = DVec3::from(table.rotate).to_array().map(f64::to_radians);
    let rotation = DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
    DAffine3::from_mat3_translation(
        rotation * DMat3::from_diagonal(table.scale.value),
        table.translate.into(),
    )
}

fn repeat(table: Option<&Spanned<Table<RepeatTable>>>, source: &Source) -> Result<Repeat, Diagnostic> {
    let Some(spanned) = table else { return Ok(Repeat::default()) };
    let (count, step) = (spanned.get_ref().count.values(), DVec3::from(spanned.get_ref().step));
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        if count[axis] > 1 && step[axis] == 0.0 {
            let message = format!("{} copies along {name} lie in the same place", count[axis]);
            return Err(Diagnostic::error(message)
                .at(source.locate(spanned.span()))
                .hint("give a `step` other than 0"));
        }
    }
    Ok(Repeat { count, step })
}

/// Refuse a placement that f32 cannot hold, or that makes the model vanish in it.
pub(super) fn check_placed(model: &Model) -> Result<(), Diagnostic> {
    let [lo, hi] = world_bounds(model);
    if lo.abs().max(hi.abs()).max_element() > f64::from(f32::MAX) || !(lo.is_finite() && hi.is_finite()) {
        return Err(Diagnostic::error(format!(
            "`{}` reaches beyond the largest number, {:.1e}",
            model.name,
            f32::MAX
        )));
    }
    if (hi - lo).max_element() < f64::from(f32::MIN_POSITIVE) {
        return Err(Diagnostic::error(format!("`{}` is too small to be seen", model.name)));
    }
    Ok(())
}

/// Least and greatest corner of a model's box in the world, copies included.
pub(super) fn world_bounds(model: &Model) -> [DVec3; 2] {
    let last = model.repeat.step * (glam::UVec3::from(model.repeat.count) - 1).as_dvec3();
    let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    for &position in &model.mesh.positions {
        let placed = model.world_from_object.transform_point3(position);
        bounds = [bounds[0].min(placed), bounds[1].max(placed)];
    }
    [bounds[0] + last.min(DVec3::ZERO), bounds[1] + last.max(DVec3::ZERO)]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::scene::{Normals, fault};

    fn table(keys: &str) -> ModelTable {
        let source = Source::new(Path::new("a.toml"), format!("[[model]]\n{keys}"));
        fault::parse(&source).unwrap().model.remove(0).into_inner().0
    }

    #[test]
    fn a_model_is_scaled_then_turned_about_x_y_z_then_moved() {
        let world_from_object =
            transform(&table("scale = [2, 1, 1]\nrotate = [90, 0, 90]\ntranslate = [0, 0, 5]"));
        let placed = |point| world_from_object.transform_point3(point);
        assert!((placed(DVec3::X) - DVec3::new(0.0, 2.0, 5.0)).length() < 1e-15);
        assert!((placed(DVec3::Y) - DVec3::new(0.0, 0.0, 6.0)).length() < 1e-15);
        assert!((placed(DVec3::Z) - DVec3::new(1.0, 0.0, 5.0)).length() < 1e-15);
    }

    #[test]
    fn bounds_enclose_every_copy() {
        let mesh = Mesh { positions: vec![DVec3::ZERO, DVec3::ONE], ..Mesh::default() };
        let model = Model {
            name: String::new(),
            mesh: Arc::new(mesh),
            materials: Vec::new(),
            priority: 0,
            world_from_object: DAffine3::IDENTITY,
            normals: Normals::File,
            repeat: Repeat { count: [3, 2, 1], step: DVec3::new(2.0, -1.0, 9.0) },
            location: None,
        };
        assert_eq!(world_bounds(&model), [DVec3::new(0.0, -1.0, 0.0), DVec3::new(5.0, 1.0, 1.0)]);
    }

    #[test]
    fn namesakes_are_numbered() {
        let mut models = Models::default();
        let names = ["box", "ball", "box", "box"].map(|name| models.unique(name.into()));
        assert_eq!(names, ["box", "ball", "box 2", "box 3"]);
    }
}
