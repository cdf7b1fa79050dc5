//! One assembly of the shaders: what is chosen before they are compiled.

use crate::layout::constants::{BLOCK, ROUNDOFF_F32, ROUNDOFF_F64, SHARED, Shared};
use crate::layout::{Effect, EffectSet, Float, Intersector, Lights, Plan, Precision, Settings};

/// Bytes of a waiting ray in f32; in f64 at most twice as many.
const BRANCH_BYTES: u32 = 64;
/// Waiting rays that the rest of an invocation's memory counts for: the sample and the ray in work.
const SAMPLE_BRANCHES: u32 = 4;
/// Bytes that the invocations of one dispatch may take.
const LANE_MEMORY: u32 = 32 << 20;
/// Blocks of a dispatch, however deep their stacks.
const LEAST_BLOCKS: u32 = 16;
/// Blocks of a dispatch, however flat their stacks.
const MOST_BLOCKS: u32 = 4096;

/// What is chosen before the shaders are compiled; the key of the pipeline cache.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Variant {
    /// `real` is f32 or f64; feature `f64`.
    pub precision: Precision,
    /// Whether the arithmetic is decorated with NoContraction after assembly.
    pub float: Float,
    /// Feature `moller_trumbore`.
    pub intersector: Intersector,
    /// A feature for each effect, under its name with `_` for `-`. With `aovs` the film holds
    /// [`Aov`](crate::layout::Aov)s, with `adaptive` [`Statistics`](crate::layout::Statistics).
    pub effects: EffectSet,
    /// Feature `lights` where there are any, and `one_light`.
    pub lights: Lights,
    /// Pending rays of a tree beside the one in work: one for each branching level. Constant `STACK_SIZE`; feature
    /// `branches` where it is not 0.
    pub stack_size: u32,
    /// Nodes of a traversal whose children are not all visited. Constant `BVH_STACK`.
    pub bvh_stack: u32,
    /// Feature `tree`: the film holds the ray tree of the one pixel that is traced.
    pub tree: bool,
}

impl Variant {
    /// The variant that simulates a plan through a BVH of `bvh_depth` nodes from root to leaf.
    #[must_use]
    pub fn new(bvh_depth: u32, settings: &Settings, plan: &Plan) -> Self {
        Self {
            precision: settings.precision,
            float: settings.float,
            intersector: settings.intersector,
            effects: plan.effects,
            lights: plan.lights,
            stack_size: plan.waiting,
            bvh_stack: bvh_depth.saturating_sub(1).max(1),
            tree: false,
        }
    }

    /// Most blocks of one dispatch: the stacks and samples of their invocations lie in the film buffer, and are to take
    /// tens of megabytes only.
    #[must_use]
    pub fn most_blocks(&self) -> u32 {
        let word = match self.precision {
            Precision::F32 => 1,
            Precision::F64 => 2,
        };
        let lane = (self.stack_size + SAMPLE_BRANCHES) * BRANCH_BYTES * word;
        (LANE_MEMORY / (lane * BLOCK * BLOCK)).clamp(LEAST_BLOCKS, MOST_BLOCKS)
    }

    /// Whether the film holds [`Aov`](crate::layout::Aov)s.
    #[must_use]
    pub fn aovs(&self) -> bool {
        self.effects.has(Effect::Aovs)
    }

    /// Whether the film holds [`Statistics`](crate::layout::Statistics), and a list of pixels.
    #[must_use]
    pub fn adaptive(&self) -> bool {
        self.effects.has(Effect::Adaptive)
    }

    /// What `@if(…)` asks for, and the answers.
    pub fn features(&self) -> impl Iterator<Item = (String, bool)> {
        let bounces = self.effects.has(Effect::Reflection) || self.effects.has(Effect::Transmission);
        let own = [
            ("f64", self.precision == Precision::F64),
            ("moller_trumbore", self.intersector == Intersector::MollerTrumbore),
            ("tree", self.tree),
            ("lights", self.lights != Lights::None),
            ("one_light", self.lights == Lights::One),
            // A surface may send a ray on; and two of them.
            ("bounces", bounces),
            ("branches", bounces && self.stack_size > 0),
            // An invocation may have a second ray of the itinerary to trace, and so rest before it.
            ("rests", bounces || self.effects.has(Effect::Antialiasing)),
        ];
        let effects = Effect::ALL.map(|effect| (effect.name().replace('-', "_"), self.effects.has(effect)));
        own.map(|(name, on)| (name.to_owned(), on)).into_iter().chain(effects)
    }

    /// The shader module `package::constants`: the shared numbers, and those of this variant.
    #[must_use]
    pub fn constants_module(&self) -> String {
        let mut module = String::new();
        for (name, value) in self.constants() {
            module += &match (value, self.precision) {
                (Shared::U32(value), _) => format!("const {name}: u32 = {value}u;\n"),
                (Shared::F32(value), _) => single(name, value),
                // Rounded once, as Rust rounds it.
                (Shared::Real(value), Precision::F32) => single(name, value as f32),
                // Abstract, and so read in f64: wesl knows no suffix for it.
                (Shared::Real(value), Precision::F64) => format!("const {name}: f64 = {value:e};\n"),
            };
        }
        module
    }

    /// The shared numbers, and those of this variant, by name.
    fn constants(&self) -> impl Iterator<Item = (&'static str, Shared)> {
        let roundoff = match self.precision {
            Precision::F32 => ROUNDOFF_F32,
            Precision::F64 => ROUNDOFF_F64,
        };
        let own = [
            ("ROUNDOFF", Shared::Real(roundoff)),
            ("STACK_SIZE", Shared::U32(self.stack_size)),
            ("BVH_STACK", Shared::U32(self.bvh_stack)),
            ("LANES", Shared::U32(self.most_blocks() * BLOCK * BLOCK)),
        ];
        SHARED.iter().map(|&(name, value)| (name, value())).chain(own)
    }
}

/// The declaration of an f32, by the shortest literal that reads back as it.
fn single(name: &str, value: f32) -> String {
    format!("const {name}: f32 = {value:e}f;\n")
}

#[cfg(test)]
mod tests {
    use super::super::testing::PLAIN;
    use super::*;

    #[test]
    fn constants_carry_the_type_of_the_variant() {
        let single = PLAIN.constants_module();
        assert!(single.contains("const MAX_DEPTH: u32 = 64u;\n"), "{single}");
        assert!(single.contains("const PI: f32 = 3.1415927e0f;\n"), "{single}");
        assert!(single.contains("const STACK_SIZE: u32 = 16u;\n"), "{single}");
        let double = Variant { precision: Precision::F64, ..PLAIN }.constants_module();
        assert!(double.contains("const PI: f64 = 3.141592653589793e0;\n"), "{double}");
    }
}
