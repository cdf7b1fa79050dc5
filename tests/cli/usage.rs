//! Help, mistakes and exit codes.

use super::{folder, snellius};

#[test]
fn without_arguments_the_help_is_printed() {
    let run = snellius(folder().path(), "");
    assert_eq!(run.code, 0);
    assert!(run.text().contains("snellius render scenes/ice.toml -o ice.png"), "{}", run.text());
}

#[test]
fn every_command_explains_itself_with_examples() {
    for command in ["render", "check", "devices", "diff"] {
        let run = snellius(folder().path(), &format!("{command} --help"));
        assert_eq!(run.code, 0);
        assert!(run.text().contains("Examples:"), "{command}");
    }
}

#[cfg(feature = "viewer")]
#[test]
fn a_bare_scene_is_opened_with_the_flags_of_view() {
    let folder = folder();
    std::fs::write(folder.path().join("ice.toml"), "").expect("a file");
    let run = snellius(folder.path(), "ice.toml --depth 65");
    assert!(run.code == 2 && run.stderr.contains("from 0 to 64"), "{}", run.stderr);
    let run = snellius(folder.path(), "ice.toml --depth 6");
    assert!(run.code == 2 && run.stderr.contains("the scene has no models"), "{}", run.stderr);
}

#[cfg(not(feature = "viewer"))]
#[test]
fn a_bare_scene_says_how_to_render() {
    let folder = folder();
    std::fs::write(folder.path().join("ice.toml"), "").expect("a file");
    let run = snellius(folder.path(), "ice.toml");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("snellius render ice.toml -o ice.png"), "{}", run.stderr);
}

#[test]
fn mistakes_are_told_on_standard_error_with_code_2() {
    for (line, message) in [
        ("rendr a.toml -o a.png", "did you mean `snellius render`?"),
        ("render a.toml", "--output <PATH>"),
        ("render a.toml -o a.jpg", ".png, .exr or .hdr"),
        ("render a.toml -o nowhere/a.png", "no such folder"),
        ("render a.toml -o a.png --size 0x10", "width and height are from 1 to 16384"),
        ("render a.toml -o a.png --depth 65", "expected a whole number from 0 to 64"),
        ("render a.toml -o a.png --aov color=a.exr", "there are depth, normal, body"),
        ("render a.toml -o a.png --backend cpu --adapter x", "--backend cpu has no adapter"),
        ("render a.toml -o a.png -q -v", "cannot be used with"),
    ] {
        let run = snellius(folder().path(), line);
        assert_eq!(run.code, 2, "{line}: {}", run.stderr);
        assert!(run.stderr.contains(message), "{line}: {}", run.stderr);
        assert!(run.stdout.is_empty(), "{line}");
        assert!(!run.stderr.contains('\u{1b}'), "{line}: colour without a terminal");
    }
}

#[test]
fn devices_lists_the_cpu_at_least() {
    let run = snellius(folder().path(), "devices --json");
    assert_eq!(run.code, 0);
    assert!(run.json()["cpu"]["threads"].as_u64() > Some(0));
    assert!(run.json()["adapters"].is_array());
}
