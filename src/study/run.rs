//! The course of a study: references, errors, times; each as far as the time goes.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::lab::{Lab, Subject};
use super::metrics::Seen;
use super::plan::{Plan, Row, Target, cutoff_label, float_name, intersector_name, precision_name};
use super::reference::{self, Reference};
use super::store::Store;
use super::{Baseline, Certificate, Errors, Knob, LeftOut, Report, RowRecord, StudyError, Truth, output};
use crate::gpu::AdapterReport;
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{Effects, Settings};

/// Runs of a row after its warm-up: 15 give an interval between the 4th and the 12th.
const RUNS: usize = 15;
/// Shares of the study's time.
const TRUNCATION_SHARE: f64 = 0.12;
const SAMPLING_SHARE: f64 = 0.3;
const TESSELLATION_SHARE: f64 = 0.04;
/// Of the study's time, when first runs must have ended: the rest is for timing.
const FIRST_RUNS_UNTIL: f64 = 0.75;
/// One first run may take this share of the study's time; but many samples, whose time can be foretold.
const ROW_SHARE: f64 = 0.08;

/// Samples that adaptive antialiasing is expected to take at the least.
const ADAPTIVE_SAMPLES: u32 = 4;

/// What to study.
#[derive(Debug, Clone)]
pub struct Config {
    /// The scene file.
    pub scene: PathBuf,
    /// Where results go; made if it is not there. An unfinished study of the same key is taken up again.
    pub folder: PathBuf,
    /// Pixels; the scene's own without.
    pub size: Option<[u32; 2]>,
    /// The baseline's depth; the scene's own without.
    pub depth: Option<u32>,
    /// The baseline's cut-off; the scene's own without.
    pub cutoff: Option<f32>,
    /// The knobs to turn.
    pub knobs: Vec<Knob>,
    /// The adapters to compare with.
    pub adapters: Vec<AdapterReport>,
    /// About how long the study may take.
    pub budget: Duration,
    /// Begin anew, whatever lies in the folder.
    pub fresh: bool,
    /// The processor's name.
    pub cpu: String,
}

/// Who waits for a study.
pub trait Watch: Sync {
    /// What is being done, in words; and the share that is done, in [0, 1].
    fn stage(&self, words: &str, share: f64);

    /// Called often: a sign of life.
    fn tick(&self);

    /// Whether to stop.
    fn is_interrupted(&self) -> bool;
}

/// Make a study, or finish one.
///
/// # Errors
/// [`StudyError`]; after [`StudyError::Interrupted`] the same call goes on where it was.
pub fn run(config: &Config, watch: &dyn Watch) -> Result<Report, StudyError> {
    watch.stage("reading the scene", 0.0);
    let subjects = subjects(config)?;
    let baseline = baseline(config, &subjects[0]);
    let store = Store::open(&config.folder)?;
    let lab = Lab::new(&subjects, &baseline, watch);
    let fresh = new_report(config, &subjects[0], &baseline);
    let known = if config.fresh { None } else { store.resume(&fresh.key) };
    let report = known.unwrap_or(fresh);
    let steps: Vec<i32> = subjects.iter().map(|subject| subject.steps).collect();
    let effects = Effects::of(&subjects[0].flat.scene, &baseline.settings).plan(&baseline.settings).effects;
    let (knobs, adapters) = (&*config.knobs, &*config.adapters);
    let plan = Plan { baseline: &baseline, knobs, steps: &steps, adapters, effects };
    let rows = plan.rows();
    let before = report.spent_s;
    let mut course =
        Course { lab, store, watch, report, started: Instant::now(), before, budget: config.budget };
    if !course.report.complete {
        course.report.left_out.clear();
        let references = course.references(&plan, &rows)?;
        course.errors(&rows, &references)?;
        course.times(&rows)?;
        course.report.complete = true;
        course.save()?;
    }
    watch.stage("done", 1.0);
    Ok(course.report)
}

/// The scene as it is, then with its built-in solids coarser and finer where that is wanted and changes them.
fn subjects(config: &Config) -> Result<Vec<Subject>, StudyError> {
    let mut subjects = vec![Subject::load(&config.scene, 0)?];
    if !config.knobs.contains(&Knob::Tessellation) {
        return Ok(subjects);
    }
    for steps in [1, 2, -1, -2] {
        // A finer scene may exceed limits that the scene itself keeps.
        let Ok(subject) = Subject::load(&config.scene, steps) else { continue };
        if subjects.iter().any(|known| known.triangles() == subject.triangles()) {
            if steps == 1 {
                break;
            }
            continue;
        }
        subjects.push(subject);
    }
    Ok(subjects)
}

fn baseline(config: &Config, subject: &Subject) -> Baseline {
    let defaults = &subject.scene.render;
    let settings = Settings {
        depth: config.depth.unwrap_or(defaults.depth),
        cutoff: config.cutoff.unwrap_or(defaults.cutoff as f32),
        ..Settings::default()
    };
    Baseline { size: config.size.unwrap_or(defaults.size), settings }
}

fn new_report(config: &Config, subject: &Subject, baseline: &Baseline) -> Report {
    let Settings { depth, cutoff, samples, precision, float, intersector, .. } = baseline.settings;
    let words = [precision_name(precision), float_name(float), intersector_name(intersector)].join(", ");
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let flat = &subject.flat.scene;
    Report {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        key: key(config, subject, baseline),
        scene: config.scene.display().to_string(),
        size: baseline.size,
        triangles: subject.triangles(),
        max_radiance: flat.radiance_bound.last().copied().map_or(0.0, f64::from),
        cpu: config.cpu.clone(),
        threads,
        budget_s: config.budget.as_secs_f64(),
        spent_s: 0.0,
        baseline: format!(
            "depth {depth}, cut-off {}, samples {samples}, {words}, CPU with all threads",
            cutoff_label(cutoff)
        ),
        baseline_values: BTreeMap::from([
            (Knob::Depth, f64::from(depth)),
            (Knob::Cutoff, f64::from(cutoff)),
            (Knob::Samples, f64::from(samples)),
            (Knob::Tessellation, 0.0),
        ]),
        references: BTreeMap::new(),
        rows: Vec::new(),
        left_out: Vec::new(),
        complete: false,
    }
}

/// What figures depend on: program, scene, baseline, rows and devices.
fn key(config: &Config, subject: &Subject, baseline: &Baseline) -> String {
    use std::hash::Hasher;
    let mut hasher = fnv::FnvHasher::default();
    let flat = &subject.flat.scene;
    let view = crate::flatten::view(&subject.scene.camera, flat, baseline.size, None, &baseline.settings);
    let arrays: [&[u8]; 8] = [
        bytemuck::cast_slice(&flat.nodes),
        bytemuck::cast_slice(&flat.triangles),
        bytemuck::cast_slice(&flat.attributes),
        bytemuck::cast_slice(&flat.corners),
        bytemuck::cast_slice(&flat.materials),
        bytemuck::cast_slice(&flat.lights),
        bytemuck::cast_slice(&flat.texels),
        bytemuck::bytes_of(&view),
    ];
    arrays.iter().for_each(|bytes| hasher.write(bytes));
    let adapters = config.adapters.iter().map(|a| [&*a.name, &*a.driver, &*a.driver_info].join(" "));
    let adapters = adapters.collect::<Vec<_>>().join(", ");
    let knobs: Vec<_> = config.knobs.iter().map(|knob| knob.name()).collect();
    let version = env!("CARGO_PKG_VERSION");
    format!("{version} {:016x} {} | {adapters} | {}", hasher.finish(), config.cpu, knobs.join(","))
}

/// A study under way.
struct Course<'a> {
    lab: Lab<'a>,
    store: Store,
    watch: &'a dyn Watch,
    report: Report,
    started: Instant,
    /// Seconds spent before it was stopped.
    before: f64,
    budget: Duration,
}

/// The references' pictures.
type Judges = BTreeMap<Truth, Seen>;

impl Course<'_> {
    fn spent(&self) -> f64 {
        self.before + self.started.elapsed().as_secs_f64()
    }

    fn left(&self) -> Duration {
        self.budget.saturating_sub(Duration::from_secs_f64(self.spent()))
    }

    fn say(&self, words: &str) {
        self.watch.stage(words, (self.spent() / self.budget.as_secs_f64()).min(0.99));
    }

    fn save(&mut self) -> Result<(), StudyError> {
        self.report.spent_s = self.spent();
        self.report.settle();
        self.store.save(&self.report)
    }

    /// Render the references that the rows need, or read those that are there.
    fn references(&mut self, plan: &Plan, rows: &[Row]) -> Result<Judges, StudyError> {
        let base = plan.baseline.settings;
        let mut judges = Judges::new();
        self.say("reference in f64");
        let started = Instant::now();
        let half = self.budget / 2;
        let arithmetic = self.reference(Truth::Arithmetic, |lab| reference::arithmetic(lab, base, half))?;
        let Some(arithmetic) = arithmetic else {
            return Err(StudyError::TooSlow { seconds: half.as_secs_f64() });
        };
        let one_sample = self
            .report
            .references
            .get(&Truth::Arithmetic)
            .map_or(started.elapsed(), |record| Duration::from_secs_f64(record.time_ms / 1e3));
        self.whole_tree(base, &arithmetic, &mut judges)?;
        let wants = |truth| rows.iter().any(|row| row.knob.is_some_and(|knob| knob.truth() == truth));
        if wants(Truth::Tessellation)
            && let Some(&finest) = plan.steps.iter().max()
        {
            self.say("reference: finest solids");
            let limit = self.budget.mul_f64(TESSELLATION_SHARE).max(one_sample * 4);
            let finest =
                self.reference(Truth::Tessellation, |lab| reference::tessellation(lab, base, finest, limit))?;
            judges.extend(finest.map(|seen| (Truth::Tessellation, seen)));
        }
        if wants(Truth::Sampling) {
            self.say("reference: many samples");
            let limit = self.budget.mul_f64(SAMPLING_SHARE);
            let many =
                self.reference(Truth::Sampling, |lab| reference::sampling(lab, base, one_sample, limit))?;
            judges.extend(many.map(|seen| (Truth::Sampling, seen)));
        }
        judges.insert(Truth::Arithmetic, arithmetic);
        Ok(judges)
    }

    /// The whole tree, in f64 and in the rows' own arithmetic.
    fn whole_tree(&mut self, base: Settings, coarse: &Seen, judges: &mut Judges) -> Result<(), StudyError> {
        self.say("reference: the whole tree");
        let limit = self.budget.mul_f64(TRUNCATION_SHARE);
        let whole = self.reference(Truth::Whole, |lab| {
            reference::whole(&mut |setup, limit| lab.shoot(setup, limit), base, coarse, limit)
        })?;
        judges.extend(whole.map(|seen| (Truth::Whole, seen)));
        let Some(record) = self.report.references.get(&Truth::Whole).cloned() else { return Ok(()) };
        let cutoff = record.cutoff.unwrap_or(base.cutoff);
        let settings = Settings { depth: MAX_DEPTH, cutoff, ..base };
        let tree = self.reference(Truth::Truncation, |lab| reference::truncation(lab, settings, &record))?;
        judges.extend(tree.map(|seen| (Truth::Truncation, seen)));
        Ok(())
    }

    /// A reference from the folder, or a new one.
    fn reference(
        &mut self,
        truth: Truth,
        make: impl FnOnce(&mut Lab) -> Result<Option<Reference>, StudyError>,
    ) -> Result<Option<Seen>, StudyError> {
        if self.report.references.contains_key(&truth)
            && let Some(seen) = self.store.picture(truth.name())
        {
            return Ok(Some(seen));
        }
        let Some(Reference { seen, record }) = make(&mut self.lab)? else {
            let reason = "no time: allow more with --budget".to_owned();
            self.report.left_out.push(LeftOut { id: format!("reference: {}", truth.name()), reason });
            return Ok(None);
        };
        self.store.keep_picture(truth.name(), &seen)?;
        self.report.references.insert(truth, record);
        self.save()?;
        Ok(Some(seen))
    }

    /// Trace every row once, for its picture and to warm up; what may take long comes last.
    fn errors(&mut self, rows: &[Row], judges: &Judges) -> Result<(), StudyError> {
        let mut order: Vec<&Row> = rows.iter().collect();
        order.sort_by_key(|row| {
            let is_endless = row.setup.settings.cutoff == 0.0;
            (row.knob.is_some_and(|knob| knob.truth() == Truth::Sampling), is_endless)
        });
        for row in order {
            let id = row.id();
            if self.report.row(&id).is_some() {
                continue;
            }
            self.say(&id);
            match self.first_run(row, judges)? {
                Ok(record) => {
                    self.report.rows.push(record);
                    self.save()?;
                }
                Err(reason) => self.report.left_out.push(LeftOut { id, reason }),
            }
        }
        Ok(())
    }

    /// How long a first run may take, or why it is not even begun.
    fn limit(&self, row: &Row) -> Result<Duration, String> {
        let Some(knob) = row.knob else {
            // The baseline has been shown to fit, in f64.
            return Ok(self.budget);
        };
        let left = self.budget.as_secs_f64() * FIRST_RUNS_UNTIL - self.spent();
        let base = self.report.baseline_row().map_or(0.0, RowRecord::time) / 1e3;
        // How many samples adaptive antialiasing takes is for the picture to say: some at the least.
        let samples = if knob == Knob::Adaptive { ADAPTIVE_SAMPLES } else { row.setup.settings.samples };
        let expected = base * f64::from(samples);
        if expected > left {
            return Err(format!("would take about {expected:.0} s: allow more with --budget"));
        }
        if let Target::Gpu { adapter } = &row.setup.target
            && self.report.left_out.iter().any(|other| other.id.contains(adapter.as_str()))
        {
            return Err("as its first row".to_owned());
        }
        let share =
            if knob.truth() == Truth::Sampling { left } else { self.budget.as_secs_f64() * ROW_SHARE };
        Ok(Duration::from_secs_f64(share.min(left).max(0.0)))
    }

    /// A row's record, or why there is none.
    fn first_run(&mut self, row: &Row, judges: &Judges) -> Result<Result<RowRecord, String>, StudyError> {
        let limit = match self.limit(row) {
            Ok(limit) => limit,
            Err(reason) => return Ok(Err(reason)),
        };
        let shot = match self.lab.shoot(&row.setup, limit) {
            Ok(Some(shot)) => shot,
            Ok(None) => {
                return Ok(Err(format!(
                    "stopped after {:.0} s: allow more with --budget",
                    limit.as_secs_f64()
                )));
            }
            // What an adapter cannot do is worth a line, not the study.
            Err(StudyError::Gpu(error)) => return Ok(Err(error.to_string())),
            Err(error) => return Err(error),
        };
        let seen = Seen::of(&shot.frame);
        let mut errors = BTreeMap::new();
        for (&truth, reference) in judges {
            if judges_row(truth, row.knob) {
                errors.insert(truth, Errors::between(&seen, reference)?);
            }
        }
        if let Some(reference) = row.knob.and_then(|knob| judges.get(&knob.truth())) {
            self.store
                .write(&output::error_image_name(&row.id()), &output::error_image(&seen, reference)?)?;
        }
        let is_certified = row.knob.is_none_or(Knob::is_truncation);
        let tree = judges.get(&Truth::Truncation).filter(|_| is_certified);
        let certificate = tree.map(|tree| Certificate::of(&seen, tree));
        Ok(Ok(RowRecord {
            id: row.id(),
            knob: row.knob,
            label: row.label.clone(),
            value: row.value,
            rays: shot.frame.rays.into(),
            errors,
            certificate,
            warm_up_ms: shot.time.as_secs_f64() * 1e3,
            times_ms: Vec::new(),
            timing: None,
            ratio: None,
        }))
    }

    /// Let the rows take turns, so that what slows the machine down for a while slows all of them; until each
    /// has run often enough, or the time is over. Each round begins one row further on.
    fn times(&mut self, rows: &[Row]) -> Result<(), StudyError> {
        let rows: Vec<&Row> = rows.iter().filter(|row| self.report.row(&row.id()).is_some()).collect();
        // A row may have three times its share.
        let share = self.left().as_secs_f64() * 3.0 / rows.len().max(1) as f64;
        for round in 0..RUNS {
            let mut ran = false;
            for turn in 0..rows.len() {
                let row = rows[(turn + round) % rows.len()];
                ran |= self.another_run(row, round, share)?;
            }
            self.save()?;
            if !ran {
                break;
            }
        }
        Ok(())
    }

    /// One more run of a row, if it is its turn and there is time.
    fn another_run(&mut self, row: &Row, round: usize, share: f64) -> Result<bool, StudyError> {
        let id = row.id();
        let Some(record) = self.report.row(&id) else { return Ok(false) };
        let (runs, expected) = (record.times_ms.len(), record.time() / 1e3);
        let taken = record.times_ms.iter().sum::<f64>() / 1e3;
        if runs > round || taken + expected > share || expected > self.left().as_secs_f64() {
            return Ok(false);
        }
        self.say(&format!("timing, round {} of {RUNS}: {id}", round + 1));
        let Some(shot) = self.lab.shoot(&row.setup, self.budget)? else { return Ok(false) };
        if let Some(record) = self.report.rows.iter_mut().find(|record| record.id == id) {
            record.times_ms.push(shot.time.as_secs_f64() * 1e3);
        }
        Ok(true)
    }
}

/// Whether a reference can judge a row: its own knob's, the whole tree where samples and triangles are the
/// same, and each of them the baseline.
fn judges_row(truth: Truth, knob: Option<Knob>) -> bool {
    match knob {
        None => true,
        Some(knob) => knob.truth() == truth || (truth == Truth::Whole && knob.keeps_samples()),
    }
}
