//! Figures for print and screen: SVG of our own, and PNG of the same SVG.
//!
//! A `Figure` is a row of `Panel`s: points and lines over two axes, named where they are (direct labels,
//! no legend). Text is set in a font that lies in the binary, so that plots look alike on a machine without any.

mod canvas;
mod dots;
mod labels;
mod panel;
mod raster;
mod scale;

pub(crate) use canvas::{Anchor, Canvas, FONT_FAMILY, Type, escape};
pub(crate) use dots::{DotSeries, Dots};
pub(crate) use panel::{Axis, Kind, Line, Mark, Panel, Point, Rule, Series};
pub use raster::RasterError;
pub(crate) use raster::png_of;

/// Okabe and Ito's colours, told apart by all (Okabe and Ito 2008, "Color Universal Design"): black, orange,
/// sky blue, bluish green, blue, vermillion, reddish purple.
pub(crate) const BLACK: &str = "#000000";
/// See [`BLACK`].
pub(crate) const ORANGE: &str = "#e69f00";
/// See [`BLACK`].
pub(crate) const SKY: &str = "#56b4e9";
/// See [`BLACK`].
pub(crate) const GREEN: &str = "#009e73";
/// See [`BLACK`].
pub(crate) const BLUE: &str = "#0072b2";
/// See [`BLACK`].
pub(crate) const VERMILLION: &str = "#d55e00";
/// See [`BLACK`].
pub(crate) const PURPLE: &str = "#cc79a7";
/// For what stands in the background.
pub(crate) const GREY: &str = "#8a8a8a";

/// Width and height of a panel with its axes, in user units.
const PANEL: [f64; 2] = [560.0, 420.0];
/// Room between panels.
const GAP: f64 = 10.0;

/// Panels side by side.
pub(crate) struct Figure {
    /// File stem.
    pub(crate) name: &'static str,
    /// What it shows, in a few words.
    pub(crate) title: String,
    /// How to read it, in sentences.
    pub(crate) caption: String,
    pub(crate) panels: Vec<Panel>,
}

impl Figure {
    /// The figure as an SVG document.
    pub(crate) fn svg(&self) -> String {
        self.svg_in_columns(self.panels.len())
    }

    /// The same with so many panels in a row, the others below.
    pub(crate) fn svg_in_columns(&self, columns: usize) -> String {
        let columns = columns.clamp(1, self.panels.len().max(1));
        let counts = [columns, self.panels.len().div_ceil(columns).max(1)];
        let place = |axis: usize, index: usize| index as f64 * (PANEL[axis] + GAP);
        let size = [0, 1].map(|axis| place(axis, counts[axis]) - GAP);
        let mut canvas = Canvas::new(size, &self.title);
        for (index, panel) in self.panels.iter().enumerate() {
            panel.draw(&mut canvas, [place(0, index % columns), place(1, index / columns)], PANEL);
        }
        canvas.finish()
    }
}
