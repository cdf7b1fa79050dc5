//! What the shaders have as bindings and features: the flattened scene, the view and how to trace it.

use crate::layout::{Effect, EffectSet, FlatScene, Intersector, View};

/// Which effects a kernel simulates: known as it is compiled, or asked as it runs.
///
/// The kernel asks last, behind every condition of the scene under which an effect shows: in the shaders that is
/// `@if(effect)` around the same conditions. So an implementation that notes what it is asked for knows which effects
/// a picture has really used.
pub trait Simulation: Copy + Sync {
    /// Whether an effect is simulated.
    fn simulates(self, effect: Effect) -> bool;
}

impl Simulation for EffectSet {
    fn simulates(self, effect: Effect) -> bool {
        self.has(effect)
    }
}

/// The read-only surroundings of a trace.
#[derive(Debug, Clone, Copy)]
pub struct World<'a, S = EffectSet> {
    /// Triangles, materials, lights.
    pub scene: &'a FlatScene,
    /// Camera and constants.
    pub view: &'a View,
    /// The ray–triangle test.
    pub intersector: Intersector,
    /// What is simulated.
    pub effects: S,
}

impl<S: Simulation> World<'_, S> {
    /// Whether an effect is simulated.
    pub fn simulates(&self, effect: Effect) -> bool {
        self.effects.simulates(effect)
    }
}
