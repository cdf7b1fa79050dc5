//! A scene that is ready to be traced.

use std::path::{Path, PathBuf};

use crate::flatten::{Flattened, flatten, revise};
use crate::layout::Scan;
use crate::scene::{Scene, SceneError};

/// A scene that is ready to be traced, and what is known of it.
#[derive(Debug)]
pub struct Stage {
    /// Its file.
    pub path: PathBuf,
    /// What a person wrote.
    pub scene: Scene,
    /// What renderers read.
    pub flat: Flattened,
    /// What it calls for.
    pub scan: Scan,
}

impl Stage {
    /// Read a scene file and make it ready.
    ///
    /// # Errors
    /// As [`Scene::load`] and [`flatten`].
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::of(path, Scene::load(path)?)
    }

    /// Make a scene ready that was read from this file.
    ///
    /// # Errors
    /// As [`flatten`].
    pub fn of(path: &Path, scene: Scene) -> Result<Self, SceneError> {
        let flat = flatten(&scene)?;
        let scan = Scan::of(&flat.scene);
        Ok(Self { path: path.to_owned(), scene, flat, scan })
    }

    /// The same with other lights and materials: quickly where no body becomes transmissive or opaque by it.
    ///
    /// # Errors
    /// As [`flatten`].
    pub fn revised(&self, scene: Scene) -> Result<Self, SceneError> {
        let mut flat = self.flat.clone();
        if !revise(&scene, &mut flat.scene)? {
            return Self::of(&self.path, scene);
        }
        let scan = Scan::of(&flat.scene);
        Ok(Self { path: self.path.clone(), scene, flat, scan })
    }
}
