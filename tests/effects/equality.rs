//! A special kernel gives the bits of the general one.

use snellius::film::Frame;
use snellius::layout::{EffectChoice, EffectSet, Float, Settings};

use super::covering::{all_closed, covering, halves};
use super::subject::{Subject, assert_same, files};
use crate::lockstep::devices::{find, on_each};

/// The deepest ray of all scenes where they are to share a general pipeline.
const DEPTH: u32 = 8;

/// The scenes of `scenes/`, small.
fn scenes() -> impl Iterator<Item = Subject> {
    files().into_iter().map(|path| Subject::file(path.file_name().unwrap().to_str().unwrap(), [32, 24]))
}

/// The same so that one general pipeline serves all: with one depth, and the deepest tree first.
fn scenes_alike(float: Float) -> Vec<Subject> {
    let alike = scenes().map(|subject| {
        let settings = Settings { depth: DEPTH, float, ..subject.settings };
        subject.under(settings)
    });
    let mut alike: Vec<_> = alike.collect();
    alike.sort_by_key(|subject| std::cmp::Reverse(subject.flat.bvh_depth));
    alike
}

/// Sets that hold what a scene calls for.
fn supersets(subject: &Subject, choose: fn(EffectSet) -> Vec<EffectSet>) -> Vec<EffectChoice> {
    choose(subject.called_for()).into_iter().map(EffectChoice::Only).collect()
}

#[test]
fn every_scene_has_the_same_bits_with_any_two_effects_more_on_the_cpu() {
    for subject in scenes() {
        let general = subject.on_cpu(EffectChoice::All);
        for choice in supersets(&subject, covering).into_iter().chain([EffectChoice::Auto]) {
            assert_same(&subject.on_cpu(choice), &general, &format!("{}, {choice:?}", subject.name));
        }
    }
}

#[test]
fn every_scene_has_the_bits_of_the_cpu_by_its_own_and_by_the_general_shader() {
    let subjects = scenes_alike(Float::Strict);
    let pictures: Vec<_> = subjects.iter().map(|subject| subject.on_cpu(EffectChoice::Auto)).collect();
    on_each(|options| {
        let mut renderer = subjects[0].renderer(options);
        for (subject, cpu) in subjects.iter().zip(&pictures) {
            renderer.show(&subject.flat).unwrap();
            for choice in [EffectChoice::Auto, EffectChoice::All] {
                let gpu = subject.on_gpu(&mut renderer, choice);
                assert_eq!(gpu.float, Float::Strict);
                assert_same(&gpu, cpu, &format!("{} on {options:?}, {choice:?}", subject.name));
            }
        }
    });
}

#[test]
fn paint_has_the_same_bits_with_any_two_effects_more_on_strict_adapters() {
    compare_on_adapters(&Subject::file("opaque.toml", [24, 18]), covering);
}

/// What these call for is on in every set, so that each other effect meets it both ways in two sets.
#[test]
fn mirrors_and_glass_have_the_same_bits_with_and_without_any_effect_more_on_strict_adapters() {
    for (name, size) in [("mirrors.toml", [16, 12]), ("prism.toml", [24, 18])] {
        compare_on_adapters(&Subject::file(name, size), halves);
    }
}

/// Hours. `cargo test --release --test main -- --ignored every_closed_set`
#[test]
#[ignore = "hours: every closed set of effects on every scene and adapter"]
fn every_scene_has_the_same_bits_with_every_closed_set_that_holds_its_own() {
    for path in files() {
        let name = path.file_name().unwrap().to_str().unwrap();
        compare_on_adapters(&Subject::file(name, [16, 12]), all_closed);
    }
}

fn compare_on_adapters(subject: &Subject, choose: fn(EffectSet) -> Vec<EffectSet>) {
    let cpu = subject.on_cpu(EffectChoice::All);
    on_each(|options| {
        for choice in supersets(subject, choose) {
            // A new one each: pipelines are not to pile up.
            let gpu = subject.on_gpu(&mut subject.renderer(options), choice);
            assert_same(&gpu, &cpu, &format!("{} on {options:?}, {choice:?}", subject.name));
        }
    });
}

#[test]
fn fast_shaders_take_the_same_paths_with_and_without_the_effects_that_are_not_called_for() {
    find("llvmpipe").iter().for_each(|options| {
        let subjects = scenes_alike(Float::Fast);
        let mut renderer = subjects[0].renderer(options);
        for subject in subjects {
            renderer.show(&subject.flat).unwrap();
            let special = subject.on_gpu(&mut renderer, EffectChoice::Auto);
            let general = subject.on_gpu(&mut renderer, EffectChoice::All);
            assert_eq!(special.float, Float::Fast);
            let equal = share_of_equal_paths(&special, &general);
            assert!(equal >= 0.9999, "{}: {equal}", subject.name);
        }
    });
}

fn share_of_equal_paths(a: &Frame, b: &Frame) -> f64 {
    let equal = a.texels.iter().zip(&b.texels).filter(|(a, b)| a.primitive_hash == b.primitive_hash).count();
    equal as f64 / a.texels.len() as f64
}
