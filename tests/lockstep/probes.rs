//! Guard 4: every function of the kernel gives the same words on both devices, run whole over the same inputs.
//!
//! A fault reads "`fresnel` differs", not "the picture differs".

use snellius::gpu::SOURCES;
use snellius::layout::Float;
use snellius::selftest::lockstep::{Lockstep, PROBES, RECORDS};

use super::devices::{find, on_each};
use super::planted::Planted;

/// Functions without a probe of their own, and the probe that runs them.
const COVERED: &[(&str, &str)] = &[
    ("add", "the pictures"),
    ("arctangent_f32", "arctangent"),
    ("atan_poly", "arctangent"),
    ("attenuate", "attenuation"),
    ("corner_normal", "resolve"),
    ("count_ray", "the pictures"),
    ("environment", "background"),
    ("exp_neg_f32", "exp_neg"),
    ("exp_neg_f64", "the pictures"),
    ("exp_poly", "exp_neg"),
    ("far", "intersect"),
    ("find_surface", "the pictures"),
    ("float_word", "texture_color"),
    ("flush3", "the pictures"),
    ("footprint", "texture_color"),
    ("fraction", "sample_offset"),
    ("greatest", "slabs"),
    ("index_of", "scatter"),
    ("intersect_triangle", "intersect"),
    ("is_usable", "intersect"),
    ("is_transmissive", "transmittance"),
    ("keep", "the trees"),
    ("least", "slabs"),
    ("linear_texel", "background"),
    ("log2_parts", "power"),
    ("nearer", "intersect"),
    ("node_at", "intersect"),
    ("note_path", "the pictures"),
    ("off_edge", "resolve"),
    ("permute", "shear_of"),
    ("pool", "tally"),
    ("power_f32", "power"),
    ("record_end", "the trees"),
    ("record_surface", "the trees"),
    ("scale2", "exp_neg"),
    ("set_body", "cross_face"),
    ("settle", "the pictures"),
    ("shade", "the pictures"),
    ("spawn_before", "resolve"),
    ("spawn_behind", "resolve"),
    ("srgb_texel", "texture_color"),
    ("surroundings", "the pictures"),
    ("trace_pixel", "the pictures"),
    ("worth_tracing", "the pictures"),
    ("trace_tree", "the pictures"),
    ("start_tree", "the pictures"),
    ("see_background", "the pictures"),
    ("push", "the pictures"),
    ("follow", "the pictures"),
    ("triangle_at", "intersect"),
    ("triangle_slabs", "intersect"),
    ("upper", "power"),
    ("wrap_index", "texture_color"),
    ("sight_of", "intersect"),
    ("whole_tree", "intersect"),
    ("is_done", "intersect"),
    ("visit", "intersect"),
    ("meet", "intersect"),
    ("distances", "intersect"),
    ("bytes_of", "intersect"),
    ("bits", "intersect"),
    ("leaf_bits", "intersect"),
    ("ranks", "intersect"),
];

#[test]
fn every_function_gives_the_same_words_on_every_device() {
    on_each(|options| {
        let mut lockstep = Lockstep::new(options, Float::Strict, SOURCES).unwrap();
        let found: Vec<_> = lockstep.compare_all(RECORDS).unwrap().iter().map(ToString::to_string).collect();
        assert!(found.is_empty(), "{options:?}:\n{}", found.join("\n"));
    });
}

#[test]
fn a_changed_function_is_named() {
    let Some(options) = find("llvmpipe") else { return };
    let planted = Planted::new("material", "let k = (c * sum - 1.0)", "let k = (c * sum - 1.0000001)");
    let (file, probes) = PROBES[0];
    let fresnel = probes.iter().find(|probe| probe.name == "fresnel").unwrap();
    let mut lockstep = Lockstep::new(&options, Float::Strict, planted.leak()).unwrap();
    let found = lockstep.compare(file, fresnel, RECORDS).unwrap().unwrap().to_string();
    assert!(found.starts_with("`fresnel` differs"), "{found}");
}

#[test]
fn every_function_has_a_probe_or_is_run_by_one() {
    let probed: Vec<_> =
        PROBES.iter().flat_map(|(_, probes)| probes.iter().map(|probe| probe.name)).collect();
    let shaders = SOURCES.iter().filter(|source| {
        !source.0.starts_with("probe") && !["render", "sift", "blocks", "rays"].contains(&source.0)
    });
    let functions: Vec<_> = super::twins::shader_functions(&shaders.copied().collect::<Vec<_>>())
        .into_values()
        .flatten()
        .collect();
    for name in &functions {
        let covered = COVERED.iter().any(|one| one.0 == name);
        let has_probe = probed.contains(&name.as_str());
        assert!(covered != has_probe, "{name}: {}", if covered { "covered twice" } else { "no probe" });
    }
    for (name, by) in COVERED {
        assert!(functions.iter().any(|one| one == name), "{name} is not there any more");
        assert!(probed.contains(by) || ["the pictures", "the trees"].contains(by), "{by} is no probe");
    }
}
