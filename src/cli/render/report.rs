//! What `render --json` prints: a contract, field by field (design section 7).

use std::fmt;
use std::time::Duration;

use serde::Serialize;

use crate::film::{MeanMax, RayCounts, TraceTimes};

/// One finished render.
#[derive(Debug, Serialize)]
pub(super) struct RenderReport {
    /// The scene's path as it was given.
    pub(super) scene: String,
    /// "gpu" or "cpu".
    pub(super) backend: String,
    /// The device's name.
    pub(super) adapter: String,
    /// The driver's name and version; on the CPU the number of threads.
    pub(super) driver: String,
    /// "f32" or "f64".
    pub(super) precision: String,
    /// "strict" or "fast": what was used, not what was asked for.
    pub(super) float: String,
    /// Width and height of the whole picture, also where a part of it was traced.
    pub(super) size: [u32; 2],
    pub(super) depth: u32,
    pub(super) cutoff: f64,
    /// Samples of a pixel, at most.
    pub(super) samples: u32,
    /// The threshold of adaptive antialiasing, if it is asked for.
    pub(super) adaptive: Option<f64>,
    /// Samples that the pixels have.
    pub(super) samples_taken: MeanMax,
    pub(super) triangles: usize,
    /// Names of the effects that were simulated.
    pub(super) effects: Vec<String>,
    pub(super) rays: Rays,
    pub(super) times_ms: Times,
    pub(super) dropped: MeanMax,
    pub(super) bound: MeanMax,
    /// L(D*): the greatest radiance that any pixel could have.
    pub(super) max_radiance: f32,
}

/// Rays traced, by kind.
#[derive(Debug, Serialize)]
pub(super) struct Rays {
    primary: u64,
    reflection: u64,
    refraction: u64,
    shadow: u64,
}

impl From<RayCounts> for Rays {
    fn from(rays: RayCounts) -> Self {
        let RayCounts { primary, reflection, refraction, shadow } = rays;
        Self { primary, reflection, refraction, shadow }
    }
}

/// Milliseconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Times {
    /// Reading, checking and flattening the scene.
    pub(super) load: f64,
    /// Building the BVH.
    pub(super) bvh: f64,
    upload: f64,
    compile: f64,
    trace: f64,
    readback: f64,
    /// Pictures to files.
    pub(super) encode: f64,
    /// Everything from the command's start.
    pub(super) total: f64,
}

impl fmt::Display for Times {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "milliseconds: load {:.1}, bvh {:.1}, upload {:.1}, compile {:.1}, trace {:.1}, readback {:.1}, encode {:.1}",
            self.load, self.bvh, self.upload, self.compile, self.trace, self.readback, self.encode
        )
    }
}

impl Times {
    pub(super) fn new(
        load: Duration,
        bvh: Duration,
        device: TraceTimes,
        encode: Duration,
        total: Duration,
    ) -> Self {
        let ms = |time: Duration| time.as_micros() as f64 / 1e3;
        Self {
            load: ms(load),
            bvh: ms(bvh),
            upload: ms(device.upload),
            compile: ms(device.compile),
            trace: ms(device.trace),
            readback: ms(device.readback),
            encode: ms(encode),
            total: ms(total),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn report() -> RenderReport {
        RenderReport {
            scene: "ice.toml".to_owned(),
            backend: "cpu".to_owned(),
            adapter: "CPU".to_owned(),
            driver: "rayon, 2 threads".to_owned(),
            precision: "f32".to_owned(),
            float: "strict".to_owned(),
            size: [640, 480],
            depth: 16,
            cutoff: 1e-4,
            samples: 4,
            adaptive: None,
            samples_taken: MeanMax::default(),
            triangles: 12,
            effects: vec!["shadows".to_owned()],
            rays: RayCounts::default().into(),
            times_ms: Times::new(
                Duration::from_millis(1),
                Duration::from_millis(2),
                TraceTimes::default(),
                Duration::from_millis(3),
                Duration::from_millis(4),
            ),
            dropped: MeanMax::default(),
            bound: MeanMax::default(),
            max_radiance: 1.5,
        }
    }

    fn keys(value: &serde_json::Value) -> Vec<&str> {
        let mut keys: Vec<_> = value.as_object().unwrap().keys().map(String::as_str).collect();
        keys.sort_unstable();
        keys
    }

    #[test]
    fn the_report_has_exactly_the_fields_of_the_contract() {
        let json = serde_json::to_value(report()).unwrap();
        let mut expected = [
            "scene",
            "backend",
            "adapter",
            "driver",
            "precision",
            "float",
            "size",
            "depth",
            "cutoff",
            "samples",
            "adaptive",
            "samples_taken",
            "triangles",
            "effects",
            "rays",
            "times_ms",
            "dropped",
            "bound",
            "max_radiance",
        ];
        expected.sort_unstable();
        assert_eq!(keys(&json), expected);
        assert_eq!(keys(&json["rays"]), ["primary", "reflection", "refraction", "shadow"]);
        let times = ["bvh", "compile", "encode", "load", "readback", "total", "trace", "upload"];
        assert_eq!(keys(&json["times_ms"]), times);
        assert_eq!(keys(&json["dropped"]), ["max", "mean"]);
        assert_eq!(keys(&json["samples_taken"]), ["max", "mean"]);
        assert_eq!(json["cutoff"], 1e-4);
        assert_eq!(json["times_ms"]["bvh"], 2.0);
    }
}
