//! Function by function: the kernel on the CPU against its twin on an adapter, over the same inputs.
//!
//! A fault reads "`fresnel` differs", not "the picture differs". The test of the sources (tests/lockstep) asks that every
//! function has a probe or is run by one; `snellius selftest` asks the adapters at hand.

mod inputs;
mod plain;
mod record;
mod scene;
mod soup;

use std::fmt;

use crate::gpu::{GpuError, GpuOptions, Prober, Source, Variant};
use crate::kernel::World;
use crate::layout::{EffectSet, FlatScene, Float, Intersector, Plan, Settings, View};
use inputs::{Generator, Input};
use record::Record;

/// Records of a probe, unless fewer are asked for.
pub const RECORDS: usize = 1 << 14;

/// One function, as the CPU runs it; the entry point `probe_NAME` of the file is its twin.
pub struct Probe {
    /// The function's name.
    pub name: &'static str,
    inputs: &'static [Input],
    /// Words that it writes at most.
    outputs: usize,
    run: fn(&World, &mut Record),
}

/// Probes by the file of their entry points, the simplest first.
pub const PROBES: [(&str, &[Probe]); 2] = [("probe_plain", plain::PROBES), ("probe_scene", scene::PROBES)];

/// How a function differs between the CPU and an adapter.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Its name.
    pub function: &'static str,
    /// Inputs for which it does.
    pub differing: usize,
    /// Inputs.
    pub records: usize,
    /// The first of them, with both answers in words.
    pub first: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { function, differing, records, first } = self;
        write!(f, "`{function}` differs for {differing} of {records} inputs, first for {first}")
    }
}

/// A scene that calls for everything at once, on the CPU and on an adapter.
pub struct Lockstep {
    scene: FlatScene,
    view: View,
    prober: Prober,
    variant: Variant,
}

impl Lockstep {
    /// Open an adapter with these shader files, strict or fast.
    ///
    /// # Errors
    /// As [`Prober::new`].
    pub fn new(
        options: &GpuOptions,
        float: Float,
        sources: &'static [Source<'static>],
    ) -> Result<Self, GpuError> {
        let scene = soup::scene();
        let view = soup::view(&scene);
        let prober = Prober::new(&scene, &view, options, sources)?;
        let settings = Settings { float, ..Settings::default() };
        let variant = Variant::new(scene.bvh_depth, &settings, &Plan::general(view.depth));
        Ok(Self { scene, view, prober, variant })
    }

    /// Run a probe of a file over `records` inputs on both sides: how they differ, if they do.
    ///
    /// # Errors
    /// As [`Prober::run`].
    pub fn compare(
        &mut self,
        file: &str,
        probe: &Probe,
        records: usize,
    ) -> Result<Option<Difference>, GpuError> {
        let width = probe.inputs.iter().map(Input::words).sum::<usize>();
        let stride = width.max(probe.outputs);
        let mut generator = Generator::new(probe.name);
        let inputs: Vec<u32> = (0..records).flat_map(|_| generator.record(probe.inputs, stride)).collect();
        // On the adapter.
        let mut found = inputs.clone();
        let entry = format!("probe_{}", probe.name);
        self.prober.run((file, &entry), &self.variant, stride, &mut found)?;
        // On the CPU.
        let world = World {
            scene: &self.scene,
            view: &self.view,
            intersector: Intersector::Watertight,
            effects: EffectSet::ALL,
        };
        let mut difference: Option<Difference> = None;
        for (input, found) in inputs.chunks(stride).zip(found.chunks(stride)) {
            let mut record = Record::new(input);
            (probe.run)(&world, &mut record);
            if !record.is_same(found) {
                let first = || Difference {
                    function: probe.name,
                    differing: 0,
                    records,
                    first: describe(&input[..width], &record, found),
                };
                difference.get_or_insert_with(first).differing += 1;
            }
        }
        Ok(difference)
    }

    /// Run every probe.
    ///
    /// # Errors
    /// As [`Prober::run`].
    pub fn compare_all(&mut self, records: usize) -> Result<Vec<Difference>, GpuError> {
        let mut differences = Vec::new();
        for (file, probe) in PROBES.iter().flat_map(|(file, probes)| probes.iter().map(move |p| (file, p))) {
            differences.extend(self.compare(file, probe, records)?);
        }
        Ok(differences)
    }
}

/// An input as floats, and both answers as words.
fn describe(input: &[u32], record: &Record, found: &[u32]) -> String {
    let floats: Vec<_> = input.iter().map(|word| f32::from_bits(*word)).collect();
    format!("{floats:?}:\n  CPU {:x?}\n  GPU {found:x?}", record.outputs())
}
