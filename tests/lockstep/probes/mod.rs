//! Guard 4: every function of the kernel gives the same words on both devices, run whole over the same inputs.
//!
//! A fault reads "`fresnel` differs", not "the picture differs".

mod inputs;
mod plain;
mod record;
mod scene;
mod soup;

use snellius::gpu::{GpuOptions, Prober, SOURCES, Source, Variant};
use snellius::kernel::World;
use snellius::layout::{EffectSet, FlatScene, Intersector, View};

use self::inputs::{Generator, Input};
use self::record::Record;
use super::devices::{find, on_each};
use super::planted::Planted;
use super::strict::PLAIN;

/// Records of a probe.
const RECORDS: usize = 1 << 14;

/// One function, as the CPU runs it; the entry point `probe_NAME` of the file is its twin.
struct Probe {
    name: &'static str,
    inputs: &'static [Input],
    /// Words that it writes at most.
    outputs: usize,
    run: fn(&World, &mut Record),
}

/// Probes of one shader file.
type Probes = (&'static str, &'static [Probe]);

const ALL: [Probes; 2] = [("probe_plain", plain::PROBES), ("probe_scene", scene::PROBES)];

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
    ("is_transmissive", "transmittance"),
    ("is_usable", "intersect"),
    ("least", "slabs"),
    ("linear_texel", "background"),
    ("log2_parts", "power"),
    ("nearer", "intersect"),
    ("note_path", "the pictures"),
    ("off_edge", "resolve"),
    ("permute", "shear_of"),
    ("power_f32", "power"),
    ("scale2", "exp_neg"),
    ("set_body", "cross_face"),
    ("shade", "the pictures"),
    ("spawn_before", "resolve"),
    ("spawn_behind", "resolve"),
    ("srgb_texel", "texture_color"),
    ("trace_pixel", "the pictures"),
    ("worth_tracing", "the pictures"),
    ("trace_tree", "the pictures"),
    ("start_tree", "the pictures"),
    ("see_background", "the pictures"),
    ("push", "the pictures"),
    ("follow", "the pictures"),
    ("traverse", "intersect"),
    ("triangle_slabs", "intersect"),
    ("upper", "power"),
    ("wrap_index", "texture_color"),
];

/// A scene on both devices.
struct Bench {
    scene: FlatScene,
    view: View,
    prober: Prober,
}

impl Bench {
    fn new(options: &GpuOptions, sources: &'static [Source<'static>]) -> Self {
        let scene = soup::scene();
        let view = soup::view(&scene);
        let prober = Prober::new(&scene, &view, options, sources).unwrap();
        Self { scene, view, prober }
    }

    /// How the probe's words differ between both devices, if they do.
    fn difference(&mut self, file: &str, probe: &Probe) -> Option<String> {
        let width = probe.inputs.iter().map(Input::words).sum::<usize>();
        let stride = width.max(probe.outputs);
        let mut generator = Generator::new(probe.name);
        let inputs: Vec<u32> = (0..RECORDS).flat_map(|_| generator.record(probe.inputs, stride)).collect();
        // On the adapter.
        let mut found = inputs.clone();
        let entry = format!("probe_{}", probe.name);
        let variant = Variant { bvh_stack: 8, stack_size: 8, ..PLAIN };
        self.prober.run((file, &entry), &variant, stride, &mut found).unwrap();
        // On the CPU.
        let world = World {
            scene: &self.scene,
            view: &self.view,
            intersector: Intersector::Watertight,
            effects: EffectSet::ALL,
        };
        let mut differing = Vec::new();
        let mut written = 0;
        for (input, found) in inputs.chunks(stride).zip(found.chunks(stride)) {
            let mut record = Record::new(input);
            (probe.run)(&world, &mut record);
            written += record.outputs().len();
            if !record.is_same(found) {
                differing.push((input[..width].to_vec(), record, found.to_vec()));
            }
        }
        assert!(written >= RECORDS, "{entry} compares nothing");
        let (input, record, found) = differing.first()?;
        let floats: Vec<_> = input.iter().map(|word| f32::from_bits(*word)).collect();
        Some(format!(
            "`{}` differs for {} of {RECORDS} inputs, first for {floats:?}:\n  CPU {:x?}\n  GPU {found:x?}",
            probe.name,
            differing.len(),
            record.outputs(),
        ))
    }
}

/// Every probe on one adapter.
fn differences(options: &GpuOptions) -> Vec<String> {
    let mut bench = Bench::new(options, SOURCES);
    let probes = ALL.iter().flat_map(|(file, probes)| probes.iter().map(move |probe| (file, probe)));
    probes.filter_map(|(file, probe)| bench.difference(file, probe)).collect()
}

#[test]
fn every_function_gives_the_same_words_on_every_device() {
    on_each(|options| {
        let found = differences(options);
        assert!(found.is_empty(), "{options:?}:\n{}", found.join("\n"));
    });
}

#[test]
fn a_changed_function_is_named() {
    let Some(options) = find("llvmpipe") else { return };
    let planted = Planted::new("material", "let k = (c * sum - 1.0)", "let k = (c * sum - 1.0000001)");
    let fresnel = plain::PROBES.iter().find(|probe| probe.name == "fresnel").unwrap();
    let found = Bench::new(&options, planted.leak()).difference("probe_plain", fresnel);
    assert!(found.is_some_and(|text| text.starts_with("`fresnel` differs")));
}

#[test]
fn every_function_has_a_probe_or_is_run_by_one() {
    let probed: Vec<_> = ALL.iter().flat_map(|(_, probes)| probes.iter().map(|probe| probe.name)).collect();
    let shaders = SOURCES.iter().filter(|source| !source.0.starts_with("probe") && source.0 != "render");
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
        assert!(probed.contains(by) || *by == "the pictures", "{by} is no probe");
    }
}
