// Stop 4 of 7: surface. Twin of src/kernel/surface.rs.

import package::real::{greatest, least, real, vec3r};
import package::math::{dot3, max3, unit3};
import package::bvh::{Hit, Ray};
import package::bindings::{attributes, triangle_at, uvs};
import package::constants::{EDGE_ROUNDOFFS, MOST_EDGE_WEIGHT, NONE, ROUNDOFF, SPAWN_ROUNDOFFS};

// A point on a face, as the ray that found it sees it.
struct Surface {
    point: vec3r,
    offset: real,
    face_normal: vec3r,
    normal: vec3r,
    shadow_point: vec3r,
    uv: array<real, 2>,
    material: u32,
    body: u32,
    id: u32,
    front: bool,
}

// Everything that shading needs at a hit.
fn resolve(ray: Ray, hit: Hit) -> Surface {
    let tri = triangle_at(hit.index);
    let v0 = vec3r(tri.v0);
    let v1 = vec3r(tri.v1);
    let v2 = vec3r(tri.v2);
    let face = attributes[hit.id];
    let b0 = 1.0 - hit.b1 - hit.b2;
    // The point; how far rounding may put it off the face, and another face of the same plane off the point.
    let p0 = v0 * b0;
    let p1 = v1 * hit.b1;
    let p2 = v2 * hit.b2;
    let weighted = p0 + p1 + p2;
    let size = abs(p0) + abs(p1) + abs(p2);
    let extent = abs(v1 - v0) + abs(v2 - v0);
    let outward = vec3r(face.normal);
    let face_normal = select(-outward, outward, hit.front);
    let span = max3(extent);
    let reach = dot3(abs(face_normal), size) + span * 0.5;
    let offset = reach * (SPAWN_ROUNDOFFS * ROUNDOFF);
    // Off the edges, so that a leaving ray is on the right side of the next face as well.
    let extents = extent.x + extent.y + extent.z;
    let spread = (size.x + size.y + size.z + extents) / extents;
    let margin = least(spread * (EDGE_ROUNDOFFS * ROUNDOFF), MOST_EDGE_WEIGHT);
    let point = weighted + off_edge(weighted, v0, b0, margin) + off_edge(weighted, v1, hit.b1, margin)
        + off_edge(weighted, v2, hit.b2, margin);
    var surface = Surface(
        point, offset, face_normal, face_normal, point, array<real, 2>(0.0, 0.0), face.material, face.body, hit.id,
        hit.front,
    );
    // Texture coordinates.
    @if(textures) if face.uvs != NONE {
        let uv0 = uvs[face.uvs];
        let uv1 = uvs[face.uvs + 1u];
        let uv2 = uvs[face.uvs + 2u];
        surface.uv = array<real, 2>(
            real(uv0.x) * b0 + real(uv1.x) * hit.b1 + real(uv2.x) * hit.b2,
            real(uv0.y) * b0 + real(uv1.y) * hit.b1 + real(uv2.y) * hit.b2,
        );
    }
    // Smooth normals.
    @if(smooth_normals) if any(face.normal0 != vec3f()) {
        let n0 = corner_normal(face.normal0, hit.front);
        let n1 = corner_normal(face.normal1, hit.front);
        let n2 = corner_normal(face.normal2, hit.front);
        let smoothed = unit3(n0 * b0 + n1 * hit.b1 + n2 * hit.b2);
        surface.normal = turn_towards(smoothed, -ray.direction);
        surface.shadow_point =
            point + lift(point, v0, n0) * b0 + lift(point, v1, n1) * hit.b1 + lift(point, v2, n2) * hit.b2;
    }
    return surface;
}

// What moves a point that lies on the edge opposite a corner, or nearly so, towards that corner, until the corner's
// weight is `margin`; nothing for others.
fn off_edge(point: vec3r, corner: vec3r, weight: real, margin: real) -> vec3r {
    return (corner - point) * greatest(margin - weight, 0.0);
}

// A corner's shading normal on the ray's side.
fn corner_normal(normal: vec3f, front: bool) -> vec3r {
    let n = vec3r(normal);
    return select(-n, n, front);
}

// v, mirrored to the side of `axis` if it lies on the other.
fn turn_towards(v: vec3r, axis: vec3r) -> vec3r {
    let along = dot3(v, axis);
    if along < 0.0 {
        return v - axis * (along + along);
    }
    return v;
}

// From the point to its projection on a corner's tangent plane, where it lies below.
fn lift(point: vec3r, corner: vec3r, normal: vec3r) -> vec3r {
    let height = dot3(point - corner, normal);
    if height < 0.0 {
        return normal * (-height);
    }
    return vec3r(0.0);
}

// Where a ray starts that leaves the face on the side that it came from.
fn spawn_before(surface: Surface) -> vec3r {
    return surface.point + surface.face_normal * surface.offset;
}

// Where a ray starts that goes on behind the face.
fn spawn_behind(surface: Surface) -> vec3r {
    return surface.point - surface.face_normal * surface.offset;
}
