// How a ray goes through nodes of eight children (Ylitie, Karras, Laine 2017, "Efficient incoherent ray traversal on GPUs
// through compressed wide BVHs"). The CPU goes through other trees of the same triangles: src/kernel/bvh.rs says why none
// shows. src/bvh/pack.rs writes the nodes.

import package::real::{real, vec3r, vec4r};
import package::bindings::node_at;
import package::bvh::Ray;
import package::constants::{BVH_STACK, SIBLING_BITS};
import package::records::WideNode;

// What a ray sees of planes: near and far ones from where they are seen nearest and farthest.
struct Sight {
    near_origin: vec3r,
    far_origin: vec3r,
    reciprocal: vec3r,
    falls: vec3<bool>,
    // A child's rank among its siblings is its number, turned round on the axes that the ray rises along.
    turn: u32,
}

// What a ray still has to look at: siblings to be visited and triangles of the last node, then what waits on the stack.
struct Ahead {
    // Where the sibling numbered 0 stands, or would.
    first_child: u32,
    // The ranks of those to be visited, the highest first.
    children: u32,
    first_triangle: u32,
    // By number.
    triangles: u32,
    waiting: u32,
}

// Declared once: a function's own array would be cleared at every call.
var<private> bvh_stack: array<u32, BVH_STACK>;

fn sight_of(ray: Ray) -> Sight {
    let falls = ray.reciprocal < vec3r(0.0);
    let turn = select(vec3u(1u, 2u, 4u), vec3u(0u), falls);
    return Sight(
        select(ray.origin_hi, ray.origin_lo, falls), select(ray.origin_lo, ray.origin_hi, falls), ray.reciprocal,
        falls, turn.x | turn.y | turn.z,
    );
}

// The root, as the only child of none.
fn whole_tree(sight: Sight) -> Ahead {
    return Ahead(0u, 1u << sight.turn, 0u, 0u, 0u);
}

// Whether no node is left to be visited.
fn is_done(ahead: Ahead) -> bool {
    return ahead.children == 0u && ahead.waiting == 0u;
}

// Visit the next node: its children within `limit` come first now. Its siblings wait on the stack only if it has some.
fn visit(sight: Sight, ahead: Ahead, limit: real) -> Ahead {
    var first_child = ahead.first_child;
    var children = ahead.children;
    var waiting = ahead.waiting;
    if children == 0u {
        waiting--;
        let group = bvh_stack[waiting];
        first_child = group >> SIBLING_BITS;
        children = group & ((1u << SIBLING_BITS) - 1u);
    }
    let rank = firstLeadingBit(children);
    children ^= 1u << rank;
    let node = node_at(first_child + (rank ^ sight.turn));
    let planes = node.planes;
    let scales = vec3r(bitcast<vec3f>(((vec3u(node.scales) >> vec3u(0u, 8u, 16u)) & vec3u(0xffu)) << vec3u(23u)));
    let lower_a = vec3u(planes[0].x, planes[1].x, planes[2].x);
    let lower_b = vec3u(planes[0].y, planes[1].y, planes[2].y);
    let upper_a = vec3u(planes[0].z, planes[1].z, planes[2].z);
    let upper_b = vec3u(planes[0].w, planes[1].w, planes[2].w);
    let origin = vec3r(node.origin);
    let a = meet(sight, origin, scales, lower_a, upper_a, limit);
    let b = meet(sight, origin, scales, lower_b, upper_b, limit);
    let four = vec4u(1u) << vec4u(0u, 1u, 2u, 3u);
    let numbers = bits(a, four) | (bits(b, four) << 4u);
    let triangles = bits(a, leaf_bits(node.leaves.x)) | bits(b, leaf_bits(node.leaves.y));
    let met = ranks(numbers & (node.scales >> 24u), sight.turn);
    if met != 0u {
        if children != 0u {
            bvh_stack[waiting] = (first_child << SIBLING_BITS) | children;
            waiting++;
        }
        first_child = node.first_child;
        children = met;
    }
    return Ahead(first_child, children, node.first_triangle, triangles, waiting);
}

// Which of four boxes a ray meets within `limit`; a byte each for the planes.
fn meet(sight: Sight, origin: vec3r, scales: vec3r, lower: vec3u, upper: vec3u, limit: real) -> vec4<bool> {
    let near = select(lower, upper, sight.falls);
    let distant = select(upper, lower, sight.falls);
    let near_x = distances(near.x, origin.x, scales.x, sight.near_origin.x, sight.reciprocal.x);
    let near_y = distances(near.y, origin.y, scales.y, sight.near_origin.y, sight.reciprocal.y);
    let near_z = distances(near.z, origin.z, scales.z, sight.near_origin.z, sight.reciprocal.z);
    let distant_x = distances(distant.x, origin.x, scales.x, sight.far_origin.x, sight.reciprocal.x);
    let distant_y = distances(distant.y, origin.y, scales.y, sight.far_origin.y, sight.reciprocal.y);
    let distant_z = distances(distant.z, origin.z, scales.z, sight.far_origin.z, sight.reciprocal.z);
    let entry = max(max(near_x, near_y), max(near_z, vec4r(0.0)));
    let exit = min(min(distant_x, distant_y), min(distant_z, vec4r(limit)));
    return entry <= exit;
}

// Distances to four planes, which are exact but for their last sum.
fn distances(bytes: u32, origin: real, scale: real, seen_from: real, reciprocal: real) -> vec4r {
    let planes = vec4r(vec4f(bytes_of(bytes))) * scale + origin;
    return (planes - seen_from) * reciprocal;
}

// The four bytes of a word: the built-in function may ask for bytes in the device's arithmetic, which few have.
fn bytes_of(word: u32) -> vec4u {
    return vec4u(word & 255u, (word >> 8u) & 255u, (word >> 16u) & 255u, word >> 24u);
}

// Those of four bit sets whose boxes are met, as one.
fn bits(met: vec4<bool>, sets: vec4u) -> u32 {
    let taken = select(vec4u(0u), sets, met);
    return taken.x | taken.y | taken.z | taken.w;
}

// The triangles of four children, by number.
fn leaf_bits(bytes: u32) -> vec4u {
    let leaves = bytes_of(bytes);
    return ((vec4u(1u) << (leaves >> vec4u(5u))) - vec4u(1u)) << (leaves & vec4u(31u));
}

// Ranks of children by number.
fn ranks(numbers: u32, turn: u32) -> u32 {
    var result = numbers;
    result = select(result, ((result & 0x55u) << 1u) | ((result >> 1u) & 0x55u), (turn & 1u) != 0u);
    result = select(result, ((result & 0x33u) << 2u) | ((result >> 2u) & 0x33u), (turn & 2u) != 0u);
    result = select(result, ((result & 0x0fu) << 4u) | (result >> 4u), (turn & 4u) != 0u);
    return result;
}
