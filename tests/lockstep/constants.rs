//! Guard 2: a number that both devices share is written down once, in Rust.

use snellius::gpu::{SOURCES, Source};
use snellius::layout::constants::{SHARED, Shared};

use super::planted::Planted;

/// Whole numbers below this are indices and factors, of which every program is full.
const TRIVIAL: f64 = 6.0;

/// Literals that equal a shared number by chance: file, literal, how often, and what it is.
const ALLOWED: &[(&str, &str, usize, &str)] = &[
    ("hash", "8", 1, "32 bits less the 24 of a fraction"),
    ("hash", "0x80000000u", 1, "one half in 32 bits"),
    ("math", "17.0", 1, "a term of the arctangent's series"),
    ("texture", "8", 1, "bits of a channel"),
    ("texture", "16", 1, "bits of two channels"),
    ("whitted", "8u", 1, "the back side in a hash"),
    ("wide", "8u", 2, "bits of a byte"),
    ("wide", "16u", 2, "bits of two bytes"),
];

/// Literals that repeat a shared number, and allowances that allow nothing.
fn repetitions(sources: &[Source<'_>]) -> Vec<String> {
    let mut found = Vec::new();
    for (stem, text) in sources {
        let literals = literals(text);
        for literal in &literals {
            let allowed = ALLOWED.iter().any(|one| (one.0, one.1) == (*stem, literal.as_str()));
            if let (Some(name), false) = (repeated(literal), allowed) {
                found.push(format!("{stem}: {literal} is {name}"));
            }
        }
        for (_, literal, times, what) in ALLOWED.iter().filter(|one| one.0 == *stem) {
            let count = literals.iter().filter(|one| one == literal).count();
            if count != *times {
                found.push(format!("{stem}: {literal} ({what}) is there {count} times, not {times}"));
            }
        }
    }
    found
}

/// The shared number that the literal repeats.
fn repeated(literal: &str) -> Option<&'static str> {
    let value = value(literal)?;
    let is_same = |shared: Shared| match shared {
        Shared::U32(number) => value == f64::from(number) && value >= TRIVIAL,
        // A number cut to seven digits is the same number.
        Shared::F32(number) => (value - f64::from(number)).abs() <= 1e-6 * f64::from(number).abs(),
        Shared::Real(number) => (value - number).abs() <= 1e-6 * number.abs(),
    };
    SHARED.iter().find(|(_, number)| is_same(number())).map(|(name, _)| *name)
}

/// The value of a literal; none for what is no number.
fn value(literal: &str) -> Option<f64> {
    let lower = literal.to_lowercase();
    match lower.strip_prefix("0x") {
        Some(hex) => u32::from_str_radix(hex.trim_end_matches(['u', 'i']), 16).ok().map(f64::from),
        None => lower.trim_end_matches(['u', 'i', 'f', 'h']).parse().ok(),
    }
}

/// Every number in the code, as it is written.
fn literals(text: &str) -> Vec<String> {
    let code: String =
        text.lines().map(|line| line.split("//").next().unwrap_or_default().to_owned() + "\n").collect();
    let mut literals = Vec::new();
    let mut rest = code.as_str();
    while let Some(start) = rest.find(|char: char| char.is_alphanumeric() || char == '_') {
        rest = &rest[start..];
        let mut previous = ' ';
        let length = rest
            .find(|char: char| {
                let sign = matches!(char, '+' | '-')
                    && matches!(previous, 'e' | 'E')
                    && rest.starts_with(|c: char| c.is_ascii_digit());
                let ends = !(char.is_alphanumeric()
                    || char == '_'
                    || (char == '.' && rest.starts_with(|c: char| c.is_ascii_digit()))
                    || sign);
                previous = char;
                ends
            })
            .unwrap_or(rest.len());
        if rest.starts_with(|char: char| char.is_ascii_digit()) {
            literals.push(rest[..length].to_owned());
        }
        rest = &rest[length..];
    }
    literals
}

#[test]
fn no_shader_repeats_a_shared_number() {
    assert_eq!(repetitions(SOURCES), Vec::<String>::new());
}

#[test]
fn literals_are_read_as_wgsl_writes_them() {
    let text = "let a2 = 3u + 0x1fu; // 64\nvec3f(1.5, 2e-3f).x; x[4] * .5;";
    assert_eq!(literals(text), ["3u", "0x1fu", "1.5", "2e-3f", "4", "5"]);
    assert_eq!(value("0x1fu"), Some(31.0));
    assert_eq!(value("2e-3f"), Some(0.002));
}

#[test]
fn a_repeated_constant_is_caught() {
    let planted = Planted::new("whitted", "i < MAX_PASSES", "i < 4096u");
    let found = repetitions(&planted.sources());
    assert_eq!(found, ["whitted: 4096u is MAX_PASSES"]);
}

#[test]
fn a_number_cut_short_is_caught() {
    assert_eq!(repeated("3.1415927"), Some("PI"));
    assert_eq!(repeated("3.14"), None);
}
