//! A general run that notes what it simulates never touches what the scan left out.

use std::sync::atomic::{AtomicU32, Ordering};

use snellius::kernel::whitted::trace_pixel;
use snellius::kernel::{Simulation, World};
use snellius::layout::{Aov, Effect, EffectChoice, EffectSet, Effects, Intersector, Settings, Texel};

use super::random;
use super::subject::{Subject, assert_same};

/// Random scenes that are tried.
const SCENES: u32 = 300;

/// Simulates what a general run does under its settings, and notes what is asked for: the kernel asks when an effect is
/// about to show.
#[derive(Clone, Copy)]
struct Recorder<'a> {
    general: EffectSet,
    noted: &'a AtomicU32,
}

impl Simulation for Recorder<'_> {
    fn simulates(self, effect: Effect) -> bool {
        let simulated = self.general.has(effect);
        self.noted.fetch_or(u32::from(simulated) << effect as u32, Ordering::Relaxed);
        simulated
    }
}

/// The effects that a picture of the subject really uses.
fn touched(subject: &Subject) -> EffectSet {
    let all = Settings { effects: EffectChoice::All, ..subject.settings };
    let general = Effects::of(&subject.flat, &all).plan(&all).effects;
    let noted = AtomicU32::new(0);
    let (scene, view) = (&subject.flat, &subject.view);
    let effects = Recorder { general, noted: &noted };
    let world = World { scene, view, intersector: Intersector::Watertight, effects };
    let mut stack = Vec::new();
    for (x, y) in (0..view.height).flat_map(|y| (0..view.width).map(move |x| (x, y))) {
        let (mut texel, mut aov) = (Texel::default(), Aov::default());
        trace_pixel::<f32>(&world, &mut stack, [x, y], 0..view.samples, &mut texel, &mut aov, None);
    }
    EffectSet::from_bits(noted.into_inner())
}

#[test]
fn a_general_run_touches_nothing_that_the_scan_left_out() {
    let mut seen = EffectSet::NONE;
    for number in 0..SCENES {
        let subject = Subject::text(&random::scene(number));
        let (touched, called_for) = (touched(&subject), subject.called_for());
        assert!(called_for.has_all(touched), "scene {number} touches {}", touched.minus(called_for));
        seen = seen.iter().chain(touched.iter()).collect();
    }
    let textured_or_sampled = EffectSet::of(&[
        Effect::Textures,
        Effect::Environment,
        Effect::Antialiasing,
        Effect::Adaptive,
        Effect::Aovs,
    ]);
    assert_eq!(EffectSet::ALL.minus(seen), textured_or_sampled, "the scenes touch {seen}");
}

#[test]
fn random_scenes_have_the_same_bits_with_what_they_call_for_and_with_everything() {
    for number in 0..SCENES {
        let subject = Subject::text(&random::scene(number));
        let special = subject.on_cpu(EffectChoice::Auto);
        assert_same(&special, &subject.on_cpu(EffectChoice::All), &format!("scene {number}"));
    }
}

#[test]
fn scenes_touch_all_that_they_call_for() {
    for name in ["opaque.toml", "mirrors.toml", "prism.toml", "whitted.toml", "goblet.toml"] {
        let subject = Subject::file(name, [40, 30]);
        assert_eq!(touched(&subject), subject.called_for(), "{name}");
        let settings = Settings { samples: 4, adaptive: Some(0.02), aovs: true, ..subject.settings };
        let asked = subject.called_for().with(Effect::Adaptive).with(Effect::Aovs);
        assert_eq!(touched(&subject.under(settings)), asked, "{name}");
    }
}
