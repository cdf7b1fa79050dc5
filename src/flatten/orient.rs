//! Every solid knows which side its matter is on.
//!
//! A transmissive body must be closed. Its faces are wound consistently within each shell (a connected piece
//! of its surface), and each shell is judged by how many others hold it: an even number, and it bounds matter
//! from outside; an odd number, and it is the wall of a cavity, whose faces look into the cavity.

use glam::DVec3;

use super::edges::{self, Sides};
use super::place::{Placed, reverse};
use super::shells::{Shell, find_shells};
use crate::scene::{Diagnostic, Model, SceneError};

/// Turn the faces of a transmissive model's triangles so that they look out of the matter; says what was
/// wrong.
///
/// # Errors
/// The mesh is open, has an edge that no solid has, or cannot be wound consistently.
pub(super) fn orient(placed: &mut Placed) -> Result<Vec<Diagnostic>, SceneError> {
    let triangles = placed.welded();
    let sides = edges::join(&triangles, &placed.positions);
    check_closed(placed, &sides)?;
    let winding = Winding::flood(&triangles, &sides).ok_or_else(|| one_sided(placed.model))?;
    let shells = find_shells(placed, &winding);
    for (triangle, turned) in placed.triangles.iter_mut().zip(&winding.turned) {
        if *turned {
            reverse(triangle);
        }
    }
    let wrong: Vec<bool> = shells.iter().map(|shell| shell.is_wrong()).collect();
    for (triangle, &shell) in placed.triangles.iter_mut().zip(&winding.shell) {
        if wrong.get(shell as usize).is_some_and(|&wrong| wrong) {
            reverse(triangle);
        }
    }
    Ok(report(placed.model, winding.rewound, &shells))
}

/// A consistent winding of every shell.
pub(super) struct Winding {
    /// For each triangle its shell; [`edges::NONE`] for triangles without area.
    pub(super) shell: Vec<u32>,
    /// Whether the triangle must be reversed to agree with most of its shell.
    pub(super) turned: Vec<bool>,
    /// Number of shells.
    pub(super) shells: u32,
    /// How many triangles are reversed.
    pub(super) rewound: usize,
}

impl Winding {
    /// Spread the first triangle's winding over each shell; `None` for a one-sided surface.
    fn flood(triangles: &[[u32; 3]], sides: &Sides) -> Option<Self> {
        let mut winding = Self {
            shell: vec![edges::NONE; triangles.len()],
            turned: vec![false; triangles.len()],
            shells: 0,
            rewound: 0,
        };
        for first in 0..triangles.len() {
            if winding.shell[first] == edges::NONE && edges::is_proper(triangles[first]) {
                winding.flood_shell(first, triangles, sides)?;
            }
        }
        Some(winding)
    }

    fn flood_shell(&mut self, first: usize, triangles: &[[u32; 3]], sides: &Sides) -> Option<()> {
        let mut members = vec![first];
        self.shell[first] = self.shells;
        let mut next = 0;
        while let Some(&triangle) = members.get(next) {
            next += 1;
            for side in triangle * 3..triangle * 3 + 3 {
                let partner = sides.partner[side];
                let neighbour = partner as usize / 3;
                // Agreeing sides keep the winding, others turn it.
                let turned = self.turned[triangle] == edges::agree(triangles, side as u32, partner);
                if self.shell[neighbour] == edges::NONE {
                    self.shell[neighbour] = self.shells;
                    self.turned[neighbour] = turned;
                    members.push(neighbour);
                } else if self.turned[neighbour] != turned {
                    return None;
                }
            }
        }
        self.keep_majority(&members);
        self.shells += 1;
        Some(())
    }

    /// The winding of most triangles of a shell is taken for the one that was meant.
    fn keep_majority(&mut self, members: &[usize]) {
        let turned = members.iter().filter(|&&triangle| self.turned[triangle]).count();
        if turned * 2 > members.len() {
            members.iter().for_each(|&triangle| self.turned[triangle] = !self.turned[triangle]);
        }
        self.rewound += turned.min(members.len() - turned);
    }
}

fn check_closed(placed: &Placed, sides: &Sides) -> Result<(), SceneError> {
    let (model, name) = (placed.model, &placed.model.name);
    let (first, message, hint) = if let Some(&first) = sides.open.first() {
        let count = sides.open.len();
        let edges = if count == 1 { "1 edge belongs" } else { &format!("{count} edges belong") };
        let message = format!(
            "the mesh of `{name}` is open, but its material transmits light: {edges} to one face only"
        );
        (first, message, "close the mesh, or give it an opaque material (transmission = 0)")
    } else if let Some(&first) = sides.odd.first() {
        let message =
            format!("the mesh of `{name}` does not bound a solid: an odd number of faces meet at an edge");
        (first, message, "remove inner walls, or give the mesh an opaque material (transmission = 0)")
    } else {
        return Ok(());
    };
    let [start, end] = ends_in_file(placed, first);
    let hint =
        format!("{hint}; the first such edge runs from {start} to {end} in the mesh's own coordinates");
    Err(super::at(Diagnostic::error(message), model).hint(hint).into())
}

/// Where a side runs, in the coordinates of the mesh.
fn ends_in_file(placed: &Placed, side: u32) -> [String; 2] {
    let (triangle, corner) = (&placed.triangles[side as usize / 3], side as usize % 3);
    [corner, (corner + 1) % 3].map(|corner| {
        let DVec3 { x, y, z } = placed.model.mesh.positions[triangle.positions[corner] as usize];
        format!("({x}, {y}, {z})")
    })
}

fn one_sided(model: &Model) -> SceneError {
    let message = format!("the mesh of `{}` is one-sided, like a Klein bottle: it has no inside", model.name);
    super::at(Diagnostic::error(message), model).hint("give it an opaque material (transmission = 0)").into()
}

fn report(model: &Model, rewound: usize, shells: &[Shell]) -> Vec<Diagnostic> {
    let mut warnings = Vec::new();
    let mut warn = |message: String, hint: &str| {
        warnings.push(super::at(Diagnostic::warning(message), model).hint(hint));
    };
    if rewound > 0 {
        let total = model.mesh.triangles.len();
        let message = format!("{rewound} of {total} faces of `{}` were wound against the others", model.name);
        warn(message, "they were turned; list the corners of every face counter-clockwise seen from outside");
    }
    let wrong = shells.iter().filter(|shell| shell.is_wrong()).count();
    if wrong == shells.len() && wrong > 0 {
        let message = format!("the mesh of `{}` was inside-out", model.name);
        warn(message, "its faces were turned; list their corners counter-clockwise seen from outside");
    } else if wrong > 0 {
        let message = format!("{wrong} of {} shells of `{}` were inside-out", shells.len(), model.name);
        warn(message, "they were turned: outer faces look outwards, the walls of a cavity into the cavity");
    }
    warnings
}
