//! `snellius bench`: figures, files, mistakes.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{Run, folder, snellius};
use crate::lockstep::devices::find;

/// A painted box.
const BOX: &str = r##"
[camera]
eye = [2, 1.5, 4]
target = [0, 0, 0]
[background]
color = "#ffffff"
[[light]]
position = [3, 5, 3]
[material.paint]
diffuse = { color = "#c08040" }
[[model]]
shape = { box = { size = [1, 1, 1] } }
material = "paint"
"##;

/// A folder with the box in it.
fn box_folder() -> tempfile::TempDir {
    let folder = folder();
    fs::write(folder.path().join("box.toml"), BOX).expect("a file");
    folder
}

fn on_cpu(folder: &Path, more: &str) -> Run {
    snellius(folder, &format!("bench box.toml --backend cpu --rounds 6 {more}"))
}

/// A square of two faces.
const SQUARE: &str = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 3 2\nf 1 4 3\n";

/// A file of rays: a count, then origin, tmin, direction, tmax of each.
fn rays(records: &[[f32; 8]]) -> Vec<u8> {
    let words = records.iter().flatten().flat_map(|x| x.to_le_bytes());
    (records.len() as u32).to_le_bytes().into_iter().chain(words).collect()
}

#[test]
fn the_rays_of_a_file_are_traced_and_answered() {
    let folder = folder();
    fs::write(folder.path().join("square.obj"), SQUARE).expect("a file");
    let down = |x: f32, z: f32| [x, 2.0, z, 0.0, 0.0, -1.0, 0.0, 9.0];
    fs::write(folder.path().join("a.rays"), rays(&[down(0.5, -0.5), down(-0.5, 0.5), down(5.0, 0.0)]))
        .expect("a file");
    let line = "bench --rays square.obj --ray-file a.rays --backend cpu --rounds 6 --json --dump out";
    let run = snellius(folder.path(), line);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let json = run.json();
    assert_eq!((json["mesh"].as_str(), json["triangles"].as_u64()), (Some("square.obj"), Some(2)));
    assert!(json["build_ms"].as_f64() > Some(0.0) && json["bytes_per_triangle"].as_f64() > Some(36.0));
    let first = &json["runs"][0];
    assert_eq!((first["set"].as_str(), first["device"].as_str()), (Some("a.rays"), Some("cpu")));
    assert_eq!((first["threads"].as_u64(), first["mode"].as_str()), (Some(1), Some("single")));
    assert_eq!(first["hits"].as_u64(), Some(2));
    let hits = fs::read(folder.path().join("out/a.hits")).expect("answers");
    let two = 2.0_f32.to_bits();
    assert_eq!(hits, [3, two, 0, two, 1, 0, u32::MAX].map(u32::to_le_bytes).concat());
    let any =
        snellius(folder.path(), "bench --rays square.obj --ray-file a.rays --any --rounds 6 --backend cpu");
    assert!(any.text().contains("| a.rays | cpu | 1 | coherent |"), "{}", any.text());
}

#[test]
fn rays_are_traced_on_an_adapter_too() {
    if find("llvmpipe").is_none() {
        return;
    }
    let folder = folder();
    fs::write(folder.path().join("square.obj"), SQUARE).expect("a file");
    let down = |x: f32| [x, 2.0, -0.5, 0.0, 0.0, -1.0, 0.0, 9.0];
    fs::write(folder.path().join("a.rays"), rays(&[down(0.5), down(5.0), down(-0.5)])).expect("a file");
    for any in ["", "--any"] {
        let line =
            format!("bench --rays square.obj --ray-file a.rays {any} --adapter llvmpipe --rounds 6 --json");
        let run = snellius(folder.path(), &line);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let json = run.json();
        let last = json["runs"].as_array().and_then(|runs| runs.last()).expect("a run");
        assert!(last["device"].as_str().is_some_and(|name| name.starts_with("llvmpipe")), "{json}");
        assert_eq!(last["threads"].as_u64(), Some(0));
        assert_eq!((last["mode"].as_str(), last["hits"].as_u64()), (Some("single"), Some(2)));
    }
}

#[test]
fn mistakes_are_told_with_code_2() {
    let folder = folder();
    fs::write(folder.path().join("square.obj"), SQUARE).expect("a file");
    fs::write(folder.path().join("short.rays"), [9, 0, 0, 0, 1]).expect("a file");
    fs::write(folder.path().join("late.rays"), rays(&[[0.0, 1.0, 0.0, 0.5, 0.0, -1.0, 0.0, 9.0]]))
        .expect("a file");
    for (line, message) in [
        ("bench", "no folder scenes"),
        ("bench --fail-above 5%", "--baseline"),
        ("bench a.toml --baseline absent.json", "cannot read the baseline absent.json"),
        ("bench a.toml --baseline square.obj --fail-above 5", "expected a percentage"),
        ("bench --scale a.toml", "cannot be used with"),
        ("bench --scale --axes colours", "triangles, depth, lights"),
        ("bench --effects --svg a.svg", "cannot be used with"),
        ("bench --rays scene.toml", "is not an .obj file"),
        ("bench --rays absent.obj", "absent.obj"),
        ("bench --rays square.obj --effects", "cannot be used with"),
        ("bench --rays square.obj --fov 180", "between 0 and 180"),
        ("bench --rays square.obj --eye 1,2", "expected X,Y,Z"),
        ("bench --rays square.obj --ray-file short.rays", "holds 5 bytes"),
        ("bench --rays square.obj --ray-file late.rays", "begins at tmin = 0.5"),
        ("bench --rays square.obj --ray-file absent.rays", "cannot read absent.rays"),
        ("bench --rays square.obj --any", "--ray-file"),
    ] {
        let run = snellius(folder.path(), line);
        assert_eq!(run.code, 2, "{line}: {}", run.stderr);
        assert!(run.stderr.contains(message), "{line}: {}", run.stderr);
    }
}

#[test]
fn a_scene_is_measured_on_the_cpu_by_parts_and_drawn() {
    let folder = box_folder();
    let run = on_cpu(folder.path(), "--size 16x12 --json --svg box.svg");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let json = run.json();
    let row = &json["scenes"][0];
    assert_eq!((row["scene"].as_str(), row["size"][1].as_u64()), (Some("box.toml"), Some(12)));
    assert_eq!((row["rounds"].as_u64(), row["triangles"].as_u64()), (Some(6), Some(12)));
    assert_eq!(row["rays"]["primary"].as_u64(), Some(16 * 12));
    let all = row["devices"].as_array().expect("devices").last().expect("one at least");
    assert_eq!(
        (all["device"].as_str(), all["ratio"]["median"].as_f64()),
        (Some("CPU, all threads"), Some(1.0))
    );
    let phases = all["phases_ms"].as_object().expect("phases");
    let sum: f64 = phases.values().filter_map(Value::as_f64).sum();
    let whole = all["picture_ms"].as_f64().expect("a time");
    assert!((sum - whole).abs() < 1e-6 && whole > 0.0, "{sum} {whole}");
    assert!(json["machine"]["instructions"].as_str().is_some_and(|name| name != "none"));
    let svg = fs::read_to_string(folder.path().join("box.svg")).expect("a drawing");
    assert!(svg.contains("box.toml") && svg.contains("CPU, all threads"));
    let text = on_cpu(folder.path(), "--size 16x12").text();
    assert!(
        text.contains("| `box.toml` | CPU, all threads |") && text.contains("| scene | device | load |"),
        "{text}"
    );
}

/// The report with each trace time multiplied.
fn slowed(mut json: Value, factor: f64) -> String {
    for side in json["scenes"][0]["devices"].as_array_mut().expect("devices") {
        for end in ["median", "low", "high"] {
            let time = &mut side["trace_ms"][end];
            *time = (time.as_f64().expect("a time") * factor).into();
        }
    }
    json.to_string()
}

#[test]
fn a_trace_that_takes_longer_than_before_fails() {
    let folder = box_folder();
    let before = on_cpu(folder.path(), "--size 16x12 --json").json();
    for (factor, code) in [(1e-3, 1), (1e3, 0)] {
        fs::write(folder.path().join("before.json"), slowed(before.clone(), factor)).expect("a file");
        // The size is that of the baseline.
        let run = on_cpu(folder.path(), "--baseline before.json --fail-above 5% --json");
        assert_eq!(run.code, code, "{factor}: {}", run.stderr);
        let verdict = if code == 1 { "grown" } else { "kept" };
        assert_eq!(run.json()["changes"][0]["verdict"].as_str(), Some(verdict));
        assert_eq!(run.stderr.contains("takes longer than allowed"), code == 1, "{}", run.stderr);
    }
    // A comparison that compares nothing does not pass.
    let run = on_cpu(folder.path(), "--size 8x6 --baseline before.json --fail-above 5%");
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("nothing was compared") && run.text().contains("not in the baseline"));
}

#[test]
fn an_adapter_that_traces_another_picture_has_no_row() {
    if find("llvmpipe").is_none() {
        return;
    }
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let line = "bench goblet.toml --adapter llvmpipe --size 160x120 --rounds 6 --json --float";
    let strict = snellius(&scenes, &format!("{line} strict"));
    assert_eq!(strict.code, 0, "{}", strict.stderr);
    let has_adapter = |run: &Run| {
        let json = run.json();
        let devices = json["scenes"][0]["devices"].as_array().cloned().expect("devices");
        devices.iter().any(|side| side["software"].as_bool() == Some(true))
    };
    assert!(has_adapter(&strict));
    let fast = snellius(&scenes, &format!("{line} fast"));
    assert_eq!((fast.code, has_adapter(&fast)), (1, false));
    assert!(fast.stderr.contains("traces another picture than the CPU"), "{}", fast.stderr);
}

#[test]
fn growth_is_told_as_slopes() {
    let folder = folder();
    let run =
        snellius(folder.path(), "bench --scale --axes depth,lights --up-to 4 --rounds 6 --json --svg s.svg");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let json = run.json();
    let axes = json["axes"].as_array().expect("axes");
    assert_eq!(
        axes.iter().map(|axis| axis["axis"].as_str()).collect::<Vec<_>>(),
        [Some("depth"), Some("lights")]
    );
    assert!(axes[0]["slope"]["median"].as_f64() > Some(0.1), "{json}");
    assert_eq!(axes[0]["points"][2]["rays"].as_u64(), Some(160 * 120 * 4));
    let svg = fs::read_to_string(folder.path().join("s.svg")).expect("a drawing");
    assert!(svg.contains("slope") && svg.contains("lamps"));
}
