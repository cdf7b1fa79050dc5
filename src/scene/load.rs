//! From files to a [`Scene`].

use std::collections::HashSet;
use std::path::Path;

use glam::DVec3;
use toml::Spanned;

use super::document::{CameraTable, Document, RenderTable};
use super::error::Faults;
use super::material::{self, Materials};
use super::model::{Models, Shared, stem};
use super::source::Source;
use super::table::Table;
use super::texture::Textures;
use super::{
    Background, Camera, Diagnostic, Limits, Model, Normals, RenderDefaults, Repeat, Scene, SceneError,
    camera, default_view, fault, surroundings,
};

impl Scene {
    /// Read a scene with everything it names: `.toml`, or a bare `.obj`, which is framed and lit.
    ///
    /// Paths in a file are relative to that file. Nothing is written; what a hostile file can make this
    /// allocate is bounded by the file's own size and the limits named in the messages.
    ///
    /// # Errors
    /// Every fault found in the files, each with its place and, where there is one, a hint.
    ///
    /// # Examples
    /// ```no_run
    /// # use snellius::scene::Scene;
    /// match Scene::load("scenes/ice.toml".as_ref()) {
    ///     Ok(scene) => println!("{} models", scene.models.len()),
    ///     Err(error) => eprintln!("{error}"),
    /// }
    /// ```
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::load_within(path, Limits::default())
    }

    /// [`Scene::load`], with the levels of built-in solids raised by `steps`, or lowered below 0: as far as
    /// each solid's range goes. Meshes stay as they are.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_refined(path: &Path, steps: i32) -> Result<Self, SceneError> {
        read(path, Limits::default(), steps)
    }

    /// The same within other limits.
    ///
    /// # Errors
    /// As [`Scene::load`], and what is beyond the limits.
    pub fn load_within(path: &Path, limits: Limits) -> Result<Self, SceneError> {
        read(path, limits, 0)
    }

    /// Read a scene from text, as [`load`](Self::load) does from the `.toml` file at `path`: messages name it, and files
    /// that the text names are relative to it.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    ///
    /// # Examples
    /// ```
    /// # use snellius::scene::Scene;
    /// let text = "[[model]]\nshape = { sphere = { radius = 1 } }\nmaterial = 'glas'";
    /// assert!(Scene::parse("ball.toml".as_ref(), text).unwrap_err().to_string().contains("glas"));
    /// ```
    pub fn parse(path: &Path, text: &str) -> Result<Self, SceneError> {
        from_toml(&Source::new(path, text.to_owned()), Limits::default(), 0)
    }
}

/// Read a scene or a bare mesh, by the path's extension.
fn read(path: &Path, limits: Limits, refine: i32) -> Result<Scene, SceneError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "toml" => from_toml(&Source::read(path)?, limits, refine),
        "obj" => from_mesh(path, limits),
        _ => Err(Diagnostic::error(format!("{} is not a scene", path.display()))
            .hint("a scene is a .toml file, or a bare .obj mesh")
            .into()),
    }
}

/// Read a scene file.
fn from_toml(source: &Source, limits: Limits, refine: i32) -> Result<Scene, SceneError> {
    let document = fault::parse(source)?;
    let directory = source.path.parent().unwrap_or(Path::new(""));
    let mut shared = Shared {
        source,
        directory,
        materials: Materials::default(),
        textures: Textures::within(limits),
        refine,
    };
    let mut faults = Faults::default();
    let camera = document.camera.as_ref().map(|table| faults.keep(camera::camera(table, source)));
    let background = document
        .background
        .as_ref()
        .map(|table| faults.keep(surroundings::background(table, source, directory, &mut shared.textures)));
    for (name, table) in material::in_file_order(&document) {
        faults.keep(shared.materials.define(name, table, source, directory, &mut shared.textures));
    }
    let mut models = Models::within(limits);
    for table in &document.model {
        faults.keep(models.define(table, &mut shared));
    }
    if document.model.is_empty() {
        let fault = Diagnostic::error("the scene has no models").at(source.locate(0..0));
        faults.note(fault.hint("add one: [[model]] with a `mesh` or a `shape`, and a `material`"));
    }
    faults.into_result()?;
    let Materials { list: materials, mut warnings, .. } = shared.materials;
    warnings.extend(unused_materials(&document, source));
    Ok(Scene {
        source: source.path.clone(),
        meshes: models.files(),
        camera: aim(camera.flatten(), document.camera.as_ref(), &models.list),
        render: render_defaults(&document.render),
        ambient: surroundings::ambient(document.ambient.as_ref()),
        background: background.flatten().unwrap_or(Background::Color(DVec3::ZERO)),
        lights: document.light.iter().map(|table| surroundings::light(table)).collect(),
        materials,
        textures: shared.textures.list,
        models: models.list,
        warnings,
    })
}

/// The camera as given, or a view of the models. A camera with a basis of its own gets its pivot where it
/// passes the middle of the models.
fn aim(given: Option<Camera>, table: Option<&Spanned<Table<CameraTable>>>, models: &[Model]) -> Camera {
    let has_target = table.is_some_and(|table| table.get_ref().target.is_some());
    match given {
        None => default_view::camera(default_view::bounding_ball(models)),
        Some(camera) if has_target => camera,
        Some(camera) => {
            let middle = default_view::bounding_ball(models).center;
            let distance = (middle - camera.eye).dot(camera.forward);
            let target_distance = if distance > 0.0 { distance } else { camera.target_distance };
            Camera { target_distance, ..camera }
        }
    }
}

fn render_defaults(table: &RenderTable) -> RenderDefaults {
    let defaults = RenderDefaults::default();
    RenderDefaults {
        size: table.size.map_or(defaults.size, |size| size.values()),
        depth: table.depth.map_or(defaults.depth, |depth| depth.0),
        cutoff: table.cutoff.map_or(defaults.cutoff, |cutoff| cutoff.value),
        samples: table.samples.map_or(defaults.samples, |samples| samples.0),
        adaptive: table.adaptive.map(|adaptive| adaptive.value),
    }
}

/// A warning for each material that no model names.
fn unused_materials(document: &Document, source: &Source) -> Vec<Diagnostic> {
    let named = document.model.iter().filter_map(|model| model.get_ref().material.as_ref());
    let used: HashSet<&str> = named.map(|name| name.get_ref().as_str()).collect();
    let is_unused = |(name, _): &(&Spanned<String>, _)| !used.contains(name.get_ref().as_str());
    let warn = |(name, _): (&Spanned<String>, _)| {
        let message = format!("no model uses material `{}`", name.get_ref());
        Diagnostic::warning(message).at(source.locate(name.span()))
    };
    material::in_file_order(document).into_iter().filter(is_unused).map(warn).collect()
}

/// Read a bare mesh; frame and light it.
fn from_mesh(path: &Path, limits: Limits) -> Result<Scene, SceneError> {
    let mut textures = Textures::within(limits);
    let mut materials = Materials::default();
    let mut models = Models::within(limits);
    let (mesh, obj) = models.read(path)?;
    models.count(mesh.triangles.len(), Repeat::default())?;
    let slots = materials
        .of_mesh(&obj, path, &mut textures, |materials| Ok(materials.add(default_view::material())))?;
    let model = Model {
        name: stem(path),
        mesh,
        materials: slots,
        priority: 0,
        world_from_object: glam::DAffine3::IDENTITY,
        normals: Normals::File,
        repeat: Repeat::default(),
        location: None,
    };
    super::model::check_placed(&model)?;
    let ball = default_view::bounding_ball(std::slice::from_ref(&model));
    Ok(Scene {
        source: path.into(),
        meshes: models.files(),
        camera: default_view::camera(ball),
        render: RenderDefaults::default(),
        ambient: default_view::AMBIENT,
        background: default_view::BACKGROUND,
        lights: vec![default_view::light(ball)],
        materials: materials.list,
        textures: textures.list,
        models: vec![model],
        warnings: materials.warnings,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
