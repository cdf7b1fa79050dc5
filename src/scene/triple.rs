//! One number for three channels or axes, or a number for each.

use std::fmt;
use std::marker::PhantomData;

use glam::DVec3;
use serde::de::value::SeqAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

use super::number::{Number, Range, Vector};

/// Three numbers of the range `R`, which a person may write as one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triple<R> {
    /// The numbers.
    pub(super) value: DVec3,
    range: PhantomData<R>,
}

impl<R> Triple<R> {
    /// The same number thrice.
    pub(super) const fn splat(value: f64) -> Self {
        Self { value: DVec3::splat(value), range: PhantomData }
    }
}

impl<R> Default for Triple<R> {
    fn default() -> Self {
        Self::splat(0.0)
    }
}

impl<'de, R: Range> Deserialize<'de> for Triple<R> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TripleVisitor(PhantomData))
    }
}

/// Reads a number or an array of three.
struct TripleVisitor<R>(PhantomData<R>);

impl<'de, R: Range> Visitor<'de> for TripleVisitor<R> {
    type Value = Triple<R>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, or an array of three", R::EXPECTED)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        let number = Number::<R>::new(value).map_err(E::custom)?;
        Ok(Triple::splat(number.value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<Self::Value, A::Error> {
        let vector = Vector::<3, R>::deserialize(SeqAccessDeserializer::new(sequence))?;
        Ok(Triple { value: vector.into(), range: PhantomData })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::scene::number::AboveZero;

    #[derive(serde::Deserialize)]
    struct Document {
        x: Triple<AboveZero>,
    }

    fn read(value: &str) -> Result<DVec3, String> {
        toml::from_str::<Document>(&format!("x = {value}"))
            .map(|document| document.x.value)
            .map_err(|error| error.message().to_owned())
    }

    #[test]
    fn one_number_stands_for_three() {
        assert_eq!(read("2").unwrap(), DVec3::splat(2.0));
        assert_eq!(read("[1, 2.0, 3]").unwrap(), DVec3::new(1.0, 2.0, 3.0));
    }

    #[test]
    fn ranges_and_lengths_are_held() {
        assert!(read("0").unwrap_err().contains("above 0"));
        assert!(read("[1, 0, 1]").unwrap_err().contains("above 0"));
        assert!(read("[1, 2]").unwrap_err().contains("invalid length 2"));
        assert!(read("'big'").unwrap_err().contains("or an array of three"));
    }
}
