//! Numbers as a scene file may hold them: checked while they are read, so that every fault has its place.

use std::fmt;
use std::marker::PhantomData;

use glam::{DVec2, DVec3};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Unexpected, Visitor};

/// Why a number is no good; the reader of the file adds the place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NotInRange(String);

impl fmt::Display for NotInRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Accept what f32, in which devices compute, can hold.
pub(super) fn check_finite(value: f64) -> Result<f64, NotInRange> {
    if value.is_nan() {
        Err(NotInRange("NaN is not a usable number".into()))
    } else if value.is_infinite() {
        Err(NotInRange("an infinite number is not usable".into()))
    } else if value.abs() > f64::from(f32::MAX) {
        Err(NotInRange(format!("{value:e} is too large: the largest number is {:.1e}", f32::MAX)))
    } else {
        Ok(value)
    }
}

/// A set of finite numbers, with the words that name it.
pub(super) trait Range {
    /// Completes "expected …".
    const EXPECTED: &'static str;
    /// Whether a finite number belongs to it.
    fn contains(value: f64) -> bool;

    /// Accept a finite number of this range.
    fn check(value: f64) -> Result<f64, NotInRange> {
        check_contained::<Self>(check_finite(value)?)
    }
}

fn check_contained<R: Range + ?Sized>(value: f64) -> Result<f64, NotInRange> {
    if R::contains(value) {
        Ok(value)
    } else {
        Err(NotInRange(format!("{value} is out of range: expected {}", R::EXPECTED)))
    }
}

/// Every finite number.
#[derive(Debug, Clone, Copy)]
pub(super) enum Any {}

impl Range for Any {
    const EXPECTED: &'static str = "a number";
    fn contains(_: f64) -> bool {
        true
    }
}

/// [0, ∞).
#[derive(Debug, Clone, Copy)]
pub(super) enum NotNegative {}

impl Range for NotNegative {
    const EXPECTED: &'static str = "a number of at least 0";
    fn contains(value: f64) -> bool {
        value >= 0.0
    }
}

/// (0, ∞), without the numbers that f32 rounds to a subnormal or to 0.
#[derive(Debug, Clone, Copy)]
pub(super) enum AboveZero {}

impl Range for AboveZero {
    const EXPECTED: &'static str = "a number above 0";
    fn contains(value: f64) -> bool {
        value > 0.0
    }

    fn check(value: f64) -> Result<f64, NotInRange> {
        let value = check_finite(value)?;
        if value > 0.0 && value < f64::from(f32::MIN_POSITIVE) {
            return Err(NotInRange(format!(
                "{value:e} is too small: the smallest is {:.1e}",
                f32::MIN_POSITIVE
            )));
        }
        check_contained::<Self>(value)
    }
}

/// [0, 1].
#[derive(Debug, Clone, Copy)]
pub(super) enum Unit {}

impl Range for Unit {
    const EXPECTED: &'static str = "a number from 0 to 1";
    fn contains(value: f64) -> bool {
        (0.0..=1.0).contains(&value)
    }
}

/// Angles of view: (0, 180) degrees, kept a little away from the ends, where the tangent is useless.
#[derive(Debug, Clone, Copy)]
pub(super) enum ViewAngle {}

impl Range for ViewAngle {
    const EXPECTED: &'static str = "an angle in degrees above 0 and below 180";
    fn contains(value: f64) -> bool {
        (1e-3..=179.9).contains(&value)
    }
}

/// A number of the range `R`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Number<R = Any> {
    /// The number.
    pub(super) value: f64,
    range: PhantomData<R>,
}

impl<R: Range> Number<R> {
    /// A number that the program itself chooses, and answers for.
    pub(super) const fn literal(value: f64) -> Self {
        Self { value, range: PhantomData }
    }

    /// Accept a number of the range.
    pub(super) fn new(value: f64) -> Result<Self, NotInRange> {
        R::check(value).map(Self::literal)
    }
}

impl<'de, R: Range> Deserialize<'de> for Number<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberVisitor(PhantomData))
    }
}

/// Reads a TOML integer or float.
struct NumberVisitor<R>(PhantomData<R>);

impl<R: Range> Visitor<'_> for NumberVisitor<R> {
    type Value = Number<R>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(R::EXPECTED)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        Number::new(value).map_err(E::custom)
    }
}

/// Exactly `N` numbers of the range `R`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vector<const N: usize, R = Any>(pub(super) [Number<R>; N]);

impl<R> From<Vector<3, R>> for DVec3 {
    fn from(Vector([x, y, z]): Vector<3, R>) -> Self {
        DVec3::new(x.value, y.value, z.value)
    }
}

impl<R> From<Vector<2, R>> for DVec2 {
    fn from(Vector([x, y]): Vector<2, R>) -> Self {
        DVec2::new(x.value, y.value)
    }
}

impl<'de, const N: usize, R: Range> Deserialize<'de> for Vector<N, R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        fixed_array(deserializer, R::EXPECTED).map(Self)
    }
}

/// Exactly `N` whole numbers from `MIN` to `MAX`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wholes<const N: usize, const MIN: u32, const MAX: u32>(pub(super) [Whole<MIN, MAX>; N]);

impl<const N: usize, const MIN: u32, const MAX: u32> Wholes<N, MIN, MAX> {
    /// The numbers.
    pub(super) fn values(self) -> [u32; N] {
        self.0.map(|whole| whole.0)
    }
}

impl<'de, const N: usize, const MIN: u32, const MAX: u32> Deserialize<'de> for Wholes<N, MIN, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        fixed_array(deserializer, "a whole number").map(Self)
    }
}

/// A whole number from `MIN` to `MAX`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Whole<const MIN: u32, const MAX: u32>(pub(super) u32);

impl<const MIN: u32, const MAX: u32> Whole<MIN, MAX> {
    /// So many steps up, or down below 0, within the range.
    pub(super) fn stepped(self, steps: i32) -> Self {
        Self(self.0.saturating_add_signed(steps).clamp(MIN, MAX))
    }
}

impl<'de, const MIN: u32, const MAX: u32> Deserialize<'de> for Whole<MIN, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(WholeVisitor)
    }
}

/// Reads a TOML integer.
struct WholeVisitor<const MIN: u32, const MAX: u32>;

impl<const MIN: u32, const MAX: u32> Visitor<'_> for WholeVisitor<MIN, MAX> {
    type Value = Whole<MIN, MAX>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a whole number from {MIN} to {MAX}")
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        match u32::try_from(value) {
            Ok(whole) if (MIN..=MAX).contains(&whole) => Ok(Whole(whole)),
            _ => Err(E::custom(format!(
                "{value} is out of range: expected a whole number from {MIN} to {MAX}"
            ))),
        }
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        Err(E::invalid_type(Unexpected::Float(value), &self))
    }
}

/// Read an array of exactly `N` items; unlike serde's own arrays, more than `N` is an error too.
pub(super) fn fixed_array<'de, T, D, const N: usize>(
    deserializer: D,
    item: &'static str,
) -> Result<[T; N], D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    deserializer.deserialize_seq(ArrayVisitor { item, items: PhantomData })
}

/// Reads an array of exactly `N` items.
struct ArrayVisitor<T, const N: usize> {
    item: &'static str,
    items: PhantomData<[T; N]>,
}

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for ArrayVisitor<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an array of {N}, each {}", self.item)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Self::Value, A::Error> {
        let mut items = Vec::with_capacity(N);
        while let Some(item) = sequence.next_element()? {
            items.push(item);
        }
        let found = items.len();
        items.try_into().map_err(|_| A::Error::invalid_length(found, &self))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[derive(Debug, serde::Deserialize)]
    struct Document<T> {
        x: T,
    }

    fn read<T: serde::de::DeserializeOwned>(value: &str) -> Result<T, String> {
        toml::from_str::<Document<T>>(&format!("x = {value}"))
            .map(|document| document.x)
            .map_err(|error| error.message().to_owned())
    }

    #[test]
    fn integers_and_floats_are_numbers() {
        assert_eq!(read::<Number>("3").unwrap().value, 3.0);
        assert_eq!(read::<Number>("-2.5").unwrap().value, -2.5);
    }

    #[test]
    fn unusable_numbers_are_refused() {
        assert!(read::<Number>("nan").unwrap_err().contains("NaN"));
        assert!(read::<Number>("-inf").unwrap_err().contains("infinite"));
        assert!(read::<Number>("1e39").unwrap_err().contains("1e39 is too large"));
        assert!(read::<Number>("'a'").unwrap_err().contains("expected a number"));
    }

    #[test]
    fn ranges_are_held() {
        assert!(read::<Number<NotNegative>>("-1").unwrap_err().contains("-1 is out of range"));
        assert!(read::<Number<AboveZero>>("0").is_err());
        assert!(read::<Number<AboveZero>>("1e-40").unwrap_err().contains("too small"));
        assert!(read::<Number<Unit>>("1.5").is_err());
        assert!(read::<Number<ViewAngle>>("180").is_err());
        assert!(read::<Whole<1, 8>>("0").unwrap_err().contains("from 1 to 8"));
        assert!(read::<Whole<1, 8>>("9").is_err());
        assert!(read::<Whole<1, 8>>("1.5").unwrap_err().contains("expected a whole number"));
        assert!(read::<Whole<1, 8>>("99999999999").is_err());
    }

    #[test]
    fn arrays_have_exactly_their_length() {
        assert_eq!(DVec3::from(read::<Vector<3>>("[1, 2.5, 3]").unwrap()), DVec3::new(1.0, 2.5, 3.0));
        assert!(read::<Vector<3>>("[1, 2]").unwrap_err().contains("array of 3"));
        assert!(read::<Vector<3>>("[1, 2, 3, 4]").unwrap_err().contains("invalid length 4"));
        assert!(read::<Vector<3>>("7").is_err());
    }
}
