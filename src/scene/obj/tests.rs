use std::path::Path;

use super::scan::{MAX_CORNERS, MAX_LIBRARIES};
use super::*;

fn source(text: &str) -> Source {
    Source::new(Path::new("a.obj"), text.into())
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn read(faces: &str) -> Obj {
    parse(&source(&format!("{SQUARE}{faces}"))).unwrap()
}

/// Message, line after the square, and column of the fault.
fn fault(faces: &str) -> (String, u32, u32) {
    let error = parse(&source(&format!("{SQUARE}{faces}"))).unwrap_err();
    let diagnostic = &error.diagnostics()[0];
    let place = diagnostic.location.clone().unwrap();
    (diagnostic.message.clone(), place.line - 4, place.column)
}

#[test]
fn faces_share_the_vertices_of_all_groups() {
    let obj = read("g a\nf 1 2 3\ng b\nusemtl x\nf 1 3 4\n");
    assert_eq!(obj.mesh.positions.len(), 4);
    let positions: Vec<_> = obj.mesh.triangles.iter().map(|triangle| triangle.positions).collect();
    assert_eq!(positions, [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn negative_indices_count_backwards() {
    assert_eq!(read("f -4 -3 -2").mesh.triangles[0].positions, [0, 1, 2]);
}

#[test]
fn normals_and_texture_coordinates_have_their_own_indices() {
    let obj = read("vt 0 0\nvt 0.5\nvn 0 0 2\nf 1/2/1 2/1/1 3/1/1\nf 1//1 2//1 3//1\nf 1/1 2/1 3/1\n");
    assert_eq!(obj.mesh.normals, [DVec3::Z]);
    let none = [Triangle::NONE; 3];
    let [a, b, c] = obj.mesh.triangles[..] else { panic!("three faces") };
    let uvs = |triangle: Triangle| triangle.uvs.map(|index| obj.mesh.uvs[index as usize].to_array());
    assert_eq!((uvs(a), a.normals), ([[0.5, 0.0], [0.0; 2], [0.0; 2]], [0; 3]));
    assert_eq!((b.uvs, b.normals), (none, [0; 3]));
    assert_eq!((uvs(c), c.normals), ([[0.0; 2]; 3], none));
}

#[test]
fn normals_of_no_length_are_no_normals() {
    let obj = read("vn 0 0 0\nvn 0 0 1\nf 1//1 2//2 3//2");
    assert_eq!(obj.mesh.triangles[0].normals, [Triangle::NONE; 3]);
}

#[test]
fn materials_get_slots_in_the_order_of_their_faces() {
    let obj = read("f 1 2 3\nusemtl b\nusemtl a\nf 1 2 3\nusemtl old glass\nf 1 2 3\nusemtl a\nf 1 2 3 4");
    let names: Vec<_> = obj.slots.iter().map(|slot| slot.as_ref().map(|s| s.name.as_str())).collect();
    assert_eq!(names, [None, Some("a"), Some("old glass")]);
    let used: Vec<_> = obj.mesh.triangles.iter().map(|triangle| triangle.material).collect();
    assert_eq!(used, [0, 1, 2, 1, 1]);
}

#[test]
fn libraries_are_listed_with_their_places() {
    let obj = read("mtllib my lib.mtl\nf 1 2 3");
    assert_eq!(obj.libraries[0].name, "my lib.mtl");
    assert_eq!((obj.libraries[0].location.line, obj.libraries[0].location.column), (5, 8));
}

#[test]
fn lines_points_colours_and_free_forms_are_passed_over() {
    let obj = read("v 0 0 1 0.5 0.5 0.5\nl 1 2\np 1\ncstype bezier\ns off\nf 1 2 3");
    assert_eq!((obj.mesh.positions.len(), obj.mesh.triangles.len()), (3, 1));
}

#[test]
fn broken_statements_are_located() {
    for (faces, message, line, column) in [
        ("v 1 2", "`v` needs 3 numbers, found 2", 1, 1),
        ("v 1 nan 3", "NaN is not a usable number", 1, 5),
        ("v 1 2 -inf", "an infinite number is not usable", 1, 7),
        ("v 1 2 1e39", "1e39 is too large: the largest number is 3.4e38", 1, 7),
        ("v 1 2 3 x", "`x` is not a number", 1, 9),
        ("vn 1 2", "`vn` needs 3 numbers, found 2", 1, 1),
        ("vt", "`vt` needs 1 numbers, found 0", 1, 1),
        ("f 1 2 3\nf 1 2", "a face needs 3 corners, found 2", 2, 1),
        ("f 1 2 x", "`x` is not the number of a vertex", 1, 7),
        ("f 0 1 2", "there is no vertex 0: 4 are defined so far", 1, 3),
        ("f 1 2 5", "there is no vertex 5: 4 are defined so far", 1, 7),
        ("f 1 2 -5", "there is no vertex -5: 4 are defined so far", 1, 7),
        ("f 1/1 2/1 3/1", "there is no texture coordinate 1: 0 are defined so far", 1, 5),
        ("f 1//1 2//1 3//1", "there is no normal 1: 0 are defined so far", 1, 6),
        ("vt 0 0\nf 1 2/1 3", "`2/1` is not written like the first corner of this face", 2, 5),
        ("f 1 2 3/1/1/1", "there is no texture coordinate 1: 0 are defined so far", 1, 9),
        ("f 1 2 3////", "`3////` is not a corner", 1, 7),
        ("f 1 2 /", "`/` is not a corner", 1, 7),
        ("f 1 2 99999999999999999999", "`99999999999999999999` is not the number of a vertex", 1, 7),
        ("usemtl", "`usemtl` needs a name", 1, 1),
        ("mtllib ", "`mtllib` needs a name", 1, 1),
        ("  vertex 1 2 3", "unknown statement `vertex`", 1, 3),
        ("\u{0}PNG", "unknown statement `\u{0}PNG`", 1, 1),
    ] {
        assert_eq!(fault(faces), (message.to_owned(), line, column), "{faces:?}");
    }
}

#[test]
fn a_mesh_without_faces_is_an_error() {
    let error = parse(&source(SQUARE)).unwrap_err();
    assert_eq!(error.diagnostics()[0].message, "a.obj has no faces");
    assert!(parse(&source("")).is_err());
}

#[test]
fn too_many_libraries_are_refused() {
    let (message, line, _) = fault(&"mtllib a.mtl\n".repeat(MAX_LIBRARIES + 1));
    assert_eq!((message.as_str(), line), ("too many material libraries; the most is 64", 65));
}

#[test]
fn a_face_of_too_many_corners_is_refused() {
    let corners = "1 2 3 4 ".repeat(MAX_CORNERS / 4 + 1);
    assert!(fault(&format!("f {corners}")).0.contains("the most is 16384"));
}

#[test]
fn groups_and_materials_leave_a_cube_closed() {
    let obj = parse(&source(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\ng ends\nusemtl a\nf 4 3 2 1\n\
         f 5 6 7 8\no sides\nusemtl b\nf 1 2 6 5\nf 2 3 7 6\ng more\nusemtl a\nf 3 4 8 7\nf 4 1 5 8\n",
    ))
    .unwrap();
    assert_eq!((obj.mesh.positions.len(), obj.mesh.triangles.len(), obj.slots.len()), (8, 12, 2));
    let mut edges = std::collections::HashMap::new();
    for [a, b, c] in obj.mesh.triangles.iter().map(|triangle| triangle.positions) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            *edges.entry([from.min(to), from.max(to)]).or_insert(0) += if from < to { 1 } else { 16 };
        }
    }
    assert_eq!(edges.len(), 18);
    assert!(edges.values().all(|&uses| uses == 1 + 16), "every edge is run through once in each direction");
}

#[test]
fn coordinates_keep_the_precision_of_f64() {
    let obj = parse(&source("v 0.1 0 0\nv 1 0 0\nv 0 1 0\nvt 0.3 0\nf 1/1 2/1 3/1")).unwrap();
    assert_eq!((obj.mesh.positions[0].x, obj.mesh.uvs[0].x), (0.1, 0.3));
}

#[test]
fn faces_of_many_corners_are_cut_inside() {
    let obj = parse(&source("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\nf 1 2 3\nf 1 2 3 4"));
    let mesh = obj.unwrap().mesh;
    assert_eq!(mesh.triangles.len(), 3 + 1 + 2);
    let area = |triangle: &Triangle| {
        let [a, b, c] = triangle.positions.map(|index| mesh.positions[index as usize]);
        (b - a).cross(c - a).z / 2.0
    };
    let areas: Vec<_> = mesh.triangles.iter().map(area).collect();
    assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
    assert_eq!((areas[..3].iter().sum::<f64>(), areas[3], areas[4] + areas[5]), (10.0, 8.0, 6.0));
}
