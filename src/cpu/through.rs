//! The kernel's rays, sent through the wide tree.

use std::any::{Any, TypeId};

use super::wide::WideBvh;
use crate::kernel::bvh::{self, Hit, Ray};
use crate::kernel::{Real, Simulation, World};
use crate::layout::{Effect, TreeNode, Triangle};

/// What is simulated, by rays in f32 that go through the wide tree; others go through the scene's own.
#[derive(Debug, Clone, Copy)]
pub(super) struct Through<'a, S> {
    pub(super) effects: S,
    pub(super) tree: &'a WideBvh,
}

impl<S: Simulation> Simulation for Through<'_, S> {
    fn simulates(self, effect: Effect) -> bool {
        self.effects.simulates(effect)
    }

    fn records(self) -> bool {
        self.effects.records()
    }

    fn record(self, node: TreeNode) {
        self.effects.record(node);
    }

    fn intersect<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> Hit<R> {
        match single(ray) {
            Some(ray) => {
                let Hit { t, id, index, b1, b2, front } = self.tree.nearest(ray, limit.to_f32());
                Hit { t: R::real(t), id, index, b1: R::real(b1), b2: R::real(b2), front }
            }
            None => bvh::intersect(world, ray, limit),
        }
    }

    fn triangle_at<R: Real>(self, world: &World<Self>, index: u32) -> Triangle {
        // Those of the tree were fetched as the ray went through it; the scene's were not.
        if TypeId::of::<R>() == TypeId::of::<f32>() {
            self.tree.triangle(index)
        } else {
            world.scene.triangles[index as usize]
        }
    }

    fn occluded<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> bool {
        match single(ray) {
            Some(ray) => self.tree.occluded(ray, limit.to_f32()),
            None => bvh::occluded(world, ray, limit),
        }
    }
}

/// The ray, if it is in f32: known as it is compiled.
fn single<R: Real>(ray: &Ray<R>) -> Option<&Ray<f32>> {
    (ray as &dyn Any).downcast_ref()
}
