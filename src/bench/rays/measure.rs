//! How fast a set of rays is traced, once every answer is right.

use std::borrow::Cow;
use std::time::Duration;

use rayon::prelude::*;
use serde::Serialize;

use super::host::prepared;
use super::{Mode, Query, RayAdapter, RayAnswer, RayHost, RayRecord, RayStage};
use crate::bench::{BenchError, median, take_turns};
use crate::cpu::{Cast, thread_pool};
use crate::gpu::Records;
use crate::kernel::bvh::{intersect, occluded};

/// One set on one device. Every answer had the bits of the scalar kernel's.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RayRun {
    /// P, R, D, S, or the file that the rays came from.
    pub set: String,
    /// `cpu`, or the adapter's name.
    pub device: String,
    /// Threads; 0 for an adapter, which has its own.
    pub threads: usize,
    /// How rays are handed over.
    pub mode: Mode,
    /// Millions of rays a second: the median.
    pub mrays_per_s: f64,
    /// Rays that hit something.
    pub hits: usize,
}

/// A set's rates, and its answers.
#[derive(Debug)]
pub struct Measured {
    /// By mode, then threads.
    pub runs: Vec<RayRun>,
    /// What the scalar kernel says.
    pub answers: Vec<RayAnswer>,
    /// What is wrong where a side's answers were others: it has no run.
    pub faults: Vec<String>,
}

/// Time a set of rays, with one thread and with all, single and coherent, and on adapters, in turn; each side after its
/// answers were held against the scalar kernel's.
///
/// # Errors
/// [`BenchError::Cpu`], [`BenchError::Gpu`].
pub fn measure(
    stage: &RayStage,
    adapters: &mut [RayAdapter],
    set: &str,
    rays: &[RayRecord],
    query: Query,
    rounds: usize,
) -> Result<Measured, BenchError> {
    let rays: Vec<Cast> = rays.iter().map(Cast::from).collect();
    let answers = judge(stage, &rays, query);
    let pools = [thread_pool(1)?, thread_pool(0)?];
    let pools = &pools[..if pools[1].current_num_threads() == 1 { 1 } else { 2 }];
    let mut sides = Vec::new();
    for mode in [Mode::Single, Mode::Coherent] {
        let host = |pool| RayHost::new(stage.world(), stage.tree(), &rays, query, mode, pool);
        sides.extend(pools.iter().map(|pool| Side::Cpu(host(pool))));
    }
    for adapter in adapters {
        let records = adapter.load(&rays)?;
        sides.push(Side::Gpu { adapter, records, query });
    }
    let mut faults = Vec::new();
    let mut right = Vec::new();
    for mut side in sides {
        side.trace()?;
        let found = side.answers(rays.len())?;
        match differing(&found, &answers) {
            None => right.push(side),
            Some(ray) => faults.push(format!(
                "{set}, {}: ray {ray} is {:?}, by the scalar kernel {:?}",
                side.name(),
                found[ray],
                answers[ray]
            )),
        }
    }
    let times = take_turns(rounds, right.len(), |side| right[side].trace())?;
    let hits = answers.iter().filter(|answer| answer.is_hit()).count();
    let run = |(side, times): (&Side<'_>, &Vec<Duration>)| RayRun {
        set: set.to_owned(),
        device: side.device().to_owned(),
        threads: side.threads(),
        mode: side.mode(),
        mrays_per_s: rays.len() as f64 / median(times).as_secs_f64().max(f64::MIN_POSITIVE) / 1e6,
        hits,
    };
    Ok(Measured { runs: right.iter().zip(&times).map(run).collect(), answers, faults })
}

/// The scalar kernel's answers.
fn judge(stage: &RayStage, rays: &[Cast], query: Query) -> Vec<RayAnswer> {
    let world = stage.world();
    let answer = |cast: &Cast| {
        let ray = prepared(&world, cast);
        match query {
            Query::Nearest => RayAnswer::nearest(&intersect(&world, &ray, cast.limit)),
            Query::Any => RayAnswer::any(occluded(&world, &ray, cast.limit)),
        }
    };
    rays.par_iter().map(answer).collect()
}

/// The first ray whose answers differ in a bit.
fn differing(found: &[RayAnswer], expected: &[RayAnswer]) -> Option<usize> {
    let bits = |answer: &RayAnswer| (answer.t.to_bits(), answer.face);
    found.iter().zip(expected).position(|(a, b)| bits(a) != bits(b))
}

/// One way to trace a set.
enum Side<'a> {
    Cpu(RayHost<'a>),
    Gpu { adapter: &'a mut RayAdapter, records: Records, query: Query },
}

impl Side<'_> {
    fn trace(&mut self) -> Result<Duration, BenchError> {
        match self {
            Self::Cpu(host) => Ok(host.trace()),
            Self::Gpu { adapter, records, query } => adapter.trace(records, *query),
        }
    }

    /// What the last trace of `count` rays found.
    fn answers(&self, count: usize) -> Result<Cow<'_, [RayAnswer]>, BenchError> {
        match self {
            Self::Cpu(host) => Ok(Cow::Borrowed(host.answers())),
            Self::Gpu { adapter, records, .. } => Ok(Cow::Owned(adapter.answers(records, count)?)),
        }
    }

    fn device(&self) -> &str {
        match self {
            Self::Cpu(_) => "cpu",
            Self::Gpu { adapter, .. } => adapter.name(),
        }
    }

    fn threads(&self) -> usize {
        match self {
            Self::Cpu(host) => host.threads(),
            Self::Gpu { .. } => 0,
        }
    }

    fn mode(&self) -> Mode {
        match self {
            Self::Cpu(host) => host.mode(),
            Self::Gpu { .. } => Mode::Single,
        }
    }

    fn name(&self) -> String {
        match self {
            Self::Cpu(_) => format!("{:?}, {} threads", self.mode(), self.threads()),
            Self::Gpu { .. } => self.device().to_owned(),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::bench::rays::{Pinhole, RaySets};
    use crate::bvh::Preset;
    use crate::layout::constants::NONE;

    /// A roof over a floor, as a mesh.
    fn stage() -> RayStage {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("roof.obj");
        let roof = "v -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nv 0 3 -1\nv -2 1 1\nv 2 1 1\nf 1 3 2\nf 1 4 3\nf 5 6 7\n";
        std::fs::write(&path, roof).unwrap();
        let pinhole = Pinhole { eye: Some([0.5, 4.0, 7.0]), target: Some([0.0, 0.5, 0.0]), fov: Some(60.0) };
        RayStage::load(&path, Preset::Best, pinhole).unwrap()
    }

    #[test]
    fn every_set_is_traced_in_every_way_with_the_same_hits() {
        let stage = stage();
        let sets = RaySets::of(&stage, 32);
        let hits = sets.primary.len() - 1;
        assert_eq!((sets.primary.len(), sets.shadow.len()), (1024, sets.diffuse.len()));
        for (letter, rays, query) in sets.by_letter() {
            let Measured { runs, answers, faults } =
                measure(&stage, &mut [], letter, rays, query, 1).unwrap();
            assert_eq!(faults, Vec::<String>::new());
            let found = answers.iter().filter(|answer| answer.is_hit()).count();
            assert!((1..hits).contains(&found), "{letter}: {found}");
            assert!(runs.len() >= 2 && runs.iter().all(|run| run.hits == found && run.mrays_per_s > 0.0));
        }
    }

    #[test]
    fn faces_are_numbered_as_the_file_has_them() {
        let stage = stage();
        let down = |x: f32, z: f32| Cast {
            origin: [x, 9.0, z],
            limit: 99.0,
            direction: [0.0, -1.0, 0.0],
            origin_face: NONE,
        };
        let rays = [down(3.0, -3.5), down(-3.0, 3.5), down(0.0, 0.0), down(9.0, 0.0)];
        let answers = judge(&stage, &rays, Query::Nearest);
        assert_eq!(answers.iter().map(|answer| answer.face).collect::<Vec<_>>(), [0, 1, 2, NONE]);
        assert_eq!((answers[0].t, answers[3]), (9.0, RayAnswer::MISS));
    }

    #[test]
    fn an_answer_that_differs_in_a_bit_is_found() {
        let expected = [RayAnswer { t: 1.0, face: 3 }, RayAnswer::MISS];
        assert_eq!(differing(&expected, &expected), None);
        assert_eq!(
            differing(&[RayAnswer { t: 1.0_f32.next_up(), face: 3 }, expected[1]], &expected),
            Some(0)
        );
        assert_eq!(differing(&[expected[0], RayAnswer { t: 0.0, face: 0 }], &expected), Some(1));
    }
}
