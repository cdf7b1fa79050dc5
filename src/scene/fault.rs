//! What the TOML reader complains about, in a scene's terms.

use super::document::Document;
use super::source::Source;
use super::{Diagnostic, SceneError};

/// Read the tables of a scene file.
pub(super) fn parse(source: &Source) -> Result<Document, SceneError> {
    toml::from_str(&source.text).map_err(|error| diagnose(&error, source).into())
}

/// Turn the reader's complaint into a message with a hint.
fn diagnose(error: &toml::de::Error, source: &Source) -> Diagnostic {
    let (message, hint) = reword(error.message());
    let diagnostic = Diagnostic { hint, ..Diagnostic::error(message) };
    diagnostic.at(source.locate(error.span().unwrap_or_default()))
}

/// Complaints that speak of Rust: a part of them, what to say instead, and a hint.
const REWORDED: [(&str, &str, &str); 6] = [
    (
        "unit variant, expected newtype variant",
        "a shape needs its measures",
        "write them as a table, like shape = { sphere = { radius = 1 } }",
    ),
    (
        "wanted exactly 1 element",
        "a model has exactly one shape",
        "write one, like shape = { sphere = { radius = 1 } }",
    ),
    ("wanted string or table", "this is not a word", "write a word between quotes"),
    (
        "map, expected a sequence",
        "this table may occur several times",
        "give it double brackets, like [[light]]",
    ),
    ("recurs", "tables, arrays or dotted keys are nested too deeply", "a scene needs four levels"),
    ("sequence, expected a table", "this table occurs once only", "give it single brackets, like [camera]"),
];

/// Say a complaint in a scene's terms: the message and its hint. A complaint of this library may carry its
/// hint in a second line.
fn reword(complaint: &str) -> (String, Option<String>) {
    if let Some((kind, name, known)) = unknown_name(complaint) {
        return (format!("unknown {kind} `{name}`"), Some(suggest(name, &known)));
    }
    if let Some((_, message, hint)) = REWORDED.iter().find(|(part, ..)| complaint.contains(part)) {
        return ((*message).into(), Some((*hint).into()));
    }
    match complaint.split_once('\n') {
        Some((message, hint)) => (message.into(), Some(hint.into())),
        None => (
            complaint
                .replace("missing field", "missing key")
                .replace("expected i32", "expected a 32-bit integer"),
            None,
        ),
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

/// The most known names that a hint lists.
const MAX_LISTED: usize = 16;

/// "did you mean …?" where a known name is near, and the known names.
pub(super) fn suggest(name: &str, known: &[&str]) -> String {
    let name = name.to_lowercase();
    let near = known
        .iter()
        .map(|candidate| (strsim::osa_distance(&name, &candidate.to_lowercase()), candidate))
        .filter(|(distance, candidate)| *distance <= candidate.chars().count().div_ceil(3))
        .min_by_key(|(distance, _)| *distance);
    let question = near.map_or(String::new(), |(_, candidate)| format!("did you mean `{candidate}`? "));
    let listed: Vec<_> = known.iter().take(MAX_LISTED).map(|name| format!("`{name}`")).collect();
    let more = if known.len() > MAX_LISTED { ", …" } else { "" };
    format!("{question}known here: {}{more}", listed.join(", "))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;

    fn fault(text: &str) -> (String, u32, u32, String) {
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
    fn long_lists_are_cut_and_case_does_not_matter() {
        let names: Vec<_> = (0..40).map(|number| format!("Glass{number}")).collect();
        let known: Vec<_> = names.iter().map(String::as_str).collect();
        let hint = suggest("glass39x", &known);
        assert!(hint.starts_with("did you mean `Glass39`? known here: `Glass0`, "), "{hint}");
        assert!(hint.ends_with("`Glass15`, …"), "{hint}");
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
    fn complaints_speak_of_scenes_not_of_rust() {
        for (text, message, line, column) in [
            ("[[model]]\nshape = 'sphere'", "a shape needs its measures", 2, 9),
            ("[[model]]\nshape = {}", "a model has exactly one shape", 2, 9),
            ("[[light]]\nposition = [0, 0, 1]\nfalloff = 3", "this is not a word", 3, 11),
            ("[[camera]]\neye = [0, 0, 1]", "this table occurs once only", 1, 1),
            ("camera = 3", "invalid type: integer `3`, expected a table", 1, 10),
            (
                "[material.a]\ndiffuse = '#ff0000'",
                "invalid type: string \"#ff0000\", expected a table",
                2,
                11,
            ),
            (
                "[[model]]\npriority = 3000000000",
                "invalid value: integer `3000000000`, expected a 32-bit integer",
                2,
                12,
            ),
        ] {
            let (found, at_line, at_column, _) = fault(text);
            assert_eq!((found.as_str(), at_line, at_column), (message, line, column), "{text}");
        }
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
    fn what_is_nested_too_deeply_has_a_place() {
        for text in [format!("a{} = 1", ".a".repeat(9999)), format!("a = {}", "[".repeat(9999))] {
            let (message, line, ..) = fault(&text);
            assert_eq!((message.as_str(), line), ("tables, arrays or dotted keys are nested too deeply", 1));
        }
    }

    #[test]
    fn a_missing_key_points_at_its_table() {
        let (message, line, _, _) = fault("\n[[light]]\ncolor = \"#ffffff\"");
        assert_eq!((message.as_str(), line), ("missing key `position`", 2));
    }
}
