//! The shells of a body, and how deep each lies within the others.

use glam::DVec3;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

use super::edges;
use super::orient::Winding;
use super::place::{Placed, bounds};
use super::winding::winding_number;

/// How many faces of a shell are asked, at most, whether another holds it.
const WITNESSES: usize = 64;

/// Around a closed shell winding numbers are whole, up to rounding, except on the shell itself: one farther
/// than this from a whole number leaves doubt.
const DOUBT: f64 = 1e-3;

/// Volumes below this part of the shell's box are rounding: such a shell encloses nothing.
const LEAST_VOLUME: f64 = 1e-12;

/// A connected, closed piece of a body's surface.
pub(super) struct Shell {
    /// Corners, consistently wound.
    faces: Vec<[DVec3; 3]>,
    bounds: [DVec3; 2],
    /// 1 where its faces look out of the volume that it encloses, −1 where into it, 0 where that is nothing.
    sign: i8,
    /// Number of other shells that hold it.
    depth: u32,
}

impl Shell {
    fn new(faces: Vec<[DVec3; 3]>) -> Self {
        let points: Vec<DVec3> = faces.iter().flatten().copied().collect();
        let bounds = bounds(&points);
        let sign = sign_of_volume(&faces, bounds);
        Self { faces, bounds, sign, depth: 0 }
    }

    /// Whether its faces look into the matter.
    pub(super) fn is_wrong(&self) -> bool {
        let right = if self.depth.is_multiple_of(2) { 1 } else { -1 };
        self.sign == -right
    }

    fn may_hold(&self, point: DVec3) -> bool {
        point.cmpge(self.bounds[0]).all() && point.cmple(self.bounds[1]).all()
    }
}

/// Take a body apart into its shells and find how deep each lies.
pub(super) fn find_shells(placed: &Placed, winding: &Winding) -> Vec<Shell> {
    let mut faces = vec![Vec::new(); winding.shells as usize];
    for (index, &shell) in winding.shell.iter().enumerate().filter(|&(_, &shell)| shell != edges::NONE) {
        let [a, b, c] = placed.corners(&placed.triangles[index]);
        faces[shell as usize].push(if winding.turned[index] { [a, c, b] } else { [a, b, c] });
    }
    let mut shells: Vec<Shell> = faces.into_par_iter().map(Shell::new).collect();
    let depths: Vec<u32> = (0..shells.len()).into_par_iter().map(|index| depth(index, &shells)).collect();
    shells.iter_mut().zip(depths).for_each(|(shell, depth)| shell.depth = depth);
    shells
}

/// The number of other shells that hold a shell, judged at the centre of a face that lies on none of them, or
/// is the farthest from doubt of those that are asked.
fn depth(index: usize, shells: &[Shell]) -> u32 {
    let faces = &shells[index].faces;
    let step = faces.len().div_ceil(WITNESSES).max(1);
    let mut best = (f64::INFINITY, 0);
    for [a, b, c] in faces.iter().step_by(step) {
        let (doubt, depth) = ask((a + b + c) / 3.0, index, shells);
        if doubt < best.0 {
            best = (doubt, depth);
        }
        if doubt < DOUBT {
            break;
        }
    }
    best.1
}

/// How far the winding numbers of the other shells around a point are from whole ones, at most, and how many
/// of them hold it.
fn ask(point: DVec3, index: usize, shells: &[Shell]) -> (f64, u32) {
    let others =
        shells.par_iter().enumerate().filter(|&(other, shell)| other != index && shell.may_hold(point));
    others
        .map(|(_, shell)| {
            let number = winding_number(point, shell.faces.iter().copied()).abs();
            ((number - number.round()).abs(), u32::from(number > 0.5))
        })
        .reduce(|| (0.0, 0), |a, b| (a.0.max(b.0), a.1 + b.1))
}

/// The sign of the enclosed volume by the divergence theorem: one sixth of the sum of a·(b × c).
fn sign_of_volume(faces: &[[DVec3; 3]], [lo, hi]: [DVec3; 2]) -> i8 {
    let centre = lo.midpoint(hi);
    let volume: f64 =
        faces.iter().map(|&[a, b, c]| (a - centre).dot((b - centre).cross(c - centre)) / 6.0).sum();
    let size = (hi - lo).element_product();
    match volume {
        v if v > size * LEAST_VOLUME => 1,
        v if v < -size * LEAST_VOLUME => -1,
        _ => 0,
    }
}
