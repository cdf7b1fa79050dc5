//! The records in the storage buffers. Field order is the WGSL struct's; a vec3 is followed by a scalar
//! so that neither language pads.

use bytemuck::{Pod, Zeroable};

use super::constants;

/// An inner node: the boxes of its two children (Aila and Laine 2009). A leaf is named by its parent.
///
/// `a_first` is a node index if `a_count` is 0, else the first of `a_count` triangles.
/// Both children are always there: a scene of one leaf names it twice, and an empty scene holds one
/// degenerate triangle, which nothing hits.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Node {
    /// Least corner of child a.
    pub a_lo: [f32; 3],
    /// Node index, or first triangle.
    pub a_first: u32,
    /// Greatest corner of child a.
    pub a_hi: [f32; 3],
    /// 0 for an inner child, else its number of triangles.
    pub a_count: u32,
    /// Least corner of child b.
    pub b_lo: [f32; 3],
    /// Node index, or first triangle.
    pub b_first: u32,
    /// Greatest corner of child b.
    pub b_hi: [f32; 3],
    /// 0 for an inner child, else its number of triangles.
    pub b_count: u32,
}

/// Up to eight children with their boxes in bytes, as adapters traverse them (Ylitie, Karras, Laine 2017, "Efficient
/// incoherent ray traversal on GPUs through compressed wide BVHs", section 3.2).
///
/// A plane lies at `origin` + byte · scale. A child's number tells on which side it lies along each axis, so that a ray's
/// octant gives the order of visits. An inner child stands as many places behind `first_child` as its number says; what is
/// between may be another node's children, or nothing. The leaves' triangles stand in a row by number.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct WideNode {
    /// Least corner of all boxes.
    pub origin: [f32; 3],
    /// Bytes: the scales' exponents on x, y and z, as f32 has them; a bit for each inner child.
    pub scales: u32,
    /// Where the child numbered 0 stands, or would if it were an inner one; has `32 - SIBLING_BITS` bits.
    pub first_child: u32,
    /// Index of the leaves' first triangle.
    pub first_triangle: u32,
    /// A byte for each child: number of triangles · 32 + number of the first; 0 for an inner child or none.
    pub leaves: [u32; 2],
    /// For x, y and z, a byte for each child: eight lower planes, eight upper ones.
    pub planes: [[u32; 4]; 3],
}

/// A triangle in world space, in the order of the BVH's leaves.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Triangle {
    /// First corner.
    pub v0: [f32; 3],
    /// Primitive id: index into the attributes; ties in distance go to the lowest.
    pub id: u32,
    /// Second corner.
    pub v1: [f32; 3],
    /// Unused, 0.
    pub reserved1: u32,
    /// Third corner.
    pub v2: [f32; 3],
    /// Unused, 0.
    pub reserved2: u32,
}

/// What a hit needs to know about a triangle, in the order of primitive ids: one cache line.
#[repr(C, align(64))]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Attribute {
    /// Unit face normal, out of the matter, rounded from f64.
    pub normal: [f32; 3],
    /// Index into the materials.
    pub material: u32,
    /// Unit shading normal of the first corner, out of the matter; zero, as are the others', on a flat face.
    pub normal0: [f32; 3],
    /// Body id. Below `View::transmissive_bodies` it is also the body's bit in the media mask.
    pub body: u32,
    /// That of the second corner.
    pub normal1: [f32; 3],
    /// The second body of a merged interface: its id, plus [`Attribute::OPPOSITE`] where its outside
    /// is on the other side; [`Attribute::NONE`] where there is none.
    pub other: u32,
    /// That of the third corner.
    pub normal2: [f32; 3],
    /// First of three texture coordinates, or [`Attribute::NONE`] for a face without texture.
    pub uvs: u32,
}

impl Attribute {
    /// No second body, no texture coordinates.
    pub const NONE: u32 = constants::NONE;
    /// Flag in `other`: the second body's matter lies on the front side of the face.
    pub const OPPOSITE: u32 = constants::OPPOSITE;

    /// Whether the corners have shading normals.
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        self.normal0 != [0.0; 3]
    }
}

/// Surface and medium, linear RGB. Row 0 is the air: transparent, refractive index 1.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Material {
    /// ka × colour.
    pub ambient: [f32; 3],
    /// Refractive index.
    pub ior: f32,
    /// kd × colour.
    pub diffuse: [f32; 3],
    /// β.
    pub shininess: f32,
    /// ks × colour.
    pub specular: [f32; 3],
    /// 1 for Fresnel weights, 0 for classic ones.
    pub fresnel: u32,
    /// kr.
    pub reflection: [f32; 3],
    /// First texel of the texture, or [`Attribute::NONE`].
    pub texture: u32,
    /// kt.
    pub transmission: [f32; 3],
    /// Texture width in texels.
    pub texture_width: u32,
    /// σ per scene unit.
    pub absorption: [f32; 3],
    /// Texture height in texels.
    pub texture_height: u32,
}

/// A point light.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Light {
    /// World position.
    pub position: [f32; 3],
    /// 1 for inverse-square falloff, 0 for none.
    pub inverse_square: u32,
    /// Ij, linear RGB.
    pub intensity: [f32; 3],
    /// Unused, 0.
    pub reserved: u32,
}

/// One pixel of the film.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Texel {
    /// Linear radiance, the mean of the samples.
    pub radiance: [f32; 3],
    /// Largest weight channel of every cut ray, summed, the mean of the samples.
    pub dropped: f32,
    /// Certified bound on the truncation error (design section 1), the mean of the samples.
    pub bound: f32,
    /// Rays traced, all kinds and samples.
    pub rays: u32,
    /// Primitive hash of sample 0.
    pub primitive_hash: u32,
    /// Body hash of sample 0.
    pub body_hash: u32,
}

/// What the primary ray of sample 0 met; all zero (body and medium [`Attribute::NONE`]) where it escaped.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Aov {
    /// Unit shading normal facing the ray, world space.
    pub normal: [f32; 3],
    /// Distance along the ray.
    pub depth: f32,
    /// Body id.
    pub body: u32,
    /// Material index of the medium that the ray enters or would enter behind the face; 0 is air.
    pub medium: u32,
    /// Unused, 0.
    pub reserved: [u32; 2],
}
