//! One ray of a pixel's tree, as both devices record it when they are asked to.

use bytemuck::{Pod, Zeroable};

/// One ray of a pixel's tree: where it went, what it met, what it gave. In the order in which they are traced: a
/// ray's refracted child comes next, its reflected child when all of that one's tree is done.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct TreeNode {
    /// Where it starts.
    pub origin: [f32; 3],
    /// What made it: `RAY_PRIMARY`, `RAY_REFLECTION` or `RAY_REFRACTION`.
    pub kind: u32,
    /// Unit direction.
    pub direction: [f32; 3],
    /// 0 for the ray from the eye.
    pub depth: u32,
    /// What its radiance counts for in the pixel.
    pub weight: [f32; 3],
    /// How it ended: `END_SURFACE` and the like.
    pub end: u32,
    /// What it added to the pixel: its surface's local light, or the background, times its weight.
    pub light: [f32; 3],
    /// Media mask at its start and up to the surface; interfaces that change no medium are passed over.
    pub media: u32,
    /// Where it met the surface; this and all that follows is 0 where it met none.
    pub point: [f32; 3],
    /// Primitive id.
    pub id: u32,
    /// Shading normal on its side.
    pub normal: [f32; 3],
    /// Body id.
    pub body: u32,
    /// What is left of its weight on arrival.
    pub arriving: [f32; 3],
    /// Media mask behind the surface.
    pub media_behind: u32,
    /// Distance travelled.
    pub distance: f32,
    /// 1 if it came from outside the body's matter.
    pub front: u32,
    /// Sum of `CHILD_REFLECTION` and `CHILD_REFRACTION`.
    pub children: u32,
    /// Lights seen: bit j mod 32 is flipped for light j.
    pub seen: u32,
    /// Shadow rays traced.
    pub shadow_rays: u32,
    /// Unused, 0.
    pub reserved: [u32; 3],
}
