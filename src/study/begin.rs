//! What a study begins with: the scene at each level, the baseline, an empty report.

use std::collections::BTreeMap;

use super::lab::Subject;
use super::plan::{cutoff_label, float_name, intersector_name, precision_name};
use super::{Baseline, Config, Knob, Report, StudyError};
use crate::layout::Settings;

/// The scene as it is, then with its built-in solids coarser and finer where that is wanted and changes them.
pub(super) fn subjects(config: &Config) -> Result<Vec<Subject>, StudyError> {
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

/// The scene's own settings, or those that are asked for in their place.
pub(super) fn baseline(config: &Config, subject: &Subject) -> Baseline {
    let defaults = &subject.scene.render;
    let settings = Settings {
        depth: config.depth.unwrap_or(defaults.depth),
        cutoff: config.cutoff.unwrap_or(defaults.cutoff as f32),
        ..Settings::default()
    };
    Baseline { size: config.size.unwrap_or(defaults.size), settings }
}

/// A report of which everything is still to be found.
pub(super) fn new_report(config: &Config, subject: &Subject, baseline: &Baseline) -> Report {
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
        bytemuck::cast_slice(&flat.uvs),
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
