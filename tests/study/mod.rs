//! Studies: whole and small, and what they certify.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use snellius::cpu::CpuRenderer;
use snellius::film::{Difference, Metric, Picture, Renderer};
use snellius::flatten;
use snellius::layout::{FlatScene, Precision, Settings};
use snellius::scene::Scene;
use snellius::study::{
    Config, Goal, Knob, MOST_SAMPLES, Report, Request, StudyError, Truth, Watch, choose, run, write_outputs,
};

/// Waits in silence; stops a study after so many stages.
struct Patience {
    stages: AtomicU32,
    most: u32,
}

impl Patience {
    fn new(most: u32) -> Self {
        Self { stages: AtomicU32::new(0), most }
    }
}

impl Watch for Patience {
    fn stage(&self, _words: &str, _share: f64) {
        self.stages.fetch_add(1, Ordering::Relaxed);
    }

    fn tick(&self) {}

    fn is_interrupted(&self) -> bool {
        self.stages.load(Ordering::Relaxed) > self.most
    }
}

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

fn config(name: &str, knobs: &[Knob], folder: &Path, seconds: u64) -> Config {
    Config {
        scene: scene(name),
        folder: folder.to_owned(),
        size: Some([24, 18]),
        depth: None,
        cutoff: None,
        knobs: knobs.to_vec(),
        adapters: Vec::new(),
        budget: Duration::from_secs(seconds),
        fresh: false,
        cpu: "a processor".to_owned(),
    }
}

fn study(name: &str, knobs: &[Knob], seconds: u64) -> Report {
    let folder = tempfile::tempdir().unwrap();
    run(&config(name, knobs, folder.path(), seconds), &Patience::new(u32::MAX)).unwrap()
}

#[test]
fn the_true_truncation_error_never_exceeds_the_certified_bound() {
    for name in ["ice.toml", "whitted.toml", "prism.toml"] {
        let report = study(name, &[Knob::Depth, Knob::Cutoff], 8);
        let certified: Vec<_> =
            report.rows.iter().filter_map(|row| Some((&row.id, row.certificate?))).collect();
        assert!(
            certified.len() >= 8,
            "{name}: only {} rows, left out {:?}",
            certified.len(),
            report.left_out
        );
        for (id, certificate) in &certified {
            assert_eq!(certificate.broken, 0, "{name}, {id}");
            assert!(certificate.error_mean <= certificate.bound_mean + 1e-6, "{name}, {id}: {certificate:?}");
        }
        // A comparison with nothing to compare would hold too.
        assert!(certified.iter().any(|(_, c)| c.error_max > 1e-3 && c.bound_max > c.error_max), "{name}");
    }
}

#[test]
fn a_small_study_writes_every_file() {
    let folder = tempfile::tempdir().unwrap();
    let knobs = [Knob::Depth, Knob::Samples, Knob::Precision, Knob::Tessellation];
    let report = run(&config("whitted.toml", &knobs, folder.path(), 12), &Patience::new(u32::MAX)).unwrap();
    write_outputs(&report, folder.path()).unwrap();
    assert!(report.complete);
    for truth in [Truth::Whole, Truth::Truncation, Truth::Arithmetic, Truth::Sampling] {
        assert!(report.references.contains_key(&truth), "{truth:?}: {:?}", report.left_out);
    }
    for name in
        ["study.json", "study.csv", "report.md", "report.html", "pareto.svg", "pareto.png", "truncation.svg"]
    {
        assert!(folder.path().join(name).metadata().unwrap().len() > 500, "{name}");
    }
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("<svg") && page.contains("data:image/png;base64,"));
    assert!(!page.contains("src=\"http") && !page.contains("href="), "it needs nothing else");
    // More samples, less error; deeper trees, less error.
    let rmse =
        |id: &str, truth| report.rows.iter().find(|row| row.id == id).map(|row| row.errors[&truth].rmse);
    let few = rmse("samples: 2", Truth::Sampling).unwrap();
    assert!(rmse("samples: 8", Truth::Sampling).is_none_or(|many| many < few));
    assert!(rmse("depth: 1", Truth::Truncation).unwrap() > rmse("depth: 4", Truth::Truncation).unwrap());
}

#[test]
fn a_study_that_was_stopped_goes_on_where_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let config = config("prism.toml", &[Knob::Depth], folder.path(), 6);
    let stopped = run(&config, &Patience::new(6)).unwrap_err();
    assert!(matches!(stopped, StudyError::Interrupted), "{stopped}");
    let kept: Report =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("study.json")).unwrap()).unwrap();
    assert!(!kept.complete && !kept.rows.is_empty());
    let report = run(&config, &Patience::new(u32::MAX)).unwrap();
    for row in &kept.rows {
        // The first runs are not made again: their times would differ.
        let same = report.rows.iter().find(|other| other.id == row.id).unwrap();
        assert_eq!((same.warm_up_ms, &same.errors), (row.warm_up_ms, &row.errors), "{}", row.id);
    }
    assert!(report.complete && report.rows.len() > kept.rows.len());
}

/// A scene of scenes/, flattened.
fn flattened(name: &str) -> (Scene, FlatScene) {
    let loaded = Scene::load(&scene(name)).unwrap();
    let flat = flatten::flatten(&loaded).unwrap().scene;
    (loaded, flat)
}

const BOTH: &[Precision] = &[Precision::F32, Precision::F64];

fn request<'a>((scene, flat): &'a (Scene, FlatScene), size: [u32; 2], keeps_samples: bool) -> Request<'a> {
    let base = Settings::default();
    Request { scene: flat, camera: &scene.camera, size, base, keeps_samples, precisions: BOTH }
}

/// Linear RGB clamped to [0, 1], and what tracing took.
fn picture((scene, flat): &(Scene, FlatScene), size: [u32; 2], settings: &Settings) -> (Picture, Duration) {
    let view = flatten::view(&scene.camera, flat, size, None, settings);
    let frame = CpuRenderer::new(flat, 0).unwrap().render(&view, settings, &()).unwrap();
    let clamped: Vec<_> = frame.radiance().iter().map(|p| p.map(|v| v.clamp(0.0, 1.0))).collect();
    (Picture::from_rgb(size[0], size[1], &clamped), frame.times.trace)
}

/// For goals that ask for no time.
fn no_clock(_: [u32; 2], _: &Settings) -> Result<Duration, StudyError> {
    Ok(Duration::ZERO)
}

#[test]
fn an_error_budget_is_kept_and_is_not_wasted() {
    let size = [40, 30];
    for name in ["whitted.toml", "prism.toml", "mirrors.toml"] {
        let subject = flattened(name);
        let goal = Goal::Error { limit: 0.002, metric: Metric::Rmse };
        let choice = choose(&request(&subject, size, true), goal, &mut no_clock).unwrap();
        let truth = Settings { depth: 64, cutoff: 1e-6, precision: Precision::F64, ..Settings::default() };
        let (truth, _) = picture(&subject, size, &truth);
        let rmse =
            |settings| Difference::between(&picture(&subject, size, &settings).0, &truth).unwrap().rmse;
        assert!(choice.meets && rmse(choice.settings) <= 0.002, "{name}: {choice:?}");
        // Twice the cut-off and one level less do not keep it, or are no cheaper.
        let Settings { cutoff, depth, .. } = choice.settings;
        let coarser = Settings { cutoff: cutoff * 4.0, depth: depth.saturating_sub(1), ..choice.settings };
        assert!(depth == 0 || rmse(coarser) > 0.0015, "{name}: {choice:?}");
    }
}

#[test]
fn a_budget_counts_the_samples_that_are_missing() {
    let (subject, size, limit) = (flattened("opaque.toml"), [40, 30], 0.01);
    let goal = Goal::Error { limit, metric: Metric::Rmse };
    let choice = choose(&request(&subject, size, false), goal, &mut no_clock).unwrap();
    let truth = Settings { samples: 1024, precision: Precision::F64, ..choice.settings };
    let (truth, _) = picture(&subject, size, &Settings { adaptive: None, ..truth });
    let rmse = |settings| Difference::between(&picture(&subject, size, &settings).0, &truth).unwrap().rmse;
    assert!(choice.meets && choice.settings.samples > 4, "{choice:?}");
    assert!(rmse(choice.settings) <= limit, "{choice:?}");
    // A third of the samples would not do.
    let fewer = Settings { samples: choice.settings.samples / 3, adaptive: None, ..choice.settings };
    assert!(rmse(fewer) > 0.8 * limit, "{choice:?}");
}

/// Its 12 pixels' middles need no reflections, but their samples do.
#[test]
fn a_budget_of_few_pixels_knows_what_their_samples_meet() {
    let subject = flattened("still_life.obj");
    let goal = Goal::Error { limit: 0.03, metric: Metric::Rmse };
    let choice = choose(&request(&subject, [4, 3], false), goal, &mut no_clock).unwrap();
    assert!(choice.probed > 10_000, "{choice:?}");
    assert!(choice.settings.depth > 1, "{choice:?}");
}

#[test]
fn a_budget_that_no_samples_keep_says_so_before_it_tries_them() {
    let subject = flattened("opaque.toml");
    let goal = Goal::Error { limit: 1e-7, metric: Metric::Rmse };
    let choice = choose(&request(&subject, [40, 30], false), goal, &mut no_clock).unwrap();
    assert!(!choice.meets && choice.settings.samples == MOST_SAMPLES && choice.figure[1] > 1e-7);
    assert!(choice.tried < 40, "{choice:?}");
}

#[test]
fn a_picture_takes_about_the_time_that_it_was_given() {
    let (subject, size) = (flattened("whitted.toml"), [64, 48]);
    let mut clock = |size: [u32; 2], settings: &Settings| {
        picture(&subject, size, settings);
        Ok::<_, StudyError>(picture(&subject, size, settings).1)
    };
    let given = |ms| Goal::Time(Duration::from_millis(ms));
    let request = request(&subject, size, false);
    let [short, long] = [60, 600].map(|ms| choose(&request, given(ms), &mut clock).unwrap());
    assert!(short.meets && long.meets && long.figure[1] < short.figure[1], "{short:?} {long:?}");
    // Other work on the machine may slow one run down, hardly all of them.
    let took = (0..5).map(|_| picture(&subject, size, &long.settings).1).min().unwrap();
    assert!((0.1..=1.2).contains(&(took.as_secs_f64() / 0.6)), "{took:?} {long:?}");
}

#[test]
fn the_most_accurate_settings_are_those_that_the_clock_allows() {
    let subject = flattened("prism.toml");
    // A device that takes longer the less it cuts, and twice as long in f64.
    let mut clock = |_: [u32; 2], settings: &Settings| {
        let precision = if settings.precision == Precision::F64 { 2.0 } else { 1.0 };
        Ok::<_, StudyError>(Duration::from_secs_f64(precision * f64::from(-settings.cutoff.log2()) / 1e3))
    };
    let goal = Goal::Time(Duration::from_millis(10));
    let choice = choose(&request(&subject, [40, 30], true), goal, &mut clock).unwrap();
    let Settings { cutoff, precision, .. } = choice.settings;
    // Nine of ten milliseconds: at the finest 2^-9 in f32, or 2^-4 in f64.
    assert!(choice.meets && precision == Precision::F32, "{choice:?}");
    assert!((2.0_f32.powi(-9)..=2.0_f32.powi(-7)).contains(&cutoff), "{choice:?}");
    let nothing = choose(&request(&subject, [40, 30], true), Goal::Time(Duration::ZERO), &mut clock).unwrap();
    assert!(!nothing.meets);
}
