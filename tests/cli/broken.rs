//! Broken scenes, meshes and pictures: each gives its message at its place, exit code 2, and no output file.

use std::fs;

use super::{files_in, folder, snellius};

/// A whole scene, as the cases below break it.
const SCENE: &str = r##"[camera]
eye = [0, 1, 5]
target = [0, 0, 0]
[material.red]
diffuse = { color = "#c03020", k = 1.0 }
[material.glass]
transmission = 1.0
ior = 1.5
[[light]]
position = [3, 5, 4]
[[model]]
mesh = "mesh.obj"
material = "red"
"##;

const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// What is broken, and what the message must say.
struct Case {
    name: &'static str,
    /// A text of the scene, and what stands there instead.
    scene: (&'static str, &'static str),
    /// The mesh file.
    mesh: &'static str,
    /// Further files.
    files: &'static [(&'static str, &'static str)],
    /// Where: `file:line:column`.
    place: &'static str,
    /// Parts of the message and its hint.
    says: &'static [&'static str],
}

const WHOLE: Case = Case { name: "whole", scene: ("", ""), mesh: MESH, files: &[], place: "", says: &[] };

const fn scene(
    name: &'static str,
    find: &'static str,
    put: &'static str,
    place: &'static str,
    says: &'static [&'static str],
) -> Case {
    Case { name, scene: (find, put), place, says, ..WHOLE }
}

const fn mesh(
    name: &'static str,
    mesh: &'static str,
    place: &'static str,
    says: &'static [&'static str],
) -> Case {
    Case { name, mesh, place, says, ..WHOLE }
}

const CASES: &[Case] = &[
    scene("unknown key", "ior = 1.5", "iro = 1.5", "scene.toml:8:1", &["unknown key `iro`", "ior"]),
    scene("no number", "eye = [0, 1, 5]", "eye = [0, nan, 5]", "scene.toml:2:11", &["nan"]),
    scene("infinite", "eye = [0, 1, 5]", "eye = [0, inf, 5]", "scene.toml:2:11", &["inf"]),
    scene("too large for f32", "eye = [0, 1, 5]", "eye = [0, 1e39, 5]", "scene.toml:2:11", &["1e39"]),
    scene("negative index", "ior = 1.5", "ior = -1.5", "scene.toml:8:7", &["ior"]),
    scene("missing mesh", "mesh.obj", "mash.obj", "scene.toml:12:8", &["mash.obj"]),
    scene("unknown material", "= \"red\"", "= \"rad\"", "scene.toml:13:12", &["rad", "red"]),
    scene("no syntax", "ior = 1.5", "ior = ", "scene.toml:8", &[]),
    scene("eye on target", "eye = [0, 1, 5]", "eye = [0, 0, 0]", "scene.toml:", &["target"]),
    scene("unsafe colour", "\"#c03020\"", "[1, 1, 1]", "scene.toml:5:21", &["1.0"]),
    scene("mixed colour", "\"#c03020\"", "[1, 0.5, 0]", "scene.toml:5:", &["colo"]),
    scene("colour of five digits", "#c03020", "#c0302", "scene.toml:5:", &["six hexadecimal digits"]),
    scene(
        "unknown shape",
        "mesh = \"mesh.obj\"",
        "shape = { cone = { radius = 1 } }",
        "scene.toml:12:",
        &["cone"],
    ),
    scene(
        "mesh and shape",
        "mesh =",
        "shape = { sphere = { radius = 1 } }\nmesh =",
        "scene.toml:",
        &["shape"],
    ),
    scene(
        "no copies",
        "mesh =",
        "repeat = { count = [0, 1, 1], step = [1, 1, 1] }\nmesh =",
        "scene.toml:12:",
        &["count"],
    ),
    scene("texture is missing", "k = 1.0", "k = 1.0, texture = \"no.png\"", "scene.toml:5:", &["no.png"]),
    Case {
        files: &[("broken.png", "\u{0}this is no picture")],
        ..scene(
            "broken picture",
            "k = 1.0",
            "k = 1.0, texture = \"broken.png\"",
            "scene.toml:5:",
            &["broken.png"],
        )
    },
    mesh("index out of range", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "mesh.obj:4:7", &["9"]),
    mesh("index 0", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "mesh.obj:4:3", &["0"]),
    mesh("broken number", "v 0 0 0\nv 1 o 0\nv 0 1 0\nf 1 2 3\n", "mesh.obj:2:5", &["o"]),
    mesh("vertex is no number", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", "mesh.obj:2:5", &["nan"]),
    mesh("face of two", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "mesh.obj:4:", &["3"]),
    mesh("empty mesh", "# nothing\n", "mesh.obj", &["no faces"]),
    Case {
        mesh: "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        ..scene("open glass", "= \"red\"", "= \"glass\"", "scene.toml:", &["open"])
    },
    Case {
        mesh: "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
        files: &[("m.mtl", "newmtl a\nKd 1 x 1\n")],
        ..scene("broken MTL", "material = \"red\"\n", "", "m.mtl:2:6", &["x"])
    },
];

#[test]
fn the_scene_that_the_cases_break_is_whole() {
    let (run, files) = render(&WHOLE);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(files.contains(&"out.png".to_owned()));
}

#[test]
fn every_broken_input_is_told_at_its_place_and_leaves_no_file() {
    assert!(CASES.len() >= 20);
    let faults: Vec<_> = CASES.iter().flat_map(faults).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// What a case does not do as it must.
fn faults(case: &Case) -> Vec<String> {
    let (run, files) = render(case);
    let told = |part: &&&str| !run.stderr.contains(**part);
    let mut faults: Vec<_> =
        case.says.iter().filter(told).map(|part| format!("no {part:?} in\n{}", run.stderr)).collect();
    if run.code != 2 {
        faults.push(format!("exit code {}", run.code));
    }
    if !run.stderr.contains(case.place) {
        faults.push(format!("not at {}:\n{}", case.place, run.stderr));
    }
    if files.iter().any(|name| name.contains("out")) {
        faults.push(format!("left {files:?}"));
    }
    faults.into_iter().map(|fault| format!("{}: {fault}", case.name)).collect()
}

/// Write the case's files, and render it; returns the names of the files that are there then.
fn render(case: &Case) -> (super::Run, Vec<String>) {
    let folder = folder();
    let (find, put) = case.scene;
    assert!(SCENE.contains(find), "{}", case.name);
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
    write("scene.toml", &SCENE.replacen(find, put, 1));
    write("mesh.obj", case.mesh);
    case.files.iter().for_each(|(name, text)| write(name, text));
    let run = snellius(folder.path(), "render scene.toml -o out.png --backend cpu --size 8x8");
    (run, files_in(folder.path()))
}
