//! How to trace: shared by both devices.

use super::EffectChoice;

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

impl Default for Settings {
    /// One strict, watertight f32 sample of a tree of depth 16, cut at a ten-thousandth.
    fn default() -> Self {
        Self {
            depth: 16,
            cutoff: 1e-4,
            samples: 1,
            precision: Precision::default(),
            float: Float::default(),
            intersector: Intersector::default(),
            aovs: false,
            effects: EffectChoice::default(),
        }
    }
}
