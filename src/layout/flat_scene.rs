//! The only scene that renderers read: world-space arrays without names or paths.

use std::sync::Arc;

use super::{Attribute, Light, Material, Node, Triangle};

/// A body, for tables and messages.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// The model's name.
    pub name: String,
    /// Material index of its matter.
    pub material: u32,
    /// Whether its matter transmits light; such bodies come first, by priority.
    pub transmissive: bool,
    /// Higher wins where bodies overlap.
    pub priority: i32,
    /// Number of triangles.
    pub triangles: u32,
}

/// Where an image lies in [`FlatScene::texels`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FlatTexture {
    /// First word.
    pub first: u32,
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// The flattened scene, in world space. Indices and finiteness are proven by `flatten`. A copy shares the large arrays:
/// what only differs in its lights and materials has the same ones.
#[derive(Debug, Clone)]
pub struct FlatScene {
    /// BVH, root first. Never empty.
    pub nodes: Arc<[Node]>,
    /// Triangles in the order of the BVH's leaves.
    pub triangles: Arc<[Triangle]>,
    /// One for each primitive id.
    pub attributes: Arc<[Attribute]>,
    /// Texture coordinates, to the right and upwards: three for each textured triangle.
    pub uvs: Arc<[[f32; 2]]>,
    /// Row 0 is the air.
    pub materials: Vec<Material>,
    /// Names of `materials`.
    pub material_names: Vec<String>,
    /// Point lights in file order.
    pub lights: Vec<Light>,
    /// Words: first the 256 linear values (f32 bits) of 8-bit sRGB; then textures as 0x00BBGGRR words;
    /// then the background picture as three f32 (bits) a texel.
    pub texels: Arc<[u32]>,
    /// Transmissive bodies first, by (priority, order in the file); the index is the body id.
    pub bodies: Vec<Body>,
    /// How many of `bodies` are transmissive, ≤ [`MAX_MEDIA`](super::constants::MAX_MEDIA).
    pub transmissive_bodies: u32,
    /// Least and greatest corner of the scene's box (all zero for an empty scene).
    pub bounds: [[f32; 3]; 2],
    /// Greatest number of nodes on a path from the root, ≤ [`MAX_BVH_DEPTH`](super::constants::MAX_BVH_DEPTH).
    pub bvh_depth: u32,
    /// Ia.
    pub ambient: [f32; 3],
    /// Radiance of a constant background, or at and below the horizon of a gradient.
    pub horizon: [f32; 3],
    /// Radiance straight up (equal to `horizon` for a constant background).
    pub zenith: [f32; 3],
    /// The background picture, its rotation about +Y in turns, in [0, 1), and its intensity.
    pub environment: Option<(FlatTexture, f32, f32)>,
    /// `MAX_DEPTH` + 1 values: `radiance_bound[k]` bounds what a tree of k levels returns. L₀ is the brightest
    /// background, Lₖ₊₁ = max(L₀, A + g·Lₖ) with the largest local term A and the greatest gain g of a material.
    pub radiance_bound: Vec<f32>,
}

impl FlatScene {
    /// Triangles under their tree, of no body and no matter, in the dark: for rays alone. `depth` is the tree's.
    #[must_use]
    pub fn of_triangles(
        nodes: Vec<Node>,
        triangles: Vec<Triangle>,
        bounds: [[f32; 3]; 2],
        depth: u32,
    ) -> Self {
        Self {
            nodes: nodes.into(),
            triangles: triangles.into(),
            bounds,
            bvh_depth: depth,
            attributes: Arc::default(),
            uvs: Arc::default(),
            materials: vec![],
            material_names: vec![],
            lights: vec![],
            texels: Arc::default(),
            bodies: vec![],
            transmissive_bodies: 0,
            ambient: [0.0; 3],
            horizon: [0.0; 3],
            zenith: [0.0; 3],
            environment: None,
            radiance_bound: vec![],
        }
    }
}
