//! An effect that is called for and left out is missed: it changes the picture, the same on every device.

use snellius::film::Frame;
use snellius::layout::{Effect, EffectChoice, Settings};

use super::subject::{Subject, assert_same};
use crate::lockstep::devices::on_each;

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
fn every_effect_that_is_left_out_changes_the_picture_alike_on_every_device() {
    for (effect, name) in SHOWN {
        let subject = Subject::file(name, [32, 24]);
        let called_for = subject.called_for();
        assert!(called_for.has(effect), "{name} does not call for {effect}");
        let lacking = EffectChoice::Only(called_for.without(effect).pruned());
        let cpu = subject.on_cpu(lacking);
        let changed = changed_pixels(&cpu, &subject.on_cpu(EffectChoice::Auto));
        assert!(changed >= 10, "{name} without {effect}: {changed} pixels differ");
        on_each(|options| {
            let gpu = subject.on_gpu(&mut subject.renderer(options), lacking);
            assert_same(&gpu, &cpu, &format!("{name} without {effect} on {options:?}"));
        });
    }
}

fn changed_pixels(a: &Frame, b: &Frame) -> usize {
    a.texels.iter().zip(&b.texels).filter(|(a, b)| a.radiance != b.radiance).count()
}

#[test]
fn nothing_at_all_is_the_same_on_every_device() {
    let subject = Subject::file("goblet.toml", [24, 32]);
    let nothing = EffectChoice::Only(snellius::layout::EffectSet::NONE);
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
