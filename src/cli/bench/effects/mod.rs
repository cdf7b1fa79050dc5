//! `snellius bench --effects`: what code costs that a scene does not need.

mod markdown;

use serde::Serialize;

use super::super::console::{Console, print, print_json};
use super::super::{CliError, Outcome};
use super::machine::Machine;
use super::{BenchArgs, adapters_of, scenes_of};
use crate::bench::{EffectRow, Stage, Target, compare_effects, idle_effects};
use crate::layout::{Backend, EffectChoice};

/// Width and height of the pictures where none are given.
const SIZE: [u32; 2] = [320, 240];

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Report {
    machine: Machine,
    /// Width and height of the pictures.
    size: [u32; 2],
    /// Rounds in which both sides were traced.
    rounds: u32,
    /// Each scene's own effects against all of them.
    scenes: Vec<EffectRow>,
    /// Each effect switched on alone in a scene that does not need it.
    alone: Vec<EffectRow>,
    /// Pairs of pictures that differed: they have no row.
    failed: usize,
}

pub(super) fn run(args: &BenchArgs, console: Console) -> Result<Outcome, CliError> {
    let scenes = scenes_of(args)?;
    let targets = targets(args)?;
    let mut bench =
        Bench { args, console, targets: &targets, rows: Vec::new(), alone: Vec::new(), failed: 0 };
    let size = args.size.map_or(SIZE, |size| size.0);
    let mut stages = scenes.iter().map(|path| Stage::load(path, size)).collect::<Result<Vec<_>, _>>()?;
    for stage in &stages {
        bench.whole(stage)?;
    }
    // A scene that calls for little shows most of what one effect more costs.
    stages.sort_by_key(|stage| stage.effects().iter().count());
    let mut met = Vec::new();
    for stage in &stages {
        bench.one_by_one(stage, &mut met)?;
    }
    let Bench { rows, alone, failed, .. } = bench;
    let machine = Machine::new(&targets);
    let report = Report { machine, size, rounds: args.rounds_or_default(), scenes: rows, alone, failed };
    if args.json {
        print_json(&report)?
    } else {
        print(&markdown::page(&report))?
    }
    Ok(if failed == 0 { Outcome::Done } else { Outcome::Failed })
}

/// All threads of the CPU unless an adapter is named, then each adapter that the flags leave.
fn targets(args: &BenchArgs) -> Result<Vec<Target>, CliError> {
    let mut targets = Vec::new();
    if args.backend.map_or(args.adapter.is_none(), |backend| backend == Backend::Cpu) {
        targets.push(Target::Cpu { threads: 0 });
    }
    targets.extend(adapters_of(args)?);
    Ok(targets)
}

/// The comparison of effects, in work.
struct Bench<'a> {
    args: &'a BenchArgs,
    console: Console,
    targets: &'a [Target],
    rows: Vec<EffectRow>,
    /// Rows of one effect that a scene does not need.
    alone: Vec<EffectRow>,
    /// Pairs of pictures that differ.
    failed: usize,
}

impl Bench<'_> {
    /// A scene's own effects against all of them, on every device.
    fn whole(&mut self, stage: &Stage) -> Result<(), CliError> {
        for target in self.targets {
            let row = self.measure(stage, target, EffectChoice::All, "all effects")?;
            self.rows.extend(row);
        }
        Ok(())
    }

    /// Each effect that no scene before could do without, switched on in this one if it can.
    fn one_by_one(&mut self, stage: &Stage, met: &mut Vec<&'static str>) -> Result<(), CliError> {
        for (effect, set) in idle_effects(stage) {
            if met.contains(&effect.name()) {
                continue;
            }
            met.push(effect.name());
            for target in self.targets {
                let row = self.measure(stage, target, EffectChoice::Only(set), effect.name())?;
                self.alone.extend(row);
            }
        }
        Ok(())
    }

    fn measure(
        &mut self,
        stage: &Stage,
        target: &Target,
        general: EffectChoice,
        what: &str,
    ) -> Result<Option<EffectRow>, CliError> {
        self.console.detail(format!("{}: {what} on {}", stage.name, target.name()));
        let row = compare_effects(stage, target, general, self.args.rounds_or_default() as usize)?;
        if row.is_none() {
            self.failed += 1;
            let device = target.name();
            self.console.warn(format!("{}: the picture with {what} is another one on {device}", stage.name));
        }
        Ok(row)
    }
}
