//! From a path to what renderers read.

use std::path::Path;
use std::time::{Duration, Instant};

use super::CliError;
use crate::flatten::flatten;
use crate::layout::FlatScene;
use crate::scene::{Diagnostic, Scene};

/// A scene that renderers can read, and what it took.
pub(super) struct Prepared {
    pub(super) scene: Scene,
    pub(super) flat: FlatScene,
    /// What is legal but suspicious.
    pub(super) warnings: Vec<Diagnostic>,
    /// Reading and checking the files.
    pub(super) load: Duration,
    /// Flattening, the BVH included.
    pub(super) bvh: Duration,
}

impl Prepared {
    /// Read the scene and flatten it.
    pub(super) fn new(path: &Path) -> Result<Self, CliError> {
        let started = Instant::now();
        let scene = Scene::load(path)?;
        let load = started.elapsed();
        let flattened = flatten(&scene)?;
        let bvh = started.elapsed() - load;
        let warnings = scene.warnings.iter().cloned().chain(flattened.warnings).collect();
        Ok(Self { scene, flat: flattened.scene, warnings, load, bvh })
    }
}
