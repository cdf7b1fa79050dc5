//! What is to be studied, and who waits for it.

use std::path::PathBuf;
use std::time::Duration;

use super::Knob;
use crate::gpu::AdapterReport;

/// What to study.
#[derive(Debug, Clone)]
pub struct Config {
    /// The scene file.
    pub scene: PathBuf,
    /// Where results go; made if it is not there. An unfinished study of the same key is taken up again.
    pub folder: PathBuf,
    /// Pixels; the scene's own without.
    pub size: Option<[u32; 2]>,
    /// The baseline's depth; the scene's own without.
    pub depth: Option<u32>,
    /// The baseline's cut-off; the scene's own without.
    pub cutoff: Option<f32>,
    /// The knobs to turn.
    pub knobs: Vec<Knob>,
    /// The adapters to compare with.
    pub adapters: Vec<AdapterReport>,
    /// About how long the study may take.
    pub budget: Duration,
    /// Begin anew, whatever lies in the folder.
    pub fresh: bool,
    /// The processor's name.
    pub cpu: String,
}

/// Who waits for a study.
pub trait Watch: Sync {
    /// What is being done, in words; and the share that is done, in [0, 1].
    fn stage(&self, words: &str, share: f64);

    /// Called often: a sign of life.
    fn tick(&self);

    /// Whether to stop.
    fn is_interrupted(&self) -> bool;
}
