//! The figures of an earlier run.

use std::fs;
use std::path::Path;

use serde::Deserialize;

use super::super::super::CliError;
use super::super::machine::Machine;
use crate::bench::SceneRow;

/// What is read of an earlier report.
#[derive(Debug, Deserialize)]
pub(super) struct Baseline {
    pub(super) machine: Machine,
    pub(super) scenes: Vec<SceneRow>,
}

impl Baseline {
    /// Read what `snellius bench --json` printed.
    pub(super) fn read(path: &Path) -> Result<Self, CliError> {
        let read = || {
            serde_json::from_slice(&fs::read(path).map_err(|error| error.to_string())?)
                .map_err(|error| error.to_string())
        };
        read().map_err(|reason: String| {
            CliError::usage(format!("cannot read the baseline {}: {reason}", path.display()))
                .hint("`snellius bench --json > FILE` makes one")
        })
    }

    /// The size of a scene's picture there.
    pub(super) fn size_of(&self, path: &Path) -> Option<[u32; 2]> {
        let name = path.file_name()?.to_string_lossy();
        self.scenes.iter().find(|row| row.scene == name).map(|row| row.size)
    }
}

/// A percentage, as a share of 1.
pub(super) fn share(text: &str) -> Result<f64, String> {
    match text.strip_suffix('%').and_then(|number| number.trim().parse::<f64>().ok()) {
        Some(percent) if (0.0..=10_000.0).contains(&percent) => Ok(percent / 100.0),
        _ => Err("expected a percentage from 0%, as in 5%".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_written_in_per_cent() {
        assert_eq!((share("5%"), share("0 %"), share("12.5%")), (Ok(0.05), Ok(0.0), Ok(0.125)));
        for wrong in ["5", "-1%", "%", "NaN%", "inf%"] {
            assert!(share(wrong).is_err(), "{wrong}");
        }
    }
}
