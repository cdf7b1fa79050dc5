//! Wavefront OBJ meshes (Advanced Visualizer manual, appendix B1): polygons with their materials' names.
//!
//! Read: `v vt vn f usemtl mtllib`. Passed over: groups, smoothing groups, points, lines, free-form geometry
//! and display attributes.
//!
//! A reader of our own, in one pass over the text: every fault has to name its line and column, the vertices
//! of all groups have to stay one shared list (a body is closed only as a whole), and concave faces have to be
//! cut inside. The crate tobj 4 tells no lines, splits the vertices by group and material, fans every polygon,
//! and panics on a colour of two numbers; on plain meshes the tests compare with it.

use std::collections::HashMap;

use glam::{DVec2, DVec3};

use super::source::Source;
use super::statement::{Statement, Statements};
use super::{Location, Mesh, SceneError, Triangle, polygon};

/// The most corners of one face: cutting takes the square of their number.
const MAX_CORNERS: usize = 16384;

/// The most libraries of one mesh: a name is looked up in each.
const MAX_LIBRARIES: usize = 64;

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
            "mtllib" if self.obj.libraries.len() == MAX_LIBRARIES => {
                let message = format!("too many material libraries; the most is {MAX_LIBRARIES}");
                return Err(statement.fault(statement.keyword, message).into());
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
pub(super) fn reference(statement: &Statement<'_>) -> Result<Reference, SceneError> {
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
mod tests;
