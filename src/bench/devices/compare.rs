//! One scene on all devices: the same picture first, then times in turn.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::host::{encode_time, preparation};
use super::plan::{rounds_within, size_within};
use super::row::{ByKind, DeviceRow, Scaling, SceneRow};
use super::side::Side;
use crate::bench::effects::is_same;
use crate::bench::{BenchError, BreakEven, Phases, Ratio, Spread, Stage, Target, median, take_turns};
use crate::film::Frame;
use crate::layout::{Float, Settings, View};

/// Width and height of the picture that tells what larger ones would take.
const PILOT: [u32; 2] = [64, 48];

/// How devices are compared.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Width and height of the picture; by what a small one takes where it is not given.
    pub size: Option<[u32; 2]>,
    /// Rounds; by the time that is left where they are not given.
    pub rounds: Option<usize>,
    /// About how long a scene may take, starts included: what is not given is chosen to fit.
    pub budget: Duration,
    /// The arithmetic of the adapters.
    pub float: Float,
}

/// What came of a comparison.
#[derive(Debug)]
pub struct Compared {
    /// The figures.
    pub row: SceneRow,
    /// Why a device has none: another picture than the judge's, or an error.
    pub faults: Vec<String>,
}

/// Trace a scene on all threads of the CPU, the judge, and on other devices: a device has figures if each of its pictures
/// has the judge's bits, after as many rays of each kind.
///
/// # Errors
/// [`BenchError::Scene`], [`BenchError::Cpu`], [`BenchError::Folder`], [`BenchError::Encode`]; an adapter's errors are faults.
pub fn compare_devices(
    path: &Path,
    others: &[Target],
    comparison: &Comparison,
) -> Result<Compared, BenchError> {
    let begun = Instant::now();
    let left = || comparison.budget.saturating_sub(begun.elapsed());
    let stage = Stage::load(path, PILOT)?;
    let pipelines = tempfile::tempdir().map_err(BenchError::Folder)?;
    let settings = Settings { float: comparison.float, ..stage.settings };
    let judge = Target::Cpu { threads: 0 };
    let targets: Vec<&Target> = std::iter::once(&judge).chain(others).collect();
    let mut bench = Bench { prepared: preparation(path, 0)?, sides: Vec::new(), faults: Vec::new() };
    for (index, target) in targets.into_iter().enumerate() {
        // A folder for each, so that none finds what another compiled.
        let folder: PathBuf = pipelines.path().join(index.to_string());
        bench.add(path, &stage, target, settings, &folder)?;
    }
    let pilot = stage.view_of(PILOT, &settings);
    let (_, took) = bench.picture(&pilot)?;
    let size = comparison.size.unwrap_or_else(|| size_within(left(), took, PILOT[0] * PILOT[1]));
    let view = stage.view_of(size, &settings);
    let (picture, took) = bench.picture(&view)?;
    let rounds = comparison.rounds.unwrap_or_else(|| rounds_within(left(), took));
    bench.take_turns(rounds, &view, &picture)?;
    let Bench { sides, faults, .. } = bench;
    let row = SceneRow {
        scene: stage.name.clone(),
        size,
        triangles: stage.scene.attributes.len(),
        rounds,
        rays: picture.rays.into(),
        scaling: scaling(&sides),
        devices: device_rows(&sides, &picture)?,
    };
    Ok(Compared { row, faults })
}

/// Devices in comparison, the judge first.
struct Bench<'a> {
    /// Milliseconds of reading the scene and of building its tree with all threads.
    prepared: (f64, f64),
    sides: Vec<Side<'a>>,
    faults: Vec<String>,
}

impl<'a> Bench<'a> {
    /// Open a device: an adapter that cannot be is a fault.
    fn add(
        &mut self,
        path: &Path,
        stage: &'a Stage,
        target: &'a Target,
        settings: Settings,
        pipelines: &Path,
    ) -> Result<(), BenchError> {
        let mut side = match Side::open(stage, target, settings, pipelines) {
            Ok(side) => side,
            Err(BenchError::Gpu(error)) => {
                self.faults.push(format!("{}: {error}", target.name()));
                return Ok(());
            }
            Err(error) => return Err(error),
        };
        let prepared = match (side.threads(), self.sides.first()) {
            (Some(threads), Some(judge)) if judge.threads() != Some(threads) => preparation(path, threads)?,
            _ => self.prepared,
        };
        side.add_preparation(prepared);
        self.sides.push(side);
        Ok(())
    }

    /// The judge's picture, and the time of all sides that traced the same: the others are left out.
    fn picture(&mut self, view: &View) -> Result<(Frame, Duration), BenchError> {
        let started = Instant::now();
        let (picture, _) = self.sides[0].trace(view)?;
        let mut took = started.elapsed();
        let mut kept = Vec::new();
        for mut side in self.sides.drain(..) {
            if kept.is_empty() {
                kept.push(side);
                continue;
            }
            let started = Instant::now();
            let traced = side.trace(view).map(|(frame, _)| is_same(&frame, &picture));
            match fault(side.target, traced)? {
                Some(fault) => self.faults.push(fault),
                None => {
                    took += started.elapsed();
                    kept.push(side);
                }
            }
        }
        self.sides = kept;
        Ok((picture, took))
    }

    /// Trace on all sides in turn; those that trace another picture once are traced no more and left out in the end.
    fn take_turns(&mut self, rounds: usize, view: &View, picture: &Frame) -> Result<(), BenchError> {
        let mut found: Vec<Option<String>> = vec![None; self.sides.len()];
        take_turns(rounds, self.sides.len(), |index| {
            let side = &mut self.sides[index];
            if found[index].is_some() {
                return Ok(Duration::ZERO);
            }
            let took = side.trace_as(view, picture);
            let time = took.as_ref().ok().copied().flatten().unwrap_or_default();
            found[index] = fault(side.target, took.map(|time| time.is_some()))?;
            Ok::<_, BenchError>(time)
        })?;
        // If the judge's pictures differ, nothing is proven of the others.
        let judge = found.first().cloned().flatten();
        let mut kept = Vec::new();
        for (mut side, fault) in self.sides.drain(..).zip(found) {
            side.forget_warm_up();
            match fault.or_else(|| judge.clone()) {
                Some(fault) => self.faults.push(fault),
                None => kept.push(side),
            }
        }
        self.sides = kept;
        Ok(())
    }
}

/// What is wrong with a side whose picture is the judge's or not; errors of an adapter are its own.
fn fault(target: &Target, is_same: Result<bool, BenchError>) -> Result<Option<String>, BenchError> {
    match is_same {
        Ok(true) => Ok(None),
        Ok(false) => Ok(Some(format!("{} traces another picture than the CPU", target.name()))),
        Err(BenchError::Gpu(error)) => Ok(Some(format!("{}: {error}", target.name()))),
        Err(error) => Err(error),
    }
}

/// Figures of each side, the CPU's by threads, then adapters.
fn device_rows(sides: &[Side<'_>], picture: &Frame) -> Result<Vec<DeviceRow>, BenchError> {
    let rays = ByKind::from(picture.rays);
    let encode = encode_time(picture)?;
    let Some(judge) = sides.first() else { return Ok(Vec::new()) };
    let cpu = Phases { encode, ..judge.phases() };
    let row = |side: &Side<'_>| {
        let phases = Phases { encode, ..side.phases() };
        let traces = side.traces();
        let is_adapter = side.threads().is_none();
        DeviceRow {
            device: side.target.name(),
            threads: side.threads(),
            software: matches!(side.target, Target::Adapter(report) if !report.kind.is_real()),
            trace_ms: Spread::of_times(&traces),
            timestamps: side.has_timestamps(),
            mrays_per_s: rays.rates(median(&traces)),
            ratio: Ratio::of(&traces, &judge.traces()),
            picture_ms: phases.picture(),
            phases_ms: phases,
            break_even: is_adapter.then(|| BreakEven::of(&cpu, &phases)),
        }
    };
    let mut rows: Vec<_> = sides.iter().map(row).collect();
    rows.sort_by_key(|row| row.threads.unwrap_or(usize::MAX));
    Ok(rows)
}

/// Each number of threads against one.
fn scaling(sides: &[Side<'_>]) -> Vec<Scaling> {
    let Some(single) = sides.iter().find(|side| side.threads() == Some(1)) else { return Vec::new() };
    let mut rows: Vec<Scaling> = sides
        .iter()
        .filter_map(|side| {
            let speedup = Ratio::of(&single.traces(), &side.traces());
            Some(Scaling { threads: side.threads()?, speedup })
        })
        .collect();
    rows.sort_by_key(|row| row.threads);
    rows
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::gpu::adapters;
    use crate::layout::{EffectChoice, EffectSet};

    const SMALL: Comparison = Comparison {
        size: Some([32, 24]),
        rounds: Some(6),
        budget: Duration::from_secs(1),
        float: Float::Strict,
    };

    fn opaque() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/opaque.toml")
    }

    #[test]
    fn threads_are_measured_against_one_and_against_all() {
        let others = [Target::Cpu { threads: 1 }, Target::Cpu { threads: 3 }];
        let Compared { row, faults } = compare_devices(&opaque(), &others, &SMALL).unwrap();
        assert_eq!((faults, row.size, row.rounds), (Vec::new(), [32, 24], 6));
        assert!(row.triangles > 1000 && row.rays.primary == 32 * 24 && row.rays.total > row.rays.primary);
        assert!(row.devices.iter().all(|side| side.phases_ms.load > 0.0 && side.phases_ms.upload == 0.0));
        let one = &row.devices[0];
        assert_eq!((one.threads, one.break_even), (Some(1), None));
        let judge = row.devices.iter().find(|side| side.device == "CPU, all threads").unwrap();
        assert_eq!(judge.ratio, Ratio { median: 1.0, low: 1.0, high: 1.0 });
        assert_eq!(row.scaling[0].speedup.median, 1.0);
        assert!(row.scaling.iter().any(|row| row.threads == 3 && row.speedup.median > 0.0));
    }

    #[test]
    fn without_size_and_rounds_both_fit_the_budget() {
        let free = Comparison { size: None, rounds: None, budget: Duration::ZERO, ..SMALL };
        let row = compare_devices(&opaque(), &[], &free).unwrap().row;
        assert_eq!((row.size, row.rounds), ([80, 60], Ratio::LEAST_ROUNDS));
    }

    #[test]
    fn an_adapter_has_a_row_where_it_is_strict() {
        let Some(report) = adapters().into_iter().find(|adapter| adapter.name.contains("llvmpipe")) else {
            return;
        };
        let adapter = [Target::Adapter(Box::new(report))];
        let Compared { row, faults } = compare_devices(&opaque(), &adapter, &SMALL).unwrap();
        assert_eq!(faults, Vec::<String>::new());
        let side = &row.devices[1];
        assert!(side.software && side.threads.is_none() && side.break_even.is_some(), "{side:?}");
        let phases = side.phases_ms;
        assert!(phases.compile_cold > 0.0 && phases.compile_warm > 0.0 && phases.readback > 0.0);
        assert!((side.picture_ms - phases.picture()).abs() < 1e-9);
    }

    #[test]
    fn another_picture_is_a_fault_without_a_row() {
        let stage = Stage::load(&opaque(), PILOT).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let targets = [Target::Cpu { threads: 1 }, Target::Cpu { threads: 2 }, Target::Cpu { threads: 3 }];
        let mut bench = Bench { prepared: (1.0, 1.0), sides: Vec::new(), faults: Vec::new() };
        let lacking = EffectChoice::Only(EffectSet::NONE);
        for (effects, target) in [EffectChoice::Auto, EffectChoice::Auto, lacking].into_iter().zip(&targets) {
            let settings = Settings { effects, ..stage.settings };
            bench.add(&opaque(), &stage, target, settings, folder.path()).unwrap();
        }
        let view = stage.view_of(PILOT, &stage.settings);
        let (mut picture, _) = bench.picture(&view).unwrap();
        assert_eq!((bench.sides.len(), bench.faults.len()), (2, 1));
        assert!(bench.faults[0].contains("CPU, 3 threads traces another picture"), "{:?}", bench.faults);
        bench.take_turns(1, &view, &picture).unwrap();
        assert_eq!((bench.sides.len(), bench.sides[1].traces().len()), (2, 1));
        // A bit of one channel of one pixel.
        picture.texels[7].radiance[1] = picture.texels[7].radiance[1].next_up();
        bench.take_turns(1, &view, &picture).unwrap();
        assert_eq!((bench.sides.len(), bench.faults.len()), (0, 3));
    }
}
