//! The measured times and the fitted powers as a drawing.

use super::super::{color_of, short_name};
use crate::bench::Growth;
use crate::plot::{Axis, Figure, Kind, Line, Mark, Panel, Point, Series};

/// A panel for each axis, both ways logarithmic.
pub(super) fn figure(axes: &[Growth]) -> Figure {
    let mut names: Vec<&str> = Vec::new();
    for growth in axes {
        if !names.contains(&growth.axis) {
            names.push(growth.axis);
        }
    }
    let of = |name: &&str| axes.iter().filter(|growth| growth.axis == *name).collect::<Vec<_>>();
    Figure {
        name: "scale",
        title: "How the time of a trace grows".to_owned(),
        caption: "Medians; lines are fitted powers, with their slopes.".to_owned(),
        panels: names.iter().map(|name| panel(&of(name))).collect(),
    }
}

/// One axis on all devices.
fn panel(devices: &[&Growth]) -> Panel {
    let label = devices.first().map_or("", |growth| growth.label);
    let log = |label: &str| Axis { label: label.to_owned(), kind: Kind::Log, at_points: false };
    let mut series: Vec<Series> = Vec::new();
    for (index, growth) in devices.iter().enumerate() {
        let point = |x: f64, y: f64| Point { x, y, span: None, name: None, mark: Mark::Filled };
        let color = color_of(index);
        let slope = format!("{:.2}", growth.slope.median).replace('-', "−");
        let measured = growth.points.iter().map(|at| point(f64::from(at.amount), at.trace_ms.median));
        series.push(Series {
            name: format!("{}: slope {slope}", short_name(&growth.device)),
            color,
            line: Line::None,
            points: measured.collect(),
        });
        let ends = [growth.points.first(), growth.points.last()].into_iter().flatten();
        let fitted = ends
            .map(|at| f64::from(at.amount))
            .map(|x| Point { mark: Mark::None, ..point(x, growth.fitted(x)) });
        series.push(Series { name: String::new(), color, line: Line::Solid, points: fitted.collect() });
    }
    Panel {
        title: devices.first().map_or_else(String::new, |growth| growth.axis.to_owned()),
        x: log(label),
        y: log("trace, ms"),
        series,
        rules: Vec::new(),
    }
}
