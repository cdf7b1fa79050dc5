//! Wavefront OBJ meshes (Advanced Visualizer manual, appendix B1): polygons with their materials' names.
//!
//! Read: `v vt vn f usemtl mtllib`. Passed over: groups, smoothing groups, points, lines, free-form geometry
//! and display attributes.
//!
//! The crate tobj reads the data, but its errors name no line and it stumbles over legal text, so a [`scan`]
//! proves every statement first and hands it on in its plainest form. The scan keeps groups and materials to
//! itself, for at them tobj would split the mesh and its shared vertices, and a body is closed only as a whole.

use glam::{DVec2, DVec3};

use super::source::Source;
use super::statement::Reference;
use super::{Diagnostic, Mesh, SceneError, Triangle, polygon};
use proven::Proven;
use scan::Run;

mod proven;
mod scan;

/// What an OBJ file holds.
#[derive(Debug)]
pub(super) struct Obj {
    /// Every polygon, cut into triangles; [`Triangle::material`] indexes `slots`.
    pub(super) mesh: Mesh,
    /// Materials by name, in the order of their first face; `None` for faces before any `usemtl`.
    pub(super) slots: Vec<Option<Reference>>,
    /// The `mtllib` statements.
    pub(super) libraries: Vec<Reference>,
}

/// Read a mesh: the vertices that its faces use, in the order of their first use, and the faces.
///
/// # Errors
/// Every fault of the file, with its line and column: see the tests.
pub(super) fn parse(source: &Source) -> Result<Obj, SceneError> {
    let mut proven = Proven::new(source);
    let options = tobj::LoadOptions { single_index: false, triangulate: false, ..Default::default() };
    let loaded = tobj::load_obj_buf(&mut proven, &options, |_| Ok(Default::default()));
    // A fault of the file comes to tobj as a failure to read: the scan knows better.
    let scan = proven.into_scan()?;
    let (models, _) = loaded.map_err(|error| {
        Diagnostic::error(format!("cannot read {}: {error}", source.path.display())).at(source.locate(0..0))
    })?;
    let mesh = models.into_iter().next().map(|model| cut(&model.mesh, &scan.runs)).unwrap_or_default();
    if mesh.triangles.is_empty() {
        let fault = Diagnostic::error(format!("{} has no faces", source.path.display()))
            .at(source.locate(0..0))
            .hint("a mesh needs at least one `f` statement");
        return Err(fault.into());
    }
    Ok(Obj { mesh, slots: scan.slots, libraries: scan.libraries })
}

/// Cut the faces into triangles.
fn cut(faces: &tobj::Mesh, runs: &[Run]) -> Mesh {
    let normal = |normal: &[f64]| DVec3::from_slice(normal).normalize_or_zero();
    let mut mesh = Mesh {
        positions: faces.positions.chunks_exact(3).map(DVec3::from_slice).collect(),
        normals: faces.normals.chunks_exact(3).map(normal).collect(),
        uvs: faces.texcoords.chunks_exact(2).map(DVec2::from_slice).collect(),
        triangles: Vec::with_capacity(faces.indices.len() / 3),
    };
    // tobj leaves the arities out where all are 3.
    let mut arities = faces.face_arities.iter().map(|&arity| arity as usize).chain(std::iter::repeat(3));
    let mut first = 0;
    for run in runs {
        for arity in arities.by_ref().take(run.faces) {
            if arity == 3 {
                let triangle = triangle(faces, run, &mesh.normals, [first, first + 1, first + 2]);
                mesh.triangles.push(triangle);
            } else {
                let corner = |&index: &u32| mesh.positions[index as usize];
                let corners: Vec<_> = faces.indices[first..first + arity].iter().map(corner).collect();
                for corners in polygon::triangulate(&corners) {
                    let triangle = triangle(faces, run, &mesh.normals, corners.map(|corner| first + corner));
                    mesh.triangles.push(triangle);
                }
            }
            first += arity;
        }
    }
    mesh
}

/// The triangle of three corners of a face, which index tobj's lists.
fn triangle(faces: &tobj::Mesh, run: &Run, normals: &[DVec3], corners: [usize; 3]) -> Triangle {
    let absent = [Triangle::NONE; 3];
    // Where a face gives no texture coordinates or normals and others do, tobj invents some.
    let uvs = if run.style.has_uvs { corners.map(|corner| faces.texcoord_indices[corner]) } else { absent };
    let own = if run.style.has_normals { corners.map(|corner| faces.normal_indices[corner]) } else { absent };
    // Some writers give a normal of length 0 where they know none.
    let is_known = |&index: &u32| normals.get(index as usize).is_some_and(|normal| *normal != DVec3::ZERO);
    Triangle {
        positions: corners.map(|corner| faces.indices[corner]),
        normals: if own.iter().all(is_known) { own } else { absent },
        uvs,
        material: run.slot,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
