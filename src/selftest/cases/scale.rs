//! A millimetre and a thousand kilometres.

use glam::{DAffine3, DVec3};

use crate::film::Frame;
use crate::layout::Settings;
use crate::scene::{Background, Falloff, Light, Material, Model, Scene};
use crate::selftest::paper::{ICE, WATER};
use crate::selftest::props::{body, camera, centred, round, smooth_body, square};
use crate::selftest::solids::{placed, sphere};
use crate::selftest::{Case, Device, DeviceError, Effort, Finding, Stage};

/// T16.
pub(super) const T16: Case = Case {
    id: "T16",
    title: "scaled by powers of two",
    claim: "a whole scene scaled by 2^k for k = ±30, its absorption and its falloff likewise, gives the same bits; where \
            the driver rewrites sums, the same paths",
    run,
};

/// Powers of two: the ends of the range, and what is near 1.
const POWERS: [i32; 4] = [-30, -3, 10, 30];

/// All bounds are 0. Every length is multiplied by a power of two, which is exact, and every product, sum and quotient
/// then is so too; nothing in the kernel adds a length to a number that is none.
///
/// A driver that rewrites sums does so alike at each scale, but may flush: there the paths count, not the bits.
fn run(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    let reference = trace(device, 0)?;
    let trials = reference.texels.len();
    let mut findings = Vec::new();
    for power in POWERS {
        let frame = trace(device, power)?;
        let count = |differ: fn(&crate::layout::Texel, &crate::layout::Texel) -> bool| {
            reference.texels.iter().zip(&frame.texels).filter(|(a, b)| differ(a, b)).count() as f64
        };
        let paths = count(|a, b| a.primitive_hash != b.primitive_hash);
        let bits = count(|a, b| a.radiance.map(f32::to_bits) != b.radiance.map(f32::to_bits));
        findings.push(Finding::at_most(format!("pixels with other paths at 2^{power}"), paths, 0.0, trials));
        let what = format!("pixels with other bits at 2^{power}");
        findings.push(if device.is_exact() {
            Finding::at_most(what, bits, 0.0, trials)
        } else {
            Finding::reported(what, bits, trials)
        });
    }
    Ok(findings)
}

fn trace(device: &mut dyn Device, power: i32) -> Result<Frame, DeviceError> {
    let stage = Stage::new(&scene(2f64.powi(power)))?;
    device.picture(&stage, &Settings { samples: 2, ..stage.settings })
}

/// A smooth ball of absorbing ice with water in it on a table, in the light of two lamps, one that weakens.
fn scene(unit: f64) -> Scene {
    let ice = Material { absorption: DVec3::new(0.7, 0.2, 0.1) / unit, ..Material::clear("ice", ICE) };
    let water = Material { absorption: DVec3::new(0.1, 0.0, 0.3) / unit, ..Material::clear("water", WATER) };
    let table = Material {
        diffuse: DVec3::new(0.6, 0.5, 0.4),
        specular: DVec3::splat(0.3),
        shininess: 20.0,
        reflection: DVec3::splat(0.1),
        ..Material::black("table")
    };
    let scaled =
        |model: Model| Model { world_from_object: DAffine3::from_scale(DVec3::splat(unit)), ..model };
    let mut scene = Scene::of(
        vec![ice, water, table],
        vec![
            scaled(smooth_body(round(sphere(12)), 0, 1)),
            scaled(body(placed(sphere(8), 0.6, DVec3::new(0.1, 0.0, 0.1)), 1, 0)),
            scaled(body(placed(centred(DVec3::new(8.0, 0.5, 8.0)), 1.0, DVec3::Y * -1.3), 2, 0)),
        ],
    );
    let lamp =
        |position: DVec3, intensity: DVec3, falloff| Light { position: position * unit, intensity, falloff };
    scene.lights = vec![
        lamp(DVec3::new(3.0, 5.0, 2.0), DVec3::splat(0.6), Falloff::None),
        lamp(DVec3::new(-2.0, 3.0, 3.0), DVec3::splat(4.0) * unit * unit, Falloff::InverseSquare),
    ];
    scene.background =
        Background::Gradient { zenith: DVec3::new(0.2, 0.4, 0.9), horizon: DVec3::new(0.9, 0.8, 0.7) };
    scene.ambient = DVec3::splat(0.1);
    scene.camera = camera(DVec3::new(0.5, 1.0, 4.0) * unit, DVec3::new(0.0, -0.3, 0.0) * unit, 45.0);
    scene.render = square(32, 8, 1e-4);
    scene
}
