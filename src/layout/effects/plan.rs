//! What a kernel is made for.

use super::{Effect, EffectSet};
use crate::layout::View;

/// Which effects to simulate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum EffectChoice {
    /// What the scene and the settings call for.
    #[default]
    Auto,
    /// Every effect, called for or not: the same picture, and the general kernel.
    All,
    /// These, and what they need; the picture lacks what the scene calls for beyond.
    Only(EffectSet),
}

/// How many point lights light anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Lights {
    /// None, or no surface answers to them.
    None,
    /// One.
    One,
    /// Any number.
    Many,
}

/// What a kernel is made for: the effects that it simulates, and the numbers that its code depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Plan {
    /// The effects that it simulates.
    pub effects: EffectSet,
    /// The lights that it asks.
    pub lights: Lights,
    /// Rays that may wait at once while another is traced; with 0 the tree is a chain and needs no stack.
    pub waiting: u32,
}

impl Plan {
    /// The plan that serves every scene, for trees of this depth.
    #[must_use]
    pub const fn general(depth: u32) -> Self {
        // Every level down to the deepest may leave its reflection waiting.
        Self { effects: EffectSet::ALL, lights: Lights::Many, waiting: depth + 1 }
    }

    /// The view as this plan traces it: without antialiasing a pixel has one sample.
    #[must_use]
    pub fn applied_to(&self, view: &View) -> View {
        let samples = if self.effects.has(Effect::Antialiasing) { view.samples } else { 1 };
        View { samples, ..*view }
    }
}
