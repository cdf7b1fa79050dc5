// The eight storage buffers. Twin of src/kernel/world.rs.
//
// None is a uniform buffer: lavapipe folds those that decide loops into a copy of the shader at every dispatch.
// Nodes and triangles, which rays fetch most, lie there as vectors of four words: drivers without gathering loads fetch
// vector by vector, invocation by invocation, and need as long for three words, or one, as for four.

import package::records::{Attribute, Film, Frame, Material, Triangle, WideNode};

@group(0) @binding(0) var<storage, read> nodes: array<array<vec4u, 5>>;
@group(0) @binding(1) var<storage, read> triangles: array<array<vec4u, 3>>;
@group(0) @binding(2) var<storage, read> attributes: array<Attribute>;
@group(0) @binding(3) var<storage, read> uvs: array<vec2f>;
@group(0) @binding(4) var<storage, read> materials: array<Material>;
@group(0) @binding(5) var<storage, read> texels: array<u32>;
@group(0) @binding(6) var<storage, read> frame: Frame;
@group(0) @binding(7) var<storage, read_write> film: Film;

// A node of the tree.
fn node_at(index: u32) -> WideNode {
    let words = nodes[index];
    return WideNode(
        bitcast<vec3f>(words[0].xyz), words[0].w, words[1].x, words[1].y, words[1].zw,
        array<vec4u, 3>(words[2], words[3], words[4]),
    );
}

// A triangle, in the order of the leaves.
fn triangle_at(index: u32) -> Triangle {
    let words = triangles[index];
    return Triangle(
        bitcast<vec3f>(words[0].xyz), words[0].w, bitcast<vec3f>(words[1].xyz), words[1].w,
        bitcast<vec3f>(words[2].xyz), words[2].w,
    );
}
