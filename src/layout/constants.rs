//! Numbers that both devices share. Injected into the shaders under the same names.

/// D*: the tree of this depth is the truth of every error bound, and the deepest that may be asked for.
pub const MAX_DEPTH: u32 = 64;

/// Transmissive bodies that the media mask holds.
pub const MAX_MEDIA: u32 = 32;

/// Nodes on a path from the root of the BVH; the traversal stack holds one fewer.
pub const MAX_BVH_DEPTH: u32 = 64;

/// Side of the square block of pixels that one workgroup traces.
pub const BLOCK: u32 = 8;

/// An interface without effect lets a ray pass at no cost; one that met this many is stuck and is cut.
pub const MAX_PASSES: u32 = 4096;
