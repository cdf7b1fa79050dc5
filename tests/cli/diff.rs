//! `snellius diff`.

use std::fs;
use std::path::Path;

use snellius::film::{Channel, Metadata, Picture, encode_exr};

use super::{files_in, folder, snellius};

/// Write a 2×2 EXR whose last pixel has this red.
fn write_rgb(path: &Path, red: f32) {
    let pixels = [[0.5, 0.25, 0.0], [0.5, 0.25, 0.0], [0.5, 0.25, 0.0], [red, 0.25, 0.0]];
    write(path, &Picture::from_rgb(2, 2, &pixels));
}

fn write(path: &Path, picture: &Picture) {
    fs::write(path, encode_exr(picture, &Metadata::new()).expect("an EXR")).expect("a file");
}

#[test]
fn equal_pictures_pass_with_exactly_the_contract_s_fields() {
    let folder = folder();
    write_rgb(&folder.path().join("a.exr"), 0.5);
    let run = snellius(
        folder.path(),
        "diff a.exr a.exr --json --fail-above differing_pixels=0 --fail-above flip=0",
    );
    assert_eq!(run.code, 0, "{}", run.stderr);
    let expected = serde_json::json!({
        "rmse": 0.0, "max": 0.0, "psnr": null, "flip": 0.0, "differing_pixels": 0, "pixels": 4
    });
    assert_eq!(run.json(), expected);
    assert_eq!(run.stderr, "");
}

#[test]
fn one_bit_fails_the_comparison_and_the_metric_is_named() {
    let folder = folder();
    write_rgb(&folder.path().join("a.exr"), 0.5);
    write_rgb(&folder.path().join("b.exr"), 0.5_f32.next_up());
    let run =
        snellius(folder.path(), "diff a.exr b.exr --fail-above differing_pixels=0 --fail-above rmse=0.1");
    assert_eq!(run.code, 1);
    assert!(run.text().contains("differing pixels  1 of 4"), "{}", run.text());
    assert_eq!(run.stderr, "differing_pixels is 1, above 0\n");
}

#[test]
fn a_nan_fails_every_threshold() {
    let folder = folder();
    write_rgb(&folder.path().join("a.exr"), 0.5);
    write_rgb(&folder.path().join("b.exr"), f32::NAN);
    for metric in ["rmse", "max", "flip"] {
        let run = snellius(folder.path(), &format!("diff a.exr b.exr --fail-above {metric}=1e9"));
        assert_eq!(run.code, 1, "{metric}");
    }
}

#[test]
fn ids_and_hashes_are_compared_bit_by_bit() {
    let folder = folder();
    for (name, id) in [("a.exr", u32::MAX), ("b.exr", u32::MAX - 1)] {
        let plane = Channel::u32("body-hash", [7, id].into_iter());
        write(&folder.path().join(name), &Picture::new(2, 1, vec![plane]));
    }
    let json = snellius(folder.path(), "diff a.exr b.exr --json").json();
    assert_eq!((&json["differing_pixels"], &json["flip"]), (&1.into(), &serde_json::Value::Null));
}

#[test]
fn pictures_that_cannot_be_compared_are_usage_errors() {
    let folder = folder();
    write_rgb(&folder.path().join("a.exr"), 0.5);
    write(&folder.path().join("wide.exr"), &Picture::from_rgb(3, 1, &[[0.0; 3]; 3]));
    fs::write(folder.path().join("broken.png"), b"\x89PNG\r\n\x1a\nnothing").expect("a file");
    for (line, message) in [
        ("diff a.exr wide.exr", "the pictures differ in size: 2×2 and 3×1"),
        ("diff a.exr nowhere.exr", "cannot read the picture nowhere.exr"),
        ("diff a.exr broken.png", "cannot read the picture broken.png"),
        (
            "diff a.exr a.exr --fail-above ssim=1",
            "a limit is set on one of rmse, max, flip, differing_pixels",
        ),
        ("diff a.exr a.exr -o d.exr", "the picture of the differences is a PNG"),
        ("diff a.exr a.exr -o - --json", "both want standard output"),
    ] {
        let run = snellius(folder.path(), line);
        assert_eq!(run.code, 2, "{line}: {}", run.stderr);
        assert!(run.stderr.contains(message), "{line}: {}", run.stderr);
    }
    assert_eq!(files_in(folder.path()), ["a.exr", "broken.png", "wide.exr"]);
}

#[test]
fn the_picture_of_the_differences_is_written_even_when_the_comparison_fails() {
    let folder = folder();
    write_rgb(&folder.path().join("a.exr"), 0.5);
    write_rgb(&folder.path().join("b.exr"), 0.75);
    let run = snellius(folder.path(), "diff a.exr b.exr -o d.png --fail-above max=0.1");
    assert_eq!(run.code, 1);
    let picture = snellius::film::load(&folder.path().join("d.png")).expect("a PNG");
    let [_, green, _] = picture.rgb().expect("colours");
    assert_eq!(green.samples.value(0), 0.0);
    assert!(green.samples.value(3) > 0.0);
}
