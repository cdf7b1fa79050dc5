//! What the TOML reader complains about, in a scene's terms.

use super::document::Document;
use super::source::Source;
use super::{Diagnostic, SceneError};

/// Read the tables of a scene file.
pub(super) fn parse(source: &Source) -> Result<Document, SceneError> {
    toml::from_str(&source.text).map_err(|error| diagnose(&error, source).into())
}

/// Turn the reader's complaint into a message with a hint. A complaint of this library may carry its hint in
/// a second line.
fn diagnose(error: &toml::de::Error, source: &Source) -> Diagnostic {
    let (message, hint) = match error.message().split_once('\n') {
        Some((message, hint)) => (message.to_owned(), Some(hint.to_owned())),
        None => (error.message().replace("missing field", "missing key"), None),
    };
    let diagnostic = match unknown_name(&message) {
        Some((kind, name, known)) => {
            Diagnostic::error(format!("unknown {kind} `{name}`")).hint(suggest(name, &known))
        }
        None => Diagnostic { hint: hint.or_else(|| advise(&message)), ..Diagnostic::error(message) },
    };
    match error.span() {
        Some(span) => diagnostic.at(source.locate(span)),
        None => diagnostic,
    }
}

/// Take serde's "unknown field `a`, expected one of `b`, `c`" apart: what it is, its name, the known names.
fn unknown_name(message: &str) -> Option<(&'static str, &str, Vec<&str>)> {
    let (kind, rest) = [("key", "unknown field "), ("value", "unknown variant ")]
        .into_iter()
        .find_map(|(kind, start)| Some((kind, message.strip_prefix(start)?)))?;
    let mut quoted = rest.split('`').skip(1).step_by(2);
    let name = quoted.next()?;
    Some((kind, name, quoted.collect()))
}

/// Advice for common slips, by the reader's words.
fn advise(message: &str) -> Option<String> {
    if message.contains("map, expected a sequence") {
        Some("a table that may occur several times has double brackets, like [[light]]".into())
    } else if message.contains("sequence, expected struct") {
        Some("a table that occurs once has single brackets, like [camera]".into())
    } else {
        None
    }
}

/// "did you mean …?" where a known name is near, and all the known names.
pub(super) fn suggest(name: &str, known: &[&str]) -> String {
    let near = known
        .iter()
        .map(|candidate| (strsim::osa_distance(&name.to_lowercase(), candidate), candidate))
        .filter(|(distance, candidate)| *distance <= candidate.chars().count().div_ceil(3))
        .min_by_key(|(distance, _)| *distance);
    let list = known.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    match near {
        Some((_, candidate)) => format!("did you mean `{candidate}`? known here: {list}"),
        None => format!("known here: {list}"),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;

    fn fault(text: &str) -> (String, usize, usize, String) {
        let source = Source::new(Path::new("a.toml"), text.into());
        let error = parse(&source).unwrap_err();
        let diagnostic = &error.diagnostics()[0];
        let place = diagnostic.location.clone().unwrap();
        (diagnostic.message.clone(), place.line, place.column, diagnostic.hint.clone().unwrap_or_default())
    }

    #[test]
    fn an_unknown_key_is_located_and_the_nearest_one_named() {
        let (message, line, column, hint) = fault("[camera]\neye = [0, 0, 1]\n fov = 30\n");
        assert_eq!((message.as_str(), line, column), ("unknown key `fov`", 3, 2));
        assert!(hint.starts_with("did you mean `fov_y`?"), "{hint}");
    }

    #[test]
    fn an_unknown_table_is_located() {
        let (message, line, column, hint) = fault("\n[lights]\nposition = [0, 0, 1]\n");
        assert_eq!((message.as_str(), line, column), ("unknown key `lights`", 2, 2));
        assert!(hint.starts_with("did you mean `light`?"), "{hint}");
    }

    #[test]
    fn a_far_fetched_key_gets_the_list_only() {
        let (_, _, _, hint) = fault("zzzzzzzz = 1");
        assert!(hint.starts_with("known here: `camera`, `render`"), "{hint}");
    }

    #[test]
    fn unknown_values_and_shapes_are_located() {
        let (message, line, column, hint) = fault("[[light]]\nposition = [0, 0, 1]\nfalloff = \"square\"");
        assert_eq!((message.as_str(), line, column), ("unknown value `square`", 3, 11));
        assert!(hint.contains("`inverse-square`"), "{hint}");
        let (message, line, column, hint) = fault("[[model]]\nshape = { spere = { radius = 1 } }");
        assert_eq!((message.as_str(), line, column), ("unknown value `spere`", 2, 11));
        assert!(hint.starts_with("did you mean `sphere`?"), "{hint}");
        let (message, line, column, _) = fault("[[model]]\nshape = { sphere = { radius = 1, lvl = 2 } }");
        assert_eq!((message.as_str(), line, column), ("unknown key `lvl`", 2, 34));
    }

    #[test]
    fn single_brackets_for_a_list_get_advice() {
        let (_, line, _, hint) = fault("[light]\nposition = [0, 0, 1]");
        assert_eq!(line, 1);
        assert!(hint.contains("[[light]]"), "{hint}");
    }

    #[test]
    fn numbers_inside_arrays_are_located() {
        let (message, line, column, _) = fault("[camera]\neye = [0, nan, 1]");
        assert_eq!((message.as_str(), line, column), ("NaN is not a usable number", 2, 11));
        let (message, line, column, _) = fault("[render]\nsize = [640, 0]");
        assert!(message.contains("from 1 to 16384"), "{message}");
        assert_eq!((line, column), (2, 14));
    }

    #[test]
    fn a_colour_brings_its_own_hint() {
        let (message, line, column, hint) = fault("[ambient]\ncolor = [1, 1, 1]");
        assert!(message.contains("nearly black"), "{message}");
        assert_eq!((line, column, hint.contains("[1.0, 1.0, 1.0]")), (2, 9, true));
    }

    #[test]
    fn syntax_errors_are_located() {
        let (_, line, column, _) = fault("[camera]\neye = [0, 0\nfov_y = 3");
        assert!(line >= 2 && column >= 1);
        let (_, line, _, _) = fault("[camera]\neye = \n");
        assert_eq!(line, 2);
    }

    #[test]
    fn a_missing_key_points_at_its_table() {
        let (message, line, _, _) = fault("\n[[light]]\ncolor = \"#ffffff\"");
        assert_eq!((message.as_str(), line), ("missing key `position`", 2));
    }
}
