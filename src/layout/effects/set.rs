//! A set of effects in one word.

use std::fmt;

use super::Effect;

/// A set of effects: a bit for each.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct EffectSet(u32);

impl EffectSet {
    /// No effect: ambient light, point lights without shadows and the background.
    pub const NONE: Self = Self(0);
    /// Every effect.
    pub const ALL: Self = Self::of(&Effect::ALL);

    /// These effects.
    #[must_use]
    pub const fn of(effects: &[Effect]) -> Self {
        let mut set = Self::NONE;
        let mut i = 0;
        while i < effects.len() {
            set = set.with(effects[i]);
            i += 1;
        }
        set
    }

    /// The set of these bits.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits & Self::ALL.0)
    }

    /// A bit for each effect.
    #[must_use]
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Whether an effect is in the set.
    #[must_use]
    pub const fn has(self, effect: Effect) -> bool {
        self.0 >> effect as u32 & 1 == 1
    }

    /// Whether every effect of another set is in this one.
    #[must_use]
    pub const fn has_all(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The set with one more effect.
    #[must_use]
    pub const fn with(self, effect: Effect) -> Self {
        Self(self.0 | 1 << effect as u32)
    }

    /// The set with one effect less.
    #[must_use]
    pub const fn without(self, effect: Effect) -> Self {
        Self(self.0 & !(1 << effect as u32))
    }

    /// The effects of this set that another one lacks.
    #[must_use]
    pub const fn minus(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The set with all that its effects need.
    #[must_use]
    pub fn closed(self) -> Self {
        let needed = self.iter().flat_map(Effect::needs).fold(self, |set, &effect| set.with(effect));
        if needed == self { self } else { needed.closed() }
    }

    /// The set without the effects that need one which it lacks.
    #[must_use]
    pub fn pruned(self) -> Self {
        let idle = |effect: &Effect| effect.needs().iter().any(|&needed| !self.has(needed));
        let pruned: Self = self.iter().filter(|effect| !idle(effect)).collect();
        if pruned == self { self } else { pruned.pruned() }
    }

    /// The effects in the order of [`Effect::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Effect> {
        Effect::ALL.into_iter().filter(move |&effect| self.has(effect))
    }
}

impl FromIterator<Effect> for EffectSet {
    fn from_iter<I: IntoIterator<Item = Effect>>(effects: I) -> Self {
        effects.into_iter().fold(Self::NONE, Self::with)
    }
}

/// The names, one after the other.
impl fmt::Display for EffectSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NONE {
            return f.write_str("none");
        }
        let names: Vec<_> = self.iter().map(Effect::name).collect();
        f.write_str(&names.join(", "))
    }
}

impl fmt::Debug for EffectSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_was_put_into_it_in_the_order_of_tables() {
        let set = EffectSet::of(&[Effect::Textures, Effect::Shadows]);
        assert_eq!(set.iter().collect::<Vec<_>>(), [Effect::Shadows, Effect::Textures]);
        assert_eq!(set.to_string(), "shadows, textures");
        assert!(EffectSet::ALL.has_all(set) && !set.has_all(EffectSet::ALL));
        assert_eq!(EffectSet::ALL.iter().count(), Effect::ALL.len());
        assert_eq!(set.minus(set.without(Effect::Shadows)), EffectSet::of(&[Effect::Shadows]));
    }

    #[test]
    fn a_closed_set_has_all_that_its_effects_need() {
        let set = EffectSet::of(&[Effect::TintedShadows, Effect::Textures]).closed();
        let expected = [
            Effect::Shadows,
            Effect::TintedShadows,
            Effect::Transmission,
            Effect::SmoothNormals,
            Effect::Textures,
        ];
        assert_eq!(set, EffectSet::of(&expected));
        assert_eq!(set.closed(), set);
    }

    #[test]
    fn a_pruned_set_loses_what_cannot_work() {
        let lacking = EffectSet::ALL.without(Effect::Transmission).pruned();
        let idle = [Effect::Transmission, Effect::TintedShadows, Effect::Absorption, Effect::NestedMedia];
        assert_eq!(EffectSet::ALL.minus(lacking), EffectSet::of(&idle));
        assert_eq!(lacking.closed(), lacking);
    }
}
