//! What is fuzzed: each reader of files, from bytes to a traced picture. The runs beside this file and the
//! coverage-guided targets of `fuzz/` share this code.

use std::fs;
use std::path::PathBuf;

use snellius::cpu::CpuRenderer;
use snellius::film::Renderer;
use snellius::flatten;
use snellius::layout::{FlatScene, Settings};
use snellius::scene::{Limits, Scene, SceneError};
use tempfile::TempDir;

/// A reader: the file that it is fed, and the one that is opened to reach it.
#[derive(Debug)]
pub(crate) struct Target {
    /// Its name; that of its folder in `corpus/` too.
    pub(crate) name: &'static str,
    fed: &'static str,
    opened: &'static str,
}

/// Every reader.
pub(crate) const TARGETS: [Target; 4] = [
    Target { name: "scene", fed: "scene.toml", opened: "scene.toml" },
    Target { name: "obj", fed: "mesh.obj", opened: "mesh.obj" },
    Target { name: "mtl", fed: "mesh.mtl", opened: "mesh.obj" },
    Target { name: "picture", fed: "picture.png", opened: "scene.toml" },
];

/// The files that a fed one may name.
const BESIDE: [(&str, &[u8]); 5] = [
    ("scene.toml", SKY),
    ("mesh.obj", include_bytes!("corpus/obj/cube.obj")),
    ("mesh.mtl", include_bytes!("corpus/mtl/every.mtl")),
    ("picture.png", include_bytes!("corpus/picture/rgb8.png")),
    ("sky.hdr", include_bytes!("corpus/picture/rle.hdr")),
];

/// Reads pictures of every kind: linear ones may shine.
const SKY: &[u8] = b"[background]\nimage = \"picture.png\"\n[material.mirror]\nreflection = 1.0\n\
                     [[model]]\nshape = { box = { size = [1, 1, 1] } }\nmaterial = \"mirror\"\n";

/// So little that thousands of inputs take seconds. What a person's files may ask for is [`Limits::default`].
pub(crate) const SMALL: Limits = Limits { triangles: 4096, pixels: 1 << 20 };

/// What became of an input.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The message.
    Refused(String),
    /// It is a scene, and there is a picture of it.
    Traced,
}

/// A folder where a reader finds its input.
#[derive(Debug)]
pub(crate) struct Feeder {
    folder: TempDir,
    target: &'static Target,
    limits: Limits,
}

impl Feeder {
    /// A folder with all the files that inputs for the target of this name may name.
    ///
    /// # Panics
    /// If there can be no such folder, or is no such target.
    #[must_use]
    pub(crate) fn new(target: &str, limits: Limits) -> Self {
        let target = TARGETS.iter().find(|known| known.name == target).expect("a target of that name");
        let folder = tempfile::tempdir().expect("a temporary folder");
        for (name, bytes) in BESIDE {
            fs::write(folder.path().join(name), bytes).expect("a file");
        }
        Self { folder, target, limits }
    }

    /// Read an input, flatten what is read, and trace that.
    ///
    /// # Panics
    /// Where the library does; and if it refuses without a message, or flattens to numbers that no device must see.
    #[must_use]
    pub(crate) fn feed(&self, input: &[u8]) -> Outcome {
        fs::write(self.path(self.target.fed), input).expect("a file");
        let scene = match Scene::load_within(&self.path(self.target.opened), self.limits) {
            Ok(scene) => scene,
            Err(error) => return refused(&error),
        };
        let flat = match flatten::flatten(&scene) {
            Ok(flat) => flat,
            Err(error) => return refused(&error),
        };
        for warning in scene.warnings.iter().chain(&flat.warnings) {
            assert!(!warning.render(true).is_empty());
        }
        assert_sound(&flat.scene);
        trace(&scene, &flat.scene);
        Outcome::Traced
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
}

fn refused(error: &SceneError) -> Outcome {
    assert!(error.diagnostics().iter().all(|fault| !fault.message.is_empty()));
    Outcome::Refused(error.to_string())
}

/// Fail unless all that `flatten` promises to be finite is.
fn assert_sound(scene: &FlatScene) {
    let corners = scene.triangles.iter().flat_map(|triangle| [triangle.v0, triangle.v1, triangle.v2]);
    let normals =
        scene.attributes.iter().flat_map(|face| [face.normal, face.normal0, face.normal1, face.normal2]);
    let shading = scene.uvs.iter().map(|&[u, v]| [u, v, 0.0]);
    let lights = scene.lights.iter().flat_map(|light| [light.position, light.intensity]);
    let materials = scene.materials.iter().flat_map(|row| {
        let indices = [row.ior, row.shininess, 0.0];
        [row.ambient, row.diffuse, row.specular, row.reflection, row.transmission, row.absorption, indices]
    });
    let rest = [scene.ambient, scene.horizon, scene.zenith, scene.bounds[0], scene.bounds[1]];
    let mut numbers = corners.chain(normals).chain(shading).chain(lights).chain(materials).chain(rest);
    assert!(numbers.all(|triple| triple.iter().all(|x| x.is_finite())));
    assert!(scene.radiance_bound.iter().all(|x| x.is_finite()));
}

/// Trace a few rays.
fn trace(scene: &Scene, flat: &FlatScene) {
    let settings = Settings { depth: 3, ..Settings::default() };
    let view = flatten::view(&scene.camera, flat, [3, 2], None, &settings);
    let mut renderer = CpuRenderer::new(flat, 1).expect("a thread");
    let frame = renderer.render(&view, &settings, &()).expect("a picture");
    assert_eq!(frame.texels.len(), 6);
}
