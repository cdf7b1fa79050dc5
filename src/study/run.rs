//! The course of a study: references, errors, times; each as far as the time goes.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use super::begin::{baseline, new_report, subjects};
use super::lab::Lab;
use super::metrics::Seen;
use super::plan::{Plan, Row};
use super::reference::{self, Reference};
use super::store::Store;
use super::{Config, LeftOut, Report, StudyError, Truth, Watch};
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{Effects, Settings};

/// Shares of the study's time.
const TRUNCATION_SHARE: f64 = 0.12;
const SAMPLING_SHARE: f64 = 0.33;
const TESSELLATION_SHARE: f64 = 0.04;

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

/// A study under way.
pub(super) struct Course<'a> {
    pub(super) lab: Lab<'a>,
    pub(super) store: Store,
    watch: &'a dyn Watch,
    pub(super) report: Report,
    started: Instant,
    /// Seconds spent before it was stopped.
    before: f64,
    pub(super) budget: Duration,
}

/// The references' pictures.
pub(super) type Judges = BTreeMap<Truth, Seen>;

impl Course<'_> {
    /// Seconds so far.
    pub(super) fn spent(&self) -> f64 {
        self.before + self.started.elapsed().as_secs_f64()
    }

    /// What is left of the time.
    pub(super) fn left(&self) -> Duration {
        self.budget.saturating_sub(Duration::from_secs_f64(self.spent()))
    }

    /// Tell what is being done.
    pub(super) fn say(&self, words: &str) {
        self.watch.stage(words, (self.spent() / self.budget.as_secs_f64()).min(0.99));
    }

    /// Keep what is finished.
    pub(super) fn save(&mut self) -> Result<(), StudyError> {
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
}
