//! From values to places on the sheet.

/// An axis' range of values on its range of places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// Least and greatest value.
    domain: [f64; 2],
    /// Where they lie.
    range: [f64; 2],
    kind: Kind,
}

/// How values are spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Linear,
    Log,
    /// Logarithmic, with a place for 0 before its beginning.
    LogAndZero,
}

/// A line across the axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    /// Empty for a minor tick.
    pub(crate) label: String,
}

/// The share of a logarithmic axis that is kept for 0.
const ZERO: f64 = 0.1;
/// Most ticks with labels.
const MOST_TICKS: usize = 9;

impl Scale {
    /// A scale on which all values find a place, with a little room around them.
    ///
    /// Values ≤ 0 have no place on a logarithmic scale: they lie at its beginning.
    pub(crate) fn around(values: impl Iterator<Item = f64>, range: [f64; 2], kind: Kind) -> Self {
        let fits = |v: &f64| v.is_finite() && (kind == Kind::Linear || *v > 0.0);
        let (mut low, mut high) =
            values.filter(fits).fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            (low, high) = (1.0, 10.0);
        }
        let domain = if kind == Kind::Linear {
            let room = (high - low).max(low.abs() * 1e-3).max(1e-12) * 0.06;
            [low - room, high + room]
        } else {
            let room = (high / low).powf(0.06).max(1.3);
            [low / room, high * room]
        };
        Self { domain, range, kind }
    }

    /// Where a value lies; outside the domain at its end.
    pub(crate) fn place(&self, value: f64) -> f64 {
        let [low, high] = self.domain;
        let share = match self.kind {
            Kind::Linear => (value - low) / (high - low),
            Kind::Log if value <= low => 0.0,
            Kind::LogAndZero if value <= 0.0 => ZERO / 3.0,
            Kind::Log => (value / low).ln() / (high / low).ln(),
            Kind::LogAndZero => ZERO + (1.0 - ZERO) * (value.max(low) / low).ln() / (high / low).ln(),
        };
        self.range[0] + (self.range[1] - self.range[0]) * share.clamp(0.0, 1.0)
    }

    /// Ticks in the domain.
    pub(crate) fn ticks(&self) -> Vec<Tick> {
        let mut ticks = match self.kind {
            Kind::Linear => self.linear_ticks(),
            Kind::Log | Kind::LogAndZero => self.log_ticks(),
        };
        if self.kind == Kind::LogAndZero {
            ticks.push(Tick { value: 0.0, label: "0".to_owned() });
        }
        ticks
    }

    fn linear_ticks(&self) -> Vec<Tick> {
        let [low, high] = self.domain;
        let raw = (high - low) / 6.0;
        let decade = 10.0_f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * decade).into_iter().find(|&s| s >= raw).unwrap_or(raw);
        let first = (low / step).ceil() as i64;
        let last = (high / step).floor() as i64;
        (first..=last)
            .map(|i| i as f64 * step)
            .map(|value| Tick { value, label: format!("{}", (value / step).round() * step) })
            .collect()
    }

    /// Powers of ten; 1, 2, 5 of each where there are few; the other digits without labels.
    fn log_ticks(&self) -> Vec<Tick> {
        let [low, high] = self.domain;
        let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
        let decades = (last - first) as usize;
        let every = decades.div_ceil(MOST_TICKS).max(1) as i32;
        // One way of writing on one axis.
        let as_powers = decades > 2 && (low < 1e-3 || high > 2e4);
        let mut ticks = Vec::new();
        for exponent in first..=last {
            for digit in 1..=9 {
                let value = f64::from(digit) * 10.0_f64.powi(exponent);
                let named = if decades <= 2 {
                    [1, 2, 5].contains(&digit)
                } else {
                    digit == 1 && exponent.rem_euclid(every) == 0
                };
                let wanted = named || decades <= 5 || digit == 1;
                if (low..=high).contains(&value) && wanted {
                    let label = if named { power_label(digit, exponent, as_powers) } else { String::new() };
                    ticks.push(Tick { value, label });
                }
            }
        }
        ticks
    }
}

/// A value as 0.01, 200, or `10^−5`; 1 and 10 are always written so.
fn power_label(digit: i32, exponent: i32, as_powers: bool) -> String {
    if (0..=1).contains(&exponent) || (!as_powers && (-3..=4).contains(&exponent)) {
        let value = f64::from(digit) * 10.0_f64.powi(exponent);
        let places = usize::try_from(-exponent).unwrap_or(0);
        return format!("{value:.places$}");
    }
    let sign = if exponent < 0 { "−" } else { "" };
    let factor = if digit == 1 { String::new() } else { format!("{digit}·") };
    format!("{factor}10^{sign}{}", exponent.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_are_equally_far_apart() {
        let scale = Scale { domain: [1e-4, 1.0], range: [0.0, 400.0], kind: Kind::Log };
        for (value, place) in
            [(1e-4, 0.0), (1e-3, 100.0), (1e-2, 200.0), (1.0, 400.0), (0.0, 0.0), (-1.0, 0.0)]
        {
            assert!((scale.place(value) - place).abs() < 1e-9, "{value}");
        }
    }

    #[test]
    fn zero_has_a_place_of_its_own_before_the_decades() {
        let scale = Scale { domain: [1e-5, 0.1], range: [0.0, 300.0], kind: Kind::LogAndZero };
        assert!(scale.place(0.0) < scale.place(1e-5));
        assert!(scale.ticks().iter().any(|tick| tick.label == "0"));
    }

    #[test]
    fn ticks_lie_in_the_domain_and_some_have_labels() {
        for (low, high) in [(1e-7, 1.0), (0.3, 0.5), (1.0, 5000.0), (0.02, 3.0)] {
            let scale = Scale::around([low, high].into_iter(), [0.0, 100.0], Kind::Log);
            let ticks = scale.ticks();
            assert!(ticks.iter().filter(|tick| !tick.label.is_empty()).count() >= 1, "{low} {high}");
            assert!(ticks.iter().all(|tick| (scale.domain[0]..=scale.domain[1]).contains(&tick.value)));
        }
        let linear = Scale::around([0.0, 10.0].into_iter(), [0.0, 100.0], Kind::Linear);
        assert!((3..=9).contains(&linear.ticks().len()));
    }

    #[test]
    fn one_value_or_none_still_makes_a_scale() {
        for values in [vec![], vec![3.0], vec![0.0], vec![f64::NAN]] {
            for kind in [Kind::Linear, Kind::Log, Kind::LogAndZero] {
                let scale = Scale::around(values.iter().copied(), [0.0, 100.0], kind);
                assert!(scale.place(3.0).is_finite());
            }
        }
    }

    #[test]
    fn small_and_large_powers_are_written_as_powers() {
        assert_eq!(power_label(1, -2, false), "0.01");
        assert_eq!(power_label(1, -2, true), "10^−2");
        assert_eq!(power_label(1, 1, true), "10");
        assert_eq!(power_label(5, 2, false), "500");
        assert_eq!(power_label(1, -6, false), "10^−6");
        assert_eq!(power_label(2, 7, false), "2·10^7");
    }
}
