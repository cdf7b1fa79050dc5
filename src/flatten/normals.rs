//! Shading normals of a model's corners.

use glam::DVec3;

use super::edges;
use super::number::narrow3;
use super::place::Placed;
use crate::scene::{Normals, Triangle};

/// Normals closer than this to the face's (in radians) are the face's.
const FLAT: f64 = 1e-6;

/// Unit normals of a triangle's corners, rounded.
pub(super) type CornerNormals = [[f32; 3]; 3];

/// The shading normals of every triangle's corners, on the side of the face normal; `None` for a flat triangle.
pub(super) fn shading_normals(placed: &Placed) -> Vec<Option<CornerNormals>> {
    let faces: Vec<DVec3> = placed.triangles.iter().map(|t| face_normal(placed.corners(t))).collect();
    match placed.model.normals {
        Normals::Flat => vec![None; faces.len()],
        Normals::File => {
            let of_file = |(triangle, &face): (&Triangle, &DVec3)| {
                let normals = file_normals(placed, triangle)?;
                settle(normals, face)
            };
            placed.triangles.iter().zip(&faces).map(of_file).collect()
        }
        Normals::Crease(degrees) => {
            let averaged = crease_normals(placed, &faces, degrees);
            averaged.into_iter().zip(&faces).map(|(normals, &face)| settle(normals, face)).collect()
        }
    }
}

/// The unit normal of a triangle, to the side from which its corners run counter-clockwise; zero for a
/// triangle without area.
pub(super) fn face_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// The file's normals at a triangle's corners, if it has any.
fn file_normals(placed: &Placed, triangle: &Triangle) -> Option<[DVec3; 3]> {
    let present = triangle.normals.iter().all(|&index| index != Triangle::NONE);
    present.then(|| triangle.normals.map(|index| placed.normals[index as usize]))
}

/// Replace what cannot be used by the face normal, and turn the rest to its side; `None` where nothing but
/// the face normal is left.
fn settle(normals: [DVec3; 3], face: DVec3) -> Option<CornerNormals> {
    let settled = normals.map(|normal| {
        if !normal.is_finite() || normal == DVec3::ZERO {
            face
        } else if normal.dot(face) < 0.0 {
            -normal
        } else {
            normal
        }
    });
    settled.iter().any(|normal| normal.distance(face) > FLAT).then(|| settled.map(narrow3))
}

/// Average face normals around each vertex, weighted by the angle of the face there (Thürmer and Wüthrich
/// 1998, "Computing vertex normals from polygonal facets"), over fans of faces that meet at less than the
/// crease angle.
fn crease_normals(placed: &Placed, faces: &[DVec3], degrees: f64) -> Vec<[DVec3; 3]> {
    let triangles = placed.welded();
    let sides = edges::join(&triangles, &placed.positions);
    let least_cosine = degrees.to_radians().cos();
    let mut fans = Fans::new(triangles.len() * 3);
    for (side, &partner) in (0_u32..).zip(&sides.partner) {
        let smooth = |&partner: &u32| {
            edges::agree(&triangles, side, partner)
                && faces[side as usize / 3].dot(faces[partner as usize / 3]) > least_cosine
        };
        if side < partner && partner != edges::NONE && smooth(&partner) {
            // The side's first corner lies at the partner's second, and the other way round.
            fans.join(side, next_corner(partner));
            fans.join(next_corner(side), partner);
        }
    }
    let mut sums = vec![DVec3::ZERO; triangles.len() * 3];
    for (index, (triangle, &face)) in placed.triangles.iter().zip(faces).enumerate() {
        let corners = placed.corners(triangle);
        for corner in 0..3 {
            sums[fans.root((index * 3 + corner) as u32) as usize] += face * angle_at(corners, corner);
        }
    }
    (0..triangles.len())
        .map(|index| {
            [0, 1, 2].map(|corner| sums[fans.root((index * 3 + corner) as u32) as usize].normalize_or_zero())
        })
        .collect()
}

/// The corner at the end of a side.
fn next_corner(side: u32) -> u32 {
    side / 3 * 3 + (side + 1) % 3
}

/// The angle of a triangle at a corner, in radians; 0 where a side has no length.
fn angle_at(corners: [DVec3; 3], corner: usize) -> f64 {
    let [p, q, r] = [0, 1, 2].map(|k| corners[(corner + k) % 3]);
    let (a, b) = (q - p, r - p);
    a.cross(b).length().atan2(a.dot(b))
}

/// Disjoint sets of corners (Tarjan 1975), with path halving.
struct Fans {
    parent: Vec<u32>,
}

impl Fans {
    fn new(corners: usize) -> Self {
        Self { parent: (0..corners as u32).collect() }
    }

    fn root(&mut self, mut corner: u32) -> u32 {
        while self.parent[corner as usize] != corner {
            let grandparent = self.parent[self.parent[corner as usize] as usize];
            self.parent[corner as usize] = grandparent;
            corner = grandparent;
        }
        corner
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::flatten::samples::{STONE, cube, flattened, model};
    use crate::scene::{Mesh, Model};

    /// Three for each smooth face.
    fn corner_normals(mesh: Mesh, normals: Normals) -> Vec<[f32; 3]> {
        let flat = flattened(vec![Model { normals, ..model("it", mesh, STONE) }]).unwrap().scene;
        let smooth = flat.attributes.iter().filter(|face| face.is_smooth());
        smooth.flat_map(|face| [face.normal0, face.normal1, face.normal2]).collect()
    }

    /// A cube whose every face has the given normal, by face.
    fn with_normals(normal: impl Fn(usize) -> DVec3) -> Mesh {
        let mut mesh = cube(1.0);
        mesh.normals = (0..12).map(normal).collect();
        mesh.triangles.iter_mut().zip(0..).for_each(|(triangle, index)| triangle.normals = [index; 3]);
        mesh
    }

    #[test]
    fn a_cube_stays_flat_below_its_crease_and_is_rounded_above() {
        assert!(corner_normals(cube(1.0), Normals::Crease(30.0)).is_empty());
        assert!(corner_normals(cube(1.0), Normals::Crease(90.0)).is_empty());
        let rounded = corner_normals(cube(1.0), Normals::Crease(120.0));
        assert_eq!(rounded.len(), 36);
        // Weighted by angle, the diagonals of the faces do not show: normals point along the corners.
        let third = (1.0_f32 / 3.0).sqrt();
        for component in rounded.iter().flatten() {
            assert!((component.abs() - third).abs() < 1e-6, "{component}");
        }
    }

    #[test]
    fn the_normals_of_the_file_are_kept_where_they_can_be_used() {
        let slanted = DVec3::new(0.5, 0.5, 0.5).normalize();
        assert_eq!(corner_normals(with_normals(|_| slanted), Normals::File).len(), 36);
        assert!(corner_normals(with_normals(|_| slanted), Normals::Flat).is_empty());
        assert!(corner_normals(cube(1.0), Normals::File).is_empty());
    }

    #[test]
    fn normals_of_no_length_or_no_number_fall_back_to_the_face() {
        for broken in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
            assert!(corner_normals(with_normals(|_| broken), Normals::File).is_empty());
        }
    }

    #[test]
    fn normals_of_the_file_are_turned_to_the_face_and_with_the_model() {
        let mesh = with_normals(|_| DVec3::new(0.1, 0.2, 1.0).normalize());
        let quarter = glam::DAffine3::from_rotation_y(std::f64::consts::FRAC_PI_2);
        let turned = Model { world_from_object: quarter, normals: Normals::File, ..model("it", mesh, STONE) };
        let flat = flattened(vec![turned]).unwrap().scene;
        for face in &*flat.attributes {
            let corner = face.normal0;
            assert!(corner.iter().zip(face.normal).map(|(a, b)| a * b).sum::<f32>() > 0.0);
            assert!(corner[0].abs() > 0.9, "{corner:?}");
        }
    }
}
