//! Pictures whose answer is known in closed form.

#![allow(clippy::unwrap_used)]

use snellius::cpu::CpuRenderer;
use snellius::film::{Frame, Renderer};
use snellius::flatten;
use snellius::layout::{Precision, Settings};
use snellius::scene::Scene;

const PRECISIONS: [Precision; 2] = [Precision::F32, Precision::F64];

/// Trace a scene that is written here, with meshes beside it.
fn trace(text: &str, meshes: &[(&str, String)], precision: Precision) -> Frame {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    meshes.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
    let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
    let flat = flatten::flatten(&scene).unwrap().scene;
    let render = &scene.render;
    let settings = Settings {
        depth: render.depth,
        cutoff: render.cutoff as f32,
        samples: render.samples,
        precision,
        ..Settings::default()
    };
    let view = flatten::view(&scene.camera, &flat, render.size, None, &settings);
    CpuRenderer::new(&flat, 1).unwrap().render(&view, &settings, &()).unwrap()
}

/// An axis-aligned cube as six quadrilaterals, outward or inward, numbered from `first`.
fn cube(size: f64, inward: bool, first: usize) -> String {
    let h = size / 2.0;
    let mut text = String::new();
    for corner in 0..8 {
        let at = |bit: usize| if corner & bit == 0 { -h } else { h };
        text += &format!("v {} {} {}\n", at(4), at(2), at(1));
    }
    for face in [[1, 2, 4, 3], [5, 7, 8, 6], [1, 5, 6, 2], [3, 4, 8, 7], [1, 3, 7, 5], [2, 6, 8, 4]] {
        let mut face = face.map(|corner| (corner + first - 1).to_string());
        if inward {
            face.reverse();
        }
        text += &format!("f {}\n", face.join(" "));
    }
    text
}

/// One pixel straight up through the middle of a hollow, water-filled cube of ice, off the diagonals of its faces;
/// the light behind it is 1, before it 0.
fn hollow_cube(cutoff: f64, models: &str) -> String {
    let medium = |name: &str, ior: f64| {
        format!("[material.{name}]\nreflection = 1.0\ntransmission = 1.0\nfresnel = true\nior = {ior:?}\n")
    };
    format!(
        "[camera]\neye = [0.1, -5, 0.05]\ntarget = [0.1, 0, 0.05]\nup = [0, 0, 1]\nfov_y = 1\n\
         [render]\nsize = [1, 1]\ndepth = 16\ncutoff = {cutoff:?}\nsamples = 1\n\
         [background]\nzenith = [1.0, 1.0, 1.0]\nhorizon = [0.0, 0.0, 0.0]\n{}{}{}{models}",
        medium("ice", 1.31),
        medium("water", 1.333),
        medium("air", 1.0)
    )
}

fn model(mesh: &str, material: &str, priority: i32) -> String {
    format!("[[model]]\n{mesh}\nmaterial = \"{material}\"\npriority = {priority}\n")
}

fn solid(size: f64) -> String {
    format!("shape = {{ box = {{ size = [{size}, {size}, {size}] }} }}")
}

fn shared_faces() -> (String, [(&'static str, String); 2]) {
    let models = model("mesh = \"shell.obj\"", "ice", 1) + &model("mesh = \"water.obj\"", "water", 1);
    let shell = cube(2.0, false, 1) + &cube(1.2, true, 9);
    (models, [("shell.obj", shell), ("water.obj", cube(1.2, false, 1))])
}

#[test]
fn liquid_in_ice_transmits_the_same_by_shared_faces_and_by_overlap_and_less_through_a_gap() {
    let (shared, meshes) = shared_faces();
    let overlap = model(&solid(2.0), "ice", 1) + &model(&solid(1.2), "water", 2);
    let gap = model(&solid(2.0), "ice", 1) + &model(&solid(1.2), "air", 2) + &model(&solid(1.1), "water", 3);
    for precision in PRECISIONS {
        for (models, expected) in [(&shared, 0.964_477), (&overlap, 0.964_477), (&gap, 0.896_899)] {
            let frame = trace(&hollow_cube(0.0, models), &meshes, precision);
            let transmittance = frame.texels[0].radiance[0];
            assert!((transmittance - expected).abs() <= 2e-6, "{transmittance}, not {expected}");
        }
    }
}

#[test]
fn the_ray_tree_of_the_hollow_cube_has_the_known_size_at_every_cutoff() {
    let (models, meshes) = shared_faces();
    for (cutoff, expected) in [(0.0, 5167u32), (1e-6, 36), (1e-4, 14), (1.0 / 255.0, 10)] {
        for precision in PRECISIONS {
            let frame = trace(&hollow_cube(cutoff, &models), &meshes, precision);
            assert_eq!(frame.texels[0].rays, expected, "cutoff {cutoff}");
            let sum = frame.rays.primary + frame.rays.reflection + frame.rays.refraction;
            assert_eq!(sum, u64::from(expected));
        }
    }
}

#[test]
fn the_truncation_error_of_the_hollow_cube_is_within_its_certified_bound() {
    let (models, meshes) = shared_faces();
    let truth = trace(&hollow_cube(0.0, &models), &meshes, Precision::F64).texels[0].radiance[0];
    for cutoff in [1e-6, 1e-4, 1.0 / 255.0, 0.1] {
        let cut = trace(&hollow_cube(cutoff, &models), &meshes, Precision::F64).texels[0];
        let error = (cut.radiance[0] - truth).abs();
        assert!(error <= cut.bound && cut.dropped > 0.0, "cutoff {cutoff}: {error} > {}", cut.bound);
    }
}

const INSIDE: &str = "[camera]\neye = [0.1, 0.2, 0.3]\ntarget = [1, 0.5, 0]\nfov_y = 70\n";

#[test]
fn a_glass_furnace_is_as_bright_as_its_background_everywhere() {
    for fresnel in [false, true] {
        let (kr, kt) = if fresnel { (1.0, 1.0) } else { (0.3, 0.7) };
        let text = format!(
            "[camera]\neye = [0, 0.5, 4]\ntarget = [0, 0, 0]\nfov_y = 30\n\
             [render]\nsize = [24, 24]\ndepth = 12\ncutoff = 0.0\nsamples = 1\n\
             [background]\ncolor = [1.0, 1.0, 1.0]\n\
             [material.glass]\nreflection = {kr:?}\ntransmission = {kt:?}\nfresnel = {fresnel}\nior = 1.5\n\
             [[model]]\nshape = {{ sphere = {{ radius = 1, level = 3 }} }}\nmaterial = \"glass\"\n"
        );
        let worst = trace(&text, &[], Precision::F32)
            .texels
            .iter()
            .map(|t| (t.radiance[1] - 1.0).abs())
            .fold(0.0, f32::max);
        assert!(worst <= 12.0 * 2f32.powi(-20), "fresnel {fresnel}: {worst}");
    }
}

#[test]
fn a_mirror_furnace_sums_its_geometric_series() {
    for (kr, depth) in [(0.5f32, 7), (0.9, 20), (1.0, 5)] {
        let text = format!(
            "{INSIDE}[render]\nsize = [16, 16]\ndepth = {depth}\ncutoff = 0.0\nsamples = 1\n\
             [ambient]\ncolor = [1.0, 1.0, 1.0]\nintensity = 0.25\n\
             [material.mirror]\nambient = {{ color = [1.0, 1.0, 1.0], k = 1.0 }}\nreflection = {kr:?}\n\
             [[model]]\nshape = {{ sphere = {{ radius = 2, level = 3 }} }}\nmaterial = \"mirror\"\n"
        );
        let expected = 0.25 * (0..=depth).map(|k| kr.powi(k)).sum::<f32>();
        for texel in trace(&text, &[], Precision::F32).texels {
            assert!((texel.radiance[0] - expected).abs() <= 1e-5 * expected, "kr {kr}: {:?}", texel.radiance);
            // What deeper mirrors would have added is within the bound.
            let missing = 0.25 * (depth + 1..=64).map(|k| f64::from(kr).powi(k)).sum::<f64>();
            assert!(missing <= f64::from(texel.bound) * (1.0 + 1e-5), "kr {kr}: {missing} > {}", texel.bound);
        }
    }
}

#[test]
fn matter_of_index_one_is_invisible_to_the_last_bit() {
    let empty = "[camera]\neye = [0.3, 0.5, 4]\ntarget = [0, 0, 0]\nfov_y = 40\n\
                 [render]\nsize = [32, 32]\ndepth = 8\ncutoff = 1e-4\nsamples = 1\n\
                 [background]\nzenith = [0.1, 0.3, 0.9]\nhorizon = [1.0, 0.7, 0.4]\n\
                 [material.nothing]\nreflection = 1.0\ntransmission = 1.0\nfresnel = true\nior = 1.0\n";
    let far = "[[model]]\nshape = { box = { size = [0.1, 0.1, 0.1] } }\nmaterial = \"nothing\"\ntranslate = [0, 0, 99]\n";
    let cube =
        "[[model]]\nshape = { box = { size = [1, 1, 1] } }\nmaterial = \"nothing\"\nrotate = [20, 30, 40]\n";
    let bits = |models: &str| -> Vec<[u32; 3]> {
        let frame = trace(&format!("{empty}{models}"), &[], Precision::F32);
        frame.texels.iter().map(|texel| texel.radiance.map(f32::to_bits)).collect()
    };
    assert_eq!(bits(cube), bits(far));
}
