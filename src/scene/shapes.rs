//! Built-in solids: tessellated, centred on the origin, closed, outward, with analytic normals.
//!
//! Faces that meet share the indices of their positions, seams and poles too: the meshes are watertight by
//! index. Normals and texture coordinates have indices of their own, so that they may break along an edge.

use super::document::Shape;
use super::table::Table;
use super::{Diagnostic, Mesh};

mod builder;
mod cuboid;
mod cylinder;
mod plane;
mod rounded_box;
mod sphere;
mod torus;

impl Shape {
    /// Its name in the scene file.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Shape::Sphere(_) => "sphere",
            Shape::Box(_) => "box",
            Shape::RoundedBox(_) => "rounded_box",
            Shape::Plane(_) => "plane",
            Shape::Cylinder(_) => "cylinder",
            Shape::Torus(_) => "torus",
        }
    }

    /// The solid with its level moved by so many steps, within its range; boxes and planes have none.
    pub(super) fn refined(mut self, steps: i32) -> Self {
        match &mut self {
            Shape::Sphere(Table(table)) => table.level = table.level.stepped(steps),
            Shape::RoundedBox(Table(table)) => table.level = table.level.stepped(steps),
            Shape::Cylinder(Table(table)) => table.level = table.level.stepped(steps),
            Shape::Torus(Table(table)) => table.level = table.level.stepped(steps),
            Shape::Box(_) | Shape::Plane(_) => {}
        }
        self
    }

    /// How many triangles its mesh has.
    pub(super) fn triangles(&self) -> usize {
        match self {
            Shape::Sphere(table) => 8 << (2 * table.level.0),
            Shape::Box(_) => 12,
            Shape::RoundedBox(table) => 12 * ((2 << table.level.0) + 1_usize).pow(2),
            Shape::Plane(_) => 2,
            Shape::Cylinder(table) => 16 << table.level.0,
            Shape::Torus(table) => 64 << (2 * table.level.0),
        }
    }

    /// Tessellate; all triangles have material 0.
    ///
    /// # Errors
    /// Measures that do not fit together, without a place.
    pub(super) fn mesh(&self) -> Result<Mesh, Diagnostic> {
        match self {
            Shape::Sphere(table) => Ok(sphere::mesh(table)),
            Shape::Box(table) => Ok(cuboid::mesh(table)),
            Shape::RoundedBox(table) => rounded_box::mesh(table),
            Shape::Plane(table) => Ok(plane::mesh(table)),
            Shape::Cylinder(table) => Ok(cylinder::mesh(table)),
            Shape::Torus(table) => torus::mesh(table),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::collections::HashMap;
    use std::f64::consts::PI;

    use glam::DVec3;

    use super::*;

    #[derive(serde::Deserialize)]
    struct Document {
        shape: Shape,
    }

    fn shape(shape: &str) -> Shape {
        toml::from_str::<Document>(&format!("shape = {{ {shape} }}")).unwrap().shape
    }

    fn mesh(text: &str) -> Result<Mesh, Diagnostic> {
        shape(text).mesh()
    }

    /// Signed volume by the divergence theorem.
    fn volume(mesh: &Mesh) -> f64 {
        let corner = |index: u32| mesh.positions[index as usize];
        mesh.triangles.iter().map(|t| t.positions.map(corner)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    fn is_closed(mesh: &Mesh) -> bool {
        let mut edges = HashMap::new();
        for [a, b, c] in mesh.triangles.iter().map(|triangle| triangle.positions) {
            for edge in [[a, b], [b, c], [c, a]] {
                *edges.entry(edge).or_insert(0) += 1;
            }
        }
        edges.iter().all(|(&[a, b], &count)| count == 1 && edges.get(&[b, a]) == Some(&1))
    }

    const SOLIDS: [(&str, usize, f64); 9] = [
        ("sphere = { radius = 2, level = 0 }", 8, 32.0 / 3.0),
        ("sphere = { radius = 2, level = 5 }", 8192, 32.0 / 3.0 * PI),
        ("box = { size = [1, 2, 3] }", 12, 6.0),
        ("rounded_box = { size = [2, 3, 4], radius = 0.5, level = 0 }", 108, 22.236),
        ("rounded_box = { size = [2, 3, 4], radius = 0.5, level = 4 }", 13068, 22.236),
        ("cylinder = { radius = 1, height = 3, level = 0 }", 16, 6.0),
        ("cylinder = { radius = 1, height = 3, level = 7 }", 2048, 3.0 * PI),
        ("torus = { major = 2, minor = 0.5, level = 0 }", 64, 5.657),
        ("torus = { major = 2, minor = 0.5, level = 5 }", 65536, PI * PI),
    ];

    #[test]
    fn the_number_of_triangles_is_known_before_they_are_made() {
        let plane = ("plane = { size = [1, 1] }", 2, 0.0);
        for (text, triangles, _) in SOLIDS.into_iter().chain([plane]) {
            assert_eq!(
                (shape(text).triangles(), mesh(text).unwrap().triangles.len()),
                (triangles, triangles)
            );
        }
    }

    #[test]
    fn solids_are_closed_outward_and_of_the_right_volume() {
        for (shape, triangles, expected) in SOLIDS {
            let mesh = mesh(shape).unwrap();
            assert_eq!(mesh.triangles.len(), triangles, "{shape}");
            assert!(is_closed(&mesh), "{shape}");
            let volume = volume(&mesh);
            assert!((volume / expected - 1.0).abs() < 0.09, "{shape}: {volume}");
            if triangles > 2000 || triangles == 12 {
                assert!((volume / expected - 1.0).abs() < 0.006, "{shape}: {volume}");
            }
        }
    }

    #[test]
    fn every_position_is_used_and_no_two_coincide() {
        for (shape, ..) in SOLIDS {
            let mesh = mesh(shape).unwrap();
            let mut places: Vec<_> =
                mesh.positions.iter().map(|p| (p + 0.0).to_array().map(f64::to_bits)).collect();
            places.sort_unstable();
            places.dedup();
            assert_eq!(places.len(), mesh.positions.len(), "{shape}");
            let mut used: Vec<_> = mesh.triangles.iter().flat_map(|triangle| triangle.positions).collect();
            used.sort_unstable();
            used.dedup();
            assert_eq!(used.len(), mesh.positions.len(), "{shape}");
        }
    }

    #[test]
    fn normals_are_of_unit_length_and_on_the_side_of_their_face() {
        for (shape, ..) in SOLIDS {
            let mesh = mesh(shape).unwrap();
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.positions.map(|index| mesh.positions[index as usize]);
                let face = (b - a).cross(c - a).normalize();
                assert!(face.is_finite(), "{shape}");
                for normal in triangle.normals.map(|index| mesh.normals[index as usize]) {
                    assert!((normal.length() - 1.0).abs() < 1e-12, "{shape}");
                    assert!(normal.dot(face) > 0.5, "{shape}");
                }
            }
        }
    }

    #[test]
    fn texture_coordinates_do_not_jump_across_a_face() {
        for (shape, ..) in SOLIDS {
            let mesh = mesh(shape).unwrap();
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.uvs.map(|index| mesh.uvs[index as usize]);
                assert!((b - a).abs().max_element() <= 1.0 && (c - a).abs().max_element() <= 1.0, "{shape}");
                let fine =
                    mesh.triangles.len() > 2000 && !shape.starts_with("rounded") && !shape.starts_with("cyl");
                assert!(!fine || (b - a).abs().max_element() < 0.2, "{shape}");
            }
        }
    }

    #[test]
    fn a_finer_level_has_more_triangles_and_the_range_is_kept() {
        let triangles = |shape: &str, steps| {
            let document: Document = toml::from_str(&format!("shape = {{ {shape} }}")).unwrap();
            document.shape.refined(steps).mesh().unwrap().triangles.len()
        };
        let sphere = "sphere = { radius = 1, level = 3 }";
        assert_eq!([-1, 0, 1, -9].map(|steps| triangles(sphere, steps)), [128, 512, 2048, 8]);
        assert_eq!(triangles("box = { size = [1, 2, 3] }", 3), 12);
    }

    #[test]
    fn a_sphere_lies_on_its_radius() {
        let mesh = mesh("sphere = { radius = 3, level = 4 }").unwrap();
        assert!(mesh.positions.iter().all(|p| (p.length() - 3.0).abs() < 1e-14));
        assert!(mesh.positions.contains(&DVec3::new(0.0, 3.0, 0.0)));
    }

    #[test]
    fn a_plane_faces_up_and_repeats_its_texture() {
        let mesh = mesh("plane = { size = [4, 2], uv_repeat = [8, 4] }").unwrap();
        assert_eq!(mesh.normals, [DVec3::Y]);
        assert!(mesh.positions.iter().all(|p| p.abs() == DVec3::new(2.0, 0.0, 1.0)));
        let [a, b, c] = mesh.triangles[0].positions.map(|index| mesh.positions[index as usize]);
        assert!((b - a).cross(c - a).y > 0.0);
        assert!(mesh.uvs.contains(&glam::DVec2::new(8.0, 4.0)));
    }

    #[test]
    fn measures_that_do_not_fit_are_refused() {
        for shape in [
            "torus = { major = 1, minor = 1 }",
            "rounded_box = { size = [1, 2, 3], radius = 0.5 }",
            "rounded_box = { size = [1, 2, 3], radius = 0.7 }",
        ] {
            assert!(mesh(shape).unwrap_err().hint.is_some(), "{shape}");
        }
    }
}
