//! Guard 3: both devices have the same functions, in the same files and order.

use std::collections::BTreeMap;
use std::path::Path;

use snellius::gpu::{SOURCES, Source};
use syn::{ImplItem, Item, TraitItem};
use wesl::syntax::{GlobalDeclaration, TranslationUnit};

use super::planted::Planted;

/// Files on one side only, and why.
const ALONE: &[(&str, &str)] = &[
    ("blocks", "src/cpu numbers pixels as it likes"),
    ("bindings", "kernel::World holds what the buffers hold"),
    ("probe", "src/selftest/lockstep/record.rs is its twin"),
    ("probe_arithmetic", "src/selftest/arithmetic.rs is its twin"),
    ("probe_paths", "src/selftest/paths.rs is its twin"),
    ("probe_plain", "src/selftest/lockstep/plain.rs is its twin"),
    ("probe_rays", "src/selftest/rays.rs is its twin"),
    ("probe_scene", "src/selftest/lockstep/scene.rs is its twin"),
    ("rays", "src/bench/rays/host.rs is its twin"),
    ("records", "src/layout holds the records"),
    ("render", "the entry point: src/cpu is its twin"),
    ("sift", "the entry points between rounds: src/cpu is their twin"),
    ("vector", "WGSL has vectors"),
    (
        "wide",
        "src/bvh/pack.rs writes the tree, and src/kernel/bvh.rs goes through another, which never shows",
    ),
    ("world", "shaders/bindings is its twin"),
    ("mod", "lists the files"),
];

/// Functions on one side only, and why.
const EXCEPTIONS: &[(&str, &str, &str)] = &[
    ("math", "exp_neg_f64", "Rust has an exp of f64, WGSL has not"),
    ("real", "real", "a conversion, which WGSL writes as a type"),
    ("real", "of", "a conversion, which WGSL writes as a type"),
    ("real", "to_f32", "a conversion, which WGSL writes as a type"),
    ("real", "to_i32", "a conversion, which WGSL writes as a type"),
    ("real", "from_i32", "a conversion, which WGSL writes as a type"),
    ("real", "sqrt", "built into WGSL"),
    ("real", "floor", "built into WGSL"),
    ("real", "abs", "built into WGSL"),
];

/// Names of functions by file stem, in the order of the file.
pub(super) type Functions = BTreeMap<String, Vec<String>>;

pub(super) fn shader_functions(sources: &[Source<'_>]) -> Functions {
    let names = |text: &str| {
        let file: TranslationUnit = text.parse().unwrap();
        let name = |declaration: &GlobalDeclaration| match declaration {
            GlobalDeclaration::Function(function) => Some(function.ident.name().to_string()),
            _ => None,
        };
        file.global_declarations.iter().filter_map(|declaration| name(declaration.node())).collect()
    };
    sources.iter().map(|(stem, text)| ((*stem).to_owned(), names(text))).collect()
}

fn kernel_functions() -> Functions {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/kernel");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files
        .map(|path| {
            let file = syn::parse_file(&std::fs::read_to_string(&path).unwrap()).unwrap();
            let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
            (stem, file.items.iter().flat_map(item_functions).collect())
        })
        .collect()
}

/// Free functions, and what a trait or a type has of its own.
fn item_functions(item: &Item) -> Vec<String> {
    match item {
        Item::Fn(function) => vec![function.sig.ident.to_string()],
        Item::Trait(one) => one
            .items
            .iter()
            .filter_map(|item| match item {
                TraitItem::Fn(function) => Some(function.sig.ident.to_string()),
                _ => None,
            })
            .collect(),
        Item::Impl(one) if one.trait_.is_none() => one
            .items
            .iter()
            .filter_map(|item| match item {
                ImplItem::Fn(function) => Some(function.sig.ident.to_string()),
                _ => None,
            })
            .collect(),
        _ => Vec::new(),
    }
}

/// What one side has and the other lacks, what is in another order, and exceptions that except nothing.
fn differences(shaders: &Functions, kernel: &Functions) -> Vec<String> {
    let mut found = Vec::new();
    let stems = shaders.keys().chain(kernel.keys()).collect::<std::collections::BTreeSet<_>>();
    for stem in stems {
        let alone = ALONE.iter().any(|one| one.0 == stem);
        match (shaders.get(stem), kernel.get(stem)) {
            (Some(_), Some(_)) if alone => found.push(format!("{stem} is there twice, and listed as alone")),
            (Some(shader), Some(kernel)) => found.extend(file_differences(stem, shader, kernel)),
            _ if !alone => found.push(format!("{stem} has no twin")),
            _ => {}
        }
    }
    for (stem, name, _) in EXCEPTIONS {
        let has = |side: &Functions| side.get(*stem).is_some_and(|names| names.iter().any(|one| one == name));
        if has(shaders) == has(kernel) {
            found.push(format!("{stem}::{name} is an exception without need"));
        }
    }
    found
}

fn file_differences(stem: &str, shader: &[String], kernel: &[String]) -> Vec<String> {
    let excepted = |name: &&String| EXCEPTIONS.iter().any(|one| (one.0, one.1) == (stem, name.as_str()));
    let shader: Vec<_> = shader.iter().filter(|name| !excepted(name)).collect();
    let kernel: Vec<_> = kernel.iter().filter(|name| !excepted(name)).collect();
    let lacks = |side: &[&String], other: &[&String], place: &str| -> Vec<String> {
        let missing = side.iter().filter(|name| !other.contains(name));
        missing.map(|name| format!("{stem}::{name} is not in {place}")).collect()
    };
    let mut found = lacks(&shader, &kernel, "the kernel");
    found.extend(lacks(&kernel, &shader, "the shaders"));
    if found.is_empty() && shader != kernel {
        found.push(format!("{stem}: {shader:?} in the shaders, {kernel:?} in the kernel"));
    }
    found
}

#[test]
fn both_sides_have_the_same_functions() {
    assert_eq!(differences(&shader_functions(SOURCES), &kernel_functions()), Vec::<String>::new());
}

#[test]
fn every_shader_file_is_embedded() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    // The viewer embeds its own.
    let files = files.filter(|path| !path.ends_with("present.wgsl"));
    for path in files.filter(|path| path.extension().is_some_and(|extension| extension == "wgsl")) {
        let stem = path.file_stem().unwrap().to_string_lossy();
        assert!(SOURCES.iter().any(|source| source.0 == stem), "{stem} is not in src/gpu/sources.rs");
    }
}

#[test]
fn a_renamed_function_is_caught() {
    let planted = Planted::new("material", "fn scatter(", "fn spread(");
    let found = differences(&shader_functions(&planted.sources()), &kernel_functions());
    assert_eq!(found, ["material::spread is not in the kernel", "material::scatter is not in the shaders"]);
}

#[test]
fn functions_in_another_order_are_caught() {
    let mut shaders = shader_functions(SOURCES);
    shaders.get_mut("media").unwrap().swap(0, 1);
    let found = differences(&shaders, &kernel_functions());
    assert!(found.len() == 1 && found[0].starts_with("media:"), "{found:?}");
}
