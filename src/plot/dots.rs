//! A dot plot: names down the side, values with their intervals along a logarithmic axis.

use super::BLACK;
use super::canvas::{Anchor, Canvas, Type, width_of};
use super::scale::{Kind, Scale};

/// Values of several series, row by row.
pub(crate) struct Dots {
    pub(crate) title: String,
    /// The quantity and its unit.
    pub(crate) label: String,
    /// Names of the rows, from the top.
    pub(crate) rows: Vec<String>,
    pub(crate) series: Vec<DotSeries>,
}

/// What is drawn in one colour.
pub(crate) struct DotSeries {
    pub(crate) name: String,
    pub(crate) color: &'static str,
    /// Of each row, where it has one: the lower end of its interval, the value, the upper end; all above 0.
    pub(crate) values: Vec<Option<[f64; 3]>>,
}

/// Width of the plot without names.
const WIDTH: f64 = 620.0;
/// Room between the sides of the sheet and what is drawn.
const MARGIN: f64 = 16.0;
/// Size of names and numbers, and of titles.
const SMALL: f64 = 12.0;
const LARGE: f64 = 14.0;
const RADIUS: f64 = 4.0;
/// Height of a series within a row, and room between rows.
const STEP: f64 = 11.0;
const GAP: f64 = 12.0;
/// Height of a line of the legend.
const LINE: f64 = 18.0;
const GRID: &str = "#e4e4e4";

impl Dots {
    /// The plot as an SVG document.
    pub(crate) fn svg(&self) -> String {
        let names = self.rows.iter().map(|name| width_of(name, SMALL)).fold(40.0, f64::max);
        let left = MARGIN + names + 10.0;
        let row_height = self.series.len() as f64 * STEP + GAP;
        let top = 44.0 + self.legend_lines().len() as f64 * LINE;
        let bottom = top + self.rows.len() as f64 * row_height;
        let right = left + WIDTH;
        let values = self.series.iter().flat_map(|series| &series.values).flatten().flatten();
        let scale = Scale::around(values.copied(), [left, right], Kind::Log);
        let mut canvas = Canvas::new([right + MARGIN, bottom + 52.0], &self.title);
        let middle = f64::midpoint(left, right);
        canvas.text([middle, 24.0], &self.title, text(LARGE, Anchor::Middle));
        self.legend(&mut canvas, left);
        for tick in scale.ticks() {
            let at = scale.place(tick.value);
            let is_named = !tick.label.is_empty();
            if is_named {
                canvas.line([at, top], [at, bottom], GRID, 1.0, "");
                canvas.text([at, bottom + 19.0], &tick.label, text(SMALL, Anchor::Middle));
            }
            canvas.line([at, bottom], [at, bottom + if is_named { 5.0 } else { 3.0 }], BLACK, 1.0, "");
        }
        for (row, name) in self.rows.iter().enumerate() {
            let above = top + row as f64 * row_height;
            canvas.line([left, above], [right, above], GRID, 1.0, "");
            let base = above + row_height / 2.0 + SMALL * 0.36;
            canvas.text([left - 10.0, base], name, text(SMALL, Anchor::End));
            for (index, series) in self.series.iter().enumerate() {
                let Some(Some([low, value, high])) = series.values.get(row) else { continue };
                let y = above + (GAP + STEP) / 2.0 + index as f64 * STEP;
                canvas.line([scale.place(*low), y], [scale.place(*high), y], series.color, 2.0, "");
                canvas.circle([scale.place(*value), y], RADIUS, series.color, series.color);
            }
        }
        canvas.polyline(&[[left, top], [left, bottom], [right, bottom]], BLACK, 1.0, "");
        canvas.text([middle, bottom + 42.0], &self.label, text(SMALL + 1.0, Anchor::Middle));
        canvas.finish()
    }

    /// Where each series stands in the legend, line by line: its number, and how far right.
    fn legend_lines(&self) -> Vec<Vec<(usize, f64)>> {
        let mut lines: Vec<Vec<(usize, f64)>> = Vec::new();
        let mut end = f64::MAX;
        for (index, series) in self.series.iter().enumerate() {
            let width = width_of(&series.name, SMALL) + 34.0;
            if end + width > WIDTH {
                lines.push(Vec::new());
                end = 0.0;
            }
            if let Some(line) = lines.last_mut() {
                line.push((index, end));
            }
            end += width;
        }
        lines
    }

    fn legend(&self, canvas: &mut Canvas, left: f64) {
        for (line, entries) in self.legend_lines().into_iter().enumerate() {
            let y = 44.0 + line as f64 * LINE;
            for (index, x) in entries {
                let DotSeries { name, color, .. } = &self.series[index];
                canvas.circle([left + x + RADIUS, y], RADIUS, color, color);
                canvas.text([left + x + 14.0, y + SMALL * 0.36], name, text(SMALL, Anchor::Start));
            }
        }
    }
}

fn text(size: f64, anchor: Anchor) -> Type {
    Type { size, color: BLACK, anchor, bold: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dots() -> Dots {
        let series = |name: &str, values: Vec<Option<[f64; 3]>>| DotSeries {
            name: name.to_owned(),
            color: "#0072b2",
            values,
        };
        Dots {
            title: "speed".into(),
            label: "per second".into(),
            rows: vec!["a & b".into(), "c".into()],
            series: vec![
                series("one", vec![Some([1.0, 2.0, 3.0]), None]),
                series(&"long ".repeat(30), vec![Some([9.0, 10.0, 99.0]), Some([4.0, 5.0, 6.0])]),
            ],
        }
    }

    #[test]
    fn each_value_has_a_dot_and_each_series_one_in_the_legend() {
        let svg = dots().svg();
        assert_eq!(svg.matches("<circle").count(), 3 + 2);
        assert!(svg.contains("a &amp; b") && svg.contains("per second"));
    }

    #[test]
    fn a_long_name_begins_a_line_of_the_legend() {
        let lines = dots().legend_lines();
        assert_eq!(lines, [vec![(0, 0.0)], vec![(1, 0.0)]]);
    }
}
