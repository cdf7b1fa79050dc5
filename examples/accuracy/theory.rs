//! Agreement with theory: measured, expected and bound, for each precision and device.

use std::path::PathBuf;

use snellius::cpu::CpuRenderer;
use snellius::film::Renderer;
use snellius::flatten;
use snellius::gpu::{AdapterReport, GpuOptions, GpuRenderer, SOURCES};
use snellius::layout::{Float, Intersector, Precision, Settings};
use snellius::scene::Scene;
use snellius::selftest::{Bound, CASES, Case, CpuDevice, Device, Effort, Finding, GpuDevice};

use super::Result;
use super::expected::{Expected, expected};

/// Where the scenes are that say what they must show.
const SCENES: &str = "scenes/theory";

/// The section: scenes that state their answer, then the self-test's figures that have one; a column for each device.
/// False where a value is farther off than it may be.
pub(super) fn section(adapters: &[AdapterReport]) -> Result<(String, bool)> {
    let (scenes, scenes_hold) = scenes(adapters)?;
    let (cases, cases_hold) = cases(adapters)?;
    let lines = [
        "## Agreement with theory",
        "",
        "Scenes that have an answer on paper, which their headers derive: every pixel shows it. Columns give the greatest \
         distance of a channel of any pixel from it.",
        "",
        &scenes,
        "",
        "Angles, shifts, reflectances and counts that have an answer on paper, and what each device measures; `snellius \
         selftest` runs all cases.",
        "",
        &cases,
    ];
    Ok((lines.join("\n"), scenes_hold && cases_hold))
}

/// A line for each scene.
fn scenes(adapters: &[AdapterReport]) -> Result<(String, bool)> {
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(SCENES)?.map(|entry| Ok(entry?.path())).collect::<std::io::Result<_>>()?;
    files.sort();
    let names = adapters.iter().map(|adapter| format!(" {} |", adapter.name)).collect::<String>();
    let mut lines = vec![
        format!("| scene | expected | within | CPU f32 | CPU f64 |{names}"),
        format!("|---|---|--:|--:|--:|{}", "--:|".repeat(adapters.len())),
    ];
    let mut holds = true;
    for file in files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let promise = expected(&std::fs::read_to_string(&file)?)
            .ok_or_else(|| format!("{}: its header says not what to expect", file.display()))?;
        let distances = distances(&Scene::load(&file)?, &promise, adapters)?;
        let words = distances.iter().map(|&distance| {
            let holds = distance <= promise.within;
            format!(" {distance:.1e}{} |", if holds { "" } else { " **missed**" })
        });
        let words = words.collect::<String>();
        holds &= distances.iter().all(|&distance| distance <= promise.within);
        let [r, g, b] = promise.radiance;
        let value = if r == g && g == b { r.to_string() } else { format!("{r}, {g}, {b}") };
        lines.push(format!(
            "| [`{name}`](../{SCENES}/{name}.toml) | {value} | {:.0e} |{words}",
            promise.within
        ));
    }
    Ok((lines.join("\n"), holds))
}

/// How far each device is off: CPU f32, CPU f64, then the adapters.
fn distances(scene: &Scene, promise: &Expected, adapters: &[AdapterReport]) -> Result<Vec<f64>> {
    let flat = flatten::flatten(scene)?.scene;
    let (depth, cutoff) = (scene.render.depth, scene.render.cutoff as f32);
    let single = Settings { depth, cutoff, ..Settings::default() };
    let view = flatten::view(&scene.camera, &flat, scene.render.size, None, &single);
    let mut distances = Vec::new();
    for precision in [Precision::F32, Precision::F64] {
        let frame = CpuRenderer::new(&flat, 0)?.render(&view, &Settings { precision, ..single }, &())?;
        distances.push(promise.distance(&frame.radiance()));
    }
    for adapter in adapters {
        let options = GpuOptions { adapter: Some(adapter.name.clone()), ..GpuOptions::default() };
        let frame = GpuRenderer::new(&flat, &options)?.render(&view, &single, &())?;
        distances.push(promise.distance(&frame.radiance()));
    }
    Ok(distances)
}

/// A line for each figure of the self-test that is expected to be near a value.
fn cases(adapters: &[AdapterReport]) -> Result<(String, bool)> {
    let mut devices: Vec<Box<dyn Device>> = Vec::new();
    for precision in [Precision::F32, Precision::F64] {
        devices.push(Box::new(CpuDevice::new(precision, Intersector::Watertight)));
    }
    for adapter in adapters {
        let options = GpuOptions { adapter: Some(adapter.name.clone()), ..GpuOptions::default() };
        devices.push(Box::new(GpuDevice::new(&options, Float::Strict, Intersector::Watertight, SOURCES)?));
    }
    let names: Vec<_> = devices.iter().map(|device| device.name().to_owned()).collect();
    let mut lines = vec![
        format!("| case | figure | expected | within | {} |", names.join(" | ")),
        format!("|---|---|--:|--:|{}", "--:|".repeat(names.len())),
    ];
    let mut holds = true;
    for case in CASES {
        let (rows, all_near) = rows(case, &mut devices)?;
        lines.extend(rows);
        holds &= all_near;
    }
    Ok((lines.join("\n"), holds))
}

/// The figures of a case that are expected to be near a value, and whether all are.
fn rows(case: &Case, devices: &mut [Box<dyn Device>]) -> Result<(Vec<String>, bool)> {
    let mut found: Vec<Vec<Finding>> = Vec::new();
    for device in devices {
        found.push((case.run)(device.as_mut(), Effort::Short)?);
    }
    let Some(first) = found.first() else { return Ok((Vec::new(), true)) };
    let (mut lines, mut holds) = (Vec::new(), true);
    for (index, finding) in first.iter().enumerate() {
        let Bound::Near { expected, within } = finding.bound else { continue };
        let mut words = String::new();
        for findings in &found {
            let same = findings.get(index).filter(|other| other.what == finding.what);
            words += &same.map_or_else(|| " – |".to_owned(), |other| format!(" {} |", figure(other.figure)));
            holds &= same.is_none_or(|other| (other.figure - expected).abs() <= within);
        }
        lines.push(format!(
            "| {} | {} | {} | {within:.1e} |{words}",
            case.id,
            finding.what,
            figure(expected)
        ));
    }
    Ok((lines, holds))
}

/// Seven digits where the value is not tiny.
fn figure(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 => format!("{value:.3e}"),
        size if size >= 1e4 => format!("{value:.1}"),
        _ => format!("{value:.7}"),
    }
}
