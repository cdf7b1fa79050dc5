//! The report as one HTML file that needs nothing else: plots inline, error images as data.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;

use super::super::{Knob, Report, RowRecord};
use super::table::{self, MARKS, Table};
use super::{error_image_name, markdown};
use crate::plot::{FONT_FAMILY, Figure, escape};

/// Print and screen, light and plain.
const STYLE: &str = "\
body{max-width:1180px;margin:2em auto;padding:0 1em;color:#111;line-height:1.45}\
h1{font-size:1.6em}h2{font-size:1.2em;margin-top:2em}\
table{border-collapse:collapse;font-size:.82em;font-variant-numeric:tabular-nums}\
th,td{padding:.25em .6em;text-align:right;border-bottom:1px solid #ddd}\
th{border-bottom:1.5px solid #111;vertical-align:bottom}\
th:first-child,td:first-child{text-align:left}td{white-space:nowrap}td:last-child{white-space:normal}\
figure{margin:1.5em 0}figure svg{max-width:100%;height:auto}figcaption{font-size:.9em;color:#333}\
.errors{display:flex;flex-wrap:wrap;gap:.8em}.errors figure{margin:0;width:210px}\
.errors img{width:100%;image-rendering:pixelated}.scroll{overflow-x:auto}";

/// The whole page. `file` reads a file of the study's folder.
pub(super) fn page(report: &Report, figures: &[Figure], file: &dyn Fn(&str) -> Option<Vec<u8>>) -> String {
    let title = format!("What accuracy costs in time: {}", report.scene);
    let mut body = vec![format!("<h1>{}</h1>", escape(&title))];
    body.push(format!("<p>{}</p>", escape(&markdown::introduction(report))));
    for figure in figures {
        let caption = format!("<strong>{}.</strong> {}", escape(&figure.title), escape(&figure.caption));
        body.push(format!("<figure>{}<figcaption>{caption}</figcaption></figure>", figure.svg()));
    }
    body.push("<h2>References</h2>".to_owned());
    body.push(table_text(&markdown::references(report)));
    for knob in Knob::ALL {
        if let Some(table) = table::of_knob(report, knob) {
            body.push(format!("<h2>{}</h2>", escape(knob.title())));
            body.push(table_text(&table));
            body.push(error_images(report, knob, file));
        }
    }
    body.push(format!("<p>{}</p>", escape(MARKS)));
    if !report.left_out.is_empty() {
        let item =
            |row: &super::super::LeftOut| format!("<li>{}: {}</li>", escape(&row.id), escape(&row.reason));
        let items: Vec<_> = report.left_out.iter().map(item).collect();
        body.push(format!("<h2>Left out</h2><ul>{}</ul>", items.concat()));
    }
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>\n\
         <style>body{{font-family:{FONT_FAMILY}}}{STYLE}</style></head>\n<body>\n{}\n</body></html>\n",
        escape(&title),
        body.join("\n")
    )
}

fn table_text(table: &Table) -> String {
    let row = |cells: &[String], tag: &str| {
        let cells: Vec<_> = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escape(cell))).collect();
        format!("<tr>{}</tr>", cells.concat())
    };
    let rows: Vec<_> = table.rows.iter().map(|cells| row(cells, "td")).collect();
    format!(
        "<div class=\"scroll\"><table><thead>{}</thead><tbody>{}</tbody></table></div>",
        row(&table.head, "th"),
        rows.join("\n")
    )
}

/// The false-colour errors of a knob's rows.
fn error_images(report: &Report, knob: Knob, file: &dyn Fn(&str) -> Option<Vec<u8>>) -> String {
    let of_knob = |row: &&RowRecord| row.knob == Some(knob);
    let image = |row: &RowRecord| {
        let data = BASE64_STANDARD.encode(file(&error_image_name(&row.id))?);
        let name = escape(&row.label);
        Some(format!(
            "<figure><img alt=\"errors of {name}\" src=\"data:image/png;base64,{data}\"><figcaption>{name}</figcaption></figure>"
        ))
    };
    let images: Vec<_> = report.rows.iter().filter(of_knob).filter_map(image).collect();
    format!(
        "<p>Errors of each pixel, logarithmic: dark blue 1e−7 or less to yellow 1; black: the same bits.</p>\n\
         <div class=\"errors\">{}</div>",
        images.join("\n")
    )
}
