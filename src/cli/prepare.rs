//! From a path to what renderers read.

use std::path::Path;
use std::time::{Duration, Instant};

use super::CliError;
use crate::flatten::{Flattened, flatten};
use crate::scene::{Diagnostic, Scene};

/// A scene that renderers can read, and what it took.
pub(super) struct Prepared {
    pub(super) scene: Scene,
    pub(super) flat: Flattened,
    /// Reading, checking and flattening, the BVH left out.
    pub(super) load: Duration,
}

impl Prepared {
    /// Read the scene and flatten it.
    pub(super) fn new(path: &Path) -> Result<Self, CliError> {
        let started = Instant::now();
        let scene = Scene::load(path)?;
        let flat = flatten(&scene)?;
        let load = started.elapsed().saturating_sub(flat.bvh_time);
        Ok(Self { scene, flat, load })
    }

    /// What is legal but suspicious: first in the files, then in the geometry.
    pub(super) fn warnings(&self) -> impl Iterator<Item = &Diagnostic> {
        self.scene.warnings.iter().chain(&self.flat.warnings)
    }
}
