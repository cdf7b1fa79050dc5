//! Wavefront OBJ meshes (Advanced Visualizer manual, appendix B1): polygons with their materials' names.
//!
//! A reader of our own, because every fault has to name its line and column, and because the vertices of all
//! groups must stay one shared list: a body is closed only as a whole. Read: `v vt vn f usemtl mtllib`.
//! Passed over: groups, smoothing groups, points, lines, free-form geometry and display attributes.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::source::Source;
use super::statement::{Statement, Statements};
use super::{Location, Mesh, SceneError, Triangle, polygon};

/// The most corners of one face: cutting takes the square of their number.
const MAX_CORNERS: usize = 16384;

/// Statements that say nothing about surfaces.
const PASSED_OVER: &[&str] = &[
    "o",
    "g",
    "s",
    "mg",
    "p",
    "l",
    "vp",
    "deg",
    "bmat",
    "step",
    "cstype",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "maplib",
    "usemap",
];

/// What an OBJ file holds.
#[derive(Debug, Default)]
pub(super) struct Obj {
    /// Every polygon, cut into triangles; [`Triangle::material`] indexes `slots`.
    pub(super) mesh: Mesh,
    /// Materials by name, in the order of their first face; `None` for faces before any `usemtl`.
    pub(super) slots: Vec<Option<Reference>>,
    /// The `mtllib` statements.
    pub(super) libraries: Vec<Reference>,
}

/// A name that stands for something in another file.
#[derive(Debug, Clone)]
pub(super) struct Reference {
    /// The name.
    pub(super) name: String,
    /// Where it is written.
    pub(super) location: Location,
}

/// Read a mesh.
///
/// # Errors
/// Every fault of the file, with its line and column: see the tests.
pub(super) fn parse(source: &Source) -> Result<Obj, SceneError> {
    let mut reader = Reader::default();
    for statement in Statements::new(source) {
        reader.read(&statement)?;
    }
    if reader.obj.mesh.triangles.is_empty() {
        let fault = super::Diagnostic::error(format!("{} has no faces", source.path.display()))
            .at(source.locate(0..0))
            .hint("a mesh needs at least one `f` statement");
        return Err(fault.into());
    }
    Ok(reader.obj)
}

/// A corner of a face: indices from 0, or [`Triangle::NONE`].
#[derive(Debug, Clone, Copy)]
struct Corner {
    position: u32,
    uv: u32,
    normal: u32,
}

/// The state between two statements.
#[derive(Default)]
struct Reader {
    obj: Obj,
    /// Name of the current material.
    material: Option<Reference>,
    /// Slot of the current material, once it has a face.
    slot: Option<u32>,
    slot_of_name: HashMap<String, u32>,
    /// Corners of the current face.
    corners: Vec<Corner>,
}

impl Reader {
    fn read(&mut self, statement: &Statement<'_>) -> Result<(), SceneError> {
        let mesh = &mut self.obj.mesh;
        match statement.keyword {
            "v" => mesh.positions.push(DVec3::from_array(statement.numbers::<3>()?)),
            "vn" => mesh.normals.push(DVec3::from_array(statement.numbers::<3>()?).normalize_or_zero()),
            "vt" => mesh.uvs.push(texture_coordinate(statement)?),
            "f" | "fo" => self.face(statement)?,
            "usemtl" => {
                self.material = Some(reference(statement)?);
                self.slot = None;
            }
            "mtllib" => self.obj.libraries.push(reference(statement)?),
            word if PASSED_OVER.contains(&word) => {}
            word => {
                let fault = statement.fault(word, format!("unknown statement `{word}`"));
                return Err(fault
                    .hint("an OBJ file consists of statements like `v`, `vn`, `vt` and `f`")
                    .into());
            }
        }
        Ok(())
    }

    /// Read the corners of a face and cut it into triangles.
    fn face(&mut self, statement: &Statement<'_>) -> Result<(), SceneError> {
        self.corners.clear();
        for word in statement.words() {
            let corner = self.corner(statement, word)?;
            self.corners.push(corner);
        }
        let count = self.corners.len();
        if count < 3 {
            return Err(statement
                .fault(statement.keyword, format!("a face needs 3 corners, found {count}"))
                .into());
        }
        if count > MAX_CORNERS {
            let message = format!("a face of {count} corners; the most is {MAX_CORNERS}");
            return Err(statement.fault(statement.keyword, message).into());
        }
        let material = self.current_slot();
        if count == 3 {
            self.push(material, [0, 1, 2]);
        } else {
            let mesh = &self.obj.mesh;
            let points: Vec<_> = self.corners.iter().map(|c| mesh.positions[c.position as usize]).collect();
            for corners in polygon::triangulate(&points) {
                self.push(material, corners);
            }
        }
        Ok(())
    }

    fn push(&mut self, material: u32, corners: [usize; 3]) {
        let corners = corners.map(|corner| self.corners[corner]);
        let normals = corners.map(|corner| corner.normal);
        // Some writers give a normal of length 0 where they know none.
        let known = |&normal: &u32| {
            self.obj.mesh.normals.get(normal as usize).is_some_and(|normal| *normal != DVec3::ZERO)
        };
        self.obj.mesh.triangles.push(Triangle {
            positions: corners.map(|corner| corner.position),
            normals: if normals.iter().all(known) { normals } else { [Triangle::NONE; 3] },
            uvs: corners.map(|corner| corner.uv),
            material,
        });
    }

    /// Read `v`, `v/vt`, `v//vn` or `v/vt/vn`, like the first corner.
    fn corner(&self, statement: &Statement<'_>, word: &str) -> Result<Corner, SceneError> {
        let mesh = &self.obj.mesh;
        let mut parts = word.split('/');
        let mut index = |count: usize, what: &str| match parts.next() {
            None | Some("") => Ok(Triangle::NONE),
            Some(part) => resolve(statement, part, count, what),
        };
        let corner = Corner {
            position: index(mesh.positions.len(), "vertex")?,
            uv: index(mesh.uvs.len(), "texture coordinate")?,
            normal: index(mesh.normals.len(), "normal")?,
        };
        if corner.position == Triangle::NONE || parts.next().is_some() {
            let fault = statement.fault(word, format!("`{word}` is not a corner"));
            return Err(fault.hint("a corner is written v, v/vt, v//vn or v/vt/vn").into());
        }
        if let Some(first) = self.corners.first() {
            let differs = |a: u32, b: u32| (a == Triangle::NONE) != (b == Triangle::NONE);
            if differs(first.uv, corner.uv) || differs(first.normal, corner.normal) {
                let message = format!("`{word}` is not written like the first corner of this face");
                return Err(statement.fault(word, message).into());
            }
        }
        Ok(corner)
    }

    /// The slot of the current material; a new one at its first face.
    fn current_slot(&mut self) -> u32 {
        if let Some(slot) = self.slot {
            return slot;
        }
        // A material's name is never empty, so the empty one is free for faces without any.
        let name = self.material.as_ref().map_or_else(String::new, |material| material.name.clone());
        let next = self.obj.slots.len() as u32;
        let slot = *self.slot_of_name.entry(name).or_insert(next);
        if slot == next {
            self.obj.slots.push(self.material.clone());
        }
        self.slot = Some(slot);
        slot
    }
}

/// Read `vt u [v [w]]`.
fn texture_coordinate(statement: &Statement<'_>) -> Result<DVec2, SceneError> {
    if statement.words().nth(1).is_none() {
        return Ok(DVec2::new(statement.numbers::<1>()?[0], 0.0));
    }
    Ok(DVec2::from_array(statement.numbers::<2>()?))
}

/// Read the name after a keyword; it may hold spaces.
fn reference(statement: &Statement<'_>) -> Result<Reference, SceneError> {
    if statement.rest.is_empty() {
        let message = format!("`{}` needs a name", statement.keyword);
        return Err(statement.fault(statement.keyword, message).into());
    }
    Ok(Reference { name: statement.rest.to_owned(), location: statement.locate(statement.rest) })
}

/// Turn an index as written (from 1, or from −1 backwards) into one from 0.
fn resolve(statement: &Statement<'_>, part: &str, count: usize, what: &str) -> Result<u32, SceneError> {
    let written: i64 =
        part.parse().map_err(|_| statement.fault(part, format!("`{part}` is not the number of a {what}")))?;
    let index = match written {
        0 => None,
        1.. => Some(written - 1),
        _ => Some(count as i64 + written),
    };
    index
        .filter(|index| (0..count as i64).contains(index))
        .and_then(|index| u32::try_from(index).ok())
        .ok_or_else(|| {
            let message = format!("there is no {what} {written}: {count} are defined so far");
            let hint = "they are counted from 1, or backwards from -1, and defined before their use";
            statement.fault(part, message).hint(hint).into()
        })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;

    fn source(text: &str) -> Source {
        Source::new(Path::new("a.obj"), text.into())
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    fn read(faces: &str) -> Obj {
        parse(&source(&format!("{SQUARE}{faces}"))).unwrap()
    }

    /// Message, line after the square, and column of the fault.
    fn fault(faces: &str) -> (String, usize, usize) {
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
        assert_eq!(obj.mesh.uvs[1], DVec2::new(0.5, 0.0));
        let none = [Triangle::NONE; 3];
        let [a, b, c] = obj.mesh.triangles[..] else { panic!("three faces") };
        assert_eq!((a.uvs, a.normals), ([1, 0, 0], [0; 3]));
        assert_eq!((b.uvs, b.normals), (none, [0; 3]));
        assert_eq!((c.uvs, c.normals), ([0; 3], none));
    }

    #[test]
    fn normals_of_no_length_are_no_normals() {
        let obj = read("vn 0 0 0\nvn 0 0 1\nf 1//1 2//2 3//2");
        assert_eq!(obj.mesh.triangles[0].normals, [Triangle::NONE; 3]);
    }

    #[test]
    fn materials_get_slots_in_the_order_of_their_faces() {
        let obj =
            read("f 1 2 3\nusemtl b\nusemtl a\nf 1 2 3\nusemtl old glass\nf 1 2 3\nusemtl a\nf 1 2 3 4");
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
        assert_eq!((obj.mesh.positions.len(), obj.mesh.triangles.len()), (5, 1));
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
    fn a_face_of_too_many_corners_is_refused() {
        let corners = "1 2 3 4 ".repeat(MAX_CORNERS / 4 + 1);
        assert!(fault(&format!("f {corners}")).0.contains("the most is 16384"));
    }

    #[test]
    fn an_independent_reader_finds_the_same_triangles() {
        let text = format!(
            "{SQUARE}v 2 0.5 0\nvn 0 0 1\nvt 0 0\nvt 1 1\ng a\nf 1/1/1 2/2/1 3/2/1\nf 1/1/1 3/2/1 4/1/1\nf -4//1 -1//1 -3//1\n"
        );
        let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| unreachable!()).unwrap();
        let theirs = models.iter().flat_map(|model| {
            let point = |&index: &u32| {
                let at = 3 * index as usize;
                DVec3::from_slice(&[0, 1, 2].map(|axis| f64::from(model.mesh.positions[at + axis])))
            };
            model.mesh.indices.iter().map(point)
        });
        let obj = parse(&source(&text)).unwrap();
        let ours =
            obj.mesh.triangles.iter().flat_map(|t| t.positions).map(|p| obj.mesh.positions[p as usize]);
        assert!(theirs.eq(ours));
    }
}
