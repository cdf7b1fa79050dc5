//! What a scene calls for: each effect is on or off, with a reason that a person can read.

mod effect;
mod meeting;
mod number;
mod plan;
mod scan;
mod set;

pub use effect::Effect;
pub use number::{Number, Numbers};
pub use plan::{EffectChoice, Lights, Plan};
pub use scan::Scan;
pub use set::EffectSet;

use super::{FlatScene, Settings};

/// Whether an effect is called for, and by what.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene or the settings call for it.
    pub on: bool,
    /// What does, or that nothing does.
    pub reason: String,
}

/// What a scene and its settings call for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Effects {
    findings: Vec<Finding>,
    numbers: Numbers,
}

impl Effects {
    /// Scan a scene. Where settings change and the scene stays, keep a [`Scan`].
    #[must_use]
    pub fn of(scene: &FlatScene, settings: &Settings) -> Self {
        Scan::of(scene).effects(settings)
    }

    /// Every effect, on or off, in the order of [`Effect::ALL`].
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// How much of what can be counted.
    #[must_use]
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// The effects that are on, with all that they need.
    #[must_use]
    pub fn set(&self) -> EffectSet {
        self.findings.iter().filter(|finding| finding.on).map(|finding| finding.effect).collect()
    }

    /// What a kernel is made for that simulates what the settings ask for.
    ///
    /// Auxiliary pictures are made where they are asked for, whatever the choice, and nothing is refined without a
    /// threshold.
    #[must_use]
    pub fn plan(&self, settings: &Settings) -> Plan {
        let lights = match self.numbers.lights.value {
            0 => Lights::None,
            1 => Lights::One,
            _ => Lights::Many,
        };
        let found = Plan { effects: self.set(), lights, waiting: self.numbers.waiting.value };
        let general = Plan::general(settings.depth);
        let plan = match settings.effects {
            EffectChoice::Auto => found,
            EffectChoice::All => general,
            EffectChoice::Only(set) => {
                let effects = set.closed();
                // Without an effect that it calls for, weights may fall more slowly than they did.
                let waiting = match found.waiting {
                    waiting if waiting == 0 || effects.has_all(found.effects) => waiting,
                    _ => general.waiting,
                };
                Plan { effects, waiting, ..found }
            }
        };
        let mut effects = plan.effects.without(Effect::Aovs);
        if settings.aovs {
            effects = effects.with(Effect::Aovs);
        }
        if settings.threshold().is_none() {
            effects = effects.without(Effect::Adaptive);
        }
        Plan { effects, ..plan }
    }
}
