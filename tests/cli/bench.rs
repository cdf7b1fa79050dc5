//! `snellius bench --rays`: files, figures, mistakes.

use std::fs;

use super::{folder, snellius};

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
    let line = "bench --rays square.obj --ray-file a.rays --rounds 6 --json --dump out";
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
    let any = snellius(folder.path(), "bench --rays square.obj --ray-file a.rays --any --rounds 6");
    assert!(any.text().contains("| a.rays | cpu | 1 | coherent |"), "{}", any.text());
}

#[test]
fn mistakes_are_told_with_code_2() {
    let folder = folder();
    fs::write(folder.path().join("square.obj"), SQUARE).expect("a file");
    fs::write(folder.path().join("short.rays"), [9, 0, 0, 0, 1]).expect("a file");
    fs::write(folder.path().join("late.rays"), rays(&[[0.0, 1.0, 0.0, 0.5, 0.0, -1.0, 0.0, 9.0]]))
        .expect("a file");
    for (line, message) in [
        ("bench", "--effects"),
        ("bench --rays scene.toml", "is not an .obj file"),
        ("bench --rays absent.obj", "absent.obj"),
        ("bench --rays square.obj --effects", "cannot be used with"),
        ("bench --rays square.obj --backend gpu", "cannot be used with"),
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
