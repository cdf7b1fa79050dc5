//! What is told of a scene on all devices.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::bench::{BreakEven, Phases, Ratio, Spread};
use crate::film::RayCounts;

/// A figure of each kind of ray.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ByKind<T> {
    /// From the eye.
    pub primary: T,
    /// Children by reflection.
    pub reflection: T,
    /// Children by refraction.
    pub refraction: T,
    /// Towards lights.
    pub shadow: T,
    /// All of them.
    pub total: T,
}

impl From<RayCounts> for ByKind<u64> {
    fn from(rays: RayCounts) -> Self {
        let RayCounts { primary, reflection, refraction, shadow } = rays;
        Self { primary, reflection, refraction, shadow, total: rays.total() }
    }
}

impl ByKind<u64> {
    /// Millions a second, where all of them together took so long.
    #[must_use]
    pub fn rates(&self, time: Duration) -> ByKind<f64> {
        let rate = |rays: u64| rays as f64 / time.as_secs_f64().max(1e-9) / 1e6;
        ByKind {
            primary: rate(self.primary),
            reflection: rate(self.reflection),
            refraction: rate(self.refraction),
            shadow: rate(self.shadow),
            total: rate(self.total),
        }
    }
}

/// A scene on all devices whose every picture was the judge's, bit for bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneRow {
    /// The scene.
    pub scene: String,
    /// Width and height of its picture, of one sample a pixel.
    pub size: [u32; 2],
    /// Its triangles.
    pub triangles: usize,
    /// Rounds in which all devices traced it in turn.
    pub rounds: usize,
    /// Rays of a picture.
    pub rays: ByKind<u64>,
    /// The CPU by threads, then adapters.
    pub devices: Vec<DeviceRow>,
    /// The CPU against one thread of it, by threads.
    pub scaling: Vec<Scaling>,
}

/// A scene on one device.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DeviceRow {
    /// Its name.
    pub device: String,
    /// Threads of the CPU; none of an adapter.
    pub threads: Option<usize>,
    /// Whether an adapter runs on the processor.
    pub software: bool,
    /// Tracing alone.
    pub trace_ms: Spread,
    /// Whether that is by timestamps of the adapter, not by the host's clock.
    pub timestamps: bool,
    /// Millions of rays a second while tracing.
    pub mrays_per_s: ByKind<f64>,
    /// How many times as long the trace takes as on all threads of the CPU.
    pub ratio: Ratio,
    /// From the scene's file to the picture, at a first start.
    pub picture_ms: f64,
    /// The parts of that.
    pub phases_ms: Phases,
    /// Of how many pictures an adapter has made all before all threads of the CPU have; none of the CPU.
    pub break_even: Option<BreakEven>,
}

/// Threads against one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scaling {
    /// So many.
    pub threads: usize,
    /// How many times as fast as one.
    pub speedup: Ratio,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_of_the_kinds_add_up() {
        let rays = RayCounts { primary: 1_000_000, reflection: 500_000, refraction: 250_000, shadow: 0 };
        let rates = ByKind::from(rays).rates(Duration::from_millis(500));
        assert_eq!((rates.primary, rates.reflection, rates.refraction, rates.shadow), (2.0, 1.0, 0.5, 0.0));
        assert_eq!(rates.total, 3.5);
    }
}
