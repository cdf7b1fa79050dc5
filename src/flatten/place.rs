//! A model in world space, before its copies.

use std::collections::HashMap;

use glam::{DMat3, DVec3};

use super::number::{MAX_COORDINATE, narrow3};
use crate::scene::{Diagnostic, Model, SceneError, Triangle};

/// A model's mesh in world space: what topology and shading normals are computed from.
pub(super) struct Placed<'a> {
    /// Where it came from.
    pub(super) model: &'a Model,
    /// World positions of the first copy, not rounded yet.
    pub(super) positions: Vec<DVec3>,
    /// World normals of the file; not finite where a normal cannot be used.
    pub(super) normals: Vec<DVec3>,
    /// Counter-clockwise from outside, mirrored models too.
    pub(super) triangles: Vec<Triangle>,
}

impl<'a> Placed<'a> {
    /// Place a model.
    ///
    /// # Errors
    /// A coordinate of any copy is beyond [`MAX_COORDINATE`].
    pub(super) fn new(model: &'a Model) -> Result<Self, SceneError> {
        let linear = model.world_from_object.matrix3;
        let positions: Vec<DVec3> =
            model.mesh.positions.iter().map(|&p| model.world_from_object.transform_point3(p)).collect();
        check_range(model, &positions)?;
        // Normals go with the inverse transpose, which also keeps them outward through a mirror.
        let normal_matrix: DMat3 = linear.inverse().transpose();
        let normals = model.mesh.normals.iter().map(|&n| (normal_matrix * n).normalize()).collect();
        let mut triangles = model.mesh.triangles.clone();
        // A mirror turns counter-clockwise into clockwise.
        if linear.determinant() < 0.0 {
            triangles.iter_mut().for_each(reverse);
        }
        Ok(Self { model, positions, normals, triangles })
    }

    /// The displacement of every copy, the first (none) included, the last axis fastest.
    pub(super) fn copies(&self) -> impl Iterator<Item = DVec3> {
        let (count, step) = (self.model.repeat.count, self.model.repeat.step);
        let indices = (0..count[0]).flat_map(move |x| {
            (0..count[1])
                .flat_map(move |y| (0..count[2]).map(move |z| DVec3::new(x.into(), y.into(), z.into())))
        });
        indices.map(move |index| index * step)
    }

    /// Least and greatest corner of the first copy.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        bounds(self.positions.iter().copied())
    }

    /// World positions of a triangle's corners.
    pub(super) fn corners(&self, triangle: &Triangle) -> [DVec3; 3] {
        triangle.positions.map(|index| self.positions[index as usize])
    }

    /// Each triangle by its vertices, where vertices whose rounded positions are equal bit for bit are one:
    /// the lowest of them.
    pub(super) fn welded(&self) -> Vec<[u32; 3]> {
        let mut first_at = HashMap::with_capacity(self.positions.len());
        let vertex: Vec<u32> = (0..)
            .zip(&self.positions)
            .map(|(index, &p)| *first_at.entry(narrow3(p).map(f32::to_bits)).or_insert(index))
            .collect();
        self.triangles.iter().map(|t| t.positions.map(|index| vertex[index as usize])).collect()
    }
}

/// Turn a triangle's winding.
pub(super) fn reverse(triangle: &mut Triangle) {
    triangle.positions.swap(1, 2);
    triangle.normals.swap(1, 2);
    triangle.uvs.swap(1, 2);
}

/// Least and greatest corner; inverted where there are no points.
pub(super) fn bounds(points: impl IntoIterator<Item = DVec3>) -> [DVec3; 2] {
    points.into_iter().fold([DVec3::MAX, DVec3::MIN], |[lo, hi], p| [lo.min(p), hi.max(p)])
}

fn check_range(model: &Model, positions: &[DVec3]) -> Result<(), SceneError> {
    let last = model.repeat.step * DVec3::from_array(model.repeat.count.map(|count| f64::from(count) - 1.0));
    let [lo, hi] = bounds(positions.iter().copied());
    let reach = [lo, hi, lo + last, hi + last].map(|corner| corner.abs().max_element());
    // An empty mesh reaches nowhere; written so that NaN fails.
    if positions.is_empty() || reach.iter().all(|&reach| reach <= MAX_COORDINATE) {
        return Ok(());
    }
    let message = format!("model `{}` reaches beyond ±{MAX_COORDINATE:.2e}", model.name);
    Err(super::at(Diagnostic::error(message), model)
        .hint("scale the scene down: only proportions matter to the picture")
        .into())
}
