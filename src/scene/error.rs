//! Why a scene cannot be loaded.

use std::fmt;

use super::Diagnostic;

/// Why a scene cannot be loaded: one or more faults in the user's files, in the order they were found.
///
/// Displays every fault as [`Diagnostic::render`] does, without colour.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct SceneError {
    diagnostics: Vec<Diagnostic>,
}

impl SceneError {
    /// The faults, at least one.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }
}

impl From<Diagnostic> for SceneError {
    fn from(diagnostic: Diagnostic) -> Self {
        Self { diagnostics: vec![diagnostic] }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, diagnostic) in self.diagnostics.iter().enumerate() {
            let gap = if index == 0 { "" } else { "\n\n" };
            write!(f, "{gap}{}", diagnostic.render(false))?;
        }
        Ok(())
    }
}

/// How many faults are gathered; of more, the first are enough to begin with.
const MAX_FAULTS: usize = 20;

/// Gathers the faults of things that are read one by one, so that a person sees them together, each once.
#[derive(Debug, Default)]
pub(super) struct Faults {
    found: Vec<Diagnostic>,
}

impl Faults {
    /// Keep a value, or note why there is none.
    pub(super) fn keep<T, E: Into<SceneError>>(&mut self, result: Result<T, E>) -> Option<T> {
        result.map_err(|error| error.into().diagnostics.into_iter().for_each(|fault| self.note(fault))).ok()
    }

    /// Note a fault.
    pub(super) fn note(&mut self, fault: Diagnostic) {
        if self.found.len() < MAX_FAULTS && !self.found.contains(&fault) {
            self.found.push(fault);
        }
    }

    /// Fail with everything noted.
    pub(super) fn into_result(self) -> Result<(), SceneError> {
        if self.found.is_empty() { Ok(()) } else { Err(SceneError { diagnostics: self.found }) }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn gathered_faults_are_all_displayed() {
        let mut faults = Faults::default();
        assert_eq!(faults.keep(Ok::<_, SceneError>(1)), Some(1));
        assert_eq!(faults.keep::<u8, _>(Err(Diagnostic::error("first"))), None);
        assert_eq!(faults.keep::<u8, _>(Err(Diagnostic::error("second"))), None);
        let error = faults.into_result().map_err(|error| error.to_string());
        assert_eq!(error, Err("error: first\n\nerror: second".into()));
    }

    #[test]
    fn a_fault_met_twice_is_told_once_and_a_flood_is_cut() {
        let mut faults = Faults::default();
        for number in 0..100 {
            faults.note(Diagnostic::error(format!("fault {}", number / 2)));
        }
        let error = faults.into_result().unwrap_err();
        assert_eq!(error.diagnostics().len(), MAX_FAULTS);
        assert_eq!(error.diagnostics()[1].message, "fault 1");
    }

    #[test]
    fn no_fault_is_no_error() {
        assert_eq!(Faults::default().into_result(), Ok(()));
    }
}
