//! Every way a command ends, and the exit code of each.

use std::io;

use thiserror::Error;

use crate::bench::BenchError;
use crate::bench::rays::RayError;
use crate::cpu::CpuError;
use crate::film::{DifferenceError, EncodeError, LoadError, OutputError};
use crate::gpu::GpuError;
use crate::scene::{Diagnostic, SceneError};
use crate::selftest::DeviceError;
use crate::study::StudyError;
#[cfg(feature = "viewer")]
use crate::viewer::ViewerError;

/// How a command that met no error ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Everything was done.
    Done,
    /// A comparison failed.
    Failed,
    /// Ctrl-C; what was finished is written.
    Interrupted,
}

impl Outcome {
    /// 0, 1, and 128 + SIGINT as shells have it.
    pub(super) fn exit_code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Failed => 1,
            Self::Interrupted => 130,
        }
    }
}

/// Why a command could not do what it was asked.
#[derive(Debug, Error)]
pub(super) enum CliError {
    /// Flags that do not go together, or not with this scene.
    #[error("{message}")]
    Usage {
        /// What is wrong.
        message: String,
        /// What to do.
        hint: Option<String>,
    },
    /// A goal that cannot be met.
    #[error("{message}")]
    Unmet {
        /// Which one.
        message: String,
        /// What could be had.
        hint: String,
    },
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error(transparent)]
    Encode(#[from] EncodeError),
    #[error(transparent)]
    Load(#[from] LoadError),
    #[error(transparent)]
    Difference(#[from] DifferenceError),
    #[error(transparent)]
    Cpu(#[from] CpuError),
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error(transparent)]
    Rays(#[from] RayError),
    #[error(transparent)]
    Bench(BenchError),
    #[error(transparent)]
    Study(StudyError),
    #[cfg(feature = "viewer")]
    #[error(transparent)]
    Viewer(#[from] ViewerError),
    #[error("cannot write the report as JSON: {0}")]
    Json(serde_json::Error),
}

impl From<BenchError> for CliError {
    fn from(error: BenchError) -> Self {
        match error {
            BenchError::Cpu(error) => Self::Cpu(error),
            BenchError::Gpu(error) => Self::Gpu(error),
            BenchError::Scene(error) => Self::Scene(error),
            BenchError::Rays(error) => Self::Rays(error),
            BenchError::Encode(error) => Self::Encode(error),
            other @ BenchError::Folder(_) => Self::Bench(other),
        }
    }
}

/// A study fails with the errors of its parts, which keep their exit codes.
impl From<StudyError> for CliError {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Scene(error) => Self::Scene(error),
            StudyError::Cpu(error) => Self::Cpu(error),
            StudyError::Gpu(error) => Self::Gpu(error),
            other => Self::Study(other),
        }
    }
}

impl From<DeviceError> for CliError {
    fn from(error: DeviceError) -> Self {
        match error {
            DeviceError::Cpu(error) => Self::Cpu(error),
            DeviceError::Gpu(error) => Self::Gpu(error),
            DeviceError::Scene(error) => Self::Scene(error),
        }
    }
}

impl CliError {
    /// Flags that do not go together.
    pub(super) fn usage(message: impl Into<String>) -> Self {
        Self::Usage { message: message.into(), hint: None }
    }

    /// A goal that cannot be met.
    pub(super) fn unmet(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Unmet { message: message.into(), hint: hint.into() }
    }

    /// The same with advice.
    pub(super) fn hint(self, hint: impl Into<String>) -> Self {
        match self {
            Self::Usage { message, .. } => Self::Usage { message, hint: Some(hint.into()) },
            other => other,
        }
    }

    /// 1 for a goal that is not met; 2 for usage, scenes and files; 3 and 4 as devices say.
    pub(super) fn exit_code(&self) -> u8 {
        if self.is_closed_pipe() {
            return Outcome::Done.exit_code();
        }
        match self {
            Self::Gpu(error) => error.exit_code(),
            Self::Unmet { .. } => Outcome::Failed.exit_code(),
            #[cfg(feature = "viewer")]
            Self::Viewer(error) => error.exit_code(),
            Self::Usage { .. }
            | Self::Cpu(_)
            | Self::Scene(_)
            | Self::Output(_)
            | Self::Encode(_)
            | Self::Load(_)
            | Self::Difference(_)
            | Self::Rays(_)
            | Self::Bench(_)
            | Self::Study(_)
            | Self::Json(_) => 2,
        }
    }

    /// Whether the reader of standard output has seen enough (`snellius check … | head`).
    pub(super) fn is_closed_pipe(&self) -> bool {
        matches!(self, Self::Output(OutputError::Io { error, .. }) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// The message as a compiler would print it, without a last line break.
    pub(super) fn render(&self, color: bool) -> String {
        if let Self::Scene(error) = self {
            let faults: Vec<_> = error.diagnostics().iter().map(|fault| fault.render(color)).collect();
            return faults.join("\n\n");
        }
        let hint = match self {
            Self::Usage { hint, .. } => hint.clone(),
            Self::Unmet { hint, .. } => Some(hint.clone()),
            #[cfg(feature = "viewer")]
            Self::Viewer(error) => error.hint().map(str::to_owned),
            _ => None,
        };
        Diagnostic { hint, ..Diagnostic::error(self.to_string()) }.render(color)
    }
}
