//! What the cases found, as a person reads it.

use super::arithmetic;
use super::report::{CaseResult, Figure, Limit, Report};

/// Characters in a line.
const WIDTH: usize = 100;
/// Characters between columns.
const GAP: usize = 2;

/// The adapters' arithmetic; a table case × device; then what is beyond its bound, or if `verbose` everything.
pub(super) fn tables(report: &Report, verbose: bool) -> String {
    let rows: Vec<_> = report
        .cases
        .iter()
        .map(|case| (format!("{:<4}{}", case.case, case.title), case.results.iter().map(cell).collect()))
        .collect();
    arithmetic::table(&report.arithmetic) + &columns(&report.devices, &rows) + &figures(report, verbose)
}

/// A table of labelled rows under these heads, in parts where it is too wide.
pub(super) fn columns(heads: &[String], rows: &[(String, Vec<String>)]) -> String {
    let widest = |cells: &mut dyn Iterator<Item = &String>| {
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0) + GAP
    };
    let label = widest(&mut rows.iter().map(|(label, _)| label));
    let column = widest(&mut heads.iter().chain(rows.iter().flat_map(|(_, cells)| cells)));
    let fitting = (WIDTH.saturating_sub(label) / column).max(1);
    let mut text = String::new();
    for first in (0..heads.len()).step_by(fitting) {
        let end = heads.len().min(first + fitting);
        text += &line(&" ".repeat(label), &heads[first..end], column);
        for (name, cells) in rows {
            text += &line(&format!("{name:label$}"), &cells[first..end], column);
        }
        text.push('\n');
    }
    text
}

fn line(label: &str, cells: &[String], column: usize) -> String {
    let cells: String = cells.iter().map(|cell| format!("{cell:<column$}")).collect();
    format!("{}\n", format!("{label}{cells}").trim_end())
}

/// The figures behind the table, one a line.
fn figures(report: &Report, verbose: bool) -> String {
    let mut text = String::new();
    for case in &report.cases {
        for result in &case.results {
            for figure in result.findings.iter().filter(|figure| verbose || !figure.holds) {
                let mark = if figure.holds { ' ' } else { '✗' };
                text += &format!("{mark} {} on {}: {}\n", case.case, result.device, sentence(figure));
            }
        }
    }
    text
}

/// What was measured, what came out, and what it should be.
pub(super) fn sentence(figure: &Figure) -> String {
    let Figure { what, trials, .. } = figure;
    let value = match figure.bound {
        Limit::Near { within, .. } => resolved(figure.figure, within),
        _ => number(figure.figure),
    };
    let bound = match figure.bound {
        Limit::AtMost(most) => format!(", at most {}", number(most)),
        Limit::AtLeast(least) => format!(", at least {}", number(least)),
        Limit::Near { expected, within: 0.0 } => format!(", on paper {}", number(expected)),
        Limit::Near { expected, within } => {
            format!(", on paper {} ± {}", resolved(expected, within), number(within))
        }
        Limit::Reported(_) => String::new(),
    };
    format!("{what}: {value}{bound} ({} tried)", count(*trials))
}

/// The most telling figure of a case on a device, with its bound: the first that is beyond it, else the nearest to it.
pub(super) fn cell(result: &CaseResult) -> String {
    let tightness = |figure: &Figure| match figure.bound {
        _ if !figure.holds => f64::INFINITY,
        Limit::AtMost(0.0) => 0.0,
        Limit::AtMost(most) => figure.figure / most,
        Limit::AtLeast(least) => least / figure.figure,
        Limit::Near { within: 0.0, .. } => 0.0,
        Limit::Near { expected, within } => (figure.figure - expected).abs() / within,
        Limit::Reported(_) => -1.0,
    };
    let worst = result.findings.iter().rev().max_by(|a, b| tightness(a).total_cmp(&tightness(b)));
    let Some(worst) = worst else { return "✗ nothing found".to_owned() };
    let value = number(worst.figure);
    match worst.bound {
        _ if worst.trials == 0 => "✗ nothing tried".to_owned(),
        Limit::AtMost(most) if !worst.holds => format!("✗ {value} > {}", number(most)),
        Limit::AtLeast(least) if !worst.holds => format!("✗ {value} < {}", number(least)),
        Limit::Near { expected, .. } if !worst.holds => format!("✗ {value} ≠ {}", number(expected)),
        Limit::AtMost(0.0) => format!("0 of {}", count(zero_trials(result))),
        Limit::AtMost(most) => format!("{value} ≤ {}", number(most)),
        Limit::AtLeast(least) => format!("{value} ≥ {}", number(least)),
        Limit::Near { within: 0.0, .. } => format!("{value} as on paper"),
        Limit::Near { expected, within } => {
            format!("off {} ≤ {}", number((worst.figure - expected).abs()), number(within))
        }
        Limit::Reported(_) => value,
    }
}

/// Trials of all figures that must be 0.
fn zero_trials(result: &CaseResult) -> u64 {
    let zero = result.findings.iter().filter(|figure| figure.bound == Limit::AtMost(0.0));
    zero.map(|figure| figure.trials).sum()
}

/// A figure in as few characters as tell three digits.
pub(super) fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        magnitude if !(1e-3..1e6).contains(&magnitude) => format!("{x:.1e}"),
        _ if x.fract() == 0.0 => format!("{x}"),
        magnitude if magnitude < 100.0 => {
            format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        _ => format!("{x:.0}"),
    }
}

/// A figure with one digit more than its tolerance tells.
fn resolved(x: f64, within: f64) -> String {
    match within {
        0.0 => number(x),
        _ => format!("{x:.*}", (1.0 - within.log10().floor()).clamp(0.0, 12.0) as usize),
    }
}

/// A count, in thousands or millions where it is large.
pub(super) fn count(count: u64) -> String {
    match count {
        0..10_000 => count.to_string(),
        10_000..1_000_000 => format!("{} k", count / 1000),
        _ => format!("{:.1} M", count as f64 / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(figure: f64, bound: Limit, holds: bool) -> Figure {
        Figure { what: "errors".into(), figure, bound, trials: 2000, holds }
    }

    fn cell_of(findings: Vec<Figure>) -> String {
        cell(&CaseResult { device: "CPU".into(), seconds: 0.0, findings })
    }

    #[test]
    fn a_cell_shows_what_falls_else_what_is_nearest_to_its_bound() {
        let none = figure(0.0, Limit::AtMost(0.0), true);
        let near = figure(0.5, Limit::AtMost(1.0), true);
        let far = figure(0.5, Limit::AtMost(100.0), true);
        let fallen = figure(3.0, Limit::AtMost(2.0), false);
        let told = figure(7.0, Limit::Reported(true), true);
        assert_eq!(cell_of(vec![none, told]), "0 of 2000");
        assert_eq!(cell_of(vec![far, near]), "0.5 ≤ 1");
        assert_eq!(cell_of(vec![figure(0.5, Limit::AtMost(1.0), true), fallen]), "✗ 3 > 2");
        assert_eq!(cell_of(vec![]), "✗ nothing found");
    }

    #[test]
    fn a_figure_of_theory_shows_what_it_is_on_paper_and_how_far_off_it_is() {
        let near = |x, within| figure(x, Limit::Near { expected: 42.078, within }, true);
        assert_eq!(sentence(&near(42.07812, 1e-3)), "errors: 42.0781, on paper 42.0780 ± 0.001 (2000 tried)");
        assert_eq!(cell_of(vec![near(42.1, 0.05), near(42.078, 0.05)]), "off 0.022 ≤ 0.05");
        let exact = Limit::Near { expected: 3.0, within: 0.0 };
        assert_eq!(cell_of(vec![figure(3.0, exact, true)]), "3 as on paper");
        assert_eq!(cell_of(vec![figure(4.0, exact, false)]), "✗ 4 ≠ 3");
    }

    #[test]
    fn no_column_runs_into_the_next() {
        let heads = ["SwiftShader Device strict", "CPU"].map(str::to_owned);
        let table = columns(&heads, &[("T1".to_owned(), vec!["0 of 2000".to_owned(), "0".to_owned()])]);
        let lines: Vec<_> = table.lines().collect();
        assert_eq!((lines[0].find("CPU"), lines[1].rfind('0')), (Some(31), Some(31)), "{table}");
    }

    #[test]
    fn numbers_are_short() {
        let shown: Vec<_> = [0.0, 12.0, 0.25, 1.0 / 3.0, 3.4567e-7, 12345.678, 2e6].map(number).into();
        assert_eq!(shown, ["0", "12", "0.25", "0.3333", "3.5e-7", "12346", "2.0e6"]);
        assert_eq!([7, 20_000, 8_000_000].map(count), ["7", "20 k", "8.0 M"]);
    }
}
