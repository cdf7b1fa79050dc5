//! The files of a study: CSV, plots, Markdown and HTML, all from its report.

mod csv;
mod html;
mod markdown;
mod table;

use std::path::Path;

use super::metrics::Seen;
use super::store::Store;
use super::{Report, StudyError, figures};
use crate::film::{Metadata, difference_preview, encode_preview};
use crate::plot::png_of;

/// Write `study.csv`, `report.md`, `report.html` (self-contained) and each plot as SVG and PNG beside
/// `study.json`, which is there already.
///
/// # Errors
/// [`StudyError::Io`], [`StudyError::Raster`].
pub fn write_outputs(report: &Report, folder: &Path) -> Result<(), StudyError> {
    let store = Store::open(folder)?;
    let figures = figures::figures(report);
    store.write("study.csv", csv::csv(report).as_bytes())?;
    for figure in &figures {
        let svg = figure.svg();
        store.write(&format!("{}.png", figure.name), &png_of(figure.name, &svg)?)?;
        store.write(&format!("{}.svg", figure.name), svg.as_bytes())?;
    }
    store.write("report.md", markdown::page(report, &figures).as_bytes())?;
    let images = |name: &str| std::fs::read(folder.join(name)).ok();
    store.write("report.html", html::page(report, &figures, &images).as_bytes())
}

/// Where a row's error image goes.
pub(super) fn error_image_name(id: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' { c.to_ascii_lowercase() } else { '-' };
    let words: String = id.chars().map(plain).collect();
    let words: Vec<_> = words.split('-').filter(|word| !word.is_empty()).collect();
    format!("errors/{}.png", words.join("-"))
}

/// The distance of a picture to its reference in false colours.
pub(super) fn error_image(picture: &Seen, reference: &Seen) -> Result<Vec<u8>, StudyError> {
    let (a, b) = (picture.picture(), reference.picture());
    let preview = difference_preview(&a.channels, &b.channels, a.pixels());
    Ok(encode_preview(picture.width, picture.height, &preview, &Metadata::new())?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_images_have_plain_names() {
        assert_eq!(
            error_image_name("device: llvmpipe (LLVM 15.0.6, 256 bits) (software), strict"),
            "errors/device-llvmpipe-llvm-15.0.6-256-bits-software-strict.png"
        );
        assert_eq!(error_image_name("cutoff: 1/256"), "errors/cutoff-1-256.png");
    }
}
