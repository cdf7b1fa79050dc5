//! What lights the scene from outside: ambient light, background and point lights.

use std::path::Path;

use glam::DVec3;
use toml::Spanned;

use super::color::Color;
use super::document::{AmbientTable, BackgroundTable, FalloffKey, LightTable};
use super::source::Source;
use super::table::Table;
use super::texture::{Purpose, Textures};
use super::{Background, Diagnostic, Falloff, Light};

/// Ia.
pub(super) fn ambient(table: Option<&Table<AmbientTable>>) -> DVec3 {
    table.map_or(DVec3::ZERO, |table| table.color.0 * table.intensity.value)
}

/// A point light.
pub(super) fn light(table: &LightTable) -> Light {
    Light {
        position: table.position.into(),
        intensity: table.color.0 * table.intensity.value,
        falloff: match table.falloff {
            FalloffKey::None => Falloff::None,
            FalloffKey::InverseSquare => Falloff::InverseSquare,
        },
    }
}

/// The background: exactly one of its three kinds; `directory` is the scene file's.
pub(super) fn background(
    table: &Spanned<Table<BackgroundTable>>,
    source: &Source,
    directory: &Path,
    textures: &mut Textures,
) -> Result<Background, Diagnostic> {
    let kinds = "give `color`, or both `zenith` and `horizon`, or `image`";
    let at_table = |message| Diagnostic::error(message).at(source.locate(table.span())).hint(kinds);
    let BackgroundTable { color, zenith, horizon, image, rotation_y, intensity } = &**table.get_ref();
    let scaled = |color: &Color| color.0 * intensity.value;
    if let (None, Some(rotation)) = (image, rotation_y) {
        let message = "`rotation_y` turns an image, and this background has none";
        return Err(Diagnostic::error(message).at(source.locate(rotation.span())));
    }
    match (color, zenith, horizon, image) {
        (Some(color), None, None, None) => Ok(Background::Color(scaled(color))),
        (None, Some(zenith), Some(horizon), None) => {
            Ok(Background::Gradient { zenith: scaled(zenith), horizon: scaled(horizon) })
        }
        (None, None, None, Some(image)) => {
            let texture = textures.load(&directory.join(image.get_ref()), Purpose::Background);
            Ok(Background::Image {
                texture: texture.map_err(|fault| fault.at(source.locate(image.span())))?,
                rotation_y: rotation_y.as_ref().map_or(0.0, |rotation| rotation.get_ref().value),
                intensity: intensity.value,
            })
        }
        (None, None, None, None) => Err(at_table("the background is of no kind")),
        (None, Some(_), None, None) => Err(at_table("the background has a zenith but no horizon")),
        (None, None, Some(_), None) => Err(at_table("the background has a horizon but no zenith")),
        _ => Err(at_table("the background is of several kinds")),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn read(keys: &str) -> Result<Background, Diagnostic> {
        let source = Source::new(Path::new("a.toml"), format!("[background]\n{keys}"));
        let document = super::super::fault::parse(&source).unwrap();
        background(&document.background.unwrap(), &source, Path::new(""), &mut Textures::default())
    }

    #[test]
    fn colours_are_scaled_by_the_intensity() {
        assert_eq!(
            read("color = [1.0, 0.5, 0.0]\nintensity = 2"),
            Ok(Background::Color(DVec3::new(2.0, 1.0, 0.0)))
        );
        assert_eq!(
            read("zenith = [0.0, 0.0, 1.0]\nhorizon = [1.0, 1.0, 1.0]\nintensity = 0.5"),
            Ok(Background::Gradient { zenith: DVec3::Z * 0.5, horizon: DVec3::splat(0.5) })
        );
    }

    #[test]
    fn backgrounds_of_no_or_several_kinds_are_located() {
        for (keys, message, line) in [
            ("intensity = 1", "the background is of no kind", 1),
            ("zenith = '#ffffff'", "the background has a zenith but no horizon", 1),
            ("horizon = '#ffffff'", "the background has a horizon but no zenith", 1),
            ("color = '#ffffff'\nimage = 'a.hdr'", "the background is of several kinds", 1),
            (
                "color = '#ffffff'\nrotation_y = 3",
                "`rotation_y` turns an image, and this background has none",
                3,
            ),
        ] {
            let diagnostic = read(keys).unwrap_err();
            assert_eq!((diagnostic.message.as_str(), diagnostic.location.unwrap().line), (message, line));
        }
    }

    #[test]
    fn a_missing_picture_is_located_where_it_is_named() {
        let diagnostic = read("image = 'no/such.hdr'").unwrap_err();
        assert_eq!(diagnostic.message, "there is no file no/such.hdr");
        assert_eq!((diagnostic.location.clone().unwrap().line, diagnostic.location.unwrap().column), (2, 9));
    }
}
