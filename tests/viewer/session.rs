//! Whole sessions.

use std::fs;

use super::*;

/// Seconds that tests leave for the window to idle in.
const IDLE_MS: u32 = 3000;

/// A ball of glass over a floor: quick to read, and to trace.
const BALL: &str = r##"
[camera]
eye = [0, 1, 4]
target = [0, 0.5, 0]

[render]
samples = 2
depth = 6

[background]
zenith = "#3060a0"
horizon = "#e0e8f0"

[[light]]
position = [3, 5, 3]
color = "#ffffff"

[[model]]
shape = { sphere = { radius = 0.5 } }
translate = [0, 0.5, 0]
material = "glass"

[[model]]
shape = { plane = { size = [6, 6] } }
material = "floor"

[material.glass]
reflection = 0.1
transmission = 0.9
ior = 1.5

[material.floor]
diffuse = { color = "#a08060" }
"##;

/// A screenshot of 320 by 180 pixels of the scene, without the panel, whose figures change.
fn without_panel(file: &Path) -> image::RgbImage {
    image::imageops::crop_imm(&pixels(file), 0, 0, 320, 180).to_image()
}

#[test]
fn the_window_shows_the_picture_that_render_writes() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("whitted.toml");
    let flags = ["--size", "200x150", "--samples", "3", "--depth", "6"];
    let rendered = run(Command::new(env!("CARGO_BIN_EXE_snellius"))
        .current_dir(&folder)
        .args(["render", scene.to_str().unwrap(), "-o", "render.png", "--backend", "cpu"])
        .args(flags));
    assert_eq!(rendered.code, Some(0), "{rendered:?}");
    let picture = pixels(&folder.path().join("render.png"));
    for backend in ["gpu", "cpu"] {
        let file = format!("{backend}.png");
        let mut words = vec!["view", scene.to_str().unwrap(), "--backend", backend];
        words.extend(flags);
        words.extend(["--screenshot", &file, "--frames", "3"]);
        let shown = snellius(&display, folder.path(), &words);
        assert_eq!(shown.code, Some(0), "{shown:?}");
        assert_eq!(differing(&pixels(&folder.path().join(file)), &picture), 0, "{backend}");
    }
}

#[test]
fn without_a_display_the_way_out_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let run = run(Command::new(env!("CARGO_BIN_EXE_snellius"))
        .current_dir(&folder)
        .args(["view", scene("prism.toml").to_str().unwrap(), "--backend", "cpu"])
        .env_remove("DISPLAY"));
    assert_eq!(run.code, Some(3), "{run:?}");
    assert!(
        run.stderr.contains("no window can be opened") && run.stderr.contains("snellius render"),
        "{run:?}"
    );
    assert!(!run.stderr.contains("panicked"), "{run:?}");
}

#[test]
fn without_a_driver_the_way_out_is_told() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    let run = run(Command::new(env!("CARGO_BIN_EXE_snellius"))
        .current_dir(&folder)
        .args([scene("prism.toml").to_str().unwrap()])
        .env("DISPLAY", display.name())
        .env("VK_DRIVER_FILES", "/nonexistent"));
    assert_eq!(run.code, Some(3), "{run:?}");
    assert!(run.stderr.contains("Vulkan driver"), "{run:?}");
}

#[test]
fn a_hand_orbits_resizes_drops_breaks_and_repairs_and_all_is_answered() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("ball.toml", BALL);
    write("good.toml", BALL);
    write("broken.toml", &BALL.replace("ior = 1.5", "ior = 'heavy'"));
    write("other.toml", &BALL.replace("radius = 0.5", "radius = 0.3"));
    write(
        "script.txt",
        &format!(
            "orbit 150 40 12
             wheel 3 3
             pan -40 20 3
             resize 320 180
             key Home
             wait rest
             screenshot first.png
             orbit 40 10 4
             wait rest
             screenshot orbited.png
             key Home
             wait rest
             screenshot home.png
             resize 480 270
             wait rest
             expect size 480 270
             minimise
             wait 200
             restore
             resize 320 180
             wait rest
             copy broken.toml ball.toml
             expect toast ball.toml:
             screenshot broken.png
             copy good.toml ball.toml
             expect toast read again
             drop other.toml
             expect toast opened
             wait rest
             screenshot other.png
             drop ball.toml
             wait 500
             wait rest
             backend cpu
             wait rest
             expect backend cpu
             key Escape
             screenshot cpu.png
             backend gpu
             wait rest
             view normal rays
             wait rest
             screenshot views.png
             view beauty
             wait rest
             lose
             expect toast opened again
             wait rest
             key Escape
             screenshot recovered.png
             expect idle 1 {IDLE_MS}
             quit"
        ),
    );
    let words = ["view", "ball.toml", "--backend", "gpu", "--size", "960x540", "--script", "script.txt"];
    let run = snellius(&display, folder.path(), &words);
    assert_eq!(run.code, Some(0), "{run:?}");
    let shot = |name: &str| without_panel(&folder.path().join(name));
    let first = shot("first.png");
    for same in ["home.png", "cpu.png", "recovered.png"] {
        assert!(shot(same) == first, "{same} differs from first.png");
    }
    for other in ["orbited.png", "other.png", "views.png"] {
        assert_ne!(shot(other), first, "{other}");
    }
    let timings: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
    assert!(timings["answers"].as_u64().unwrap() >= 18, "{timings}");
    // A device that is opened compiles its kernel for over a second, and now and then wgpu lets a frame wait for that.
    let mut frames: Vec<f64> =
        timings["each_frame"].as_array().unwrap().iter().map(|frame| frame["ms"].as_f64().unwrap()).collect();
    frames.sort_by(f64::total_cmp);
    let [.., second, slowest] = frames[..] else { panic!("{timings}") };
    assert!(second < 1000.0 && slowest < 5000.0, "{timings}");
    let times = |name: &str| timings[name].as_array().unwrap().len() as u64;
    assert_eq!(timings["answers"].as_u64(), Some(times("each_answer")), "{timings}");
    assert_eq!(timings["frames"].as_u64(), Some(times("each_frame")), "{timings}");
}

#[test]
fn a_clicked_pixel_shows_its_rays_and_they_stay_in_the_scene() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    let script = "wait rest
screenshot first.png
orbit 40 10 4
wait rest
screenshot orbited.png
key Home
wait rest
click 160 90
expect tree air → glass
expect tree refraction
wait 200
screenshot clicked.png
orbit 40 10 4
wait rest
screenshot kept.png
quit
";
    fs::write(folder.path().join("script.txt"), script).unwrap();
    let words = ["view", "ball.toml", "--backend", "gpu", "--size", "320x180", "--script", "script.txt"];
    let run = snellius(&display, folder.path(), &words);
    assert_eq!(run.code, Some(0), "{run:?}");
    for pair in [["clicked.png", "first.png"], ["kept.png", "orbited.png"]] {
        let [with, without] = pair.map(|name| without_panel(&folder.path().join(name)));
        let drawn = with.pixels().zip(without.pixels()).filter(|(a, b)| a != b).count();
        assert!((100..320 * 180 / 4).contains(&drawn), "{drawn} pixels of rays");
    }
}

#[test]
fn a_turntable_of_the_window_is_that_of_render() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    let script = "wait rest\nturntable 3\nexpect toast 3 pictures are in ball-turn-001\n";
    fs::write(folder.path().join("script.txt"), script).unwrap();
    let words = ["view", "ball.toml", "--backend", "gpu", "--size", "64x48", "--script", "script.txt"];
    let shown = snellius(&display, folder.path(), &words);
    assert_eq!(shown.code, Some(0), "{shown:?}");
    let words =
        ["render", "ball.toml", "-o", "ball.png", "--turntable", "3", "--backend", "cpu", "--size", "64x48"];
    let rendered = snellius(&display, folder.path(), &words);
    assert_eq!(rendered.code, Some(0), "{rendered:?}");
    let turn = folder.path().join("ball-turn-001");
    for name in ["ball-000.png", "ball-001.png", "ball-002.png"] {
        assert!(pixels(&turn.join(name)) == pixels(&folder.path().join(name)), "{name}");
    }
    assert!(pixels(&turn.join("ball-000.png")) != pixels(&turn.join("ball-001.png")));
    assert_eq!(fs::read_dir(turn).unwrap().count(), 3);
}

#[test]
fn changed_shaders_are_compiled_and_broken_ones_told_with_their_line() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    let shaders = folder.path().join("shaders");
    fs::create_dir(&shaders).unwrap();
    for (stem, text) in snellius::gpu::SOURCES {
        fs::write(shaders.join(stem).with_extension("wgsl"), text).unwrap();
    }
    let (_, sky) = snellius::gpu::SOURCES.iter().find(|(stem, _)| *stem == "background").unwrap();
    let changed = |from: &str, to: &str| {
        assert!(sky.contains(from));
        sky.replace(from, to)
    };
    fs::write(folder.path().join("broken.wgsl"), changed("least(greatest(direction.y", "least(greatest(up"))
        .unwrap();
    fs::write(folder.path().join("dark.wgsl"), changed("return horizon +", "return 0.25 * horizon +"))
        .unwrap();
    fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    let script = "wait rest
                  key Escape
                  screenshot first.png
                  copy broken.wgsl shaders/background.wgsl
                  expect toast shaders/background.wgsl:18:
                  wait rest
                  key Escape
                  screenshot kept.png
                  copy dark.wgsl shaders/background.wgsl
                  expect toast the shaders are compiled
                  wait rest
                  key Escape
                  screenshot dark.png";
    fs::write(folder.path().join("script.txt"), script).unwrap();
    let words = [
        "view",
        "ball.toml",
        "--backend",
        "gpu",
        "--size",
        "64x48",
        "--shaders",
        "shaders",
        "--script",
        "script.txt",
    ];
    let shown = snellius(&display, folder.path(), &words);
    assert_eq!(shown.code, Some(0), "{shown:?}");
    let top = |name: &str| pixels(&folder.path().join(name)).get_pixel(32, 2).0;
    assert_eq!(top("kept.png"), top("first.png"));
    assert!(top("dark.png")[0] + 20 < top("first.png")[0], "{:?} {:?}", top("dark.png"), top("first.png"));
}

#[test]
fn keys_write_the_picture_and_the_scene_and_the_difference_is_black() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    let script = "wait rest
                  orbit 30 10 2
                  wait rest
                  key F12
                  expect toast the picture is in ball-001.png
                  key ctrl+S
                  expect toast the scene with this camera is in ball-001.toml
                  view difference
                  wait rest
                  screenshot difference.png";
    fs::write(folder.path().join("script.txt"), script).unwrap();
    let words = ["view", "ball.toml", "--backend", "gpu", "--size", "320x240", "--script", "script.txt"];
    let run = snellius(&display, folder.path(), &words);
    assert_eq!(run.code, Some(0), "{run:?}");
    // The scene that was written shows the picture that was written, but for what f32 makes of seven digits.
    let shown = snellius(
        &display,
        folder.path(),
        &["render", "ball-001.toml", "--backend", "cpu", "--size", "320x240", "-o", "again.png"],
    );
    assert_eq!(shown.code, Some(0), "{shown:?}");
    let (saved, again) =
        (pixels(&folder.path().join("ball-001.png")), pixels(&folder.path().join("again.png")));
    let far = saved.pixels().zip(again.pixels()).filter(|(a, b)| (0..3).any(|c| a[c].abs_diff(b[c]) > 2));
    assert!(far.count() < 800, "the camera was not kept");
    // Between the messages above and the legend below.
    let difference = pixels(&folder.path().join("difference.png"));
    let seen = (0..320).filter(|&x| difference.get_pixel(x, 150) != &image::Rgb([0, 0, 0])).count();
    assert_eq!(seen, 0, "lavapipe's bits are the CPU's");
}

#[test]
fn a_script_that_is_not_met_fails_with_its_line() {
    let Some(display) = Display::open() else { return };
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("ball.toml"), BALL).unwrap();
    fs::write(folder.path().join("script.txt"), "wait rest\nexpect size 10 10\n").unwrap();
    let words = ["view", "ball.toml", "--backend", "cpu", "--size", "64x48", "--script", "script.txt"];
    let run = snellius(&display, folder.path(), &words);
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stderr.contains("script.txt:2: the picture has [64, 48] pixels"), "{run:?}");
    fs::write(folder.path().join("script.txt"), "wait rest\nexpect tree glass\n").unwrap();
    let run = snellius(&display, folder.path(), &words);
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stderr.contains("script.txt:2: no line of the pixel's tree holds `glass`"), "{run:?}");
    fs::write(folder.path().join("script.txt"), "wait rest\nexpect much\n").unwrap();
    let run = snellius(&display, folder.path(), &words);
    assert!(run.code == Some(2) && run.stderr.contains("script.txt:2: `expect much` is no event"), "{run:?}");
}
