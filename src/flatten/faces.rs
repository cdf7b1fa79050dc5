//! From placed models to triangles and what a hit needs to know about them.

use bytemuck::Zeroable;
use glam::DVec3;

use super::materials::Rows;
use super::normals::{CornerNormals, face_normal};
use super::number::{narrow, narrow3, widen3};
use super::place::Placed;
use crate::layout::{Attribute, Triangle};
use crate::scene;

/// Triangles in the order of their ids, with attributes and texture coordinates.
#[derive(Default)]
pub(super) struct Faces {
    pub(super) triangles: Vec<Triangle>,
    pub(super) attributes: Vec<Attribute>,
    pub(super) uvs: Vec<[f32; 2]>,
}

impl Faces {
    /// Append every copy of a model, and tell how many of its triangles have no area in f32 and are left out.
    ///
    /// The copies share their texture coordinates, which say nothing about places.
    pub(super) fn append(
        &mut self,
        placed: &Placed,
        normals: &[Option<CornerNormals>],
        body: u32,
        rows: &Rows,
    ) -> usize {
        let templates: Vec<Attribute> = placed
            .triangles
            .iter()
            .zip(normals)
            .map(|(triangle, &normals)| self.template(placed, triangle, normals, body, rows))
            .collect();
        let before = self.triangles.len();
        let mut copies = 0;
        for displacement in placed.copies() {
            self.append_copy(placed, displacement, &templates);
            copies += 1;
        }
        copies * templates.len() - (self.triangles.len() - before)
    }

    /// Give an empty scene its one triangle: without area at the origin, nothing hits it.
    pub(super) fn append_nothing(&mut self) {
        self.triangles.push(Triangle::zeroed());
        self.attributes.push(Attribute {
            normal: [0.0, 1.0, 0.0],
            other: Attribute::NONE,
            uvs: Attribute::NONE,
            ..Attribute::zeroed()
        });
    }

    /// What all copies of a triangle have in common; appends its texture coordinates where it needs any.
    fn template(
        &mut self,
        placed: &Placed,
        triangle: &scene::Triangle,
        normals: Option<CornerNormals>,
        body: u32,
        rows: &Rows,
    ) -> Attribute {
        let id = placed.model.materials[triangle.material as usize];
        let uvs = if rows.is_textured(id) { self.append_uvs(placed, triangle) } else { Attribute::NONE };
        let [normal0, normal1, normal2] = normals.unwrap_or_default();
        Attribute {
            normal: [0.0; 3],
            material: rows.row(id),
            normal0,
            body,
            normal1,
            other: Attribute::NONE,
            normal2,
            uvs,
        }
    }

    /// A triangle without coordinates appends none: it takes the texture's lower left corner.
    fn append_uvs(&mut self, placed: &Placed, triangle: &scene::Triangle) -> u32 {
        let uvs = triangle.uvs.map(|index| placed.model.mesh.uvs.get(index as usize));
        let [Some(uv0), Some(uv1), Some(uv2)] = uvs else { return Attribute::NONE };
        let first = self.uvs.len() as u32;
        self.uvs.extend([uv0, uv1, uv2].map(|uv| [narrow(uv.x), narrow(uv.y)]));
        first
    }

    fn append_copy(&mut self, placed: &Placed, displacement: DVec3, templates: &[Attribute]) {
        let positions: Vec<[f32; 3]> = placed.positions.iter().map(|&p| narrow3(p + displacement)).collect();
        for (triangle, template) in placed.triangles.iter().zip(templates) {
            let [v0, v1, v2] = triangle.positions.map(|index| positions[index as usize]);
            let normal = face_normal([v0, v1, v2].map(widen3));
            if normal != DVec3::ZERO {
                let id = self.triangles.len() as u32;
                self.triangles.push(Triangle { v0, id, v1, reserved1: 0, v2, reserved2: 0 });
                self.attributes.push(Attribute { normal: narrow3(normal), ..*template });
            }
        }
    }
}

/// The corners of a triangle, exactly.
pub(super) fn corners(triangle: &Triangle) -> [DVec3; 3] {
    [triangle.v0, triangle.v1, triangle.v2].map(widen3)
}
