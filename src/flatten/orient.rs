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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::flatten::samples::{ICE, STONE, cube, cuboid, flattened, inside_out, joined, mesh, model};
    use crate::flatten::{Flattened, start_media};
    use crate::scene::Mesh;

    fn messages(flat: &Flattened) -> Vec<&str> {
        flat.warnings.iter().map(|warning| warning.message.as_str()).collect()
    }

    /// Whether each point along x is inside the body.
    fn inside(mesh: Mesh, xs: &[f64]) -> Vec<bool> {
        let flat = flattened(vec![model("it", mesh, ICE)]).unwrap();
        xs.iter().map(|&x| start_media(&flat.scene, [x, 0.01, 0.02]) == 1).collect()
    }

    #[test]
    fn a_cube_is_as_it_should_be() {
        let flat = flattened(vec![model("cube", cube(1.0), ICE)]).unwrap();
        assert!(flat.warnings.is_empty());
        for (triangle, face) in flat.scene.triangles.iter().map(|t| (t, flat.scene.attributes[t.id as usize]))
        {
            let outwards: f32 = (0..3).map(|axis| triangle.v0[axis] * face.normal[axis]).sum();
            assert_eq!(outwards, 1.0);
        }
    }

    #[test]
    fn an_inside_out_cube_is_turned_and_reported() {
        let flat = flattened(vec![model("cube", inside_out(cube(1.0)), ICE)]).unwrap();
        assert_eq!(messages(&flat), ["the mesh of `cube` was inside-out"]);
        assert_eq!(start_media(&flat.scene, [0.1, 0.2, 0.3]), 1);
    }

    #[test]
    fn a_cavity_is_not_inside_out() {
        let hollow = joined(&[cube(2.0), inside_out(cube(1.0))]);
        let flat = flattened(vec![model("hollow", hollow.clone(), ICE)]).unwrap();
        assert!(flat.warnings.is_empty());
        assert_eq!(inside(hollow, &[0.0, 1.5, 2.5]), [false, true, false]);
    }

    #[test]
    fn a_cavity_that_looks_into_the_matter_is_turned() {
        let hollow = joined(&[cube(2.0), cube(1.0)]);
        let flat = flattened(vec![model("hollow", hollow.clone(), ICE)]).unwrap();
        assert_eq!(messages(&flat), ["1 of 2 shells of `hollow` were inside-out"]);
        assert_eq!(inside(hollow, &[0.0, 1.5, 2.5]), [false, true, false]);
    }

    #[test]
    fn shells_alternate_however_deep_they_nest() {
        let nested = joined(&[cube(1.0), cube(4.0), cube(2.0), cube(3.0)]);
        assert_eq!(inside(nested, &[0.0, 1.5, 2.5, 3.5, 4.5]), [false, true, false, true, false]);
    }

    #[test]
    fn single_faces_are_turned_with_their_shell() {
        let mut bent = cube(1.0);
        super::super::place::reverse(&mut bent.triangles[3]);
        super::super::place::reverse(&mut bent.triangles[8]);
        let flat = flattened(vec![model("cube", bent.clone(), ICE)]).unwrap();
        assert_eq!(messages(&flat), ["2 of 12 faces of `cube` were wound against the others"]);
        assert_eq!(inside(bent, &[0.0, 1.5]), [true, false]);
    }

    #[test]
    fn a_mirrored_model_stays_outside_out() {
        let mirrored = Model {
            world_from_object: glam::DAffine3::from_scale(DVec3::splat(-1.0)),
            ..model("cube", cube(1.0), ICE)
        };
        let flat = flattened(vec![mirrored]).unwrap();
        assert!(flat.warnings.is_empty());
        assert_eq!(start_media(&flat.scene, [0.1, 0.2, 0.3]), 1);
    }

    #[test]
    fn an_open_mesh_is_an_error_if_it_transmits_light() {
        let mut open = cube(1.0);
        open.triangles.remove(5);
        let error = flattened(vec![model("cup", open.clone(), ICE)]).unwrap_err();
        let diagnostic = &error.diagnostics()[0];
        assert!(diagnostic.message.contains("`cup` is open") && diagnostic.message.contains("3 edges"));
        assert!(diagnostic.hint.as_ref().unwrap().contains("(-1, -1, -1)"));
        assert!(flattened(vec![model("cup", open, STONE)]).is_ok());
    }

    #[test]
    fn an_inner_wall_bounds_no_solid() {
        let upper = cuboid(DVec3::new(0.0, 1.0, 0.0), DVec3::new(1.0, 2.0, 1.0));
        let stacked = joined(&[cuboid(DVec3::ZERO, DVec3::ONE), upper]);
        let mut walled = stacked.clone();
        walled.triangles.drain(16..18);
        let error = flattened(vec![model("walled", walled, ICE)]).unwrap_err();
        assert!(error.diagnostics()[0].message.contains("an odd number of faces"));
        // With both sides of the wall it is two solids that touch.
        assert_eq!(inside(stacked, &[0.5, 1.5]), [true, false]);
    }

    #[test]
    fn cubes_that_touch_at_an_edge_are_two_shells() {
        let touching = joined(&[
            cuboid(DVec3::ZERO, DVec3::ONE),
            cuboid(DVec3::new(1.0, 1.0, 0.0), DVec3::new(2.0, 2.0, 1.0)),
        ]);
        for mesh in [touching.clone(), inside_out(touching)] {
            let flat = flattened(vec![model("two", mesh, ICE)]).unwrap();
            assert!(flat.warnings.iter().all(|w| w.message == "the mesh of `two` was inside-out"));
            let at = |x, y| start_media(&flat.scene, [x, y, 0.5]);
            assert_eq!([at(0.5, 0.5), at(1.5, 1.5), at(1.5, 0.5), at(0.5, 1.5)], [1, 1, 0, 0]);
        }
    }

    #[test]
    fn a_one_sided_surface_has_no_inside() {
        // The projective plane on six vertices (the hemi-icosahedron): closed, but without two sides.
        let triangles = [
            [0, 1, 2],
            [0, 2, 3],
            [0, 3, 4],
            [0, 4, 5],
            [0, 5, 1],
            [1, 2, 4],
            [2, 3, 5],
            [3, 4, 1],
            [4, 5, 2],
            [5, 1, 3],
        ];
        let positions: Vec<DVec3> =
            (0..6).map(|k| DVec3::new(f64::from(k), f64::from(k * k), f64::from(k * k * k))).collect();
        let error = flattened(vec![model("strange", mesh(&positions, &triangles), ICE)]).unwrap_err();
        assert!(error.diagnostics()[0].message.contains("one-sided"));
    }

    #[test]
    fn shells_that_touch_from_inside_are_judged_where_they_are_apart() {
        // Three walls of the cavity lie on the outer walls: most of its vertices are no witnesses.
        let cavity = cuboid(DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0));
        let mesh = joined(&[cuboid(DVec3::ZERO, DVec3::splat(4.0)), inside_out(cavity)]);
        let flat = flattened(vec![model("touching", mesh, ICE)]).unwrap();
        assert_eq!(messages(&flat), [""; 0]);
        let at = |x: f64| start_media(&flat.scene, [x, 1.5, 1.7]);
        assert_eq!([at(0.5), at(2.0), at(5.0)], [0, 1, 0]);
    }
}
