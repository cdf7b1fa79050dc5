//! T22: more than there is room for is counted or refused, never a wrong picture in silence.

use glam::DVec3;

use crate::film::Frame;
use crate::layout::constants::{MAX_DEPTH, MAX_MEDIA};
use crate::layout::{Intersector, Precision, Settings};
use crate::scene::{Falloff, Light, Material, MaterialId, Mesh, Model, Scene};
use crate::selftest::{Bound, Case, CpuDevice, Device, DeviceError, Effort, Finding, Random, Stage, Walk};

/// Deep trees, many media, a million lights.
pub(super) const T22: Case = Case {
    id: "T22",
    title: "too much is told",
    claim: "rays beyond the depth are counted with their weight, 32 nested media are told apart and 33 refused, and a million \
            lights shine rightly or are refused",
    run: beyond,
};

fn beyond(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let (rays, lights) = match effort {
        Effort::Quick => (500, 70_000),
        Effort::Short => (5_000, 1_000_000),
        Effort::Long => (100_000, 1_000_000),
    };
    Ok(vec![
        endless_tree(device)?,
        nested_media(device, rays)?,
        too_many_media()?,
        many_lights(device, lights)?,
    ])
}

/// In a closed room of perfect mirrors each tree is a chain without end: at any depth one ray is cut, of weight 1, and
/// depth + 1 are traced. Products and sums of ones are exact, so the bound is 0.
fn endless_tree(device: &mut dyn Device) -> Result<Finding, DeviceError> {
    let mirror = Material { reflection: DVec3::ONE, ..Material::black("mirror") };
    let room = Mesh::cuboid(DVec3::splat(-6.0), DVec3::new(6.0, 7.0, 8.0));
    let mut scene = Scene::of(vec![mirror], vec![Model::of("room", room, MaterialId(0))]);
    (scene.render.size, scene.render.samples) = ([12, 9], 1);
    let stage = Stage::new(&scene)?;
    let (mut wrong, mut pixels) = (0, 0);
    for depth in [0, 1, MAX_DEPTH / 2, MAX_DEPTH] {
        let frame = device.picture(&stage, &Settings { depth, cutoff: 0.0, ..stage.settings })?;
        wrong += frame.texels.iter().filter(|t| t.dropped != 1.0 || t.rays != depth + 1).count();
        pixels += frame.texels.len();
    }
    Ok(counted("pixels whose endless tree is cut without account", wrong, pixels))
}

/// Boxes within each other, as many as the media mask holds: a ray through all of them crosses two faces of each and ends
/// in air.
fn nested_media(device: &mut dyn Device, count: usize) -> Result<Finding, DeviceError> {
    let stage = Stage::new(&boxes_in_boxes(MAX_MEDIA))?;
    let mut random = Random::new("nested media");
    let rays: Vec<_> = (0..count).map(|_| through_the_middle(&mut random)).collect();
    let wrong =
        device.walk(&stage, &rays)?.iter().filter(|w| w.faces != 2 * MAX_MEDIA || w.media != 0).count();
    Ok(counted("rays that lose count of 32 nested media", wrong, count))
}

/// Device-independent, but part of the same promise.
fn too_many_media() -> Result<Finding, DeviceError> {
    let is_refused = matches!(Stage::new(&boxes_in_boxes(MAX_MEDIA + 1)), Err(DeviceError::Scene(_)));
    Ok(counted("scenes of 33 media that are accepted", usize::from(!is_refused), 1))
}

/// Box k has a half side of 1 + k/8.
fn boxes_in_boxes(count: u32) -> Scene {
    let materials = (0..count).map(|k| Material::clear("ice", 1.0 + 0.01 * f64::from(k + 1))).collect();
    let model = |k: u32| {
        let half = DVec3::splat(1.0 + f64::from(k) / 8.0);
        // The inner ones win.
        let priority = -(k as i32);
        Model { priority, ..Model::of("box", Mesh::cuboid(-half, half), MaterialId(k as usize)) }
    };
    Scene::of(materials, (0..count).map(model).collect())
}

/// From outside every box, through the innermost.
fn through_the_middle(random: &mut Random) -> Walk {
    let side = DVec3::new(random.between(-0.5, 0.5), random.between(-0.5, 0.5), 1.0);
    let middle = DVec3::new(random.between(-0.3, 0.3), random.between(-0.3, 0.3), 0.0);
    let direction = side.normalize();
    Walk {
        origin: (middle - direction * 20.0).as_vec3().to_array(),
        direction: direction.as_vec3().to_array(),
        media: 0,
        limit: 2 * MAX_MEDIA,
    }
}

/// A pixel in the light of so many lamps. A device may refuse it (some drivers end long loops); what it shows must be what
/// the CPU shows, bit for bit where it is exact, else to within the rounding of as many sums, n·u.
fn many_lights(device: &mut dyn Device, count: u32) -> Result<Finding, DeviceError> {
    let stage = Stage::new(&lamps_over_a_floor(count))?;
    let reference =
        CpuDevice::new(Precision::F32, Intersector::Watertight).picture(&stage, &stage.settings)?;
    let wrong = match device.picture(&stage, &stage.settings) {
        Ok(frame) if device.is_exact() && device.precision() == Precision::F32 => {
            frame.texels != reference.texels
        }
        Ok(frame) => {
            let (a, b) = (brightness(&reference), brightness(&frame));
            let roundoff = 2f64.powi(-23);
            let apart = (a - b).abs() / a;
            apart.is_nan() || apart > f64::from(count) * roundoff
        }
        Err(DeviceError::Gpu(error)) if is_refusal(&error) => false,
        Err(error) => return Err(error),
    };
    Ok(counted(&format!("pictures of {count} lights that are wrong"), usize::from(wrong), 1))
}

fn is_refusal(error: &crate::gpu::GpuError) -> bool {
    use crate::gpu::GpuError::{LoopLimit, OutOfMemory, TooLarge};
    matches!(error, LoopLimit { .. } | OutOfMemory { .. } | TooLarge { .. })
}

fn lamps_over_a_floor(count: u32) -> Scene {
    let paper = Material { diffuse: DVec3::splat(0.5), ..Material::black("paper") };
    let floor = Mesh::cuboid(DVec3::new(-9.0, -2.0, -9.0), DVec3::new(9.0, -1.0, 9.0));
    let mut scene = Scene::of(vec![paper], vec![Model::of("floor", floor, MaterialId(0))]);
    scene.camera.eye = DVec3::new(0.1, 0.2, 3.0);
    // Towards the floor.
    scene.camera.forward = DVec3::new(0.0, -0.6, -0.8);
    scene.camera.up = DVec3::new(0.0, 0.8, -0.6);
    (scene.render.size, scene.render.samples) = ([1, 1], 1);
    let side = f64::from(count).sqrt().ceil();
    let lamp = |k: u32| Light {
        position: DVec3::new(
            f64::from(k) % side / side - 0.5,
            4.0,
            (f64::from(k) / side).floor() / side - 0.5,
        ),
        intensity: DVec3::splat(1.0 / f64::from(count)),
        falloff: Falloff::None,
    };
    scene.lights = (0..count).map(lamp).collect();
    scene
}

fn brightness(frame: &Frame) -> f64 {
    frame.texels.iter().map(|texel| f64::from(texel.radiance[1])).sum()
}

fn counted(what: &str, figure: usize, trials: usize) -> Finding {
    Finding { what: what.into(), figure: figure as f64, bound: Bound::AtMost(0.0), trials: trials as u64 }
}
