//! The shells of a body, and how deep each lies within the others.

use glam::DVec3;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::edges;
use super::orient::Winding;
use super::place::{Placed, bounds};
use super::winding::winding_number;

/// How many faces of a shell are asked, at most, whether they lie within another …
const WITNESSES: usize = 64;

/// … and how many clear answers are enough.
const ANSWERS: usize = 8;

/// Around a closed shell winding numbers are whole, up to rounding, except on the shell itself: one farther
/// than this from a whole number is no clear answer.
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
    /// Whether it lies in part within another shell.
    crossing: bool,
}

impl Shell {
    fn new(faces: Vec<[DVec3; 3]>) -> Self {
        let points: Vec<DVec3> = faces.iter().flatten().copied().collect();
        let bounds = bounds(&points);
        let sign = sign_of_volume(&faces, bounds);
        Self { faces, bounds, sign, depth: 0, crossing: false }
    }

    /// Whether its faces look into the matter.
    pub(super) fn is_wrong(&self) -> bool {
        let right = if self.depth.is_multiple_of(2) { 1 } else { -1 };
        self.sign == -right
    }

    /// Whether part of it lies within a shell and part outside.
    pub(super) fn is_crossing(&self) -> bool {
        self.crossing
    }

    fn may_hold(&self, point: DVec3) -> bool {
        point.cmpge(self.bounds[0]).all() && point.cmple(self.bounds[1]).all()
    }

    fn may_meet(&self, other: &Self) -> bool {
        self.bounds[0].cmple(other.bounds[1]).all() && other.bounds[0].cmple(self.bounds[1]).all()
    }

    /// Points on some of its faces, by turns at the centre and near a corner, from all over it (multiples of the
    /// golden section are spread evenly).
    fn witnesses(&self) -> impl Iterator<Item = DVec3> {
        let count = self.faces.len();
        (0..WITNESSES.min(count)).map(move |k| {
            let place = (k as f64 * 0.618_033_988_749_894_9).fract() * count as f64;
            let [a, b, c] = self.faces[(place as usize).min(count - 1)];
            let centre = (a + b + c) / 3.0;
            if k % 2 == 0 { centre } else { a + (centre - a) / 16.0 }
        })
    }

    /// Where it lies as seen from another shell.
    fn relation(&self, other: &Self) -> Relation {
        let (mut inside, mut outside) = (0, 0);
        for point in self.witnesses() {
            if !other.may_hold(point) {
                outside += 1;
            } else {
                let number = winding_number(point, other.faces.iter().copied()).abs();
                let clear = (number - number.round()).abs() < DOUBT;
                inside += usize::from(clear && number > 0.5);
                outside += usize::from(clear && number < 0.5);
            }
            if inside + outside >= ANSWERS {
                break;
            }
        }
        match (inside, outside) {
            (0, _) => Relation::Outside,
            (_, 0) => Relation::Inside,
            _ => Relation::Across,
        }
    }
}

/// Where a shell lies as seen from another.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Relation {
    Outside,
    Inside,
    Across,
}

/// Take a body apart into its shells and find how deep each lies.
pub(super) fn find_shells(placed: &Placed, winding: &Winding) -> Vec<Shell> {
    let mut faces = vec![Vec::new(); winding.shells as usize];
    for (index, &shell) in winding.shell.iter().enumerate().filter(|&(_, &shell)| shell != edges::NONE) {
        let [a, b, c] = placed.corners(&placed.triangles[index]);
        faces[shell as usize].push(if winding.turned[index] { [a, c, b] } else { [a, b, c] });
    }
    let mut shells: Vec<Shell> = faces.into_par_iter().map(Shell::new).collect();
    let places: Vec<(u32, bool)> =
        (0..shells.len()).into_par_iter().map(|index| place(index, &shells)).collect();
    for (shell, (depth, crossing)) in shells.iter_mut().zip(places) {
        (shell.depth, shell.crossing) = (depth, crossing);
    }
    shells
}

/// How many other shells hold a shell, and whether it crosses one.
fn place(index: usize, shells: &[Shell]) -> (u32, bool) {
    let shell = &shells[index];
    let others =
        shells.iter().enumerate().filter(|&(other, candidate)| other != index && candidate.may_meet(shell));
    others.fold((0, false), |(depth, crossing), (_, other)| match shell.relation(other) {
        Relation::Outside => (depth, crossing),
        Relation::Inside => (depth + 1, crossing),
        Relation::Across => (depth, true),
    })
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
