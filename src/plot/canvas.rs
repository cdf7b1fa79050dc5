//! An SVG document in the making.

use std::fmt::Write;

/// The embedded font first; it has the widths of Helvetica and Arial, which stand in for it in a browser.
pub(crate) const FONT_FAMILY: &str = "Snellius Plot, Liberation Sans, Arial, Helvetica, sans-serif";

/// Where a text is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// At its first letter.
    Start,
    /// In its middle.
    Middle,
    /// Behind its last letter.
    End,
}

/// How a text looks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Type {
    pub(crate) size: f64,
    pub(crate) color: &'static str,
    pub(crate) anchor: Anchor,
    pub(crate) bold: bool,
}

/// An SVG document in the making.
pub(crate) struct Canvas {
    text: String,
}

impl Canvas {
    /// An empty white sheet.
    pub(crate) fn new([width, height]: [f64; 2], title: &str) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
             height=\"{height}\" font-family=\"{FONT_FAMILY}\">\n<title>{}</title>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
            escape(title)
        );
        Self { text }
    }

    /// A straight line; `dash` as in SVG, empty for none.
    pub(crate) fn line(&mut self, a: [f64; 2], b: [f64; 2], color: &str, width: f64, dash: &str) {
        self.put(format_args!(
            "<line x1=\"{:.2}\" y1=\"{:.2}\" x2=\"{:.2}\" y2=\"{:.2}\" stroke=\"{color}\" stroke-width=\"{width}\"{}/>",
            a[0], a[1], b[0], b[1], dashes(dash)
        ));
    }

    /// A line through points.
    pub(crate) fn polyline(&mut self, points: &[[f64; 2]], color: &str, width: f64, dash: &str) {
        let mut list = String::new();
        for [x, y] in points {
            // Writing to a string cannot fail.
            let _ = write!(list, "{x:.2},{y:.2} ");
        }
        self.put(format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\"{}/>",
            list.trim_end(),
            dashes(dash)
        ));
    }

    /// A closed shape.
    pub(crate) fn polygon(&mut self, points: &[[f64; 2]], fill: &str, stroke: &str, width: f64) {
        let list: Vec<_> = points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect();
        self.put(format_args!(
            "<polygon points=\"{}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"{width}\"/>",
            list.join(" ")
        ));
    }

    /// A disc.
    pub(crate) fn circle(&mut self, [x, y]: [f64; 2], radius: f64, fill: &str, stroke: &str) {
        self.put(format_args!(
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"1.5\"/>"
        ));
    }

    /// A text on one line. A `^` begins a superscript that goes on to its end.
    pub(crate) fn text(&mut self, [x, y]: [f64; 2], text: &str, style: Type) {
        self.turned_text([x, y], text, style, 0.0);
    }

    /// A text turned about its anchor, clockwise in degrees.
    pub(crate) fn turned_text(&mut self, [x, y]: [f64; 2], text: &str, style: Type, degrees: f64) {
        let anchor = match style.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn = if degrees == 0.0 {
            String::new()
        } else {
            format!(" transform=\"rotate({degrees} {x:.2} {y:.2})\"")
        };
        let weight = if style.bold { " font-weight=\"bold\"" } else { "" };
        let content = match text.split_once('^') {
            Some((base, raised)) => format!(
                "{}<tspan dy=\"-0.45em\" font-size=\"{:.1}\">{}</tspan>",
                escape(base),
                style.size * 0.75,
                escape(raised)
            ),
            None => escape(text),
        };
        self.put(format_args!(
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{anchor}\"{weight}{turn}>{content}</text>",
            style.size, style.color
        ));
    }

    /// The document.
    pub(crate) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    fn put(&mut self, element: std::fmt::Arguments) {
        let _ = writeln!(self.text, "{element}");
    }
}

fn dashes(dash: &str) -> String {
    if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") }
}

/// A text for XML and HTML.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// About how wide a text is set: the mean letter of the font is half as wide as it is high.
pub(super) fn width_of(text: &str, size: f64) -> f64 {
    let wide = |c: char| match c {
        'i' | 'j' | 'l' | 't' | 'f' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' | '(' | ')' | '/' => 0.3,
        'm' | 'M' | 'W' | 'w' | 'C' | 'G' | 'O' | 'S' | 'U' | 'D' | 'R' | 'N' => 0.76,
        _ => 0.56,
    };
    text.chars().map(wide).sum::<f64>() * size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_break_the_document() {
        let style = Type { size: 12.0, color: "black", anchor: Anchor::Start, bold: false };
        let mut canvas = Canvas::new([10.0, 10.0], "a < b & \"c\"");
        canvas.text([0.0, 0.0], "<script>", style);
        let svg = canvas.finish();
        assert!(svg.contains("a &lt; b &amp; &quot;c&quot;") && svg.contains("&lt;script&gt;"));
        assert!(!svg.contains("<script>"));
    }

    #[test]
    fn powers_are_raised() {
        let style = Type { size: 12.0, color: "black", anchor: Anchor::End, bold: false };
        let mut canvas = Canvas::new([10.0, 10.0], "");
        canvas.text([0.0, 0.0], "10^−3", style);
        assert!(canvas.finish().contains(">10<tspan dy=\"-0.45em\" font-size=\"9.0\">−3</tspan>"));
    }
}
