//! Who imports whom: `use crate::` lines against the table of the architecture.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

/// Each module with the modules it may import besides itself. `cli` may import all.
const MAY_IMPORT: &[(&str, &[&str])] = &[
    ("scene", &[]),
    ("layout", &[]),
    ("bvh", &["layout"]),
    ("flatten", &["scene", "bvh", "layout"]),
    ("kernel", &["layout"]),
    ("film", &["layout"]),
    ("cpu", &["kernel", "bvh", "layout", "film"]),
    ("gpu", &["bvh", "layout", "film"]),
    ("bench", &["kernel", "bvh", "flatten", "cpu", "gpu", "film", "layout", "scene"]),
    ("plot", &[]),
    ("study", &["flatten", "cpu", "gpu", "film", "layout", "scene", "plot"]),
    ("trace", &["kernel", "gpu", "flatten", "film", "layout", "scene", "plot"]),
    ("viewer", &["flatten", "cpu", "gpu", "layout", "film", "scene", "trace"]),
    ("selftest", &["kernel", "bvh", "layout", "film", "scene", "flatten", "cpu", "gpu"]),
];

/// Crates that a module must do without: the kernel is plain arithmetic.
const FORBIDDEN_CRATES: &[(&str, &[&str])] =
    &[("kernel", &["rayon", "wgpu", "glam", "std::fs", "std::thread"]), ("scene", &["wgpu", "rayon"])];

fn sources() -> Vec<(String, PathBuf)> {
    fn walk(folder: &Path, module: Option<&str>, found: &mut Vec<(String, PathBuf)>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
            if path.is_dir() {
                walk(&path, Some(module.unwrap_or(&stem)), found);
            } else if path.extension().is_some_and(|e| e == "rs") {
                found.push((module.unwrap_or(&stem).to_owned(), path));
            }
        }
    }
    let mut found = Vec::new();
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), None, &mut found);
    found
}

/// What a module's text breaks: forbidden imports by line.
fn violations(module: &str, text: &str) -> Vec<String> {
    let Some((_, allowed)) = MAY_IMPORT.iter().find(|(name, _)| *name == module) else { return Vec::new() };
    let forbidden = FORBIDDEN_CRATES.iter().filter(|(name, _)| *name == module).flat_map(|(_, list)| *list);
    let forbidden: Vec<_> = forbidden.collect();
    // Unit tests at the end of a file, or in one of their own, may import what they please.
    let is_test = |line: &&str| line.starts_with("#[cfg(test)]") || line.starts_with("#![cfg(test)]");
    let code = text.lines().take_while(|line| !is_test(line));
    let mut found = Vec::new();
    for (number, line) in code.enumerate() {
        let imported = line
            .split("crate::")
            .skip(1)
            .map(|rest| rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default());
        for target in
            imported.filter(|target| MAY_IMPORT.iter().any(|(name, _)| name == target) || *target == "cli")
        {
            if target != module && !allowed.contains(&target) && !line.trim_start().starts_with("//") {
                found.push(format!("line {}: {module} imports {target}", number + 1));
            }
        }
        let uses = |name: &str| line.contains(&format!("{name}::")) && !line.trim_start().starts_with("//");
        found.extend(
            forbidden.iter().filter(|c| uses(c)).map(|c| format!("line {}: {module} uses {c}", number + 1)),
        );
    }
    found
}

#[test]
fn modules_import_only_what_the_architecture_allows() {
    let mut seen = std::collections::BTreeSet::new();
    for (module, path) in sources() {
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(violations(&module, &text), Vec::<String>::new(), "{}", path.display());
        seen.insert(module);
    }
    for (module, _) in MAY_IMPORT {
        assert!(seen.contains(*module), "{module} is in the table, but not in src/");
    }
}

#[test]
fn a_forbidden_import_is_caught() {
    assert_eq!(violations("gpu", "use crate::kernel::World;"), ["line 1: gpu imports kernel"]);
    assert_eq!(violations("kernel", "use rayon::prelude::*;"), ["line 1: kernel uses rayon"]);
    assert!(violations("cpu", "use crate::kernel::World;\nuse super::Tile;").is_empty());
}
