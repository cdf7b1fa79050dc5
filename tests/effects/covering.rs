//! Few sets of effects that stand for all.

use snellius::layout::{Effect, EffectSet};

/// Random sets of which the best is taken: each compiles a pipeline.
const TRIES: usize = 300;

/// The effects that sets are chosen from: nothing is refined without a threshold, whatever the set.
const CHOICES: EffectSet = EffectSet::ALL.without(Effect::Adaptive);

/// A combination of two effects: those that are on, and those that are off.
type Combination = (EffectSet, EffectSet);

/// Few closed sets that hold `base`, in which any two other effects are on and off in every combination that there is
/// (pairwise covering: nearly every fault of a combination shows in one of two). Each set is the one of many that meets
/// most of what the others lack (Cohen et al. 1997, "The AETG system").
pub(crate) fn covering(base: EffectSet) -> Vec<EffectSet> {
    let mut random = Random(1);
    let mut wanted = combinations(base);
    let mut sets = Vec::new();
    while let Some(&first) = wanted.first() {
        let tried = (0..TRIES).map(|_| random_set(base, first, &mut random));
        let meets = |set: &EffectSet| wanted.iter().filter(|one| is_met(*set, **one)).count();
        let set = tried.max_by_key(meets).unwrap();
        wanted.retain(|&one| !is_met(set, one));
        sets.push(set);
    }
    sets
}

/// Two closed sets that hold `base`, of which each other effect is in one, and but for what the others need not in both.
pub(crate) fn halves(base: EffectSet) -> Vec<EffectSet> {
    let free: Vec<_> = CHOICES.minus(base.closed()).iter().collect();
    let half = |part: usize| base.with_all(free.iter().copied().skip(part).step_by(2).collect());
    vec![half(0), half(1)]
}

/// A closed set that holds `base` and meets a combination.
fn random_set(base: EffectSet, (on, off): Combination, random: &mut Random) -> EffectSet {
    CHOICES.iter().fold(base.with_all(on), |set, effect| {
        let grown = set.with(effect).closed();
        if grown.minus(off) == grown && random.flip() { grown } else { set }
    })
}

fn is_met(set: EffectSet, (on, off): Combination) -> bool {
    set.has_all(on) && set.minus(off) == set
}

/// Every closed set that holds `base`.
pub(crate) fn all_closed(base: EffectSet) -> Vec<EffectSet> {
    let mut sets = vec![base.closed()];
    for effect in CHOICES.iter() {
        let grown: Vec<_> = sets.iter().map(|set| set.with(effect).closed()).collect();
        for set in grown {
            if !sets.contains(&set) {
                sets.push(set);
            }
        }
    }
    sets
}

/// What two effects beside `base` can be at once.
fn combinations(base: EffectSet) -> Vec<Combination> {
    let free: Vec<_> = CHOICES.minus(base.closed()).iter().collect();
    let mut found = Vec::new();
    for (i, &a) in free.iter().enumerate() {
        for &b in &free[..=i] {
            for (a_on, b_on) in [(false, false), (false, true), (true, false), (true, true)] {
                let pick = |on: bool| [(a, a_on), (b, b_on)].into_iter().filter(move |one| one.1 == on);
                let [on, off] = [true, false].map(|on| pick(on).map(|one| one.0).collect::<EffectSet>());
                if base.with_all(on).minus(off) == base.with_all(on) {
                    found.push((on, off));
                }
            }
        }
    }
    found
}

trait WithAll {
    fn with_all(self, other: Self) -> Self;
}

impl WithAll for EffectSet {
    fn with_all(self, other: Self) -> Self {
        self.iter().chain(other.iter()).collect::<Self>().closed()
    }
}

/// A linear congruential generator.
struct Random(u32);

impl Random {
    fn flip(&mut self) -> bool {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.0 >> 31 == 1
    }
}

#[test]
fn any_two_effects_meet_in_every_combination() {
    let base = EffectSet::of(&[Effect::Shadows]);
    let sets = covering(base);
    assert!(sets.iter().all(|set| set.has_all(base) && set.closed() == *set));
    let met = |on: &[Effect], off: &[Effect]| {
        sets.iter().any(|set| set.has_all(EffectSet::of(on)) && set.minus(EffectSet::of(off)) == *set)
    };
    assert!(
        met(&[Effect::Fresnel], &[Effect::Environment]) && met(&[Effect::Environment], &[Effect::Fresnel])
    );
    assert!(met(&[Effect::TintedShadows], &[Effect::Absorption]));
    assert!(!met(&[Effect::TintedShadows], &[Effect::Transmission]), "that cannot be");
    assert!(sets.len() <= 12, "{}", sets.len());
    let all = all_closed(base);
    assert!(sets.iter().all(|set| all.contains(set)) && all.len() > 1000, "{}", all.len());
}

#[test]
fn each_effect_is_in_one_half_and_only_what_others_need_in_both() {
    let base = EffectSet::of(&[Effect::Shadows, Effect::Reflection]);
    let [a, b] = halves(base)[..] else { panic!("not two") };
    assert_eq!(a.with_all(b), CHOICES);
    let both = a.minus(a.minus(b));
    let needed = EffectSet::of(&[Effect::Transmission, Effect::SmoothNormals]);
    assert!(base.with_all(needed).has_all(both) && both != CHOICES, "{a:?} and {b:?}");
}
