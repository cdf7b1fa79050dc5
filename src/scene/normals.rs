//! The key `normals` of a model.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Unexpected, Visitor};

use super::Normals;

/// "file", "flat" or a crease angle in degrees.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormalsKey(pub(super) Normals);

impl Default for NormalsKey {
    fn default() -> Self {
        Self(Normals::File)
    }
}

impl<'de> Deserialize<'de> for NormalsKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NormalsVisitor)
    }
}

/// Reads a word or a number.
struct NormalsVisitor;

impl Visitor<'_> for NormalsVisitor {
    type Value = NormalsKey;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"file\", \"flat\" or a crease angle in degrees, above 0 and at most 180")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<NormalsKey, E> {
        match word {
            "file" => Ok(NormalsKey(Normals::File)),
            "flat" => Ok(NormalsKey(Normals::Flat)),
            _ => Err(E::invalid_value(Unexpected::Str(word), &self)),
        }
    }

    fn visit_i64<E: Error>(self, angle: i64) -> Result<NormalsKey, E> {
        self.visit_f64(angle as f64)
    }

    fn visit_f64<E: Error>(self, angle: f64) -> Result<NormalsKey, E> {
        if angle > 0.0 && angle <= 180.0 {
            Ok(NormalsKey(Normals::Crease(angle)))
        } else {
            Err(E::invalid_value(Unexpected::Float(angle), &self))
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[derive(serde::Deserialize)]
    struct Document {
        x: NormalsKey,
    }

    fn read(value: &str) -> Result<Normals, String> {
        toml::from_str::<Document>(&format!("x = {value}"))
            .map(|document| document.x.0)
            .map_err(|error| error.message().to_owned())
    }

    #[test]
    fn words_and_angles_are_read() {
        assert_eq!(read("'file'").unwrap(), Normals::File);
        assert_eq!(read("'flat'").unwrap(), Normals::Flat);
        assert_eq!(read("40").unwrap(), Normals::Crease(40.0));
    }

    #[test]
    fn anything_else_is_refused() {
        for value in ["'smooth'", "0", "-1", "181", "nan", "true"] {
            assert!(read(value).unwrap_err().contains("expected \"file\""), "{value}");
        }
    }
}
