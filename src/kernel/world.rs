//! What the shaders have as bindings and features: the flattened scene, the view and how to trace it.

use super::bvh::{self, Hit, Ray};
use super::real::Real;
use crate::layout::{Effect, EffectSet, FlatScene, Intersector, TreeNode, Triangle, View};

/// Which effects a kernel simulates: known as it is compiled, or asked as it runs.
///
/// It may also know a faster way through the scene. The kernel asks last, behind every condition of the scene under which an effect shows: in the shaders that is
/// `@if(effect)` around the same conditions. So an implementation that notes what it is asked for knows which effects
/// a picture has really used.
pub trait Simulation: Copy + Sync {
    /// Whether an effect is simulated.
    fn simulates(self, effect: Effect) -> bool;

    /// Whether it wants to hear of every ray.
    fn records(self) -> bool {
        false
    }

    /// Hears of a ray, in the order of tracing.
    fn record(self, _node: TreeNode) {}

    /// [`bvh::intersect`], or a faster way to the same bits; `index` is for [`triangle_at`](Self::triangle_at) alone.
    fn intersect<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> Hit<R> {
        bvh::intersect(world, ray, limit)
    }

    /// The triangle that [`intersect`](Self::intersect) in the same reals calls by this index.
    fn triangle_at<R: Real>(self, world: &World<Self>, index: u32) -> Triangle {
        world.scene.triangles[index as usize]
    }

    /// [`bvh::occluded`], or a faster way to the same answer.
    fn occluded<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> bool {
        bvh::occluded(world, ray, limit)
    }
}

impl Simulation for EffectSet {
    fn simulates(self, effect: Effect) -> bool {
        self.has(effect)
    }
}

/// A set of effects that a kernel asks as it runs, but of which it knows as it is compiled that it holds none beyond those
/// of the bits `MOST`.
#[derive(Debug, Clone, Copy)]
pub struct Within<const MOST: u32>(pub EffectSet);

impl<const MOST: u32> Simulation for Within<MOST> {
    fn simulates(self, effect: Effect) -> bool {
        EffectSet::from_bits(MOST).has(effect) && self.0.has(effect)
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

impl<'a, S: Simulation> World<'a, S> {
    /// The same surroundings with other effects.
    pub fn simulating<T: Simulation>(&self, effects: T) -> World<'a, T> {
        World { scene: self.scene, view: self.view, intersector: self.intersector, effects }
    }

    /// Whether an effect is simulated.
    pub fn simulates(&self, effect: Effect) -> bool {
        self.effects.simulates(effect)
    }
}
