use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use tempfile::TempDir;

use super::*;
use crate::scene::{Falloff, Light, Pixels, Severity};

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const MINIMAL: &str = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n[material.grey]\n[[model]]\n\
                       shape = { sphere = { radius = 1, level = 0 } }\nmaterial = \"grey\"\n";

/// A directory with files; the first is the scene.
struct Files {
    directory: TempDir,
    first: PathBuf,
}

fn files(contents: &[(&str, &str)]) -> Files {
    let directory = tempfile::tempdir().unwrap();
    for (name, text) in contents {
        fs::write(directory.path().join(name), text).unwrap();
    }
    Files { first: directory.path().join(contents[0].0), directory }
}

fn load(contents: &[(&str, &str)]) -> Scene {
    Scene::load(&files(contents).first).unwrap()
}

/// The first fault: its message without the directory, the file's name, line, column, and the hint.
fn fault(contents: &[(&str, &str)]) -> (String, String, u32, u32, String) {
    let files = files(contents);
    let error = Scene::load(&files.first).unwrap_err();
    let diagnostic = error.diagnostics()[0].clone();
    let directory = format!("{}/", files.directory.path().display());
    let (file, line, column) = diagnostic.location.map_or_else(Default::default, |place| {
        (place.file.file_name().unwrap().to_string_lossy().into_owned(), place.line, place.column)
    });
    (diagnostic.message.replace(&directory, ""), file, line, column, diagnostic.hint.unwrap_or_default())
}

#[test]
fn every_key_reaches_the_scene() {
    let text = r##"
[camera]
eye = [3.0, 1.6, 5.0]
target = [0.0, 0.6, 0.0]
up = [0, 1, 0]
fov_y = 40
[render]
size = [64, 48]
depth = 5
cutoff = 0.01
samples = 9
adaptive = 0.02
[ambient]
color = "#ffffff"
intensity = 0.1
[background]
zenith = [0.0, 0.0, 1.0]
horizon = [1.0, 1.0, 1.0]
intensity = 2.0
[[light]]
position = [4, 6, 3]
color = [1.0, 0.5, 0.25]
intensity = 2.0
falloff = "inverse-square"
[material.b]
ambient = { color = [1.0, 1.0, 1.0], k = 0.5 }
diffuse = { color = [1.0, 0.5, 0.0], k = 0.5, texture = "dot.png" }
specular = { color = [1.0, 1.0, 1.0], k = 0.25, shininess = 200 }
[material.a]
reflection = 1.0
transmission = [1.0, 0.5, 0.25]
fresnel = true
ior = 1.31
absorption = [0.35, 0.08, 0.05]
[[model]]
mesh = "cube.obj"
material = "a"
priority = 2
scale = 2.0
rotate = [0, 90, 0]
translate = [0, 1, 0]
normals = 30
repeat = { count = [3, 1, 2], step = [2, 0, 4] }
[[model]]
mesh = "cube.obj"
material = "b"
normals = "flat"
"##;
    let files = files(&[("a.toml", text), ("cube.obj", CUBE)]);
    image::RgbImage::from_pixel(1, 1, image::Rgb([9, 8, 7]))
        .save(files.directory.path().join("dot.png"))
        .unwrap();
    let scene = Scene::load(&files.first).unwrap();
    assert_eq!((scene.camera.eye, scene.camera.fov_y), (DVec3::new(3.0, 1.6, 5.0), 40.0));
    let expected =
        RenderDefaults { size: [64, 48], depth: 5, cutoff: 0.01, samples: 9, adaptive: Some(0.02) };
    assert_eq!(scene.render, expected);
    assert!((scene.ambient - 0.1).length() < 1e-15);
    assert_eq!(scene.background, Background::Gradient { zenith: 2.0 * DVec3::Z, horizon: DVec3::splat(2.0) });
    let position = DVec3::new(4.0, 6.0, 3.0);
    let intensity = DVec3::new(2.0, 1.0, 0.5);
    assert_eq!(scene.lights, [Light { position, intensity, falloff: Falloff::InverseSquare }]);
    let [b, a] = &scene.materials[..] else { panic!("two materials") };
    assert_eq!((b.name.as_str(), b.ambient, b.diffuse), ("b", DVec3::splat(0.5), DVec3::new(0.5, 0.25, 0.0)));
    assert_eq!((b.specular, b.shininess, b.ior, b.fresnel), (DVec3::splat(0.25), 200.0, 1.5, false));
    assert_eq!(scene.textures[b.texture.unwrap().0].pixels, Pixels::Srgb8(vec![[9, 8, 7]]));
    assert_eq!((a.reflection, a.transmission), (DVec3::ONE, DVec3::new(1.0, 0.5, 0.25)));
    assert_eq!((a.fresnel, a.ior, a.absorption), (true, 1.31, DVec3::new(0.35, 0.08, 0.05)));
    let [first, second] = &scene.models[..] else { panic!("two models") };
    assert_eq!((first.name.as_str(), second.name.as_str()), ("cube", "cube 2"));
    assert!(std::sync::Arc::ptr_eq(&first.mesh, &second.mesh));
    assert_eq!((first.priority, first.normals, second.normals), (2, Normals::Crease(30.0), Normals::Flat));
    assert_eq!(first.repeat, Repeat { count: [3, 1, 2], step: DVec3::new(2.0, 0.0, 4.0) });
    assert_eq!(scene.materials[first.materials[0].0].name, "a");
    let corner = first.world_from_object.transform_point3(DVec3::new(1.0, 1.0, 0.0));
    assert!((corner - DVec3::new(0.0, 3.0, -2.0)).length() < 1e-15, "{corner}");
    assert!(scene.warnings.is_empty());
}

#[test]
fn what_is_left_out_has_its_default() {
    let scene = load(&[("a.toml", MINIMAL)]);
    assert_eq!(scene.render, RenderDefaults::default());
    assert_eq!((scene.ambient, scene.background), (DVec3::ZERO, Background::Color(DVec3::ZERO)));
    assert_eq!((scene.camera.fov_y, scene.lights.len()), (35.0, 0));
    let grey = &scene.materials[0];
    assert_eq!((grey.ambient, grey.diffuse, grey.specular), (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO));
    assert_eq!(
        (grey.reflection, grey.transmission, grey.absorption),
        (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO)
    );
    let model = &scene.models[0];
    assert_eq!((model.priority, model.normals, model.repeat), (0, Normals::File, Repeat::default()));
    assert_eq!(model.world_from_object, glam::DAffine3::IDENTITY);
    assert_eq!(model.location.as_ref().map(|place| place.line), Some(5));
}

#[test]
fn materials_come_from_the_mesh_where_the_model_names_none() {
    let mesh = format!("mtllib a.mtl\nusemtl red\n{CUBE}usemtl glass\nf 1 2 3\n");
    let library = "newmtl glass\nKs 1 1 1\nNi 1.5\nTf 1 1 1\nillum 7\nnewmtl red\nKd 1 0 0\n";
    let scene = load(&[("a.toml", "[[model]]\nmesh = 'a.obj'\n"), ("a.obj", &mesh), ("a.mtl", library)]);
    let names: Vec<_> =
        scene.models[0].materials.iter().map(|id| scene.materials[id.0].name.as_str()).collect();
    assert_eq!(names, ["red", "glass"]);
    assert!(scene.materials[0].fresnel && scene.materials[0].is_transmissive());
}

#[test]
fn a_named_material_stands_for_every_part_of_a_mesh_and_needs_no_library() {
    let mesh = format!("mtllib none.mtl\nusemtl red\n{CUBE}usemtl glass\nf 1 2 3\n");
    let text = "[material.grey]\n[[model]]\nmesh = 'a.obj'\nmaterial = 'grey'";
    let scene = load(&[("a.toml", text), ("a.obj", &mesh)]);
    assert_eq!(scene.models[0].materials, [crate::scene::MaterialId(0); 2]);
}

#[test]
fn a_bare_mesh_is_framed_and_lit() {
    let scene = load(&[("cube.OBJ", CUBE)]);
    assert_eq!(scene.models[0].name, "cube");
    assert_eq!((scene.lights.len(), scene.camera.fov_y), (1, 35.0));
    assert_eq!(scene.materials[0].name, "default");
    assert!(matches!(scene.background, Background::Gradient { .. }));
}

#[test]
fn models_without_a_camera_are_framed() {
    let text = MINIMAL.replace("[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n", "");
    let camera = load(&[("a.toml", &text)]).camera;
    let half_angle = (1.0 / camera.target_distance).asin().to_degrees();
    assert!(half_angle < 17.5 && half_angle > 14.0, "{half_angle}");
    assert!((camera.eye + camera.forward * camera.target_distance).length() < 1e-14);
}

#[test]
fn a_camera_with_a_basis_turns_about_the_models() {
    let text =
        MINIMAL.replace("target = [0, 0, 0]", "right = [1, 0, 0]\nup = [0, 1, 0]\nforward = [0, 0, -1]");
    assert!((load(&[("a.toml", &text)]).camera.target_distance - 5.0).abs() < 1e-15);
}

#[test]
fn shapes_written_alike_share_their_mesh() {
    let model =
        |radius| format!("[[model]]\nshape = {{ sphere = {{ radius = {radius} }} }}\nmaterial = 'a'\n");
    let text = format!("[material.a]\n{}{}{}", model(1), model(2), model(1));
    let models = load(&[("a.toml", &text)]).models;
    assert!(Arc::ptr_eq(&models[0].mesh, &models[2].mesh));
    assert!(models[0].mesh != models[1].mesh);
}

#[test]
fn suspicious_scenes_are_warned_of() {
    let text = MINIMAL
        .replace("[material.grey]", "[material.grey]\nreflection = 0.6\ntransmission = 0.5\n[material.old]");
    let warnings = load(&[("a.toml", &text)]).warnings;
    let told: Vec<_> =
        warnings.iter().map(|w| (w.message.as_str(), w.location.as_ref().unwrap().line)).collect();
    assert_eq!(
        told,
        [("material `grey` sends on more light than it gets", 4), ("no model uses material `old`", 7)]
    );
    assert!(warnings.iter().all(|warning| warning.severity == Severity::Warning));
}

#[test]
fn transparency_without_a_glass_model_is_warned_of() {
    let mesh = format!("mtllib a.mtl\nusemtl a\n{CUBE}");
    let scene = load(&[("a.obj", &mesh), ("a.mtl", "newmtl a\nd 0.5\nillum 2")]);
    let place = scene.warnings[0].location.as_ref().unwrap();
    assert_eq!(
        (scene.warnings[0].message.as_str(), place.line, place.column),
        ("material `a` is shown opaque", 1, 8)
    );
}

#[test]
fn every_fault_is_told_at_once() {
    let text = "[camera]\neye = [0, 0, 0]\n[[model]]\n[[model]]\nmesh = 'none.obj'\n";
    let files = files(&[("a.toml", text)]);
    let error = Scene::load(&files.first).unwrap_err();
    assert_eq!(error.diagnostics().len(), 3);
    assert_eq!(error.to_string().matches("error: ").count(), 3);
}

#[test]
fn broken_scenes_are_located() {
    let model = |keys: &str| format!("[material.ice]\ntransmission = 1.0\n[[model]]\n{keys}\n");
    let sphere = "shape = { sphere = { radius = 1 } }";
    for (text, message, line, column, hint) in [
        ("".into(), "the scene has no models", 1, 1, "[[model]]"),
        ("model = []".into(), "the scene has no models", 1, 1, "[[model]]"),
        (model(""), "the model has neither a mesh nor a shape", 3, 1, "give `mesh"),
        (model(&format!("mesh = 'a.obj'\n{sphere}")), "the model has both a mesh and a shape", 5, 9, ""),
        (model("mesh = 'none.obj'"), "there is no file none.obj", 4, 8, ""),
        (model("mesh = '.'"), ". is not a file", 4, 8, ""),
        (model("mesh = 3"), "invalid type: integer `3`, expected a string", 4, 8, ""),
        (model(sphere), "the shape has no material", 4, 9, "`material`"),
        (
            model(&format!("{sphere}\nmaterial = 'ide'")),
            "there is no material `ide`",
            5,
            12,
            "did you mean `ice`?",
        ),
        (model("mesh = 'a.obj'"), "a.obj has faces without a material", 4, 8, "`material`"),
        (
            model("shape = { plane = { size = [1, 1] } }\nmaterial = 'ice'"),
            "a plane bounds no matter, so its material cannot transmit light",
            5,
            12,
            "thin box",
        ),
        (
            model("shape = { torus = { major = 1, minor = 2 } }\nmaterial = 'ice'"),
            "the torus runs into itself: minor 2 is not below major 1",
            4,
            9,
            "middle of the tube",
        ),
        (
            model("shape = { sphere = { radius = 1, level = 10 } }\nmaterial = 'ice'"),
            "10 is out of range: expected a whole number from 0 to 9",
            4,
            42,
            "",
        ),
        (model(&format!("{sphere}\nscale = 0")), "0 is out of range: expected a number above 0", 5, 9, ""),
        (
            model(&format!(
                "{sphere}\nmaterial = 'ice'\nscale = 1e-30\n[[model]]\n{sphere}\nmaterial = 'ice'\nscale = 3e38\ntranslate = [3e38, 0, 0]"
            )),
            "`sphere 2` reaches beyond the largest number, 3.4e38",
            7,
            1,
            "",
        ),
        (
            model(&format!("{sphere}\nmaterial = 'ice'\nrepeat = {{ count = [0, 1, 1], step = [1, 1, 1] }}")),
            "0 is out of range: expected a whole number from 1 to 1000000",
            6,
            21,
            "",
        ),
        (
            model(&format!("{sphere}\nmaterial = 'ice'\nrepeat = {{ count = [2, 1, 1], step = [0, 1, 1] }}")),
            "2 copies along x lie in the same place",
            6,
            10,
            "`step`",
        ),
        (
            model(&format!(
                "{sphere}\nmaterial = 'ice'\nrepeat = {{ count = [9999, 9999, 1], step = [1, 1, 1] }}"
            )),
            "the scene has 819036168192 triangles; the most is 33554432",
            3,
            1,
            "level",
        ),
        ("[material.a]\nior = -1".into(), "-1 is out of range: expected a number above 0", 2, 7, ""),
        (
            "[material.a]\nabsorption = [0.1, -0.1, 0]".into(),
            "-0.1 is out of range: expected a number of at least 0",
            2,
            20,
            "",
        ),
        (
            "[material.a]\nspecular = { shininess = -2 }".into(),
            "-2 is out of range: expected a number of at least 0",
            2,
            26,
            "",
        ),
        (
            "[material.a]\nreflection = 1e39".into(),
            "1e39 is too large: the largest number is 3.4e38",
            2,
            14,
            "",
        ),
        ("[material.a]\nfresnel = 1".into(), "invalid type: integer `1`, expected a boolean", 2, 11, ""),
        ("[material.a]\nindex = 1.5".into(), "unknown key `index`", 2, 1, "`ior`"),
        ("[material.a]\ndiffuse = { texture = 'none.png' }".into(), "there is no file none.png", 2, 23, ""),
        (
            "[material.a]\ndiffuse = { texture = 'a.obj' }".into(),
            "cannot decode a.obj: The image format could not be determined",
            2,
            23,
            "PNG",
        ),
        (
            "[camera]\neye = [0, 0, 1]\ntarget = [0, 0, 0]\nfov_y = 180".into(),
            "180 is out of range: expected an angle in degrees above 0 and below 180",
            4,
            9,
            "",
        ),
        (
            "[camera]\neye = [0, 0, inf]\ntarget = [0, 0, 0]".into(),
            "an infinite number is not usable",
            2,
            14,
            "",
        ),
        ("[render]\ndepth = 65".into(), "65 is out of range: expected a whole number from 0 to 64", 2, 9, ""),
        (
            "[render]\nsamples = 0".into(),
            "0 is out of range: expected a whole number from 1 to 65536",
            2,
            11,
            "",
        ),
        ("[render]\ncutoff = 2".into(), "2 is out of range: expected a number from 0 to 1", 2, 10, ""),
        ("[render]\ndepth = 3\ndepth = 4".into(), "duplicate key", 3, 1, ""),
        ("[[light]]\nintensity = 1".into(), "missing key `position`", 1, 1, ""),
        (
            "[[light]]\nposition = [1, 2, 3]\nintensity = -1".into(),
            "-1 is out of range: expected a number of at least 0",
            3,
            13,
            "",
        ),
        (
            "[background]\nimage = 'a.obj'".into(),
            "cannot decode a.obj: The image format could not be determined",
            2,
            9,
            "PNG",
        ),
        ("[camera\n".into(), "unclosed table, expected `]`", 1, 8, ""),
    ] {
        let text: String = text;
        let found = fault(&[("a.toml", &text), ("a.obj", CUBE)]);
        assert_eq!((found.0.as_str(), found.2, found.3), (message, line, column), "{text}");
        assert!(found.4.contains(hint), "{text}\n{}", found.4);
        assert_eq!(found.1, "a.toml");
    }
}

#[test]
fn faults_in_meshes_and_libraries_are_located_in_their_own_file() {
    let scene = "[[model]]\nmesh = 'a.obj'";
    for (mesh, library, message, file, line, column) in [
        ("f 1 2 3", "", "there is no vertex 1: 0 are defined so far", "a.obj", 1, 3),
        ("v 0 0 0", "", "a.obj has no faces", "a.obj", 1, 1),
        ("mtllib b.mtl\nv 0 0 0\nf 1 1 1", "", "there is no file b.mtl", "a.obj", 1, 8),
        ("v 0 0 0\nusemtl x\nf 1 1 1", "", "there is no material `x`", "a.obj", 2, 8),
        ("mtllib a.mtl\nv 0 0 0\nusemtl x\nf 1 1 1", "newmtl y", "there is no material `x`", "a.obj", 3, 8),
        (
            "mtllib a.mtl\nv 0 0 0\nf 1 1 1",
            "newmtl y\nKd 1 1",
            "`Kd` needs 3 numbers, found 2",
            "a.mtl",
            2,
            1,
        ),
        (
            "mtllib a.mtl\nv 0 0 0\nf 1 1 1",
            "newmtl y\nmap_Kd no.png",
            "there is no file no.png",
            "a.mtl",
            2,
            8,
        ),
        ("v 0 0 0\nv 1e-40 0 0\nf 1 1 2", "", "a.obj has faces without a material", "a.toml", 2, 8),
    ] {
        let found = fault(&[("a.toml", scene), ("a.obj", mesh), ("a.mtl", library)]);
        assert_eq!((found.0.as_str(), found.1.as_str(), found.2, found.3), (message, file, line, column));
    }
}

#[test]
fn a_bare_mesh_that_cannot_be_seen_is_refused() {
    assert_eq!(fault(&[("a.obj", "v 1 1 1\nf 1 1 1")]).0, "`a` is too small to be seen");
}

#[test]
fn other_files_are_no_scenes() {
    for name in ["a.stl", "a", "a.toml.bak"] {
        assert_eq!(fault(&[(name, "")]).0, format!("{name} is not a scene"));
    }
    assert!(
        Scene::load(std::path::Path::new("none.toml")).unwrap_err().to_string().contains("there is no file")
    );
}

#[test]
fn a_missing_picture_leaves_no_dangling_material() {
    let text = "[material.a]\ntransmission = 1\ndiffuse = { texture = 'none.png' }\n[[model]]\n\
                shape = { plane = { size = [1, 1] } }\nmaterial = 'a'";
    let files = files(&[("a.toml", text)]);
    assert_eq!(Scene::load(&files.first).unwrap_err().diagnostics().len(), 2);
}

#[test]
fn texture_coordinates_survive_the_way() {
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nf 1/1 2/1 3/1";
    let scene = load(&[("a.obj", mesh)]);
    assert_eq!(scene.models[0].mesh.uvs, [DVec2::new(0.25, 0.75)]);
}

/// A small generator of reproducible numbers (Marsaglia 2003, xorshift).
fn next(state: &mut u64) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state as usize
}

/// Overwrite, drop or repeat a few bytes.
fn mutate(text: &str, state: &mut u64) -> Vec<u8> {
    const BYTES: &[u8] = b"0123456789-+.e/\\ \n\r\t#[]{}=\"',_anif\xff\x00\xc3";
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..1 + next(state) % 4 {
        let at = next(state) % bytes.len();
        match next(state) % 4 {
            0 => bytes.truncate(at + 1),
            1 => bytes.insert(at, BYTES[next(state) % BYTES.len()]),
            _ => bytes[at] = BYTES[next(state) % BYTES.len()],
        }
    }
    bytes
}

#[test]
fn mutated_files_load_or_fail_without_panic() {
    let scene = "[camera]\neye = [0.5, 1e0, 5]\ntarget = [0, 0, 0]\n[background]\ncolor = \"#fff3e0\"\n[material.a]\n\
                 transmission = [1, 0.5, 0]\n[[model]]\nmesh = 'a.obj'\nnormals = 30\n[[model]]\nshape = { rounded_box = \
                 { size = [1, 2, 3], radius = 0.1, level = 1 } }\nmaterial = 'a'\nrepeat = { count = [2, 1, 1], step = [1, 0, 0] }\n";
    let mesh = "mtllib a.mtl\nusemtl glass\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.2 1 0\nvn 0 0 1\nvt 0 0.5\n\
                f -4/1/1 2/1/1 3/1/1 \\\n4/1/1 # quad\n";
    let library = "newmtl glass\nKd 1 1 1\nNs 20\nd 0.5\nillum 7\n";
    let originals = [("a.toml", scene), ("a.obj", mesh), ("a.mtl", library)];
    let files = files(&originals);
    Scene::load(&files.first).unwrap();
    let mut state = 0x9e37_79b9_7f4a_7c15;
    let (mut loaded, mut failed) = (0, 0);
    for (name, text) in originals {
        let path = files.directory.path().join(name);
        for _ in 0..300 {
            fs::write(&path, mutate(text, &mut state)).unwrap();
            match Scene::load(&files.first) {
                Ok(_) => loaded += 1,
                Err(error) => {
                    assert!(error.to_string().starts_with("error: "));
                    failed += 1;
                }
            }
        }
        fs::write(&path, text).unwrap();
    }
    assert!(loaded > 50 && failed > 50, "{loaded} loaded, {failed} failed");
}
