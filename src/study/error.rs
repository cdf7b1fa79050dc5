//! Why a study cannot be made.

use std::io;
use std::path::PathBuf;

use crate::cpu::CpuError;
use crate::film::{DifferenceError, EncodeError, OutputError};
use crate::gpu::GpuError;
use crate::plot::RasterError;
use crate::scene::SceneError;

/// Why a study cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// No threads.
    #[error(transparent)]
    Cpu(#[from] CpuError),
    /// An adapter failed where nothing can be learnt without it.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// Pictures of one study differ in size.
    #[error(transparent)]
    Difference(#[from] DifferenceError),
    /// A picture cannot be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A picture cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The folder, or a file in it, cannot be written.
    #[error("cannot write {}: {error}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// Why not.
        #[source]
        error: io::Error,
    },
    /// The report cannot be put into words.
    #[error("cannot write the study as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A plot cannot be drawn in pixels.
    #[error(transparent)]
    Raster(#[from] RasterError),
    /// Not even the baseline fits the time.
    #[error("one picture of the baseline takes over {seconds:.0} s, half of the time of the whole study")]
    TooSlow {
        /// Half of the budget.
        seconds: f64,
    },
    /// Ctrl-C.
    #[error("interrupted: what is finished is kept, and the same command goes on from there")]
    Interrupted,
}
