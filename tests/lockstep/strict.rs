//! Strict float: what an adapter computes is what the CPU computes, and without it that is not so.

use snellius::gpu::{GpuOptions, Prober, SOURCES, Variant};
use snellius::layout::{Effect, EffectSet, Float, Intersector, Lights, Precision};

use super::devices::on_each;
use super::scene;

/// The variant of the default settings, with small stacks.
pub(super) const PLAIN: Variant = Variant {
    precision: Precision::F32,
    float: Float::Strict,
    intersector: Intersector::Watertight,
    effects: EffectSet::ALL.without(Effect::Aovs).without(Effect::Adaptive),
    lights: Lights::Many,
    stack_size: 1,
    bvh_stack: 1,
    tree: false,
};

/// a·b + a·c, which every compiler would rather compute as a·(b + c).
const SUM_OF_PRODUCTS: &str = "
    import package::constants::PROBE_GROUP;
    import package::probe::{begin, put, take};

    @compute @workgroup_size(PROBE_GROUP)
    fn probe_sum(@builtin(global_invocation_id) id: vec3u) {
        if begin(id.x) {
            let a = take();
            let b = take();
            let c = take();
            put(a * b + a * c);
        }
    }
";

/// Floats of either sign between 2^-16 and 2^16, evenly by magnitude.
fn random_floats(count: usize) -> Vec<f32> {
    let mut state = 0x9e37_79b9_u32;
    let mut next = || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 16 ^ state).wrapping_mul(0x45d9_f3b5)
    };
    let float = |bits: u32| f32::from_bits(bits & 0x807f_ffff | (111 + (bits >> 23) % 32) << 23);
    (0..count).map(|_| float(next())).collect()
}

/// How many of 2^16 sums of products have other bits than the CPU's.
fn differing_sums(options: &GpuOptions, float: Float) -> usize {
    let scene = scene::triangle();
    let sources: Vec<_> = SOURCES.iter().copied().chain([("sum", SUM_OF_PRODUCTS)]).collect();
    let view = scene::view(&scene, 8, 8, 1);
    let mut prober = Prober::new(&scene, &view, options, sources.leak()).unwrap();
    let inputs = random_floats(3 << 16);
    let mut records: Vec<u32> = inputs.iter().map(|x| x.to_bits()).collect();
    let variant = Variant { float, ..PLAIN };
    prober.run(("sum", "probe_sum"), &variant, 3, &mut records).unwrap();
    let expected = inputs.chunks_exact(3).map(|abc| (abc[0] * abc[1] + abc[0] * abc[2]).to_bits());
    records.chunks_exact(3).zip(expected).filter(|(record, bits)| record[0] != *bits).count()
}

#[test]
fn strict_sums_of_products_have_the_bits_of_the_cpu() {
    on_each(|options| assert_eq!(differing_sums(options, Float::Strict), 0, "{options:?}"));
}

#[test]
fn fast_sums_of_products_differ_so_that_the_comparison_can_fail() {
    on_each(|options| assert!(differing_sums(options, Float::Fast) > 1000, "{options:?}"));
}
