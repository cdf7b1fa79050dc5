//! How an example ends.

use std::fmt::Display;
use std::process::ExitCode;

/// 0 if all holds, 1 if it does not, 2 with the reason if that cannot be told.
pub(crate) fn verdict(holds: Result<bool, impl Display>) -> ExitCode {
    match holds {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
