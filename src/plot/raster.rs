//! SVG to PNG, with the font in the binary.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

/// A subset of Liberation Sans 2.1.5 (SIL Open Font License 1.1, beside the file), renamed as the licence asks.
const FONT: &[u8] = include_bytes!("font/snellius-plot.ttf");

/// Pixels a user unit: print at 300 dpi when a figure is 6 cm a panel wide.
const ZOOM: f32 = 2.0;

/// An SVG document that cannot be drawn in pixels.
#[derive(Debug, thiserror::Error)]
#[error("cannot rasterise {name}: {reason}")]
pub struct RasterError {
    /// The drawing's file stem.
    name: String,
    /// Why not.
    reason: String,
}

/// Loaded once.
static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    fonts.set_sans_serif_family("Snellius Plot");
    Arc::new(fonts)
});

/// The picture of an SVG document, twice as many pixels each way as it has user units.
///
/// # Errors
/// [`RasterError`] for a document that is none, or too large to be held.
pub(crate) fn png_of(name: &str, svg: &str) -> Result<Vec<u8>, RasterError> {
    let fault = |reason: String| RasterError { name: name.to_owned(), reason };
    let options = Options { fontdb: FONTS.clone(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|error| fault(error.to_string()))?;
    let size = tree.size().to_int_size();
    let pixels = |side: u32| (side as f32 * ZOOM).ceil() as u32;
    let mut picture = Pixmap::new(pixels(size.width()), pixels(size.height()))
        .ok_or_else(|| fault(format!("{}×{} is too large", size.width(), size.height())))?;
    resvg::render(&tree, Transform::from_scale(ZOOM, ZOOM), &mut picture.as_mut());
    picture.encode_png().map_err(|error| fault(error.to_string()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::Canvas;
    use super::super::canvas::{Anchor, Type};
    use super::*;

    fn dark_pixels(text: &str) -> usize {
        let mut canvas = Canvas::new([120.0, 30.0], "");
        let style = Type { size: 16.0, color: "#000000", anchor: Anchor::Start, bold: false };
        canvas.text([4.0, 20.0], text, style);
        let png = png_of("test", &canvas.finish()).unwrap();
        let picture = image::load_from_memory(&png).unwrap().to_luma8();
        assert_eq!((picture.width(), picture.height()), (240, 60));
        picture.pixels().filter(|pixel| pixel.0[0] < 128).count()
    }

    #[test]
    fn text_is_drawn_without_any_font_of_the_system() {
        assert_eq!(dark_pixels(""), 0);
        assert!(dark_pixels("error") > 100);
        // Each sign that the plots use is in the font.
        for sign in ["−", "×", "·", "≤", "σ", "±", "–", "†"] {
            assert!(dark_pixels(sign) > 4, "{sign}");
        }
    }

    #[test]
    fn what_is_no_svg_is_an_error_with_its_name() {
        assert!(png_of("pareto", "<nothing").unwrap_err().to_string().contains("pareto"));
    }
}
