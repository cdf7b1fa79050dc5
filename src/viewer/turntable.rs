//! Pictures from round the target, traced and written while nothing else is to be traced.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::files::png_of;
use super::tracer::Wanted;
use crate::film::{Development, Frame, Metadata, numbered, write_whole};
use crate::scene::Camera;

/// Pictures from round the target of a camera: those of `snellius render --turntable`.
pub struct Turntable {
    /// The first picture.
    pub wanted: Wanted,
    /// How many, at equal angles.
    pub pictures: u32,
    /// Where they go, as `STEM-000.png`, `STEM-001.png`, …
    pub folder: PathBuf,
    /// Of their names.
    pub stem: String,
    /// How they are developed.
    pub development: Development,
    /// What they say about themselves.
    pub metadata: Metadata,
    /// Set where no more are wanted.
    pub stop: Arc<AtomicBool>,
    /// Pictures that are written.
    pub done: u32,
}

/// A turntable in work, as the panel shows it.
#[derive(Debug, Clone)]
pub struct Turning {
    /// Pictures that are written.
    pub done: u32,
    /// All of them.
    pub of: u32,
    /// To be set where no more are wanted.
    pub stop: Arc<AtomicBool>,
}

impl Turntable {
    fn degrees(&self) -> f64 {
        360.0 * f64::from(self.done) / f64::from(self.pictures)
    }

    /// The camera of the next picture; none when all are written.
    pub(super) fn camera(&self) -> Option<Camera> {
        (self.done < self.pictures).then(|| self.wanted.camera.turned(self.degrees()))
    }

    /// Whether no more are wanted.
    pub(super) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Write the next picture; returns how many there are by then, or what went wrong.
    pub(super) fn write(&mut self, frame: &Frame) -> Result<u32, String> {
        let path = numbered(&self.folder.join(&self.stem).with_extension("png"), self.done);
        let metadata = self.metadata.clone().with("turned", format!("{} degrees", self.degrees()));
        let bytes = png_of(frame, self.development, &metadata).map_err(|error| error.to_string())?;
        write_whole(&path, &bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        self.done += 1;
        Ok(self.done)
    }
}
