//! Whether bodies meet decides about the list of interiors.

use snellius::layout::{Effect, Effects};

use super::subject::Subject;

const SCENE: &str = "[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 0]\nfov_y = 40\n\
    [render]\nsize = [8, 8]\n[material.ice]\nreflection = 1.0\ntransmission = 1.0\nfresnel = true\nior = 1.31\n\
    [material.paint]\ndiffuse = { color = [0.8, 0.5, 0.3], k = 1.0 }\n";

fn model(shape: &str, material: &str, at: [f64; 3]) -> String {
    let [x, y, z] = at;
    format!(
        "[[model]]\nshape = {{ {shape} }}\nmaterial = \"{material}\"\ntranslate = [{x:?}, {y:?}, {z:?}]\n"
    )
}

fn ball(material: &str, radius: f64, at: [f64; 3]) -> String {
    model(&format!("sphere = {{ radius = {radius:?}, level = 3 }}"), material, at)
}

fn cube(size: f64, at: [f64; 3]) -> String {
    model(&format!("box = {{ size = [{size:?}, {size:?}, {size:?}] }}"), "ice", at)
}

/// Whether a list of interiors is called for, and how many bodies a point may be in.
fn nested(models: &[String]) -> (bool, u32) {
    let subject = Subject::text(&format!("{SCENE}{}", models.concat()));
    let effects = Effects::of(&subject.flat, &subject.settings);
    (effects.set().has(Effect::NestedMedia), effects.numbers().media.value)
}

#[test]
fn bodies_apart_need_no_list_of_interiors() {
    assert_eq!(nested(&[ball("paint", 1.0, [0.0; 3])]), (false, 0));
    assert_eq!(nested(&[ball("ice", 1.0, [0.0; 3])]), (false, 1));
    assert_eq!(nested(&[cube(1.0, [-1.0, 0.0, 0.0]), cube(1.0, [1.0, 0.0, 0.0])]), (false, 1));
    // Their boxes meet; a plane across the corner stands between them.
    assert_eq!(nested(&[ball("ice", 1.0, [0.0; 3]), ball("ice", 1.0, [1.3, 1.3, 1.3])]), (false, 1));
    assert_eq!(nested(&[ball("ice", 1.0, [0.0; 3]), ball("paint", 0.5, [0.2, 0.0, 0.0])]), (false, 1));
}

#[test]
fn bodies_that_overlap_touch_or_hold_each_other_need_one() {
    assert_eq!(nested(&[cube(1.0, [0.0; 3]), cube(1.0, [0.9, 0.1, 0.2])]), (true, 2));
    assert_eq!(nested(&[cube(1.0, [0.0; 3]), cube(1.0, [1.0, 0.0, 0.0])]), (true, 2));
    assert_eq!(nested(&[cube(1.0, [0.0; 3]), cube(1.0, [1.000_001, 0.0, 0.0])]), (true, 2));
    assert_eq!(nested(&[ball("ice", 1.0, [0.0; 3]), ball("ice", 0.4, [0.1, 0.0, 0.0])]), (true, 2));
}

#[test]
fn a_point_is_in_as_many_bodies_as_hang_together() {
    let row = [0.0, 0.8, 1.6, 5.0, 5.8].map(|x| cube(1.0, [x, 0.0, 0.0]));
    assert_eq!(nested(&row), (true, 3));
}
