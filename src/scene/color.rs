//! Colours: sRGB by hexadecimal or integers, linear by floats; always linear once read.

use std::fmt;

use glam::DVec3;
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

use super::number::{NotNegative, Range};

/// A linear RGB colour, each channel ≥ 0 (lights and backgrounds may exceed 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Color(pub(super) DVec3);

impl Color {
    pub(super) const WHITE: Self = Self(DVec3::ONE);
}

/// Linear value of an 8-bit sRGB code (IEC 61966-2-1, section 5.2).
#[must_use]
pub fn linear_from_srgb8(code: u8) -> f64 {
    let encoded = f64::from(code) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Read "#rrggbb".
fn from_hex(text: &str) -> Option<DVec3> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let code = u32::from_str_radix(digits, 16).ok()?;
    let [_, red, green, blue] = code.to_be_bytes();
    Some(linear_from_codes([red, green, blue]))
}

fn linear_from_codes(codes: [u8; 3]) -> DVec3 {
    DVec3::from_array(codes.map(linear_from_srgb8))
}

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColorVisitor)
    }
}

const EXPECTED: &str = "a colour: \"#rrggbb\", three integers from 0 to 255 (sRGB) or three floats (linear)";

/// Reads a colour in any of its three spellings. The second line of a message is its hint.
struct ColorVisitor;

impl<'de> Visitor<'de> for ColorVisitor {
    type Value = Color;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(EXPECTED)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Color, E> {
        from_hex(text).map(Color).ok_or_else(|| {
            E::custom(format!("\"{text}\" is not a colour\nwrite six hexadecimal digits, like \"#fff3e0\""))
        })
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Color, A::Error> {
        let mut channels = Vec::with_capacity(3);
        while let Some(channel) = sequence.next_element()? {
            channels.push(channel);
        }
        let found = channels.len();
        let channels: [Channel; 3] =
            channels.try_into().map_err(|_| A::Error::invalid_length(found, &self))?;
        match channels {
            [Channel::Code(red), Channel::Code(green), Channel::Code(blue)] => from_codes([red, green, blue]),
            [Channel::Linear(red), Channel::Linear(green), Channel::Linear(blue)] => {
                Ok(Color(DVec3::new(red, green, blue)))
            }
            _ => Err(A::Error::custom(
                "a colour mixes integers and floats\n\
                 write three integers from 0 to 255 (sRGB) or three floats (linear), like [1.0, 0.5, 0.0]",
            )),
        }
    }
}

/// Three sRGB codes; nearly black ones are most likely meant to be linear.
fn from_codes<E: Error>(codes: [u8; 3]) -> Result<Color, E> {
    if codes.iter().all(|&code| code <= 1) && codes != [0; 3] {
        let [red, green, blue] = codes;
        return Err(E::custom(format!(
            "integers are sRGB codes from 0 to 255, so [{red}, {green}, {blue}] is nearly black\n\
             write floats for a linear colour: [{red}.0, {green}.0, {blue}.0]"
        )));
    }
    Ok(Color(linear_from_codes(codes)))
}

/// One item of a colour array.
enum Channel {
    /// An sRGB code.
    Code(u8),
    /// A linear value.
    Linear(f64),
}

impl<'de> Deserialize<'de> for Channel {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ChannelVisitor)
    }
}

/// Reads one item of a colour array.
struct ChannelVisitor;

impl Visitor<'_> for ChannelVisitor {
    type Value = Channel;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an integer from 0 to 255 or a float")
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Channel, E> {
        u8::try_from(value)
            .map(Channel::Code)
            .map_err(|_| E::custom(format!("{value} is out of range: an sRGB code is from 0 to 255")))
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Channel, E> {
        NotNegative::check(value).map(Channel::Linear).map_err(E::custom)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[derive(serde::Deserialize)]
    struct Document {
        color: Color,
    }

    fn read(value: &str) -> Result<DVec3, String> {
        toml::from_str::<Document>(&format!("color = {value}"))
            .map(|document| document.color.0)
            .map_err(|error| error.message().to_owned())
    }

    #[test]
    fn the_three_spellings_agree() {
        let hex = read("'#ff8000'").unwrap();
        assert_eq!(hex, read("[255, 128, 0]").unwrap());
        assert!((hex.y - 0.215_860_5).abs() < 1e-7);
        assert_eq!(read("[1.0, 0.25, 0.0]").unwrap(), DVec3::new(1.0, 0.25, 0.0));
    }

    #[test]
    fn black_may_be_written_in_integers() {
        assert_eq!(read("[0, 0, 0]").unwrap(), DVec3::ZERO);
    }

    #[test]
    fn integers_of_at_most_one_are_refused_with_the_floats_that_were_meant() {
        let message = read("[1, 0, 1]").unwrap_err();
        assert!(message.contains("nearly black") && message.ends_with("[1.0, 0.0, 1.0]"), "{message}");
    }

    #[test]
    fn broken_colours_are_refused() {
        assert!(read("[1, 0.5, 0]").unwrap_err().contains("mixes integers and floats"));
        assert!(read("[256, 0, 0]").unwrap_err().contains("256 is out of range"));
        assert!(read("[-0.5, 0.0, 0.0]").unwrap_err().contains("out of range"));
        assert!(read("[0.5, nan, 0.0]").unwrap_err().contains("NaN"));
        assert!(read("[0.5, 0.5]").unwrap_err().contains("invalid length 2"));
        assert!(read("[0.5, 0.5, 0.5, 0.5]").unwrap_err().contains("invalid length 4"));
        assert!(read("'#12345'").unwrap_err().contains("is not a colour"));
        assert!(read("'red'").unwrap_err().contains("is not a colour"));
        assert!(read("'#1234é'").is_err());
        assert!(read("3").unwrap_err().contains("expected a colour"));
    }
}
