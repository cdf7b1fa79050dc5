//! Matter of index one.

use glam::{DAffine3, DQuat, DVec3, EulerRot};

use crate::scene::{Background, Material, Model, Scene};
use crate::selftest::paper::greatest;
use crate::selftest::props::{body, camera, cube, square};
use crate::selftest::{Bend, Case, Device, DeviceError, Effort, Finding, Stage};

/// T7.
pub(super) const T7: Case = Case {
    id: "T7",
    title: "index one is invisible",
    claim: "matter of index 1 reflects exactly nothing at cosines down to 1e-7, bends no ray, and its picture is that of \
            the empty scene, bit for bit",
    run,
};

/// All bounds are 0: η − 1 is 0, and so is all that is multiplied with it, on any device; and the weight of a
/// transmitted ray is 1·(1 − 0).
fn run(device: &mut dyn Device, _: Effort) -> Result<Vec<Finding>, DeviceError> {
    Ok(vec![reflectance(device)?, grazing(device)?, picture(device)?])
}

fn reflectance(device: &mut dyn Device) -> Result<Finding, DeviceError> {
    let queries: Vec<[f32; 2]> = (0..=256).map(|k| [10f32.powf(-7.0 * k as f32 / 256.0), 1.0]).collect();
    let answers = device.fresnel(&queries)?;
    let worst = greatest(answers.iter().map(|answer| f64::from(answer.unwrap_or(f32::NAN))));
    Ok(Finding::at_most("reflectance", worst, 0.0, answers.len()))
}

/// Rays that enter the top of a cube at cosines from 1 to 1e-7.
fn grazing(device: &mut dyn Device) -> Result<Finding, DeviceError> {
    let stage = Stage::new(&Scene::of(vec![nothing()], vec![body(cube(2.0), 0, 0)]))?;
    let rays: Vec<Bend> = (0..=256)
        .map(|k| {
            let cosine = 10f64.powf(-7.0 * f64::from(k) / 256.0);
            let direction = DVec3::new((1.0 - cosine * cosine).sqrt(), -cosine, 0.0);
            Bend::through(DVec3::new(0.1, 1.0, 0.2) - direction * 0.5, direction)
        })
        .collect();
    let bent = device.bend(&stage, &rays)?;
    let met = bent.iter().filter(|bent| bent.surfaces > 0).count();
    let changed = rays
        .iter()
        .zip(&bent)
        .filter(|(ray, bent)| bent.direction != ray.direction || bent.weight != [1.0; 3])
        .count();
    Ok(Finding::at_most("rays bent or weakened", changed as f64, 0.0, met))
}

fn picture(device: &mut dyn Device) -> Result<Finding, DeviceError> {
    let tilt = DAffine3::from_quat(DQuat::from_euler(EulerRot::XYZ, 0.35, 0.52, 0.7));
    let mut scene = Scene::of(vec![nothing()], vec![]);
    scene.background =
        Background::Gradient { zenith: DVec3::new(0.1, 0.3, 0.9), horizon: DVec3::new(1.0, 0.7, 0.4) };
    scene.render = square(48, 8, 1e-4);
    scene.camera = camera(DVec3::new(0.3, 0.5, 4.0), DVec3::ZERO, 40.0);
    let mut bits = |models: Vec<Model>| -> Result<Vec<[u32; 3]>, DeviceError> {
        let stage = Stage::new(&Scene { models, ..scene.clone() })?;
        let frame = device.picture(&stage, &stage.settings)?;
        Ok(frame.texels.iter().map(|texel| texel.radiance.map(f32::to_bits)).collect())
    };
    let with = bits(vec![Model { world_from_object: tilt, ..body(cube(1.5), 0, 0) }])?;
    let without = bits(vec![])?;
    let differing = with.iter().zip(&without).filter(|(a, b)| a != b).count();
    Ok(Finding::at_most("pixels that differ from the empty scene's", differing as f64, 0.0, with.len()))
}

fn nothing() -> Material {
    Material::clear("nothing", 1.0)
}
