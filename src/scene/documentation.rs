//! Holds `docs/scenes.md` to the loader.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use super::source::Source;
use super::{Scene, fault};

/// The blocks of the document with this info string: the line on which each starts, and its text.
fn blocks<'a>(document: &'a str, info: &str) -> Vec<(usize, &'a str)> {
    let fence = format!("```{info}\n");
    let starts = document.match_indices(&fence);
    starts
        .map(|(at, _)| {
            let text = &document[at + fence.len()..];
            (document[..at].lines().count() + 1, &text[..text.find("```").unwrap()])
        })
        .collect()
}

fn document() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scenes.md")).unwrap()
}

#[test]
fn complete_scenes_of_the_document_load_without_a_warning() {
    let document = document();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("scene.toml");
    let scenes = blocks(&document, "toml complete");
    assert!(scenes.len() >= 2);
    for (line, text) in scenes {
        fs::write(&path, text).unwrap();
        let scene = Scene::load(&path).unwrap_or_else(|error| panic!("line {line}: {error}"));
        assert!(scene.warnings.is_empty(), "line {line}: {:?}", scene.warnings);
    }
}

#[test]
fn parts_of_scenes_in_the_document_are_read() {
    let document = document();
    let parts = blocks(&document, "toml");
    assert!(parts.len() >= 6);
    for (line, text) in parts {
        let read = fault::parse(&Source::new(Path::new("scenes.md"), text.into()));
        assert!(read.is_ok(), "line {line}: {}", read.unwrap_err());
    }
}

#[test]
fn every_key_of_the_format_is_in_the_document() {
    let document = document();
    for table in [
        "NO",
        "camera = { NO }",
        "render = { NO }",
        "ambient = { NO }",
        "background = { NO }",
        "light = [{ NO }]",
        "light = [{ falloff = 'no' }]",
        "material.a = { NO }",
        "material.a.ambient = { NO }",
        "material.a.diffuse = { NO }",
        "material.a.specular = { NO }",
        "model = [{ NO }]",
        "model = [{ repeat = { NO } }]",
        "model = [{ shape = { NO } }]",
        "model = [{ shape.sphere = { NO } }]",
        "model = [{ shape.box = { NO } }]",
        "model = [{ shape.rounded_box = { NO } }]",
        "model = [{ shape.cylinder = { NO } }]",
        "model = [{ shape.torus = { NO } }]",
        "model = [{ shape.plane = { NO } }]",
    ] {
        let text = table.replace("NO", "zzzzzzzz = 1");
        let error = fault::parse(&Source::new(Path::new("a.toml"), text)).unwrap_err();
        let hint = error.diagnostics()[0].hint.clone().unwrap_or_default();
        let keys: Vec<_> = hint.split('`').skip(1).step_by(2).collect();
        assert!(!keys.is_empty(), "{table}: {error}");
        for key in keys {
            let forms = [format!("`{key}`"), format!("`\"{key}\"`"), format!("[{key}")];
            assert!(
                forms.iter().any(|form| document.contains(form)),
                "`{key}` of {table} is not in the document"
            );
        }
    }
}
