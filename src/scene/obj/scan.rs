//! The scan of an OBJ file before tobj reads it: one pass that proves every statement, knows the place of every
//! fault, and stores nothing but what tobj loses.

use std::collections::HashMap;

use crate::scene::SceneError;
use crate::scene::statement::{Reference, Statement};

/// The most corners of one face: cutting takes the square of their number.
pub(super) const MAX_CORNERS: usize = 16384;

/// The most libraries of one mesh: a name is looked up in each.
pub(super) const MAX_LIBRARIES: usize = 64;

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

/// What has been scanned so far.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// All faces.
    pub(super) runs: Vec<Run>,
    /// See [`super::Obj::slots`].
    pub(super) slots: Vec<Option<Reference>>,
    /// See [`super::Obj::libraries`].
    pub(super) libraries: Vec<Reference>,
    /// How many `v`, `vt` and `vn` there are.
    positions: usize,
    uvs: usize,
    normals: usize,
    /// Name of the current material.
    material: Option<Reference>,
    /// Slot of the current material, once it has a face.
    slot: Option<u32>,
    slot_of_name: HashMap<String, u32>,
}

/// Consecutive faces of one material that are written alike.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// Index into [`Scan::slots`].
    pub(super) slot: u32,
    /// How every corner is written.
    pub(super) style: Style,
    /// How many faces, ≥ 1.
    pub(super) faces: usize,
}

/// How a corner is written: `v`, `v/vt`, `v//vn` or `v/vt/vn`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Style {
    pub(super) has_uvs: bool,
    pub(super) has_normals: bool,
}

impl Scan {
    /// Prove a statement; append to `plain` what tobj has to know of it: a line, or nothing.
    ///
    /// # Errors
    /// The fault of the statement. `plain` is untouched then.
    pub(super) fn prove(&mut self, statement: &Statement<'_>, plain: &mut String) -> Result<(), SceneError> {
        match statement.keyword {
            "v" => {
                statement.numbers::<3>()?;
                self.positions += 1;
                write(plain, "v", statement.words().take(3));
            }
            "vn" => {
                statement.numbers::<3>()?;
                self.normals += 1;
                write(plain, "vn", statement.words().take(3));
            }
            "vt" => {
                texture_coordinate(statement)?;
                self.uvs += 1;
                write(plain, "vt", statement.words().chain(["0"]).take(2));
            }
            "f" | "fo" => {
                self.face(statement)?;
                write(plain, "f", statement.words());
            }
            "usemtl" => {
                self.material = Some(statement.reference()?);
                self.slot = None;
            }
            "mtllib" if self.libraries.len() == MAX_LIBRARIES => {
                let message = format!("too many material libraries; the most is {MAX_LIBRARIES}");
                return Err(statement.fault(statement.keyword, message).into());
            }
            "mtllib" => self.libraries.push(statement.reference()?),
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

    /// Prove a face and count it.
    fn face(&mut self, statement: &Statement<'_>) -> Result<(), SceneError> {
        let mut style = None;
        let mut count = 0;
        for word in statement.words() {
            let corner = self.corner(statement, word)?;
            if *style.get_or_insert(corner) != corner {
                let message = format!("`{word}` is not written like the first corner of this face");
                return Err(statement.fault(word, message).into());
            }
            count += 1;
        }
        let Some(style) = style.filter(|_| count >= 3) else {
            return Err(statement
                .fault(statement.keyword, format!("a face needs 3 corners, found {count}"))
                .into());
        };
        if count > MAX_CORNERS {
            let message = format!("a face of {count} corners; the most is {MAX_CORNERS}");
            return Err(statement.fault(statement.keyword, message).into());
        }
        let slot = self.current_slot();
        match self.runs.last_mut() {
            Some(run) if (run.slot, run.style) == (slot, style) => run.faces += 1,
            _ => self.runs.push(Run { slot, style, faces: 1 }),
        }
        Ok(())
    }

    /// Prove a corner.
    fn corner(&self, statement: &Statement<'_>, word: &str) -> Result<Style, SceneError> {
        let mut parts = word.split('/');
        let mut has_index = |count: usize, what: &str| match parts.next() {
            None | Some("") => Ok(false),
            Some(part) => check_index(statement, part, count, what).map(|()| true),
        };
        let has_position = has_index(self.positions, "vertex")?;
        let has_uvs = has_index(self.uvs, "texture coordinate")?;
        let has_normals = has_index(self.normals, "normal")?;
        if !has_position || parts.next().is_some() {
            let fault = statement.fault(word, format!("`{word}` is not a corner"));
            return Err(fault.hint("a corner is written v, v/vt, v//vn or v/vt/vn").into());
        }
        Ok(Style { has_uvs, has_normals })
    }

    /// The slot of the current material; a new one at its first face.
    fn current_slot(&mut self) -> u32 {
        if let Some(slot) = self.slot {
            return slot;
        }
        // A material's name is never empty, so the empty one is free for faces without any.
        let name = self.material.as_ref().map_or_else(String::new, |material| material.name.clone());
        let next = self.slots.len() as u32;
        let slot = *self.slot_of_name.entry(name).or_insert(next);
        if slot == next {
            self.slots.push(self.material.clone());
        }
        self.slot = Some(slot);
        slot
    }
}

/// Append a line.
fn write<'a>(plain: &mut String, keyword: &str, words: impl Iterator<Item = &'a str>) {
    plain.push_str(keyword);
    for word in words {
        plain.push(' ');
        plain.push_str(word);
    }
    plain.push('\n');
}

/// Prove `vt u [v [w]]`.
fn texture_coordinate(statement: &Statement<'_>) -> Result<(), SceneError> {
    match statement.words().nth(1) {
        None => statement.numbers::<1>().map(drop),
        Some(_) => statement.numbers::<2>().map(drop),
    }
}

/// Prove an index as written: from 1, or from −1 backwards.
fn check_index(statement: &Statement<'_>, part: &str, count: usize, what: &str) -> Result<(), SceneError> {
    let written: i64 =
        part.parse().map_err(|_| statement.fault(part, format!("`{part}` is not the number of a {what}")))?;
    if written == 0 || written.unsigned_abs() > count as u64 {
        let message = format!("there is no {what} {written}: {count} are defined so far");
        let hint = "they are counted from 1, or backwards from -1, and defined before their use";
        return Err(statement.fault(part, message).hint(hint).into());
    }
    Ok(())
}
