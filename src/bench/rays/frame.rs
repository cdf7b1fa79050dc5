//! The rays of a frame, as the kernel asks for them.

use std::sync::{Mutex, PoisonError};

use super::Query;
use crate::cpu::{Cast, morton_order};
use crate::kernel::bvh::{Hit, Ray, far, intersect, occluded};
use crate::kernel::whitted::trace_pixel;
use crate::kernel::{Real, Simulation, Vec3, World};
use crate::layout::{Aov, Effect, EffectSet, FlatScene, Intersector, Texel, View};

/// Every ray that the kernel sends through the tree for one sample of each pixel, by kind: pixels along a Morton curve, those of
/// a pixel as its tree grows.
#[derive(Debug, Clone, Default)]
pub struct FrameRays {
    /// From the eye.
    pub primary: Vec<Cast>,
    /// Reflected and refracted ones.
    pub bounced: Vec<Cast>,
    /// To lights, of which what is transparent is to be found: one for each interface crossed.
    pub tinted: Vec<Cast>,
    /// To lights, where all that blocks is opaque.
    pub shadow: Vec<Cast>,
}

impl FrameRays {
    /// Trace the frame with one thread, and note its rays.
    #[must_use]
    pub fn of(scene: &FlatScene, view: &View, effects: EffectSet) -> Self {
        let log = Mutex::new(Self::default());
        let noting = Noting { effects, log: &log };
        let world = World { scene, view, intersector: Intersector::Watertight, effects: noting };
        let [left, top, width, height] = view.crop;
        let mut stack = Vec::new();
        for [column, row] in morton_order(width, height) {
            let (mut texel, mut aov) = (Texel::default(), Aov::default());
            let pixel = [left + column, top + row];
            trace_pixel::<f32>(&world, &mut stack, pixel, 0..1, &mut texel, &mut aov, None);
        }
        log.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// All of them, with what is asked.
    #[must_use]
    pub fn by_kind(&self) -> [(&'static str, &[Cast], Query); 4] {
        [
            ("primary", &self.primary, Query::Nearest),
            ("reflected and refracted", &self.bounced, Query::Nearest),
            ("to lights, through interfaces", &self.tinted, Query::Nearest),
            ("to lights", &self.shadow, Query::Any),
        ]
    }
}

/// Simulates a frame and notes its rays.
#[derive(Clone, Copy)]
struct Noting<'a> {
    effects: EffectSet,
    log: &'a Mutex<FrameRays>,
}

impl Noting<'_> {
    fn note<R: Real>(self, view: &View, ray: &Ray<R>, limit: R, query: Query) {
        let three = |v: Vec3<R>| [v.x.to_f32(), v.y.to_f32(), v.z.to_f32()];
        let (origin, limit) = (three(ray.origin), limit.to_f32());
        let cast = Cast { origin, limit, direction: three(ray.direction), origin_face: ray.origin_face };
        let mut log = self.log.lock().unwrap_or_else(PoisonError::into_inner);
        let kind = match query {
            Query::Any => &mut log.shadow,
            Query::Nearest if limit < far::<f32>() => &mut log.tinted,
            Query::Nearest if origin == view.eye => &mut log.primary,
            Query::Nearest => &mut log.bounced,
        };
        kind.push(cast);
    }
}

impl Simulation for Noting<'_> {
    fn simulates(self, effect: Effect) -> bool {
        self.effects.has(effect)
    }

    fn intersect<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> Hit<R> {
        self.note(world.view, ray, limit, Query::Nearest);
        intersect(world, ray, limit)
    }

    fn occluded<R: Real>(self, world: &World<Self>, ray: &Ray<R>, limit: R) -> bool {
        self.note(world.view, ray, limit, Query::Any);
        occluded(world, ray, limit)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::flatten::{flatten, view};
    use crate::layout::constants::{RAY_PRIMARY, RAY_REFLECTION, RAY_REFRACTION, RAY_SHADOW};
    use crate::layout::{Effects, Settings};
    use crate::scene::Scene;

    /// A scene's rays, and how many of each kind the kernel counts.
    fn noted(scene: &str, crop: Option<[u32; 4]>) -> (FrameRays, [usize; 4]) {
        let scene = Scene::load(&Path::new("scenes").join(scene)).unwrap();
        let flat = flatten(&scene).unwrap().scene;
        let settings = Settings { depth: 6, samples: 1, ..Settings::default() };
        let view = view(&scene.camera, &flat, [40, 30], crop, &settings);
        let effects = Effects::of(&flat, &settings).plan(&settings).effects;
        let world = World { scene: &flat, view: &view, intersector: Intersector::Watertight, effects };
        let mut counted = [0; 4];
        let mut stack = Vec::new();
        for pixel in morton_order(40, 30) {
            let (mut texel, mut aov) = (Texel::default(), Aov::default());
            let rays = trace_pixel::<f32>(&world, &mut stack, pixel, 0..1, &mut texel, &mut aov, None);
            counted.iter_mut().zip(rays).for_each(|(sum, rays)| *sum += rays as usize);
        }
        (FrameRays::of(&flat, &view, effects), counted)
    }

    #[test]
    fn every_ray_that_the_kernel_counts_is_noted_by_kind() {
        let (rays, counted) = noted("opaque.toml", None);
        let count = |kind: u32| counted[kind as usize];
        assert_eq!(rays.primary.len(), 1200);
        assert_eq!((rays.bounced.len(), count(RAY_PRIMARY)), (0, 1200));
        assert_eq!((rays.shadow.len(), rays.tinted.len()), (count(RAY_SHADOW), 0));
        assert!(count(RAY_SHADOW) > 0);
    }

    #[test]
    fn a_part_of_the_picture_has_its_own_rays() {
        let (whole, _) = noted("opaque.toml", None);
        let (top, _) = noted("opaque.toml", Some([0, 0, 40, 10]));
        let (rest, _) = noted("opaque.toml", Some([0, 10, 40, 20]));
        assert_eq!((top.primary.len(), rest.primary.len()), (400, 800));
        assert_eq!(top.shadow.len() + rest.shadow.len(), whole.shadow.len());
    }

    #[test]
    fn a_shadow_ray_through_glass_is_several() {
        let (rays, counted) = noted("whitted.toml", None);
        let count = |kind: u32| counted[kind as usize];
        assert_eq!(rays.bounced.len(), count(RAY_REFLECTION) + count(RAY_REFRACTION));
        assert!(rays.tinted.len() > count(RAY_SHADOW) && rays.shadow.is_empty());
    }
}
