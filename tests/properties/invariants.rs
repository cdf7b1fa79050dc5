//! What holds for every scene of closed bodies, whatever is in it.

use snellius::film::Frame;
use snellius::kernel::Real;
use snellius::layout::{Intersector, Precision, Settings, Texel};
use snellius::selftest::{CpuDevice, Device, Stage};

use super::{Subject, balance};

/// An invariant that does not hold, in words.
pub(super) type Broken = String;

/// By how many levels the deeper of two pictures goes on.
const FURTHER: u32 = 3;

/// Check all that holds on the CPU.
pub(super) fn check(subject: &Subject) -> Result<(), Broken> {
    let stage = &subject.stage;
    for precision in [Precision::F32, Precision::F64] {
        let picture = picture(stage, precision, stage.settings)?;
        let checked = radiance_is_bounded(stage, &picture, stage.settings.depth);
        checked.map_err(|broken| format!("{precision:?}: {broken}"))?;
    }
    truncation_is_bounded(stage)?;
    if subject.has_coplanar_faces {
        return Ok(());
    }
    media_are_balanced::<f32>(stage)?;
    media_are_balanced::<f64>(stage)
}

/// Check that a device gives the bits of the CPU.
pub(super) fn check_bits(stage: &Stage, device: &mut dyn Device) -> Result<(), Broken> {
    let settings = Settings { aovs: true, ..stage.settings };
    let cpu = picture(stage, Precision::F32, settings)?;
    let found = device.picture(stage, &settings).map_err(|error| error.to_string())?;
    let differing = cpu.texels.iter().zip(&found.texels).position(|(a, b)| bits(a) != bits(b));
    match differing {
        Some(pixel) => {
            let (a, b) = (cpu.texels[pixel], found.texels[pixel]);
            Err(format!("{}: pixel {pixel} is {b:?}, not {a:?}", device.name()))
        }
        None if cpu.rays != found.rays => Err(format!("{}: other rays", device.name())),
        None if cpu.aovs != found.aovs => Err(format!("{}: other AOVs", device.name())),
        None => Ok(()),
    }
}

fn bits(texel: &Texel) -> [u32; 8] {
    bytemuck::cast(*texel)
}

fn picture(stage: &Stage, precision: Precision, settings: Settings) -> Result<Frame, Broken> {
    let mut cpu = CpuDevice::new(precision, Intersector::Watertight);
    cpu.picture(stage, &settings).map_err(|error| error.to_string())
}

/// What rounding may add to a bound: a weight of depth k is a product of k + 1 factors, each good to a dozen unit
/// roundoffs of f32.
fn rounding(depth: u32) -> f32 {
    f32::exp2(-20.0) * (depth + 1) as f32
}

/// Radiance is finite, not negative, and no more than a tree of that many levels can return.
fn radiance_is_bounded(stage: &Stage, picture: &Frame, depth: u32) -> Result<(), Broken> {
    let most = stage.flat.radiance_bound[depth as usize + 1] * (1.0 + rounding(depth));
    for (pixel, texel) in picture.texels.iter().enumerate() {
        let sound = texel.radiance.iter().all(|&x| (0.0..=most).contains(&x));
        let accounted = [texel.dropped, texel.bound].iter().all(|&x| x >= 0.0 && x.is_finite());
        if !(sound && accounted) {
            return Err(format!("pixel {pixel} is {texel:?}, where {most} is the most"));
        }
    }
    Ok(())
}

/// A deeper picture differs from a shallower one by no more than the bound that the shallower one states.
fn truncation_is_bounded(stage: &Stage) -> Result<(), Broken> {
    let settings = stage.settings;
    let shallow = picture(stage, Precision::F64, settings)?;
    let depth = settings.depth + FURTHER;
    let deep = picture(stage, Precision::F64, Settings { depth, cutoff: 0.0, ..settings })?;
    let slack = stage.flat.radiance_bound[depth as usize + 1] * rounding(depth);
    for (pixel, (a, b)) in shallow.texels.iter().zip(&deep.texels).enumerate() {
        let error = (0..3).map(|c| (a.radiance[c] - b.radiance[c]).abs()).fold(0.0, f32::max);
        if error > a.bound + slack {
            return Err(format!("pixel {pixel}: {a:?} is off by {error}; deeper: {b:?}"));
        }
    }
    Ok(())
}

/// Rays that leave the scene leave through air.
fn media_are_balanced<R: Real>(stage: &Stage) -> Result<(), Broken> {
    let exits = balance::exits::<R>(stage);
    if exits.unbalanced == 0 {
        return Ok(());
    }
    let name = std::any::type_name::<R>();
    Err(format!("{name}: {} of {} rays leave in matter", exits.unbalanced, exits.rays))
}
