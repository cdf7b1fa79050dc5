//! Scenes in which everything is equally bright.

use glam::DVec3;

use crate::layout::constants::MAX_DEPTH;
use crate::scene::{Background, Material, Model, Scene};
use crate::selftest::paper::{ICE, WATER, greatest};
use crate::selftest::props::{WHITE, body, camera, cube, mirror, round, smooth_body, square};
use crate::selftest::solids::{placed, sphere};
use crate::selftest::{Case, Device, DeviceError, Effort, Finding, Stage};

/// T10.
pub(super) const T10: Case = Case {
    id: "T10",
    title: "glass furnace",
    claim: "under a white sky matter with kr + kt = 1 is white: every pixel is within depth·2^-20 of 1",
    run: t10,
};

/// T11.
pub(super) const T11: Case = Case {
    id: "T11",
    title: "mirror furnace",
    claim: "in a closed room that glows and mirrors, d reflections sum up to ka·Ia(1 − kr^(d+1))/(1 − kr) everywhere",
    run: t11,
};

/// Each level of the tree multiplies weights that sum up to 1, and rounds: 16 roundoffs of f32 are given to a level, for the
/// Fresnel terms (R and 1 − R share one R, so that only the rounding of 1 − R and two products counts: 3), and for the
/// sum over the rays of a level, whose weights sum up to 1 as well.
fn t10(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let fresnel = |ior| Material::clear("clear", ior);
    let classic = |ior, kr: f64| Material {
        reflection: DVec3::splat(kr),
        transmission: DVec3::splat(1.0 - kr),
        fresnel: false,
        ..fresnel(ior)
    };
    let ball = || smooth_body(round(sphere(16)), 0, 1);
    let filled = || vec![ball(), smooth_body(round(placed(sphere(16), 0.8, DVec3::ZERO)), 1, 0)];
    let mut findings = Vec::new();
    for (name, depth, materials, models) in [
        ("a glass ball", 12, vec![fresnel(1.5)], vec![ball()]),
        ("a classic glass ball", 12, vec![classic(1.5, 0.25)], vec![ball()]),
        ("a classic glass cube", 12, vec![classic(1.5, 0.25)], vec![body(cube(1.4), 0, 0)]),
        ("ice with water", 7, vec![fresnel(ICE), fresnel(WATER)], filled()),
        ("classic ice with water", 7, vec![classic(ICE, 0.25), classic(WATER, 0.5)], filled()),
    ] {
        let mut scene = Scene::of(materials, models);
        scene.background = WHITE;
        scene.camera = camera(DVec3::new(0.0, 0.5, 4.0), DVec3::ZERO, 32.0);
        scene.render = square(24, depth, 0.0);
        let stage = Stage::new(&scene)?;
        let texels = device.picture(&stage, &stage.settings)?.texels;
        let errors = texels.iter().flat_map(|texel| texel.radiance).map(|x| f64::from(x - 1.0).abs());
        let bound = f64::from(depth) * 2f64.powi(-20);
        findings.push(Finding::at_most(
            format!("brightness off 1, {name}"),
            greatest(errors),
            bound,
            texels.len(),
        ));
    }
    Ok(findings)
}

/// Every level adds a product of powers of kr, each off by one u for each factor, and a sum: 3u a level, relative.
fn t11(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let (glow, mut findings) = (0.25, Vec::new());
    for (kr, depth) in [(0.5, 7), (0.9, 20), (1.0, 5)] {
        let wall = Material { ambient: DVec3::ONE, reflection: DVec3::splat(kr), ..mirror() };
        let room: Vec<Model> = vec![smooth_body(round(sphere(16)), 0, 0)];
        let mut scene = Scene::of(vec![wall], room);
        scene.ambient = DVec3::splat(glow);
        scene.background = Background::Color(DVec3::ZERO);
        scene.camera = camera(DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 0.5, 0.0), 70.0);
        scene.render = square(16, depth, 0.0);
        let stage = Stage::new(&scene)?;
        let texels = device.picture(&stage, &stage.settings)?.texels;
        let kr = f64::from(kr as f32);
        let expected = glow * (0..=depth as i32).map(|level| kr.powi(level)).sum::<f64>();
        let errors =
            texels.iter().flat_map(|texel| texel.radiance).map(|x| (f64::from(x) / expected - 1.0).abs());
        let bound = 3.0 * f64::from(depth + 1) * device.roundoff().max(2f64.powi(-24));
        let what = format!("brightness off the sum, kr = {kr:.1}");
        findings.push(Finding::at_most(what, greatest(errors), bound, texels.len()));
        // What deeper reflections would have added must be certified.
        let levels = depth as i32 + 1..=MAX_DEPTH as i32;
        let missing = glow * levels.map(|level| kr.powi(level)).sum::<f64>();
        let least = texels.iter().map(|texel| f64::from(texel.bound)).fold(f64::INFINITY, f64::min);
        let what = format!("certified bound over what is missing, kr = {kr:.1}");
        findings.push(Finding::at_least(what, least / missing, 1.0 - bound, texels.len()));
    }
    Ok(findings)
}
