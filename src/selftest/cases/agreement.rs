//! T20: devices agree about whole pictures.
//!
//! An exact device in f32 does what the CPU does, operation by operation: 0 pixels may differ. Where a driver rewrites sums
//! and products, and in f64, a ray within rounding of an edge or of the critical angle goes another way; how many do
//! depends on the scene, so the bounds are what the project promises for its own scenes, not derived: 99.9 % of
//! primitive hashes for a fast device, 97 % of body hashes in f64, and 99 % of these pixels within 1e-4 of the scene's
//! greatest radiance.

use std::path::{Path, PathBuf};

use super::built_in;
use crate::layout::{Intersector, Precision};
use crate::scene::Scene;
use crate::selftest::{
    Agreement, Bound, Case, CpuDevice, Device, DeviceError, Effort, Finding, LEAST_EQUAL_F64,
    LEAST_EQUAL_FAST, Stage, greatest_difference,
};

/// Pictures of scenes against those of the CPU in f32.
pub(super) const T20: Case = Case {
    id: "T20",
    title: "pictures agree",
    claim: "a strict device gives the CPU's bits, a fast one the same primitives in 99.9 % of pixels, f64 the same bodies in \
            97 % of them, and there nearly the same colours: in the built-in scenes and, in a long run beside the folder \
            `scenes`, in all of those",
    run: agreement,
};

fn agreement(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let (size, has_folder) = match effort {
        Effort::Quick => ([40, 30], false),
        Effort::Short => ([80, 60], false),
        Effort::Long => ([160, 120], true),
    };
    let mut findings = Vec::new();
    for scene in built_in::ALL {
        findings.extend(compare(device, scene.0, &built_in::read(scene, size)?)?);
    }
    for path in if has_folder { scene_files() } else { Vec::new() } {
        let mut scene = Scene::load(&path)?;
        (scene.render.size, scene.render.samples) = (size, 1);
        findings.extend(compare(device, &path.display().to_string(), &scene)?);
    }
    Ok(findings)
}

/// Scene files and bare meshes of the folder `scenes`, in order.
fn scene_files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(Path::new("scenes")).into_iter().flatten().flatten();
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|end| end == "toml" || end == "obj");
    let mut paths: Vec<_> = entries.map(|entry| entry.path()).filter(is_scene).collect();
    paths.sort();
    paths
}

fn compare(device: &mut dyn Device, name: &str, scene: &Scene) -> Result<Vec<Finding>, DeviceError> {
    let stage = Stage::new(scene)?;
    let reference =
        CpuDevice::new(Precision::F32, Intersector::Watertight).picture(&stage, &stage.settings)?;
    let agreement = Agreement::between(&reference, &device.picture(&stage, &stage.settings)?);
    let finding = |what: &str, figure, bound| Finding {
        what: format!("{what}, {name}"),
        figure,
        bound,
        trials: agreement.pixels as u64,
    };
    let differing = agreement.differing as f64;
    Ok(match (device.precision(), device.is_exact()) {
        (Precision::F32, true) => vec![finding("differing pixels", differing, Bound::AtMost(0.0))],
        (Precision::F32, false) => {
            let same =
                finding("% same primitives", agreement.same_primitives, Bound::AtLeast(LEAST_EQUAL_FAST));
            vec![same, finding("differing pixels", differing, Bound::Reported)]
        }
        (Precision::F64, _) => {
            let most = greatest_difference(stage.flat.radiance_bound.last().copied().unwrap_or(0.0));
            vec![
                finding("% same bodies", agreement.same_bodies, Bound::AtLeast(LEAST_EQUAL_F64)),
                finding("99th percentile of |ΔRGB|", agreement.p99.into(), Bound::AtMost(most.into())),
            ]
        }
    })
}
