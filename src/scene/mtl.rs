//! Wavefront MTL material libraries (Alias|Wavefront, "MTL material format", Object Files 4.2).
//!
//! Read: `newmtl Ka Kd Ks Tf Ns Ni d Tr illum map_Kd`; everything else is passed over. What a material means
//! is told in [`super::illumination`].
//!
//! A reader of our own: tobj's knows no lines, and panics on a colour of two numbers.

use glam::DVec3;

use super::number::{AboveZero, NotNegative, Range};
use super::source::Source;
use super::statement::{Reference, Statement, Statements};
use super::{Location, SceneError};

/// A material as written; `None` where the file is silent.
#[derive(Debug, Clone, Default)]
pub(super) struct Mtl {
    /// newmtl.
    pub(super) name: String,
    /// Where the name is written.
    pub(super) location: Option<Location>,
    /// Ka.
    pub(super) ambient: Option<DVec3>,
    /// Kd.
    pub(super) diffuse: Option<DVec3>,
    /// Ks.
    pub(super) specular: Option<DVec3>,
    /// Tf.
    pub(super) filter: Option<DVec3>,
    /// Ns.
    pub(super) shininess: Option<f64>,
    /// Ni.
    pub(super) ior: Option<f64>,
    /// d, or 1 − Tr: 1 is fully there, 0 is not there at all.
    pub(super) dissolve: Option<f64>,
    /// illum, 0 to 10.
    pub(super) illumination: Option<u8>,
    /// map_Kd.
    pub(super) texture: Option<Reference>,
}

/// Read every material of a library.
///
/// # Errors
/// Every fault of the file, with its line and column: see the tests.
pub(super) fn parse(source: &Source) -> Result<Vec<Mtl>, SceneError> {
    let mut materials: Vec<Mtl> = Vec::new();
    for statement in Statements::new(source) {
        if statement.keyword == "newmtl" {
            let Reference { name, location } = statement.reference()?;
            materials.push(Mtl { name, location: Some(location), ..Mtl::default() });
        } else if let Some(material) = materials.last_mut() {
            read(material, &statement)?;
        } else if KEYWORDS.contains(&statement.keyword) {
            let fault =
                statement.fault(statement.keyword, format!("`{}` before any `newmtl`", statement.keyword));
            return Err(fault.into());
        }
    }
    Ok(materials)
}

/// The statements that [`read`] knows.
const KEYWORDS: [&str; 9] = ["Ka", "Kd", "Ks", "Tf", "Ns", "Ni", "d", "Tr", "illum"];

/// Read one statement into its material.
fn read(material: &mut Mtl, statement: &Statement<'_>) -> Result<(), SceneError> {
    match statement.keyword {
        "Ka" => material.ambient = Some(color(statement)?),
        "Kd" => material.diffuse = Some(color(statement)?),
        "Ks" => material.specular = Some(color(statement)?),
        "Tf" => material.filter = Some(color(statement)?),
        "Ns" => material.shininess = Some(number::<NotNegative>(statement)?),
        "Ni" => material.ior = Some(number::<AboveZero>(statement)?),
        "d" => material.dissolve = Some(fraction(statement)?),
        "Tr" => material.dissolve = Some(1.0 - fraction(statement)?),
        "illum" => material.illumination = Some(illumination(statement)?),
        "map_Kd" => material.texture = Some(texture(statement)?),
        _ => {}
    }
    Ok(())
}

/// Read `r [g b]`, linear; one number is a grey.
fn color(statement: &Statement<'_>) -> Result<DVec3, SceneError> {
    if let Some(form @ ("spectral" | "xyz")) = statement.words().next() {
        let fault =
            statement.fault(statement.rest, format!("`{} {form}` is not supported", statement.keyword));
        return Err(fault.hint("write the colour as three linear RGB numbers").into());
    }
    let color = match statement.words().count() {
        1 => DVec3::splat(statement.numbers::<1>()?[0]),
        _ => DVec3::from_array(statement.numbers::<3>()?),
    };
    if color.min_element() < 0.0 {
        let message = format!("a channel of `{}` is below 0", statement.keyword);
        return Err(statement.fault(statement.rest, message).into());
    }
    Ok(color)
}

fn number<R: Range>(statement: &Statement<'_>) -> Result<f64, SceneError> {
    let [value] = statement.numbers::<1>()?;
    R::check(value).map_err(|reason| statement.fault(statement.rest, reason.to_string()).into())
}

/// Read `[-halo] factor` in [0, 1].
fn fraction(statement: &Statement<'_>) -> Result<f64, SceneError> {
    let Some(word) = statement.words().find(|&word| word != "-halo") else {
        return Err(statement
            .fault(statement.keyword, format!("`{}` needs a number", statement.keyword))
            .into());
    };
    let value = statement.number(word)?;
    super::number::Unit::check(value).map_err(|reason| statement.fault(word, reason.to_string()).into())
}

fn illumination(statement: &Statement<'_>) -> Result<u8, SceneError> {
    let word = statement.words().next().unwrap_or(statement.keyword);
    word.parse().ok().filter(|model| *model <= 10).ok_or_else(|| {
        let fault = statement.fault(word, format!("`{word}` is not an illumination model"));
        fault.hint("`illum` is a whole number from 0 to 10").into()
    })
}

/// Read `[options] file`; the file's name may hold spaces, so options are known by their dash.
fn texture(statement: &Statement<'_>) -> Result<Reference, SceneError> {
    if statement.rest.starts_with('-') {
        let fault = statement.fault(statement.rest, "options of `map_Kd` are not supported");
        return Err(fault.hint("write the file's name alone; texture coordinates repeat").into());
    }
    statement.reference()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::path::Path;

    use super::*;

    fn read(text: &str) -> Result<Vec<Mtl>, SceneError> {
        parse(&Source::new(Path::new("a.mtl"), text.into()))
    }

    #[test]
    fn every_statement_is_read() {
        let text = "# a\nnewmtl old glass\nKa 0.1\nKd 0.2 0.3 0.4\nKs 1 1 1\nTf 0.9 1 1\nNs 200\nNi 1.5\n\
                    Tr 0.75\nillum 7\nmap_Kd a b.png\nPr 0.5\nKe 0 0 0\nnewmtl b\nd -halo 0.5\n";
        let materials = read(text).unwrap();
        let glass = &materials[0];
        assert_eq!(glass.name, "old glass");
        assert_eq!(glass.ambient, Some(DVec3::splat(0.1)));
        assert_eq!(glass.diffuse, Some(DVec3::new(0.2, 0.3, 0.4)));
        assert_eq!((glass.specular, glass.filter), (Some(DVec3::ONE), Some(DVec3::new(0.9, 1.0, 1.0))));
        assert_eq!((glass.shininess, glass.ior, glass.dissolve), (Some(200.0), Some(1.5), Some(0.25)));
        assert_eq!(glass.illumination, Some(7));
        assert_eq!(glass.texture.as_ref().map(|texture| texture.name.as_str()), Some("a b.png"));
        assert_eq!((materials[1].dissolve, materials[1].diffuse), (Some(0.5), None));
    }

    #[test]
    fn broken_statements_are_located() {
        for (text, message, line, column) in [
            ("newmtl", "`newmtl` needs a name", 1, 1),
            ("Kd 1 1 1", "`Kd` before any `newmtl`", 1, 1),
            ("newmtl a\nKd 1 1", "`Kd` needs 3 numbers, found 2", 2, 1),
            ("newmtl a\nKd", "`Kd` needs 3 numbers, found 0", 2, 1),
            ("newmtl a\nKd 1 x 1", "`x` is not a number", 2, 6),
            ("newmtl a\nKs 1 1 -1", "a channel of `Ks` is below 0", 2, 4),
            ("newmtl a\nKs spectral a.rfl", "`Ks spectral` is not supported", 2, 4),
            ("newmtl a\nNs -1", "-1 is out of range: expected a number of at least 0", 2, 4),
            ("newmtl a\nNi 0", "0 is out of range: expected a number above 0", 2, 4),
            ("newmtl a\nd 2", "2 is out of range: expected a number from 0 to 1", 2, 3),
            ("newmtl a\nd -halo", "`d` needs a number", 2, 1),
            ("newmtl a\nTr nan", "NaN is not a usable number", 2, 4),
            ("newmtl a\nillum 11", "`11` is not an illumination model", 2, 7),
            ("newmtl a\nmap_Kd -s 2 2 2 a.png", "options of `map_Kd` are not supported", 2, 8),
            ("newmtl a\nmap_Kd", "`map_Kd` needs a name", 2, 1),
        ] {
            let error = read(text).unwrap_err();
            let diagnostic = &error.diagnostics()[0];
            let place = diagnostic.location.as_ref().unwrap();
            assert_eq!(
                (diagnostic.message.as_str(), place.line, place.column),
                (message, line, column),
                "{text:?}"
            );
        }
    }
}
