//! Stop 4 of 7: surface. Twin of `shaders/surface.wgsl`.

use crate::layout::Effect;
use crate::layout::constants::{EDGE_ROUNDOFFS, MOST_EDGE_WEIGHT, NONE, SPAWN_ROUNDOFFS};

use super::bvh::{Hit, Ray};
use super::math::{dot3, max3, unit3};
use super::{Real, Simulation, Vec3, World};

/// A point on a face, as the ray that found it sees it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Surface<R> {
    /// From barycentrics, not along the ray: its error does not grow with the distance.
    pub point: Vec3<R>,
    /// How far a leaving ray must start off the face, > 0.
    pub offset: R,
    /// Face normal on the ray's side.
    pub face_normal: Vec3<R>,
    /// Shading normal on the ray's side: never turned away from the ray.
    pub normal: Vec3<R>,
    /// Where shadow rays start: on the curved surface that the shading normals stand for.
    pub shadow_point: Vec3<R>,
    /// Texture coordinates.
    pub uv: [R; 2],
    /// Index into the materials.
    pub material: u32,
    /// Body id.
    pub body: u32,
    /// Primitive id.
    pub id: u32,
    /// Whether the ray comes from outside the matter.
    pub front: bool,
}

/// Everything that shading needs at a hit.
// Inlined: the walk of a shadow ray through interfaces then leaves out what it does not read.
#[inline(always)]
pub fn resolve<R: Real>(world: &World<impl Simulation>, ray: &Ray<R>, hit: &Hit<R>) -> Surface<R> {
    let tri = world.effects.triangle_at::<R>(world, hit.index);
    let face = &world.scene.attributes[hit.id as usize];
    let (v0, v1, v2) = (Vec3::load(tri.v0), Vec3::load(tri.v1), Vec3::load(tri.v2));
    let b0 = R::ONE - hit.b1 - hit.b2;
    // The point; how far rounding may put it off the face, and another face of the same plane off the point.
    let (p0, p1, p2) = (v0 * b0, v1 * hit.b1, v2 * hit.b2);
    let weighted = p0 + p1 + p2;
    let size = p0.abs() + p1.abs() + p2.abs();
    let extent = (v1 - v0).abs() + (v2 - v0).abs();
    let outward = Vec3::load(face.normal);
    let face_normal = if hit.front { outward } else { -outward };
    let span = max3(extent);
    let reach = dot3(face_normal.abs(), size) + span * R::of(0.5);
    let offset = reach * (R::of(SPAWN_ROUNDOFFS) * R::of(R::ROUNDOFF));
    // Off the edges, so that a leaving ray is on the right side of the next face as well.
    let extents = extent.x + extent.y + extent.z;
    let spread = (size.x + size.y + size.z + extents) / extents;
    let margin = (spread * (R::of(EDGE_ROUNDOFFS) * R::of(R::ROUNDOFF))).least(R::of(MOST_EDGE_WEIGHT));
    let point = weighted
        + off_edge(weighted, v0, b0, margin)
        + off_edge(weighted, v1, hit.b1, margin)
        + off_edge(weighted, v2, hit.b2, margin);
    let mut surface = Surface {
        point,
        offset,
        face_normal,
        normal: face_normal,
        shadow_point: point,
        uv: [R::ZERO; 2],
        material: face.material,
        body: face.body,
        id: hit.id,
        front: hit.front,
    };
    // Texture coordinates.
    if face.uvs != NONE && world.simulates(Effect::Textures) {
        let first = face.uvs as usize;
        let [[u0, v0], [u1, v1], [u2, v2]] =
            [0, 1, 2].map(|corner| world.scene.uvs[first + corner].map(R::real));
        surface.uv = [u0 * b0 + u1 * hit.b1 + u2 * hit.b2, v0 * b0 + v1 * hit.b1 + v2 * hit.b2];
    }
    // Smooth normals.
    if face.is_smooth() && world.simulates(Effect::SmoothNormals) {
        let n0 = corner_normal(face.normal0, hit.front);
        let n1 = corner_normal(face.normal1, hit.front);
        let n2 = corner_normal(face.normal2, hit.front);
        let smooth = unit3(n0 * b0 + n1 * hit.b1 + n2 * hit.b2);
        surface.normal = turn_towards(smooth, -ray.direction);
        surface.shadow_point =
            point + lift(point, v0, n0) * b0 + lift(point, v1, n1) * hit.b1 + lift(point, v2, n2) * hit.b2;
    }
    surface
}

/// What moves a point that lies on the edge opposite a corner, or nearly so, towards that corner, until the corner's
/// weight is `margin`; nothing for others.
pub fn off_edge<R: Real>(point: Vec3<R>, corner: Vec3<R>, weight: R, margin: R) -> Vec3<R> {
    (corner - point) * (margin - weight).greatest(R::ZERO)
}

/// A corner's shading normal on the ray's side.
pub fn corner_normal<R: Real>(normal: [f32; 3], front: bool) -> Vec3<R> {
    let n = Vec3::load(normal);
    if front { n } else { -n }
}

/// v, mirrored to the side of `axis` if it lies on the other: unit length stays, and so does continuity.
pub fn turn_towards<R: Real>(v: Vec3<R>, axis: Vec3<R>) -> Vec3<R> {
    let along = dot3(v, axis);
    if along < R::ZERO { v - axis * (along + along) } else { v }
}

/// From the point to its projection on a corner's tangent plane, where it lies below (Hanika 2021, "Hacking the
/// shadow terminator", Ray Tracing Gems II, chapter 4).
pub fn lift<R: Real>(point: Vec3<R>, corner: Vec3<R>, normal: Vec3<R>) -> Vec3<R> {
    let height = dot3(point - corner, normal);
    if height < R::ZERO { normal * (-height) } else { Vec3::zero() }
}

/// Where a ray starts that leaves the face on the side that it came from.
pub fn spawn_before<R: Real>(surface: &Surface<R>) -> Vec3<R> {
    surface.point + surface.face_normal * surface.offset
}

/// Where a ray starts that goes on behind the face.
pub fn spawn_behind<R: Real>(surface: &Surface<R>) -> Vec3<R> {
    surface.point - surface.face_normal * surface.offset
}
