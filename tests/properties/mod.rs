//! Random scenes of closed bodies that nest, touch and overlap, seen from anywhere: what must hold for each of them.
//!
//! The scenes are the same in every run; `PROPTEST_CASES=5000 PROPTEST_RNG_SEED=2` makes it more, and others. A scene
//! that fails is shrunk and shown as a scene file: under a name of its own in `tests/regressions/` it is checked from
//! then on, on every device.

#![allow(clippy::unwrap_used)]

mod balance;
mod invariants;
mod scenes;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use proptest::test_runner::{Config, RngSeed, TestCaseError, TestRunner};
use snellius::flatten::flatten;
use snellius::gpu::SOURCES;
use snellius::layout::{Float, Intersector};
use snellius::scene::{Scene, SceneError};
use snellius::selftest::{GpuDevice, Stage};

use crate::lockstep::devices::on_each;
use invariants::{Broken, check, check_bits};
use scenes::{SceneFile, scenes};

/// Check so many scenes, or as many as `PROPTEST_CASES` says.
fn for_scenes(cases: u32, check: impl Fn(&Subject) -> Result<(), Broken>) {
    let chosen = Config::default();
    let is_set = |name: &str| std::env::var_os(name).is_some();
    let config = Config {
        cases: if is_set("PROPTEST_CASES") { chosen.cases } else { cases },
        rng_seed: if is_set("PROPTEST_RNG_SEED") { chosen.rng_seed } else { RngSeed::Fixed(1) },
        failure_persistence: None,
        ..chosen
    };
    let run = TestRunner::new(config).run(&scenes(), |scene: SceneFile| {
        let read = Scene::parse(Path::new("scene.toml"), &scene.to_string());
        Subject::new(read).and_then(|subject| check(&subject)).map_err(TestCaseError::fail)
    });
    run.unwrap_or_else(|fault| panic!("{fault}"));
}

/// A scene, ready to be traced.
struct Subject {
    stage: Stage,
    /// Whether `flatten` warns that faces of two bodies overlap in one plane: rays may meet only one of the two, for they
    /// leave it beyond the other.
    has_coplanar_faces: bool,
}

impl Subject {
    fn new(read: Result<Scene, SceneError>) -> Result<Self, Broken> {
        let scene = read.map_err(|error| error.to_string())?;
        let stage = Stage::new(&scene).map_err(|error| error.to_string())?;
        let warnings = flatten(&scene).map_err(|error| error.to_string())?.warnings;
        let has_coplanar_faces =
            warnings.iter().any(|warning| warning.message.contains("overlap in one plane"));
        Ok(Self { stage, has_coplanar_faces })
    }
}

fn strict(options: &snellius::gpu::GpuOptions) -> GpuDevice {
    GpuDevice::new(options, Float::Strict, Intersector::Watertight, SOURCES).unwrap()
}

#[test]
fn radiance_truncation_and_media_keep_their_bounds_in_every_scene() {
    for_scenes(300, check);
}

#[test]
fn strict_adapters_give_the_bits_of_the_cpu_in_every_scene() {
    on_each(|options| {
        let device = RefCell::new(strict(options));
        for_scenes(24, |subject| check_bits(&subject.stage, &mut *device.borrow_mut()));
    });
}

/// The scenes that failed once.
fn regressions() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/regressions");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn scenes_that_failed_once_hold_on_every_device() {
    let subjects: Vec<_> =
        regressions().into_iter().map(|path| (Subject::new(Scene::load(&path)).unwrap(), path)).collect();
    assert!(!subjects.is_empty());
    let hold = |check: &mut dyn FnMut(&Subject) -> Result<(), Broken>| {
        for (subject, path) in &subjects {
            check(subject).unwrap_or_else(|broken| panic!("{}: {broken}", path.display()));
        }
    };
    hold(&mut check);
    on_each(|options| {
        let mut device = strict(options);
        hold(&mut |subject| check_bits(&subject.stage, &mut device));
    });
}
