//! `snellius render` and `snellius check` on a small scene.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use super::{command, files_in, folder, snellius};

/// A glass ball on a floor.
const SCENE: &str = r##"
[camera]
eye = [0, 1, 4]
target = [0, 0.5, 0]
fov_y = 40
[render]
size = [24, 16]
samples = 2
[background]
zenith = "#4080ff"
horizon = "#ffffff"
[[light]]
position = [3, 5, 3]
color = "#ffffff"
[material.glass]
specular = { color = "#ffffff", k = 0.5, shininess = 100 }
reflection = 1.0
transmission = 1.0
fresnel = true
ior = 1.5
absorption = [0.2, 0.1, 0.0]
[material.floor]
diffuse = { color = "#c08040", k = 0.8 }
[[model]]
shape = { sphere = { radius = 0.8, level = 2 } }
material = "glass"
translate = [0, 0.9, 0]
[[model]]
shape = { box = { size = [6, 0.2, 6] } }
material = "floor"
translate = [0, -0.1, 0]
"##;

/// A folder with the scene in it.
fn scene_folder() -> tempfile::TempDir {
    let folder = folder();
    fs::write(folder.path().join("ball.toml"), SCENE).expect("a file");
    folder
}

fn png_texts(path: &Path) -> Vec<(String, String)> {
    let file = BufReader::new(fs::File::open(path).expect("a file"));
    let reader = png::Decoder::new(file).read_info().expect("a PNG");
    let texts = reader.info().utf8_text.iter();
    texts.map(|text| (text.keyword.clone(), text.get_text().expect("a text"))).collect()
}

#[test]
fn a_render_writes_its_picture_and_nothing_else() {
    let folder = scene_folder();
    let run = snellius(folder.path(), "render ball.toml -o ball.png --backend cpu");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(files_in(folder.path()), ["ball.png", "ball.toml"]);
    assert!(run.stdout.is_empty());
    let texts = png_texts(&folder.path().join("ball.png"));
    let text = |key: &str| &texts.iter().find(|(keyword, _)| keyword == key).expect(key).1;
    assert_eq!(text("scene"), "ball.toml");
    assert_eq!(text("settings"), "24x16, depth 16, cutoff 0.0001, samples 2, f32, strict, watertight");
    assert!(text("effects").contains("fresnel"));
    assert_eq!(text("complete"), "yes");
    assert!(text("seconds").parse::<f64>().expect("a number") >= 0.0);
}

#[test]
fn the_report_tells_settings_device_rays_and_times() {
    let folder = scene_folder();
    let run =
        snellius(folder.path(), "render ball.toml --json --backend cpu --threads 1 --depth 3 --size 8x4 -q");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let json = run.json();
    assert_eq!((&json["backend"], &json["driver"]), (&"cpu".into(), &"rayon, 1 threads".into()));
    assert_eq!((&json["size"], &json["depth"]), (&serde_json::json!([8, 4]), &3.into()));
    assert_eq!(json["rays"]["primary"], 8 * 4 * 2);
    assert!(json["times_ms"]["total"].as_f64() >= json["times_ms"]["trace"].as_f64());
    assert!(json["max_radiance"].as_f64() > Some(0.0));
    assert_eq!(run.stderr, "");
}

#[test]
fn a_dash_is_standard_output_as_png() {
    let folder = scene_folder();
    let run = snellius(folder.path(), "render ball.toml -o - --backend cpu");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.starts_with(b"\x89PNG"));
    assert_eq!(files_in(folder.path()), ["ball.toml"]);
}

#[test]
fn a_crop_is_the_same_part_of_the_whole_picture() {
    let folder = scene_folder();
    for line in ["-o whole.exr", "-o part.exr --crop 5,3,7,9"] {
        let run = snellius(folder.path(), &format!("render ball.toml --backend cpu {line}"));
        assert_eq!(run.code, 0, "{}", run.stderr);
    }
    let load = |name| snellius::film::load(&folder.path().join(name)).expect("a picture");
    let (whole, part) = (load("whole.exr"), load("part.exr"));
    assert_eq!((part.width, part.height), (7, 9));
    for (whole, part) in whole.channels.iter().zip(&part.channels) {
        for (x, y) in (0..9).flat_map(|y| (0..7).map(move |x| (x, y))) {
            assert_eq!(part.samples.bits(y * 7 + x), whole.samples.bits((y + 3) * 24 + x + 5), "{x}, {y}");
        }
    }
}

#[test]
fn a_turntable_begins_with_the_picture_and_goes_round() {
    let folder = scene_folder();
    let turned = snellius(folder.path(), "render ball.toml -o turn.png --turntable 4 --backend cpu");
    assert_eq!(turned.code, 0, "{}", turned.stderr);
    assert_eq!(snellius(folder.path(), "render ball.toml -o one.png --backend cpu").code, 0);
    let pixels = |name: &str| image::open(folder.path().join(name)).expect("a picture").to_rgb8().into_raw();
    assert_eq!(pixels("turn-000.png"), pixels("one.png"));
    assert_ne!(pixels("turn-001.png"), pixels("one.png"));
    assert_eq!(
        files_in(folder.path()),
        ["ball.toml", "one.png", "turn-000.png", "turn-001.png", "turn-002.png", "turn-003.png"]
    );
    assert_eq!(snellius(folder.path(), "render ball.toml -o - --turntable 4").code, 2);
}

#[test]
fn the_number_of_threads_never_shows() {
    let folder = scene_folder();
    for threads in [1, 3] {
        let line = format!(
            "render ball.toml --backend cpu --threads {threads} -o {threads}.exr --aov body-hash={threads}h.exr"
        );
        assert_eq!(snellius(folder.path(), &line).code, 0);
    }
    for pair in ["1.exr 3.exr", "1h.exr 3h.exr"] {
        let run = snellius(folder.path(), &format!("diff {pair} --fail-above differing_pixels=0"));
        assert_eq!(run.code, 0, "{pair}: {}", run.text());
    }
}

#[test]
fn every_aov_has_an_exact_file_and_a_preview() {
    let folder = scene_folder();
    let names = snellius::film::AovKind::ALL.map(|kind| kind.name());
    let flags: String =
        names.iter().map(|name| format!(" --aov {name}={name}.exr --aov {name}={name}.png")).collect();
    let run = snellius(folder.path(), &format!("render ball.toml --backend cpu{flags}"));
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(files_in(folder.path()).len(), 1 + 2 * names.len());
    let body = snellius::film::load(&folder.path().join("body.exr")).expect("an EXR");
    let plane = body.channel("body").expect("its plane");
    assert_eq!(plane.samples.type_name(), "u32");
    assert!(run.stderr.contains("depth.png: depth: "), "{}", run.stderr);
}

#[test]
fn a_broken_scene_is_told_with_its_place_and_leaves_no_picture() {
    let folder = scene_folder();
    fs::write(folder.path().join("ball.toml"), SCENE.replace("ior = 1.5", "ior = -1.5")).expect("a file");
    for line in ["render ball.toml -o ball.png", "check ball.toml", "render ball.toml --json"] {
        let run = snellius(folder.path(), line);
        assert_eq!(run.code, 2, "{line}");
        assert!(run.stderr.contains("ball.toml:20:"), "{line}: {}", run.stderr);
        assert!(run.stdout.is_empty(), "{line}");
    }
    assert_eq!(files_in(folder.path()), ["ball.toml"]);
}

#[test]
fn an_adapter_that_is_not_there_is_code_3() {
    let folder = scene_folder();
    let run = snellius(folder.path(), "render ball.toml -o ball.png --adapter nonesuch");
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert_eq!(files_in(folder.path()), ["ball.toml"]);
}

#[test]
fn check_lists_bodies_media_buffers_and_effects_with_reasons() {
    let folder = scene_folder();
    let json = snellius(folder.path(), "check ball.toml --json").json();
    assert_eq!(json["bodies"].as_array().map(Vec::len), Some(2));
    assert_eq!(json["media"][0]["ior"], 1.5);
    let text = snellius(folder.path(), "check ball.toml").text();
    for part in
        ["glass", "ior 1.5", "bytes", "nodes, depth", "absorption       on: ", "textures         off: "]
    {
        assert!(text.contains(part), "{part} in\n{text}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_finished() {
    let folder = scene_folder();
    let line = "render ball.toml -o ball.png --backend cpu --size 1024x1024 --samples 256 --progress plain";
    let mut child = command(folder.path(), line).stderr(Stdio::piped()).spawn().expect("the program starts");
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    assert!(lines.any(|line| line.is_ok_and(|line| line.contains("traced"))));
    let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(interrupt.success());
    lines.for_each(drop);
    assert_eq!(child.wait().expect("an end").code(), Some(130));
    let texts = png_texts(&folder.path().join("ball.png"));
    assert!(texts.iter().any(|(key, value)| key == "complete" && value.starts_with("no")), "{texts:?}");
}
