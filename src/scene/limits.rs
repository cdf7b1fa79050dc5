//! Bounds on what a scene may ask for.

/// Bounds on the memory that the files of a scene may ask for with few words: copies, levels, picture headers.
/// What they hold word by word is bounded by their own size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// The most triangles of a scene, copies included.
    pub triangles: u64,
    /// The most pixels of one picture; all pictures together may have four times as many.
    pub pixels: u64,
}

impl Default for Limits {
    /// 2^25 triangles, and an 8192 × 4096 environment: a bound on memory, not on devices.
    fn default() -> Self {
        Self { triangles: 1 << 25, pixels: 1 << 25 }
    }
}
