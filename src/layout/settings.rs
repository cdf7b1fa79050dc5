//! How to trace: shared by both devices.

use super::EffectChoice;
use super::constants::BASE_SAMPLES;

/// Which device traces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Backend {
    /// rayon over all cores.
    Cpu,
    /// A Vulkan adapter.
    Gpu,
}

/// The arithmetic of a trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// 32 bits: fast, the same bits on every strict device.
    #[default]
    F32,
    /// 64 bits: the judge.
    F64,
}

/// What a shader compiler may do to float arithmetic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Float {
    /// Every operation as written: the CPU's bits.
    #[default]
    Strict,
    /// Contraction and reassociation allowed.
    Fast,
}

/// The ray–triangle test.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Intersector {
    /// Woop, Benthin, Wald 2013: no ray passes between two triangles of an edge.
    #[default]
    Watertight,
    /// Möller, Trumbore 1997: the textbook's, leaks at edges.
    MollerTrumbore,
}

/// How to trace: shared by both devices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The deepest ray that is traced, in 0..=[`MAX_DEPTH`](super::constants::MAX_DEPTH).
    pub depth: u32,
    /// The least weight that is traced, in [0, 1].
    pub cutoff: f32,
    /// Samples per pixel, ≥ 1.
    pub samples: u32,
    /// Adaptive antialiasing: a pixel gets more samples while one more is expected to move it by more than this, in
    /// [0, 1], as a part of a display's range; `samples` are the most. At 0 each gets all of them.
    pub adaptive: Option<f32>,
    /// The arithmetic.
    pub precision: Precision,
    /// What a shader compiler may do to it; the CPU is always strict.
    pub float: Float,
    /// The ray–triangle test.
    pub intersector: Intersector,
    /// Whether to fill [`Aov`](super::Aov)s.
    pub aovs: bool,
    /// Which effects to simulate.
    pub effects: EffectChoice,
}

/// Thresholds of adaptive antialiasing below this are 0: no picture shows them, and subnormals decide nothing.
const LEAST_THRESHOLD: f32 = 1e-6;

impl Settings {
    /// The threshold of adaptive antialiasing, where it has samples to choose.
    #[must_use]
    pub fn threshold(&self) -> Option<f32> {
        let choice = self.samples > BASE_SAMPLES;
        self.adaptive.filter(|_| choice).map(|t| if t < LEAST_THRESHOLD { 0.0 } else { t })
    }
}

impl Default for Settings {
    /// One strict, watertight f32 sample of a tree of depth 16, cut at a ten-thousandth.
    fn default() -> Self {
        Self {
            depth: 16,
            cutoff: 1e-4,
            samples: 1,
            adaptive: None,
            precision: Precision::default(),
            float: Float::default(),
            intersector: Intersector::default(),
            aovs: false,
            effects: EffectChoice::default(),
        }
    }
}
