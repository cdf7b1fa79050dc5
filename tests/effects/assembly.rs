//! What is not called for is not in the shader.

use snellius::gpu::{SOURCES, Variant, assemble};
use snellius::layout::{Effects, Settings};

use super::subject::Subject;

/// The shader that traces a scene, and the names of its functions, globals and fields.
fn assembled(name: &str) -> (String, Vec<String>) {
    assembled_for(&Subject::file(name, [8, 6]))
}

fn assembled_for(subject: &Subject) -> (String, Vec<String>) {
    let plan = Effects::of(&subject.flat, &subject.settings).plan(&subject.settings);
    let variant = Variant::new(subject.flat.bvh_depth, &subject.settings, &plan);
    let shader = assemble(SOURCES, "render", "render", &variant).unwrap();
    let module = &shader.module;
    let functions = module.functions.iter().filter_map(|(_, one)| one.name.clone());
    let globals = module.global_variables.iter().filter_map(|(_, one)| one.name.clone());
    let mut names: Vec<_> = functions.chain(globals).collect();
    for (_, kind) in module.types.iter() {
        if let (naga::TypeInner::Struct { members, .. }, Some(record)) = (&kind.inner, &kind.name) {
            names.extend(members.iter().filter_map(|one| Some(format!("{record}.{}", one.name.as_ref()?))));
        }
    }
    (shader.wgsl, names)
}

/// Records that the host fills for every scene alike, and the picture itself: their fields stay.
const SHARED: [&str; 4] = ["Material.", "View.", "FilmHead.", "Film.texels"];

fn assert_absent(scene: &str, words: &[&str]) {
    let (_, names) = assembled(scene);
    let own = names.iter().filter(|name| !SHARED.iter().any(|shared| name.starts_with(shared)));
    let found: Vec<_> =
        own.filter(|name| words.iter().any(|word| name.to_lowercase().contains(word))).collect();
    assert!(found.is_empty(), "{scene}: {found:?}");
}

#[test]
fn paint_calls_for_no_refraction_absorption_media_or_ray_stack() {
    let (wgsl, names) = assembled("opaque.toml");
    assert_absent(
        "opaque.toml",
        &["refract", "transmis", "transmits", "absor", "atten", "medi", "lane.stack", "stack_size"],
    );
    assert_absent(
        "opaque.toml",
        &["scatter", "fresnel", "environment", "texture", "texels", "spawn", "exp_neg"],
    );
    // The words that would be there are those that are searched for.
    let (_, general) = assembled("ice.toml");
    for name in ["Lane.stack", "stack_size", "cross_face", "attenuation", "Scatter.refracted", "Branch.media"]
    {
        assert!(general.contains(&name.to_owned()) && !names.contains(&name.to_owned()), "{name}");
    }
    // What is there is short.
    assert!(wgsl.contains("fn direct(surface: Surface, direction: vec3r) -> Direct"), "{wgsl}");
}

#[test]
fn a_tree_of_one_ray_is_never_cut_and_one_of_them_never_rests() {
    let subject = Subject::file("opaque.toml", [8, 6]);
    let (_, two) = assembled_for(&subject);
    let settings = Settings { samples: 1, ..subject.settings };
    let (_, one) = assembled_for(&subject.under(settings));
    let (_, tree) = assembled("mirrors.toml");
    let has = |names: &[String], name: &str| names.contains(&name.to_owned());
    for name in ["Sample.dropped", "Sample.bound", "worth_tracing"] {
        assert!(has(&tree, name) && !has(&two, name) && !has(&one, name), "{name}");
    }
    for name in ["Film.lanes", "Lane.sample_index", "lane"] {
        assert!(has(&tree, name) && has(&two, name) && !has(&one, name), "{name}");
    }
}

#[test]
fn mirrors_need_no_stack_and_no_media() {
    let (_, names) = assembled("mirrors.toml");
    assert!(names.contains(&"Lane.branch".to_owned()) && names.contains(&"scatter".to_owned()));
    assert_absent(
        "mirrors.toml",
        &["refract", "transmis", "transmits", "medi", "lane.stack", "stack_size", "fresnel", "exp_neg"],
    );
}

#[test]
fn a_setting_turns_only_its_own_effects_on() {
    let subject = Subject::file("opaque.toml", [8, 6]);
    let set = |settings: Settings| Effects::of(&subject.flat, &settings).plan(&settings).effects;
    let plain = set(Settings { samples: 1, ..subject.settings });
    use snellius::layout::Effect::{Antialiasing, Aovs};
    assert_eq!(set(subject.settings), plain.with(Antialiasing));
    assert_eq!(set(Settings { samples: 1, aovs: true, ..subject.settings }), plain.with(Aovs));
}
