//! The models: meshes and shapes with their materials, placed in the world.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use toml::Spanned;

use super::document::{ModelTable, RepeatTable, Shape};
use super::material::Materials;
use super::obj::{self, Obj};
use super::source::Source;
use super::texture::Textures;
use super::{Diagnostic, MaterialId, Mesh, Model, Repeat, SceneError};

/// The most triangles of a scene, copies included: a bound on memory, not on devices.
const MAX_TRIANGLES: u64 = 1 << 25;

/// What models share while they are read.
#[derive(Debug, Default)]
pub(super) struct Models {
    /// In file order.
    pub(super) list: Vec<Model>,
    meshes: HashMap<PathBuf, LoadedMesh>,
    /// Models that go by each name, before numbers make them differ.
    namesakes: HashMap<String, u32>,
    triangles: u64,
}

/// A mesh file, read once.
#[derive(Debug, Clone)]
struct LoadedMesh {
    mesh: Arc<Mesh>,
    /// Slots and libraries; its mesh has moved out.
    obj: Arc<Obj>,
}

/// What a model needs of the rest of the scene.
pub(super) struct Surroundings<'a> {
    pub(super) source: &'a Source,
    pub(super) directory: &'a Path,
    pub(super) materials: &'a mut Materials,
    pub(super) textures: &'a mut Textures,
}

impl Models {
    /// Add the model of a table.
    pub(super) fn define(
        &mut self,
        table: &Spanned<ModelTable>,
        scene: &mut Surroundings<'_>,
    ) -> Result<(), SceneError> {
        let location = scene.source.locate(table.span());
        let place = location.clone();
        let table = table.get_ref();
        let (name, mesh, materials) = match (&table.mesh, &table.shape) {
            (Some(file), None) => self.from_file(file, table, scene)?,
            (None, Some(shape)) => from_shape(shape, table, scene)?,
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
            repeat: repeat(table.repeat.as_ref(), scene.source)?,
            location: Some(location),
        };
        check_placed(&model).map_err(|fault| fault.at(place.clone()))?;
        self.count(&model).map_err(|fault| fault.at(place))?;
        self.list.push(model);
        Ok(())
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

    fn from_file(
        &mut self,
        file: &Spanned<String>,
        table: &ModelTable,
        scene: &mut Surroundings<'_>,
    ) -> Result<(String, Arc<Mesh>, Vec<MaterialId>), SceneError> {
        let path = scene.directory.join(file.get_ref());
        let place = || scene.source.locate(file.span());
        super::source::check_regular(&path).map_err(|fault| fault.at(place()))?;
        let (mesh, obj) = self.read(&path)?;
        let materials = match &table.material {
            Some(name) => vec![scene.materials.named(name, scene.source)?; obj.slots.len()],
            None => scene.materials.of_mesh(&obj, &path, scene.textures, |_| {
                Err(Diagnostic::error(format!("{} has faces without a material", path.display()))
                    .at(place())
                    .hint("give the model a `material`"))
            })?,
        };
        Ok((stem(&path), mesh, materials))
    }

    /// The name; the second model of a name and those after it get a number.
    fn unique(&mut self, name: String) -> String {
        let count = self.namesakes.entry(name.clone()).or_default();
        *count += 1;
        if *count == 1 { name } else { format!("{name} {count}") }
    }

    /// Count a model's triangles; refuse more than memory should hold.
    fn count(&mut self, model: &Model) -> Result<(), Diagnostic> {
        let copies = model.repeat.count.iter().map(|&count| u64::from(count)).fold(1, u64::saturating_mul);
        self.triangles =
            self.triangles.saturating_add(copies.saturating_mul(model.mesh.triangles.len() as u64));
        if self.triangles > MAX_TRIANGLES {
            let message = format!("the scene has {} triangles; the most is {MAX_TRIANGLES}", self.triangles);
            return Err(Diagnostic::error(message).hint("repeat it less often, or use a lower level"));
        }
        Ok(())
    }
}

/// A file's name without its extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn from_shape(
    shape: &Spanned<Shape>,
    table: &ModelTable,
    scene: &mut Surroundings<'_>,
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
    let mesh = shape.get_ref().mesh().map_err(|fault| fault.at(place()))?;
    Ok((shape.get_ref().kind().to_owned(), Arc::new(mesh), vec![material]))
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

fn repeat(table: Option<&Spanned<RepeatTable>>, source: &Source) -> Result<Repeat, Diagnostic> {
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
