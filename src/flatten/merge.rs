//! Exactly coincident faces become one.
//!
//! Two faces coincide where their corners are the same three points bit for bit, in any order. A ray must meet
//! them as one interface: from one body's matter into the other's, not through a gap of air of no thickness.

use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;

use super::bodies::Bodies;
use super::faces::Faces;
use crate::layout::{Attribute, Material, Triangle};

/// What was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Merged {
    /// Faces of two bodies that became one interface, or of which an opaque one was kept.
    pub interfaces: usize,
    /// Faces that a body had more than once, or that cut its own matter in two, and that were left out.
    pub duplicates: usize,
    /// Places where more than two transmissive bodies share a face.
    pub crowded: usize,
}

/// Merge coincident faces and number what is left from 0.
///
/// Within a transmissive body faces that look in opposite directions cancel, since matter lies on both sides
/// of them; of others, and within an opaque body, the first stays. Between bodies an opaque face stays alone;
/// else the face of the body that wins by priority stays and names the other. Either takes the lowest id of
/// all. More than two transmissive bodies are merged pair by pair.
pub(super) fn merge(faces: &mut Faces, bodies: &Bodies, materials: &[Material]) -> Merged {
    let mut merged = Merged::default();
    let mut gone = vec![false; faces.triangles.len()];
    let mut by_place = keys(&faces.triangles);
    by_place.par_sort_unstable();
    for group in by_place.chunk_by_mut(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        // Equal hashes: sort by the places themselves, then by id.
        let place = |&(_, id): &(u64, u32)| sorted_corners(&faces.triangles[id as usize]);
        group.sort_unstable_by_key(|entry| (place(entry), entry.1));
        let same: Vec<Vec<u32>> = group
            .chunk_by(|a, b| place(a) == place(b))
            .map(|same| same.iter().map(|&(_, id)| id).collect())
            .collect();
        for ids in same.iter().filter(|ids| ids.len() > 1) {
            resolve(faces, ids, bodies, materials, &mut gone, &mut merged);
        }
    }
    drop_gone(faces, &gone);
    merged
}

/// Decide about faces in one place, given by ascending ids.
fn resolve(
    faces: &mut Faces,
    ids: &[u32],
    bodies: &Bodies,
    materials: &[Material],
    gone: &mut [bool],
    merged: &mut Merged,
) {
    let kept = one_for_each_body(faces, ids, bodies);
    merged.duplicates += ids.len() - kept.len();
    ids.iter().for_each(|&id| gone[id as usize] = true);
    // Opaque faces first, then by priority.
    let opaque = |id: u32| {
        materials[faces.attributes[id as usize].material as usize].transmission.iter().all(|&k| k <= 0.0)
    };
    let mut kept: Vec<(bool, u32, u32)> =
        kept.into_iter().map(|id| (!opaque(id), faces.attributes[id as usize].body, id)).collect();
    kept.sort_unstable();
    let records: Vec<(Triangle, Attribute)> = match kept.as_slice() {
        [(false, _, governing), others @ ..] => {
            merged.interfaces += others.len();
            vec![record(faces, *governing, None)]
        }
        transmissive => {
            merged.crowded += usize::from(transmissive.len() > 2);
            merged.interfaces += transmissive.len() / 2;
            let pairs = transmissive.chunks(2);
            pairs.map(|pair| record(faces, pair[0].2, pair.get(1).map(|other| other.2))).collect()
        }
    };
    for (&id, (triangle, attribute)) in ids.iter().zip(records) {
        faces.triangles[id as usize] = triangle;
        faces.attributes[id as usize] = attribute;
        gone[id as usize] = false;
    }
}

/// The faces that stay within each body.
fn one_for_each_body(faces: &Faces, ids: &[u32], bodies: &Bodies) -> Vec<u32> {
    let body = |id: u32| faces.attributes[id as usize].body;
    let turn = |id: u32| is_even(&faces.triangles[id as usize]);
    let mut by_body = ids.to_vec();
    by_body.sort_by_key(|&id| body(id));
    let of_body = |own: &[u32]| {
        if !bodies.is_transmissive(body(own[0])) {
            return Some(own[0]);
        }
        let even = own.iter().filter(|&&id| turn(id)).count();
        let odd = own.len() - even;
        if even == odd { None } else { own.iter().copied().find(|&id| turn(id) == (even > odd)) }
    };
    by_body.chunk_by(|&a, &b| body(a) == body(b)).filter_map(of_body).collect()
}

/// A governing face, with the second body where there is one.
fn record(faces: &Faces, governing: u32, other: Option<u32>) -> (Triangle, Attribute) {
    let triangle = faces.triangles[governing as usize];
    let mut attribute = faces.attributes[governing as usize];
    if let Some(other) = other {
        let opposite = is_even(&triangle) != is_even(&faces.triangles[other as usize]);
        attribute.other =
            faces.attributes[other as usize].body | if opposite { Attribute::OPPOSITE } else { 0 };
    }
    (triangle, attribute)
}

/// Close the gaps and number anew.
fn drop_gone(faces: &mut Faces, gone: &[bool]) {
    let mut stays = gone.iter().map(|gone| !gone);
    faces.attributes.retain(|_| stays.next().unwrap_or(true));
    let mut stays = gone.iter().map(|gone| !gone);
    faces.triangles.retain(|_| stays.next().unwrap_or(true));
    faces.triangles.iter_mut().zip(0..).for_each(|(triangle, id)| triangle.id = id);
}

/// A hash of each triangle's place, the same for any order of corners, with its id.
fn keys(triangles: &[Triangle]) -> Vec<(u64, u32)> {
    let key = |(id, triangle): (usize, &Triangle)| {
        let hash = corners(triangle).iter().fold(0_u64, |sum, corner| sum.wrapping_add(hash(corner)));
        (hash, id as u32)
    };
    triangles.par_iter().enumerate().map(key).collect()
}

/// SplitMix64's finaliser (Steele, Lea, Flood 2014) over the words of a point.
fn hash(corner: &[u32; 3]) -> u64 {
    corner.iter().fold(0, |hash: u64, &word| {
        let mut z = (hash ^ u64::from(word)).wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    })
}

fn corners(triangle: &Triangle) -> [[u32; 3]; 3] {
    [triangle.v0, triangle.v1, triangle.v2].map(|corner| corner.map(f32::to_bits))
}

fn sorted_corners(triangle: &Triangle) -> [[u32; 3]; 3] {
    let mut corners = corners(triangle);
    corners.sort_unstable();
    corners
}

/// Whether the corners are an even permutation of the sorted ones: coincident faces look to the same side
/// where this is equal.
fn is_even(triangle: &Triangle) -> bool {
    let [a, b, c] = corners(triangle);
    (a < b) ^ (b < c) ^ (a < c)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::flatten::samples::{ICE, STONE, WATER, cube, cuboid, flattened, joined, model};
    use crate::flatten::start_media;
    use crate::layout::FlatScene;
    use crate::scene::{MaterialId, Mesh, Model, Repeat};

    fn unit(x: f64) -> Mesh {
        cuboid(DVec3::new(x, 0.0, 0.0), DVec3::new(x + 1.0, 1.0, 1.0))
    }

    fn merged(models: Vec<Model>) -> (FlatScene, Merged) {
        let flat = flattened(models).unwrap();
        let ids: Vec<u32> = flat.scene.triangles.iter().map(|triangle| triangle.id).collect();
        assert!((0..flat.scene.attributes.len() as u32).all(|id| ids.contains(&id)));
        (flat.scene, flat.merged)
    }

    #[test]
    fn a_shared_wall_is_one_interface_with_two_outsides() {
        let (scene, merged) = merged(vec![model("a", unit(0.0), ICE), model("b", unit(1.0), WATER)]);
        assert_eq!(merged, Merged { interfaces: 2, ..Merged::default() });
        assert_eq!(scene.attributes.len(), 22);
        let walls: Vec<_> = scene.attributes.iter().filter(|face| face.other != Attribute::NONE).collect();
        assert_eq!(walls.len(), 2);
        for wall in walls {
            assert_eq!((wall.body, wall.other, wall.normal), (0, 1 | Attribute::OPPOSITE, [1.0, 0.0, 0.0]));
        }
        assert_eq!([0.5, 1.5].map(|x| start_media(&scene, [x, 0.4, 0.3])), [0b01, 0b10]);
    }

    #[test]
    fn the_higher_priority_governs_and_keeps_its_normal() {
        let high = Model { priority: 1, ..model("b", unit(1.0), WATER) };
        let (scene, _) = merged(vec![model("a", unit(0.0), ICE), high]);
        let wall = scene.attributes.iter().find(|face| face.other != Attribute::NONE).unwrap();
        assert_eq!((wall.body, wall.other, wall.normal), (0, 1 | Attribute::OPPOSITE, [-1.0, 0.0, 0.0]));
        assert_eq!((scene.bodies[0].name.as_str(), scene.bodies[0].triangles), ("b", 12));
        assert_eq!(scene.bodies[1].triangles, 10);
        // The lowest id stays, and with it the order: the wall lies among the first model's faces.
        let id = scene.attributes.iter().position(|face| face.other != Attribute::NONE).unwrap();
        assert_eq!(id, 2);
    }

    #[test]
    fn coincident_cubes_look_the_same_way() {
        let (scene, merged) = merged(vec![model("a", cube(1.0), ICE), model("b", cube(1.0), WATER)]);
        assert_eq!(merged.interfaces, 12);
        assert!(scene.attributes.iter().all(|face| (face.body, face.other) == (0, 1)));
        assert_eq!(start_media(&scene, [0.1, 0.2, 0.3]), 0b11);
    }

    #[test]
    fn an_opaque_face_stays_alone() {
        let (scene, _) = merged(vec![model("glass", unit(0.0), ICE), model("wall", unit(1.0), STONE)]);
        assert_eq!(scene.attributes.len(), 22);
        assert!(scene.attributes.iter().all(|face| face.other == Attribute::NONE));
        let wall: Vec<u32> = scene.attributes[2..4].iter().map(|face| face.body).collect();
        assert_eq!(wall, [1, 1]);
        assert_eq!([0.9, 1.1].map(|x| start_media(&scene, [x, 0.5, 0.5])), [1, 0]);
    }

    #[test]
    fn duplicates_within_a_body_are_left_out() {
        for material in [ICE, STONE] {
            let doubled = joined(&[cube(1.0), cube(1.0)]);
            let (scene, merged) = merged(vec![model("twice", doubled, material)]);
            assert_eq!((scene.attributes.len(), merged.duplicates), (12, 12), "{material:?}");
        }
    }

    #[test]
    fn the_wall_between_touching_copies_is_no_wall() {
        let copies = |material: MaterialId| Model {
            repeat: Repeat { count: [3, 1, 1], step: DVec3::X },
            ..model("row", unit(0.0), material)
        };
        let (scene, _) = merged(vec![copies(ICE)]);
        assert_eq!(scene.attributes.len(), 3 * 12 - 2 * 4);
        assert_eq!([0.5, 1.5, 2.5, 3.5].map(|x| start_media(&scene, [x, 0.4, 0.3])), [1, 1, 1, 0]);
        // Opaque sheets that lie back to back are still seen from both sides.
        let (scene, _) = merged(vec![copies(STONE)]);
        assert_eq!(scene.attributes.len(), 3 * 12 - 2 * 2);
    }

    #[test]
    fn a_third_body_is_reported() {
        let models = [ICE, WATER, ICE].map(|material| model("same", cube(1.0), material));
        let flat = flattened(models.into()).unwrap();
        assert_eq!((flat.merged.crowded, flat.scene.attributes.len()), (12, 24));
        assert!(flat.warnings[0].message.contains("more than two"));
    }
}
