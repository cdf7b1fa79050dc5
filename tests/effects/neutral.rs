//! What has no effect is as if it were not there: to the last bit, by the kernel that simulates it and by the one that
//! does not.

use snellius::layout::{Effect, EffectChoice};

use super::subject::Subject;

const SCENE: &str = "[camera]\neye = [0.3, 1.5, 4]\ntarget = [0, 0.5, 0]\nfov_y = 40\n\
    [render]\nsize = [40, 30]\ndepth = 6\ncutoff = 1e-4\nsamples = 1\n\
    [ambient]\ncolor = [1.0, 1.0, 1.0]\nintensity = 0.2\n\
    [background]\nzenith = [0.1, 0.3, 0.9]\nhorizon = [1.0, 0.7, 0.4]\n\
    [[light]]\nposition = [3, 5, 2]\ncolor = [1.0, 1.0, 1.0]\n\
    [material.floor]\ndiffuse = { color = [0.8, 0.5, 0.3], k = 1.0 }\n\
    [[model]]\nshape = { plane = { size = [8, 8] } }\nmaterial = \"floor\"\n\
    [[model]]\nshape = { sphere = { radius = 0.6, level = 3 } }\nmaterial = \"ball\"\ntranslate = [0.2, 0.7, 0]\n";

const GLASS: &str = "[material.ball]\nreflection = 0.1\ntransmission = 0.9\nior = 1.5\n";

fn radiance(text: &str, choice: EffectChoice) -> Vec<[u32; 3]> {
    let frame = Subject::text(text).on_cpu(choice);
    frame.texels.iter().map(|texel| texel.radiance.map(f32::to_bits)).collect()
}

/// Both scenes look the same, both with everything simulated and with what they call for; whether the one with the
/// neutral element calls for `effect`.
fn assert_neutral(with: &str, without: &str, effect: Effect) -> bool {
    let expected = radiance(without, EffectChoice::Auto);
    for choice in [EffectChoice::Auto, EffectChoice::All] {
        assert!(radiance(with, choice) == expected, "{effect}, {choice:?}");
        assert!(radiance(without, choice) == expected, "{effect}, {choice:?}");
    }
    Subject::text(with).called_for().has(effect)
}

#[test]
fn a_medium_that_absorbs_nothing_is_clear() {
    let (without, with) =
        (format!("{SCENE}{GLASS}"), format!("{SCENE}{GLASS}absorption = [0.0, 0.0, 0.0]\n"));
    assert!(!assert_neutral(&with, &without, Effect::Absorption));
}

#[test]
fn a_mirror_that_reflects_nothing_is_matt() {
    let paint = "[material.ball]\ndiffuse = { color = [0.2, 0.6, 0.3], k = 1.0 }\n";
    let (without, with) = (format!("{SCENE}{paint}"), format!("{SCENE}{paint}reflection = 0.0\n"));
    assert!(!assert_neutral(&with, &without, Effect::Reflection));
}

#[test]
fn matter_of_index_one_by_fresnel_is_air() {
    let air = "[material.ball]\nreflection = 1.0\ntransmission = 1.0\nfresnel = true\nior = 1.0\n";
    // By ambient light alone: rays that went through meet the floor in the same place, but for rounding.
    let dim = SCENE
        .replace("[[light]]\nposition = [3, 5, 2]\ncolor = [1.0, 1.0, 1.0]\n", "")
        .replace("diffuse", "ambient");
    // Out of the picture, so that the scene has the same box.
    let moved = dim.replace("translate = [0.2, 0.7, 0]", "translate = [3.0, 0.7, 3.3]");
    assert!(assert_neutral(&format!("{dim}{air}"), &format!("{moved}{air}"), Effect::Transmission));
}

#[test]
fn a_black_light_lights_nothing() {
    let paint = "[material.ball]\ndiffuse = { color = [0.2, 0.6, 0.3], k = 1.0 }\nspecular = { k = 0.4, shininess = 30 }\n";
    let black = "[[light]]\nposition = [-3, 4, 1]\ncolor = [0.0, 0.0, 0.0]\nfalloff = \"inverse-square\"\n";
    let (without, with) = (format!("{SCENE}{paint}"), format!("{SCENE}{paint}{black}"));
    assert!(assert_neutral(&with, &without, Effect::Falloff), "a light that is there is asked");
}

#[test]
fn a_white_texture_leaves_the_colour_as_it_is() {
    let paint = "[material.ball]\ndiffuse = { color = [0.2, 0.6, 0.3], k = 1.0 }\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("white.png");
    let file = std::fs::File::create(&path).unwrap();
    let mut encoder = png::Encoder::new(file, 3, 2);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[255; 18]).unwrap();
    let without = format!("{SCENE}{paint}");
    let texture = format!("k = 1.0, texture = \"{}\" }}\n[[model]]", path.display());
    let with = without.replacen("k = 1.0 }\n[[model]]", &texture, 1);
    assert!(with != without && assert_neutral(&with, &without, Effect::Textures));
}
