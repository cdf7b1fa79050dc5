//! What the shaders have as bindings: the flattened scene, the view and how to trace it.

use crate::layout::{FlatScene, Intersector, View};

/// The read-only surroundings of a trace.
#[derive(Debug, Clone, Copy)]
pub struct World<'a> {
    /// Triangles, materials, lights.
    pub scene: &'a FlatScene,
    /// Camera and constants.
    pub view: &'a View,
    /// The ray–triangle test.
    pub intersector: Intersector,
}
