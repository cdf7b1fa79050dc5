//! Every variant of the shaders assembles and validates, with no device at hand.

use snellius::gpu::{GpuError, Promises, SOURCES, Variant, assemble, write_spirv};
use snellius::layout::{EffectSet, Float, Intersector, Lights, Precision};

use crate::effects::covering::covering;

/// Variants in which any two effects are on and off in every combination that there is, first the general one; with
/// each precision, intersector, number of lights, and with small and large stacks. The general one records its tree.
pub(super) fn all() -> Vec<Variant> {
    let sets = [EffectSet::ALL, EffectSet::NONE].into_iter().chain(covering(EffectSet::NONE));
    let mut variants = Vec::new();
    for (index, effects) in sets.enumerate() {
        for precision in [Precision::F32, Precision::F64] {
            let intersectors = [Intersector::Watertight, Intersector::MollerTrumbore];
            let sizes = [(64, 63), (0, 1), (1, 1)];
            let lights = [Lights::Many, Lights::One, Lights::None];
            variants.push(Variant {
                precision,
                float: Float::Strict,
                intersector: intersectors[index % 2],
                effects,
                lights: lights[index / 2 % 3],
                stack_size: sizes[index % 3].0,
                bvh_stack: sizes[index % 3].1,
                tree: effects == EffectSet::ALL,
            });
        }
    }
    variants
}

#[test]
fn every_variant_validates_and_is_written_as_spirv() {
    for variant in all() {
        let between: &[_] = if variant.adaptive() { &["sift", "settle_film"] } else { &[] };
        let between = between.iter().map(|entry| ("sift", *entry));
        for (root, entry) in [("render", "render")].into_iter().chain(between) {
            let shader = assemble(SOURCES, root, entry, &variant)
                .unwrap_or_else(|error| panic!("{entry}, {variant:?}: {error}"));
            for float in [Float::Strict, Float::Fast] {
                let words = write_spirv(&shader, &Variant { float, ..variant }, &Promises::default());
                assert!(words.is_ok_and(|words| words.len() > 500), "{entry}, {variant:?}");
            }
        }
    }
}

#[test]
fn without_refinement_the_shader_knows_nothing_of_it() {
    for variant in all().into_iter().filter(|variant| !variant.adaptive()) {
        let wgsl = assemble(SOURCES, "render", "render", &variant).unwrap().wgsl;
        for word in ["Statistics", "tally", "slot_in_list", "first_body"] {
            assert!(!wgsl.contains(word), "{word}");
        }
    }
}

#[test]
fn a_broken_shader_is_reported_with_its_file_and_line() {
    let broken: Vec<_> = SOURCES
        .iter()
        .map(|&(stem, text)| {
            (stem, if stem == "camera" { format!("\n\n{text}\nfn ) {{") } else { text.to_owned() })
        })
        .collect();
    let sources: Vec<_> = broken.iter().map(|(stem, text)| (*stem, text.as_str())).collect();
    let Err(GpuError::Shader { file, line, .. }) = assemble(&sources, "render", "render", &all()[0]) else {
        panic!("the fault was not reported")
    };
    let lines =
        broken.iter().find(|(stem, _)| *stem == "camera").map(|(_, text)| text.lines().count() as u32);
    assert_eq!((file.as_str(), Some(line)), ("shaders/camera.wgsl", lines));
}
