//! What can go wrong between this program and an adapter.

use thiserror::Error;

/// What can go wrong between this program and an adapter.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum GpuError {
    /// No adapter, or none of the wanted name.
    #[error("{}", no_adapter(.wanted.as_deref(), .found))]
    NoAdapter {
        /// The part of a name that was asked for.
        wanted: Option<String>,
        /// Names of the adapters there are.
        found: Vec<String>,
    },
    /// `--precision f64` on an adapter without 64-bit floats.
    #[error("{adapter} has no 64-bit floats (Vulkan's shaderFloat64): use --backend cpu for --precision f64")]
    NoF64 {
        /// Its name.
        adapter: String,
    },
    /// The scene or the picture is over a limit of the adapter.
    #[error(
        "{what}: {needed} bytes, but {adapter} allows {limit} in one buffer: use --backend cpu, or less of it"
    )]
    TooLarge {
        /// What does not fit, in words.
        what: &'static str,
        /// Its size in bytes.
        needed: u64,
        /// The adapter's limit in bytes.
        limit: u64,
        /// The adapter's name.
        adapter: String,
    },
    /// The adapter has no memory left.
    #[error("{what}: {adapter} has no room for {needed} bytes")]
    OutOfMemory {
        /// What did not fit, in words.
        what: &'static str,
        /// Its size in bytes.
        needed: u64,
        /// The adapter's name.
        adapter: String,
    },
    /// A shader does not assemble, parse or validate: a fault of this program.
    #[error("{file}:{line}:{column}: {message}")]
    Shader {
        /// Shader file.
        file: String,
        /// From 1.
        line: u32,
        /// From 1, in characters.
        column: u32,
        /// What is wrong.
        message: String,
    },
    /// The driver refuses a request that its limits and features allow.
    #[error("{adapter} refuses {what}: {reason}")]
    Refused {
        /// The adapter's name.
        adapter: String,
        /// What was asked for, in words.
        what: &'static str,
        /// The driver's words.
        reason: String,
    },
    /// The device is gone, or answers no more.
    #[error("the device was lost: {reason}")]
    DeviceLost {
        /// The driver's words, or what was waited for.
        reason: String,
    },
    /// The driver ended loops before their time: a ray with its shadow rays took more rounds than it allows.
    #[error(
        "{adapter} ends the loops of a shader after a fixed number of rounds, and a ray of this scene with its shadow rays \
         takes more: use --backend cpu, or fewer lights"
    )]
    LoopLimit {
        /// The adapter's name.
        adapter: String,
    },
    /// A submission was reported as finished, but part of it never ran.
    #[error(
        "the device was lost in silence: {done} of {expected} invocations of the tile at block {first_block} ran"
    )]
    TileLost {
        /// The tile's first block.
        first_block: u32,
        /// Invocations submitted.
        expected: u32,
        /// Invocations that ran.
        done: u32,
    },
}

impl GpuError {
    /// The program's exit code for this error: 2 for a scene or picture that does not fit, 3 for a device that
    /// is missing or cannot do what is asked, 4 for a device lost on the way.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::TooLarge { .. } | Self::LoopLimit { .. } => 2,
            Self::NoAdapter { .. } | Self::NoF64 { .. } | Self::Shader { .. } | Self::Refused { .. } => 3,
            Self::OutOfMemory { .. } | Self::DeviceLost { .. } | Self::TileLost { .. } => 4,
        }
    }
}

/// Name what was looked for and what there is.
fn no_adapter(wanted: Option<&str>, found: &[String]) -> String {
    match (wanted, found) {
        (_, []) => "no Vulkan adapter: install a driver (mesa-vulkan-drivers has one in software), or use \
                    --backend cpu"
            .to_owned(),
        (Some(wanted), found) => format!("no adapter is called {wanted:?}; there are: {}", found.join(", ")),
        (None, found) => format!("no adapter can be used; there are: {}", found.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_adapter_is_named_with_those_there_are() {
        let error = GpuError::NoAdapter { wanted: Some("radeon".into()), found: vec!["llvmpipe".into()] };
        assert_eq!(error.to_string(), "no adapter is called \"radeon\"; there are: llvmpipe");
        assert_eq!(error.exit_code(), 3);
    }

    #[test]
    fn a_limit_is_named_with_both_figures() {
        let error = GpuError::TooLarge { what: "triangles", needed: 4096, limit: 1024, adapter: "A".into() };
        let text = error.to_string();
        assert!(text.contains("triangles") && text.contains("4096") && text.contains("1024"), "{text}");
        assert_eq!(error.exit_code(), 2);
    }
}
