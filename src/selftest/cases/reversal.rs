//! Light goes the same way back.

use glam::{DAffine3, DQuat, EulerRot};

use crate::scene::{Material, Model, Scene};
use crate::selftest::paper::{ICE, WATER, greatest, narrow, refract, widen3};
use crate::selftest::props::{body, cube};
use crate::selftest::random::Random;
use crate::selftest::{Bend, Bent, Case, Device, DeviceError, Effort, Ending, Finding, Stage};

/// T9.
pub(super) const T9: Case = Case {
    id: "T9",
    title: "reversed light",
    claim: "R(c, η) = R(c_t, 1/η) to 1e-5; a path from its end meets the same faces in reverse",
    run,
};

fn run(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    Ok(vec![reciprocity(device)?, retraced(device, effort)?])
}

/// The cosine behind the interface is rounded to u, and so is 1/η: the cosine before it moves by up to 2.7u/c by
/// these, and R by 6 times that. For c ≥ 1/8 that is 8e-6 at the u of a driver that rewrites sums.
fn reciprocity(device: &mut dyn Device) -> Result<Finding, DeviceError> {
    let cosines = (128..=1024).map(|k| f64::from(k) / 1024.0);
    let pairs: Vec<[[f32; 2]; 2]> = cosines
        .flat_map(|c| {
            [ICE, WATER, WATER / ICE, 2.4].map(|eta| {
                let behind = refract(c, narrow(eta)).unwrap_or(f64::NAN);
                [[c as f32, eta as f32], [behind as f32, 1.0 / eta as f32]]
            })
        })
        .collect();
    let answers = device.fresnel(pairs.as_flattened())?;
    let difference = |pair: &[Option<f32>]| match pair {
        [Some(there), Some(back)] => f64::from(there - back).abs(),
        _ => f64::NAN,
    };
    let worst = greatest(answers.chunks(2).map(difference));
    Ok(Finding::at_most("reflectance from either side, difference", worst, 1e-5, pairs.len()))
}

/// Rays through a tilted cube of ice with water in it, and back from where they end.
///
/// A path back lies within some hundred roundoffs of the path there, 1e-5. It meets another face where an edge is nearer
/// than that to one of its six or so points, of which on a face of 4 with 10 of edges there is a chance of 3e-5 each,
/// or where a reflection is total by as little: together less than one in a thousand.
fn retraced(device: &mut dyn Device, effort: Effort) -> Result<Finding, DeviceError> {
    let tilt = DQuat::from_euler(EulerRot::XYZ, 0.3, 0.5, 0.7);
    let tilted = |model: Model| Model { world_from_object: DAffine3::from_quat(tilt), ..model };
    let materials = vec![Material::clear("ice", ICE), Material::clear("water", WATER)];
    let models = vec![tilted(body(cube(2.0), 0, 1)), tilted(body(cube(1.2), 1, 0))];
    let stage = Stage::new(&Scene::of(materials, models))?;
    // There: from all sides, at all parts of it.
    let count = effort.rays(4096);
    let mut random = Random::new("reversal");
    let there: Vec<Bend> = (0..count)
        .map(|_| {
            let (from, to) = (random.direction() * 4.0, random.direction() * 0.9);
            Bend::through(from, to - from)
        })
        .collect();
    let met = device.bend(&stage, &there)?;
    // And back.
    let ends: Vec<&Bent> = met.iter().filter(|bent| is_refracted(bent)).collect();
    let back: Vec<Bend> = ends
        .iter()
        .map(|bent| {
            let direction = widen3(bent.direction);
            Bend::through(widen3(bent.origin) + direction * 4.0, -direction)
        })
        .collect();
    let met_back = device.bend(&stage, &back)?;
    let strayed = ends.iter().zip(&met_back).filter(|(there, back)| !is_reverse(there, back)).count();
    let share = strayed as f64 / back.len() as f64;
    Ok(Finding::at_most("share of paths that do not go back the way they came", share, 1e-3, back.len()))
}

/// Whether a path came through, by refraction alone.
fn is_refracted(bent: &Bent) -> bool {
    bent.end == Ending::Free && bent.surfaces > 0 && bent.reflected == 0
}

fn is_reverse(there: &Bent, back: &Bent) -> bool {
    let surfaces = there.surfaces as usize;
    let mut reverse = there.ids;
    reverse[..surfaces].reverse();
    there.surfaces == back.surfaces && reverse == back.ids && is_refracted(back)
}
