//! From files to a [`Scene`].

use std::collections::HashSet;
use std::path::Path;

use toml::Spanned;

use super::document::{Document, RenderTable};
use super::error::Faults;
use super::material::{self, Materials};
use super::model::{Models, Surroundings, stem};
use super::source::Source;
use super::texture::Textures;
use super::{
    Background, Camera, Diagnostic, Model, Normals, RenderDefaults, Repeat, Scene, SceneError, camera,
    default_view, fault, surroundings,
};

impl Scene {
    /// Read a scene with everything it names: `.toml`, or a bare `.obj`, which is framed and lit.
    ///
    /// Paths in a file are relative to that file. Nothing is written; what a hostile file can make this
    /// allocate is bounded by the file's own size and the limits named in the messages.
    ///
    /// # Errors
    /// Every fault found in the files, each with its place and, where there is one, a hint.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match extension.as_str() {
            "toml" => from_toml(&Source::read(path)?),
            "obj" => from_mesh(path),
            _ => Err(Diagnostic::error(format!("{} is not a scene", path.display()))
                .hint("a scene is a .toml file, or a bare .obj mesh")
                .into()),
        }
    }
}

/// Read a scene file.
pub(super) fn from_toml(source: &Source) -> Result<Scene, SceneError> {
    let document = fault::parse(source)?;
    let directory = source.path.parent().unwrap_or(Path::new(""));
    let mut faults = Faults::default();
    let mut textures = Textures::default();
    let given_camera = document
        .camera
        .as_ref()
        .and_then(|table| faults.keep(camera::camera(table, source).map_err(Into::into)));
    let background = document.background.as_ref().and_then(|table| {
        let background = surroundings::background(table, source, directory, &mut textures);
        faults.keep(background.map_err(Into::into))
    });
    let mut materials = Materials::default();
    for (name, table) in material::in_file_order(&document) {
        faults.keep(materials.define(name, table, source, directory, &mut textures));
    }
    let mut models = Models::default();
    for table in &document.model {
        let mut scene =
            Surroundings { source, directory, materials: &mut materials, textures: &mut textures };
        faults.keep(models.define(table, &mut scene));
    }
    if document.model.is_empty() {
        let fault = Diagnostic::error(format!("{} has no models", source.path.display()));
        faults.keep::<()>(Err(fault
            .hint("add one: [[model]] with a `mesh` or a `shape`, and a `material`")
            .into()));
    }
    faults.into_result()?;
    let mut warnings = materials.warnings;
    warnings.extend(unused_materials(&document, source));
    Ok(Scene {
        source: source.path.clone(),
        camera: aim(
            given_camera,
            document.camera.as_ref().is_some_and(|c| c.get_ref().target.is_some()),
            &models.list,
        ),
        render: render_defaults(&document.render),
        ambient: surroundings::ambient(document.ambient.as_ref()),
        background: background.unwrap_or(Background::Color(super::color::Color::BLACK.0)),
        lights: document.light.iter().map(surroundings::light).collect(),
        materials: materials.list,
        textures: textures.list,
        models: models.list,
        warnings,
    })
}

/// The camera as given, or a view of the models. A camera without a target gets its pivot where it passes the
/// middle of the models.
fn aim(given: Option<Camera>, has_target: bool, models: &[Model]) -> Camera {
    match given {
        Some(camera) if has_target => camera,
        Some(camera) => {
            let distance = (default_view::bounding_ball(models).center - camera.eye).dot(camera.forward);
            let target_distance = if distance > 0.0 { distance } else { camera.target_distance };
            Camera { target_distance, ..camera }
        }
        None => default_view::camera(default_view::bounding_ball(models)),
    }
}

fn render_defaults(table: &RenderTable) -> RenderDefaults {
    let defaults = RenderDefaults::default();
    RenderDefaults {
        size: table.size.map_or(defaults.size, |size| size.values()),
        depth: table.depth.map_or(defaults.depth, |depth| depth.0),
        cutoff: table.cutoff.map_or(defaults.cutoff, |cutoff| cutoff.value),
        samples: table.samples.map_or(defaults.samples, |samples| samples.0),
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
fn from_mesh(path: &Path) -> Result<Scene, SceneError> {
    let mut textures = Textures::default();
    let mut materials = Materials::default();
    let (mesh, obj) = Models::default().read(path)?;
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
