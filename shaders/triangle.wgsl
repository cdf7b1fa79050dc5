// Stop 3 of 7: triangle. Twin of src/kernel/triangle.rs.

import package::real::{real, vec3r, greatest};
import package::math::{cross3, dot3};
import package::records::Triangle;

// A ray's shear: the axis it mostly follows, and what turns it into that axis at unit length.
struct Shear {
    by: vec3r,
    axis: u32,
}

// Where a ray meets a triangle, if `found`.
struct Crossing {
    t: real,
    b1: real,
    b2: real,
    front: bool,
    found: bool,
}

// v with `axis` last, the others in cyclic order.
fn permute(v: vec3r, axis: u32) -> vec3r {
    return select(select(v, v.zxy, axis == 1u), v.yzx, axis == 0u);
}

// The shear of a direction (Woop, Benthin, Wald 2013, section 3.1).
fn shear_of(direction: vec3r) -> Shear {
    let a = abs(direction);
    var axis = select(0u, 1u, a.y > a.x);
    if a.z > greatest(a.x, a.y) {
        axis = 2u;
    }
    let d = permute(direction, axis);
    return Shear(vec3r(d.x / d.z, d.y / d.z, 1.0 / d.z), axis);
}

// The watertight test: products are compared, not subtracted; divided first.
fn watertight(origin: vec3r, shear: Shear, tri: Triangle) -> Crossing {
    var result = Crossing(0.0, 0.0, 0.0, false, false);
    // Corners as seen from the ray.
    let a = permute(vec3r(tri.v0) - origin, shear.axis);
    let b = permute(vec3r(tri.v1) - origin, shear.axis);
    let c = permute(vec3r(tri.v2) - origin, shear.axis);
    let ax = a.x - shear.by.x * a.z;
    let ay = a.y - shear.by.y * a.z;
    let bx = b.x - shear.by.x * b.z;
    let by = b.y - shear.by.y * b.z;
    let cx = c.x - shear.by.x * c.z;
    let cy = c.y - shear.by.y * c.z;
    // On which side of each edge does the ray pass?
    let u1 = cx * by;
    let u2 = cy * bx;
    let v1 = ax * cy;
    let v2 = ay * cx;
    let w1 = bx * ay;
    let w2 = by * ax;
    if (u1 < u2 || v1 < v2 || w1 < w2) && (u1 > u2 || v1 > v2 || w1 > w2) {
        return result;
    }
    // Barycentric weights and distance.
    let u = u1 - u2;
    let v = v1 - v2;
    let w = w1 - w2;
    let det = u + v + w;
    if det == 0.0 {
        return result;
    }
    let b0 = u / det;
    result.b1 = v / det;
    result.b2 = w / det;
    result.t = (b0 * a.z + result.b1 * b.z + result.b2 * c.z) * shear.by.z;
    // Seen along a positive axis, corners that turn counter-clockwise from the front turn clockwise.
    result.front = (det > 0.0) == (shear.by.z > 0.0);
    result.found = result.t > 0.0;
    return result;
}

// The test of Möller and Trumbore 1997.
fn moller_trumbore(origin: vec3r, direction: vec3r, tri: Triangle) -> Crossing {
    var result = Crossing(0.0, 0.0, 0.0, false, false);
    let v0 = vec3r(tri.v0);
    let e1 = vec3r(tri.v1) - v0;
    let e2 = vec3r(tri.v2) - v0;
    let p = cross3(direction, e2);
    let det = dot3(e1, p);
    if det == 0.0 {
        return result;
    }
    let s = origin - v0;
    result.b1 = dot3(s, p) / det;
    let q = cross3(s, e1);
    result.b2 = dot3(direction, q) / det;
    if result.b1 < 0.0 || result.b2 < 0.0 || result.b1 + result.b2 > 1.0 {
        return result;
    }
    result.t = dot3(e2, q) / det;
    result.front = det > 0.0;
    result.found = result.t > 0.0;
    return result;
}

// The test that the variant was assembled for.
fn intersect_triangle(origin: vec3r, direction: vec3r, shear: Shear, tri: Triangle) -> Crossing {
    @if(moller_trumbore) return moller_trumbore(origin, direction, tri);
    @if(!moller_trumbore) return watertight(origin, shear, tri);
}
