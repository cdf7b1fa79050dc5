//! The shells of a body, and how deep each lies within the others.

use glam::DVec3;
use rayon::iter::{IntoParallelRefMutIterator, ParallelIterator};

use super::edges;
use super::faces::corners;
use super::flood::Winding;
use super::number::narrow3;
use super::pierce::Lines;
use super::place::{Placed, bounds};
use crate::bvh::BvhError;
use crate::layout::Triangle;

/// How many points of a shell are asked, at most, which others hold them …
const WITNESSES: usize = 64;

/// … and how many clear answers are enough.
const ANSWERS: usize = 8;

/// Volumes below this part of the shell's box are rounding: such a shell encloses nothing.
const LEAST_VOLUME: f64 = 1e-12;

/// A connected, closed piece of a body's surface.
pub(super) struct Shell {
    /// Its number.
    index: u32,
    /// Its faces, consistently wound.
    faces: Vec<u32>,
    /// 1 where its faces look out of the volume that it encloses, −1 where into it, 0 where that is nothing.
    sign: i8,
    /// Number of other shells that hold it.
    depth: usize,
    /// Whether it lies in part within another shell.
    crossing: bool,
}

impl Shell {
    /// Whether its faces look into the matter.
    pub(super) fn is_wrong(&self) -> bool {
        let right = if self.depth.is_multiple_of(2) { 1 } else { -1 };
        self.sign == -right
    }

    /// Whether part of it lies within another shell and part outside.
    pub(super) fn is_crossing(&self) -> bool {
        self.crossing
    }

    /// Find the shells that hold it: those that hold every witness. A witness that touches another shell is not
    /// asked; where all do, the shell coincides with others and is held by none.
    fn settle(&mut self, faces: &[Triangle], lines: &Lines) {
        let answers = self.witnesses(faces).filter_map(|point| self.holders(point, lines));
        let answers: Vec<Vec<u32>> = answers.take(ANSWERS).collect();
        let Some(first) = answers.first() else { return };
        let in_all = |shell: &&u32| answers.iter().all(|holders| holders.contains(shell));
        self.depth = first.iter().filter(in_all).count();
        self.crossing = answers.iter().any(|holders| holders.len() > self.depth);
    }

    /// Points on some of its faces, by turns at the centre and near a corner, from all over it (multiples of the
    /// golden section are spread evenly).
    fn witnesses(&self, faces: &[Triangle]) -> impl Iterator<Item = DVec3> {
        let count = self.faces.len();
        (0..WITNESSES.min(count)).map(move |k| {
            let place = (k as f64 * 0.618_033_988_749_894_9).fract() * count as f64;
            let [a, b, c] = corners(&faces[self.faces[place as usize] as usize]);
            let centre = (a + b + c) / 3.0;
            if k % 2 == 0 { centre } else { a + (centre - a) / 16.0 }
        })
    }

    /// The other shells that hold a point; `None` where it touches one.
    fn holders(&self, point: DVec3, lines: &Lines) -> Option<Vec<u32>> {
        let mut crossings = lines.pierce(point);
        crossings.retain(|crossing| crossing.shell != self.index);
        let clear = crossings.iter().all(|crossing| !crossing.touches);
        let holding = crossings.iter().filter(|crossing| crossing.winding != 0);
        clear.then(|| holding.map(|crossing| crossing.shell).collect())
    }
}

/// Take a body apart into its shells and find how deep each lies.
pub(super) fn find_shells(placed: &Placed, winding: &Winding) -> Result<Vec<Shell>, BvhError> {
    let faces = wound_faces(placed, winding);
    let mut members = vec![Vec::new(); winding.shells as usize];
    faces.iter().zip(0..).for_each(|(face, index)| members[face.id as usize].push(index));
    let shell = |(index, own): (u32, Vec<u32>)| {
        let sign = sign_of_volume(own.iter().map(|&face| corners(&faces[face as usize])));
        Shell { index, faces: own, sign, depth: 0, crossing: false }
    };
    let mut shells: Vec<Shell> = (0..).zip(members).map(shell).collect();
    if shells.len() > 1 {
        let lines = Lines::new(&faces)?;
        shells.par_iter_mut().for_each(|shell| shell.settle(&faces, &lines));
    }
    Ok(shells)
}

/// The faces of all shells, with the shell for an id.
fn wound_faces(placed: &Placed, winding: &Winding) -> Vec<Triangle> {
    let positions: Vec<[f32; 3]> = placed.positions.iter().map(|&position| narrow3(position)).collect();
    let wound = placed.triangles.iter().zip(&winding.shell).zip(&winding.turned);
    wound
        .filter(|&((_, &shell), _)| shell != edges::NONE)
        .map(|((triangle, &id), &turned)| {
            let [v0, v1, v2] = triangle.positions.map(|index| positions[index as usize]);
            let (v1, v2) = if turned { (v2, v1) } else { (v1, v2) };
            Triangle { v0, id, v1, reserved1: 0, v2, reserved2: 0 }
        })
        .collect()
}

/// The sign of the enclosed volume by the divergence theorem: one sixth of the sum of a·(b × c).
fn sign_of_volume(faces: impl Iterator<Item = [DVec3; 3]> + Clone) -> i8 {
    let [lo, hi] = bounds(faces.clone().flatten());
    let centre = lo.midpoint(hi);
    let volume: f64 = faces.map(|[a, b, c]| (a - centre).dot((b - centre).cross(c - centre)) / 6.0).sum();
    let size = (hi - lo).element_product();
    match volume {
        v if v > size * LEAST_VOLUME => 1,
        v if v < -size * LEAST_VOLUME => -1,
        _ => 0,
    }
}
