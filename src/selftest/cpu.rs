//! The CPU as a device of the self-test.

use std::num::NonZero;

use rayon::prelude::*;

use super::lockstep::Difference;
use super::{Answered, Bend, Bent, Device, DeviceError, Leave, Left, Stage, Walk, Walked, paths, rays};
use crate::cpu::CpuRenderer;
use crate::film::{Frame, Renderer};
use crate::kernel::material::fresnel;
use crate::kernel::{Real, World};
use crate::layout::{EffectChoice, EffectSet, Intersector, Precision, Settings};

/// The CPU in one precision, on all its cores.
#[derive(Debug, Clone, Copy)]
pub struct CpuDevice {
    precision: Precision,
    intersector: Intersector,
}

impl CpuDevice {
    /// The CPU in this precision, with this ray–triangle test.
    #[must_use]
    pub fn new(precision: Precision, intersector: Intersector) -> Self {
        Self { precision, intersector }
    }

    fn world<'a>(&self, stage: &'a Stage) -> World<'a> {
        World {
            scene: &stage.flat,
            view: &stage.view,
            intersector: self.intersector,
            effects: EffectSet::ALL,
        }
    }
}

impl Device for CpuDevice {
    fn name(&self) -> &str {
        match self.precision {
            Precision::F32 => "CPU f32",
            Precision::F64 => "CPU f64",
        }
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn roundoff(&self) -> f64 {
        match self.precision {
            Precision::F32 => f32::ROUNDOFF,
            Precision::F64 => f64::ROUNDOFF,
        }
    }

    fn walk(&mut self, stage: &Stage, rays: &[Walk]) -> Answered<Walked> {
        let world = self.world(stage);
        Ok(match self.precision {
            Precision::F32 => rays.par_iter().map(|ray| rays::walk::<f32>(&world, ray)).collect(),
            Precision::F64 => rays.par_iter().map(|ray| rays::walk::<f64>(&world, ray)).collect(),
        })
    }

    fn leave(&mut self, stage: &Stage, rays: &[Leave]) -> Answered<Left> {
        let (world, places) = (self.world(stage), stage.places(0..stage.flat.triangles.len() as u32));
        let place = |ray: &Leave| places[ray.id as usize];
        Ok(match self.precision {
            Precision::F32 => {
                rays.par_iter().map(|ray| rays::leave::<f32>(&world, place(ray), ray)).collect()
            }
            Precision::F64 => {
                rays.par_iter().map(|ray| rays::leave::<f64>(&world, place(ray), ray)).collect()
            }
        })
    }

    fn bend(&mut self, stage: &Stage, rays: &[Bend]) -> Answered<Bent> {
        let world = self.world(stage);
        Ok(match self.precision {
            Precision::F32 => rays.par_iter().map(|ray| paths::bend::<f32>(&world, ray)).collect(),
            Precision::F64 => rays.par_iter().map(|ray| paths::bend::<f64>(&world, ray)).collect(),
        })
    }

    fn fresnel(&mut self, inputs: &[[f32; 2]]) -> Answered<Option<f32>> {
        Ok(match self.precision {
            Precision::F32 => inputs.iter().map(|&input| reflectance::<f32>(input)).collect(),
            Precision::F64 => inputs.iter().map(|&input| reflectance::<f64>(input)).collect(),
        })
    }

    fn differences(&mut self, _: usize) -> Answered<Difference> {
        Ok(Vec::new())
    }

    fn picture(&mut self, stage: &Stage, settings: &Settings) -> Result<Frame, DeviceError> {
        let settings = Settings {
            precision: self.precision,
            intersector: self.intersector,
            effects: EffectChoice::All,
            ..*settings
        };
        Ok(CpuRenderer::new(&stage.flat, 0)?.render(&stage.view_for(&settings), &settings, &())?)
    }

    fn shared_out(&mut self, stage: &Stage, settings: &Settings) -> Answered<(String, Frame)> {
        let settings = Settings { precision: self.precision, intersector: self.intersector, ..*settings };
        let view = stage.view_for(&settings);
        let most = std::thread::available_parallelism().map_or(1, NonZero::get);
        let mut frames = Vec::new();
        // One thread more than there are cores, so that it is never one only.
        for (threads, tile) in (1..=most + 1).zip(TILES.into_iter().cycle()) {
            let mut renderer = CpuRenderer::with_tile(&stage.flat, threads, tile)?;
            let way = format!("{threads} threads, tiles of {tile} × {tile}");
            frames.push((way, renderer.render(&view, &settings, &())?));
        }
        Ok(frames)
    }
}

/// Sides of tiles: a few pixels, the usual one, and one that does not divide a picture.
const TILES: [u32; 3] = [3, 16, 61];

/// None where it is total.
fn reflectance<R: Real>([cosine, eta]: [f32; 2]) -> Option<f32> {
    let answer = fresnel(R::real(cosine), R::real(eta));
    (!answer.total).then(|| answer.reflectance.to_f32())
}
