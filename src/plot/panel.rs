//! One plot: axes, lines, marks, names.

use super::canvas::{Anchor, Canvas, Type, width_of};
use super::labels::{Place, Taken};
pub(crate) use super::scale::Kind;
use super::scale::{Scale, Tick};
use super::{BLACK, GREY};

/// What an axis shows.
#[derive(Debug, Clone)]
pub(crate) struct Axis {
    /// The quantity and its unit.
    pub(crate) label: String,
    pub(crate) kind: Kind,
    /// Whether numbers stand at the points instead of at round values.
    pub(crate) at_points: bool,
}

/// How points are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Line {
    None,
    Solid,
    Dashed,
}

/// How a point is marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    Filled,
    Hollow,
    /// Only for the line.
    None,
}

/// A point with what is known of it.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// The interval of x.
    pub(crate) span: Option<[f64; 2]>,
    pub(crate) name: Option<String>,
    pub(crate) mark: Mark,
}

/// Points that belong together.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    /// Written at its last point; empty for none.
    pub(crate) name: String,
    pub(crate) color: &'static str,
    pub(crate) line: Line,
    pub(crate) points: Vec<Point>,
}

/// A horizontal line with a name.
#[derive(Debug, Clone)]
pub(crate) struct Rule {
    pub(crate) y: f64,
    pub(crate) name: String,
}

/// One plot.
#[derive(Debug, Clone)]
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    /// What comes first gets its names first.
    pub(crate) series: Vec<Series>,
    pub(crate) rules: Vec<Rule>,
}

/// Size of axis numbers and names, of axis titles, of the panel's title.
const SMALL: f64 = 12.0;
const MEDIUM: f64 = 13.0;
const LARGE: f64 = 14.0;
/// Radius of a mark.
const MARK: f64 = 4.0;
const GRID: &str = "#e4e4e4";

impl Panel {
    /// Draw on a part of the sheet.
    pub(super) fn draw(&self, canvas: &mut Canvas, [left, top]: [f64; 2], [width, height]: [f64; 2]) {
        let area = [left + 74.0, top + 40.0, left + width - 16.0, top + height - 54.0];
        let points = || self.series.iter().flat_map(|series| &series.points);
        let xs = points().flat_map(|p| [p.x].into_iter().chain(p.span.into_iter().flatten()));
        let ys = points().map(|p| p.y).chain(self.rules.iter().map(|rule| rule.y));
        let x = Scale::around(xs, [area[0], area[2]], self.x.kind);
        let y = Scale::around(ys, [area[3], area[1]], self.y.kind);
        let drawing = Drawing { panel: self, area, x, y };
        drawing.frame(canvas);
        let mut taken = Taken::inside(area);
        drawing.rules(canvas, &mut taken);
        drawing.lines(canvas, &mut taken);
        drawing.marks(canvas, &mut taken);
        drawing.names(canvas, &mut taken);
    }
}

/// A panel with its scales.
struct Drawing<'a> {
    panel: &'a Panel,
    /// Left, top, right and bottom of the plot without its axes.
    area: [f64; 4],
    x: Scale,
    y: Scale,
}

impl Drawing<'_> {
    fn place(&self, point: &Point) -> [f64; 2] {
        [self.x.place(point.x), self.y.place(point.y)]
    }

    /// Grid, axes, numbers and titles.
    fn frame(&self, canvas: &mut Canvas) {
        let [left, top, right, bottom] = self.area;
        let number = |anchor| Type { size: SMALL, color: BLACK, anchor, bold: false };
        for tick in self.x_ticks() {
            let at = self.x.place(tick.value);
            let major = !tick.label.is_empty();
            if major {
                canvas.line([at, top], [at, bottom], GRID, 1.0, "");
                canvas.text([at, bottom + 19.0], &tick.label, number(Anchor::Middle));
            }
            canvas.line([at, bottom], [at, bottom + if major { 5.0 } else { 3.0 }], BLACK, 1.0, "");
        }
        for tick in self.y.ticks() {
            let at = self.y.place(tick.value);
            let major = !tick.label.is_empty();
            if major {
                canvas.line([left, at], [right, at], GRID, 1.0, "");
                canvas.text([left - 9.0, at + SMALL * 0.36], &tick.label, number(Anchor::End));
            }
            canvas.line([left - if major { 5.0 } else { 3.0 }, at], [left, at], BLACK, 1.0, "");
        }
        canvas.polyline(&[[left, top], [left, bottom], [right, bottom]], BLACK, 1.0, "");
        let title = |size, bold| Type { size, color: BLACK, anchor: Anchor::Middle, bold };
        let middle = [f64::midpoint(left, right), f64::midpoint(top, bottom)];
        canvas.text([middle[0], bottom + 42.0], &self.panel.x.label, title(MEDIUM, false));
        canvas.turned_text([left - 56.0, middle[1]], &self.panel.y.label, title(MEDIUM, false), -90.0);
        canvas.text([middle[0], top - 16.0], &self.panel.title, title(LARGE, false));
    }

    fn x_ticks(&self) -> Vec<Tick> {
        if !self.panel.x.at_points {
            return self.x.ticks();
        }
        let mut values: Vec<_> = self.panel.series.iter().flat_map(|s| &s.points).map(|p| p.x).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values.into_iter().map(|value| Tick { value, label: value.to_string() }).collect()
    }

    fn rules(&self, canvas: &mut Canvas, taken: &mut Taken) {
        let [left, _, right, _] = self.area;
        for rule in &self.panel.rules {
            let at = self.y.place(rule.y);
            canvas.line([left, at], [right, at], GREY, 1.2, "2 3");
            let (width, base) = (width_of(&rule.name, SMALL), at - 5.0);
            let style = Type { size: SMALL, color: "#5a5a5a", anchor: Anchor::End, bold: false };
            canvas.text([right - 4.0, base], &rule.name, style);
            taken.take([right - 4.0 - width, base - SMALL, right, base + 4.0]);
            taken.take([left, at - 1.0, right, at + 1.0]);
        }
    }

    fn lines(&self, canvas: &mut Canvas, taken: &mut Taken) {
        for series in &self.panel.series {
            let dash = match series.line {
                Line::None => continue,
                Line::Solid => "",
                Line::Dashed => "6 4",
            };
            let places: Vec<_> = series.points.iter().map(|point| self.place(point)).collect();
            canvas.polyline(&places, series.color, 2.0, dash);
            // Keep names off the line: a mark's worth of room every few units.
            for pair in places.windows(2) {
                for step in 1..12 {
                    let t = f64::from(step) / 12.0;
                    let along = [0, 1].map(|i| pair[0][i] + (pair[1][i] - pair[0][i]) * t);
                    taken.take_mark(along, 2.0);
                }
            }
        }
    }

    fn marks(&self, canvas: &mut Canvas, taken: &mut Taken) {
        // The last series lies deepest.
        for series in self.panel.series.iter().rev() {
            for point in series.points.iter().filter(|point| point.mark != Mark::None) {
                let at = self.place(point);
                if let Some([low, high]) = point.span {
                    taken.take([self.x.place(low), at[1] - 2.0, self.x.place(high), at[1] + 2.0]);
                    canvas.line(
                        [self.x.place(low), at[1]],
                        [self.x.place(high), at[1]],
                        series.color,
                        1.2,
                        "",
                    );
                }
                let fill = if point.mark == Mark::Filled { series.color } else { "white" };
                if point.y <= 0.0 && self.panel.y.kind == Kind::Log {
                    // Nothing lies at the beginning of a logarithmic axis: an arrow downwards.
                    let [x, y] = at;
                    let arrow = [[x - MARK, y - 2.0 * MARK], [x + MARK, y - 2.0 * MARK], [x, y]];
                    canvas.polygon(&arrow, fill, series.color, 1.5);
                } else {
                    canvas.circle(at, MARK, fill, series.color);
                }
                taken.take_mark(at, MARK + 1.0);
            }
        }
    }

    /// Names of series beside the last of their points that has room, then names of points, as far as there is room.
    fn names(&self, canvas: &mut Canvas, taken: &mut Taken) {
        for series in self.panel.series.iter().filter(|series| !series.name.is_empty()) {
            let places = || series.points.iter().rev().map(|point| self.place(point));
            let beside = places().find_map(|at| taken.place_beside(at, &series.name, SMALL));
            let found = beside.or_else(|| places().find_map(|at| taken.place(at, &series.name, SMALL)));
            if let Some(Place { at, anchor, .. }) = found {
                let style = Type { size: SMALL, color: series.color, anchor, bold: false };
                canvas.text(at, &series.name, style);
            }
        }
        for series in &self.panel.series {
            for point in &series.points {
                if let Some(name) = &point.name
                    && let Some(Place { at, anchor, is_far }) = taken.place(self.place(point), name, SMALL)
                {
                    if is_far {
                        canvas.line(self.place(point), [at[0], at[1] - SMALL * 0.35], "#b0b0b0", 0.8, "");
                    }
                    let color = if point.mark == Mark::Filled { BLACK } else { "#6a6a6a" };
                    canvas.text(at, name, Type { size: SMALL, color, anchor, bold: false });
                }
            }
        }
    }
}
