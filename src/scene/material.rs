//! The materials of a scene: its own by name, and those of the MTL libraries that its meshes name.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::DVec3;
use toml::Spanned;

use super::document::{DEFAULT_SHININESS, Document, MaterialTable};
use super::fault::suggest;
use super::obj::Obj;
use super::source::Source;
use super::statement::Reference;
use super::texture::{Purpose, Textures};
use super::{Diagnostic, Material, MaterialId, SceneError, illumination, mtl};

/// Every material of the scene.
#[derive(Debug, Default)]
pub(super) struct Materials {
    /// Indexed by [`MaterialId`].
    pub(super) list: Vec<Material>,
    /// What is legal but suspicious.
    pub(super) warnings: Vec<Diagnostic>,
    own: HashMap<String, MaterialId>,
    libraries: HashMap<PathBuf, HashMap<String, MaterialId>>,
}

impl Materials {
    /// Add a material of the scene file.
    pub(super) fn define(
        &mut self,
        name: &Spanned<String>,
        table: &MaterialTable,
        source: &Source,
        directory: &Path,
        textures: &mut Textures,
    ) -> Result<(), SceneError> {
        let material = from_table(name.get_ref(), table);
        if !material.fresnel && (material.reflection + material.transmission).max_element() > 1.0 + 1e-9 {
            let warning = format!("material `{}` sends on more light than it gets", material.name);
            let hint =
                "reflection and transmission add up to more than 1; `fresnel = true` shares the light out";
            self.warnings.push(Diagnostic::warning(warning).at(source.locate(name.span())).hint(hint));
        }
        let id = self.add(material);
        self.own.insert(name.get_ref().clone(), id);
        if let Some(file) = table.diffuse.as_ref().and_then(|diffuse| diffuse.texture.as_ref()) {
            let texture = textures.load(&directory.join(file.get_ref()), Purpose::Surface);
            self.list[id.0].texture = Some(texture.map_err(|fault| fault.at(source.locate(file.span())))?);
        }
        Ok(())
    }

    /// Find a material of the scene file.
    pub(super) fn named(&self, name: &Spanned<String>, source: &Source) -> Result<MaterialId, Diagnostic> {
        self.own.get(name.get_ref()).copied().ok_or_else(|| {
            let mut known: Vec<_> = self.own.keys().map(String::as_str).collect();
            known.sort_unstable();
            let diagnostic = Diagnostic::error(format!("there is no material `{}`", name.get_ref()))
                .at(source.locate(name.span()));
            diagnostic.hint(if known.is_empty() {
                format!("define it: [material.{}]", name.get_ref())
            } else {
                suggest(name.get_ref(), &known)
            })
        })
    }

    /// Find the materials of a mesh in its libraries, slot by slot; `untold` stands for faces without any.
    pub(super) fn of_mesh(
        &mut self,
        obj: &Obj,
        path: &Path,
        textures: &mut Textures,
        mut untold: impl FnMut(&mut Self) -> Result<MaterialId, Diagnostic>,
    ) -> Result<Vec<MaterialId>, SceneError> {
        let directory = path.parent().unwrap_or(Path::new(""));
        let libraries: Vec<_> = obj.libraries.iter().map(|library| directory.join(&library.name)).collect();
        for (library, path) in obj.libraries.iter().zip(&libraries) {
            self.read_library(library, path, textures)?;
        }
        let mut ids = Vec::with_capacity(obj.slots.len());
        for slot in &obj.slots {
            ids.push(match slot {
                Some(reference) => self.in_libraries(reference, &libraries)?,
                None => untold(self)?,
            });
        }
        Ok(ids)
    }

    /// Add a material that no file names.
    pub(super) fn add(&mut self, material: Material) -> MaterialId {
        self.list.push(material);
        MaterialId(self.list.len() - 1)
    }

    fn in_libraries(&self, reference: &Reference, libraries: &[PathBuf]) -> Result<MaterialId, Diagnostic> {
        let tables: Vec<_> = libraries.iter().filter_map(|path| self.libraries.get(path)).collect();
        tables.iter().find_map(|table| table.get(&reference.name)).copied().ok_or_else(|| {
            let mut known: Vec<_> =
                tables.iter().flat_map(|table| table.keys()).map(String::as_str).collect();
            known.sort_unstable();
            let diagnostic = Diagnostic::error(format!("there is no material `{}`", reference.name))
                .at(reference.location.clone());
            diagnostic.hint(if libraries.is_empty() {
                "name a material library by `mtllib`, or give the model a `material` in the scene file".into()
            } else {
                suggest(&reference.name, &known)
            })
        })
    }

    /// Read an MTL file, unless it is already read.
    fn read_library(
        &mut self,
        library: &Reference,
        path: &Path,
        textures: &mut Textures,
    ) -> Result<(), SceneError> {
        if self.libraries.contains_key(path) {
            return Ok(());
        }
        let source = Source::read_lossy(path).map_err(|fault| {
            fault
                .at(library.location.clone())
                .hint("a `material` in the scene file makes the library unnecessary")
        })?;
        let mut table = HashMap::new();
        for mtl in mtl::parse(&source)? {
            let texture = match &mtl.texture {
                None => None,
                Some(file) => {
                    let directory = path.parent().unwrap_or(Path::new(""));
                    let texture = textures.load(&directory.join(&file.name), Purpose::Surface);
                    Some(texture.map_err(|fault| fault.at(file.location.clone()))?)
                }
            };
            if illumination::ignores_dissolve(&mtl) {
                let warning = Diagnostic::warning(format!("material `{}` is shown opaque", mtl.name))
                    .hint("its illumination model has no transparency; `illum` 4, 6, 7 and 9 have");
                self.warnings.push(Diagnostic { location: mtl.location.clone(), ..warning });
            }
            let id = self.add(illumination::material(&mtl, texture));
            table.insert(mtl.name, id);
        }
        self.libraries.insert(path.into(), table);
        Ok(())
    }
}

/// The materials of the document, in the order of the file.
pub(super) fn in_file_order(document: &Document) -> Vec<(&Spanned<String>, &MaterialTable)> {
    let mut materials: Vec<_> = document.material.iter().map(|(name, table)| (name, &**table)).collect();
    materials.sort_by_key(|(name, _)| name.span().start);
    materials
}

/// Multiply the colours by their coefficients.
fn from_table(name: &str, table: &MaterialTable) -> Material {
    let specular = table.specular.as_ref();
    Material {
        name: name.to_owned(),
        ambient: table.ambient.as_ref().map_or(DVec3::ZERO, |term| term.color.0 * term.k.value),
        diffuse: table.diffuse.as_ref().map_or(DVec3::ZERO, |term| term.color.0 * term.k.value),
        texture: None,
        specular: specular.map_or(DVec3::ZERO, |term| term.color.0 * term.k.value),
        shininess: specular.map_or(DEFAULT_SHININESS, |term| term.shininess.value),
        reflection: table.reflection.value,
        transmission: table.transmission.value,
        fresnel: table.fresnel,
        ior: table.ior.value,
        absorption: table.absorption.value,
    }
}
