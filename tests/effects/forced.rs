//! An effect that is called for and left out is missed: it changes the picture, the same on every device.

use snellius::film::Frame;
use snellius::layout::{Effect, EffectChoice, EffectSet, Settings};

use super::subject::{Subject, assert_same};
use crate::lockstep::devices::{find, on_each};

/// A scene for each effect that shows.
const SHOWN: [(Effect, &str); 13] = [
    (Effect::Shadows, "opaque.toml"),
    (Effect::TintedShadows, "whitted.toml"),
    (Effect::Specular, "opaque.toml"),
    (Effect::Reflection, "mirrors.toml"),
    (Effect::Transmission, "prism.toml"),
    (Effect::Fresnel, "prism.toml"),
    (Effect::Absorption, "goblet.toml"),
    (Effect::NestedMedia, "whitted.toml"),
    (Effect::SmoothNormals, "opaque.toml"),
    (Effect::Textures, "whitted.toml"),
    (Effect::Environment, "goblet.toml"),
    (Effect::Falloff, "goblet.toml"),
    (Effect::Antialiasing, "opaque.toml"),
];

#[test]
fn every_effect_that_is_left_out_changes_the_picture_alike_on_both_devices() {
    for (effect, name) in SHOWN {
        let subject = Subject::file(name, [32, 24]);
        let lacking = lacking(&subject, &[effect]);
        let cpu = subject.on_cpu(lacking);
        let changed = changed_pixels(&cpu, &subject.on_cpu(EffectChoice::Auto));
        assert!(changed >= 10, "{name} without {effect}: {changed} pixels differ");
        if let Some(options) = find("llvmpipe") {
            let gpu = subject.on_gpu(&mut subject.renderer(&options), lacking);
            assert_same(&gpu, &cpu, &format!("{name} without {effect}"));
        }
    }
}

/// Another driver compiles the same code: there all that is shown by a scene is left out at once.
#[test]
fn all_that_a_scene_shows_is_left_out_alike_on_swiftshader() {
    let Some(options) = find("swiftshader") else { return };
    let mut names: Vec<_> = SHOWN.iter().map(|one| one.1).collect();
    names.sort_unstable();
    names.dedup();
    for name in names {
        let shown: Vec<_> = SHOWN.iter().filter(|one| one.1 == name).map(|one| one.0).collect();
        let subject = Subject::file(name, [32, 24]);
        let lacking = lacking(&subject, &shown);
        let gpu = subject.on_gpu(&mut subject.renderer(&options), lacking);
        assert_same(&gpu, &subject.on_cpu(lacking), &format!("{name} without {shown:?}"));
    }
}

/// What a scene calls for, without these effects and what needs them.
fn lacking(subject: &Subject, effects: &[Effect]) -> EffectChoice {
    let called_for = subject.called_for();
    let without = EffectSet::of(effects);
    assert!(called_for.has_all(without), "{} does not call for {}", subject.name, without.minus(called_for));
    EffectChoice::Only(called_for.minus(without).pruned())
}

fn changed_pixels(a: &Frame, b: &Frame) -> usize {
    a.texels.iter().zip(&b.texels).filter(|(a, b)| a.radiance != b.radiance).count()
}

#[test]
fn nothing_at_all_is_the_same_on_every_device() {
    let subject = Subject::file("goblet.toml", [24, 32]);
    let nothing = EffectChoice::Only(EffectSet::NONE);
    let cpu = subject.on_cpu(nothing);
    assert_eq!((cpu.rays.shadow, cpu.rays.reflection, cpu.rays.refraction), (0, 0, 0));
    on_each(|options| {
        assert_same(&subject.on_gpu(&mut subject.renderer(options), nothing), &cpu, "no effect");
    });
}

#[test]
fn auxiliary_pictures_come_where_they_are_asked_for_whatever_the_choice() {
    let mut subject = Subject::file("opaque.toml", [8, 6]);
    for aovs in [false, true] {
        subject.settings = Settings { aovs, ..subject.settings };
        for choice in [EffectChoice::Auto, EffectChoice::All, EffectChoice::Only(subject.called_for())] {
            let depth = subject.on_cpu(choice).aovs.map(|aovs| aovs.iter().map(|aov| aov.depth).sum::<f32>());
            assert_eq!(depth.is_some_and(|depth| depth > 0.0), aovs, "{choice:?}");
        }
    }
}
