// The eight storage buffers. Twin of src/kernel/world.rs.
//
// None is a uniform buffer: lavapipe folds those that decide loops into a copy of the shader at every dispatch.

import package::records::{Attribute, Corner, Film, Frame, Material, Node, Triangle};

@group(0) @binding(0) var<storage, read> nodes: array<Node>;
@group(0) @binding(1) var<storage, read> triangles: array<Triangle>;
@group(0) @binding(2) var<storage, read> attributes: array<Attribute>;
@group(0) @binding(3) var<storage, read> corners: array<Corner>;
@group(0) @binding(4) var<storage, read> materials: array<Material>;
@group(0) @binding(5) var<storage, read> texels: array<u32>;
@group(0) @binding(6) var<storage, read> frame: Frame;
@group(0) @binding(7) var<storage, read_write> film: Film;
