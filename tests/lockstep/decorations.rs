//! The SPIR-V of the strict variants leaves no float operation to the compiler's taste.

use std::collections::HashSet;

use snellius::gpu::{Promises, SOURCES, Variant, assemble, write_spirv};
use snellius::layout::Float;

use super::variants;

/// OpDecorate, and the decoration NoContraction (SPIR-V specification 1.6, sections 3.52.3 and 3.20).
const DECORATE: u32 = 71;
const NO_CONTRACTION: u32 = 42;
/// OpTypeFloat, OpTypeVector, OpTypeMatrix.
const TYPE_FLOAT: u32 = 22;
const TYPE_VECTOR: u32 = 23;
const TYPE_MATRIX: u32 = 24;
/// The arithmetic instructions, OpSNegate to OpDot (section 3.52.13); those of floats are told by their type.
const ARITHMETIC: std::ops::RangeInclusive<u32> = 126..=148;

/// The instructions of a module: opcode and operands.
fn instructions(words: &[u32]) -> Vec<(u32, &[u32])> {
    let mut rest = &words[5..];
    let mut found = Vec::new();
    while let [first, ..] = rest {
        let (instruction, behind) = rest.split_at((first >> 16) as usize);
        found.push((first & 0xffff, &instruction[1..]));
        rest = behind;
    }
    found
}

/// Results of float arithmetic, and those of them without the decoration.
fn float_arithmetic(words: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut floats = HashSet::new();
    let mut decorated = HashSet::new();
    let mut results = Vec::new();
    for (op, operands) in instructions(words) {
        match (op, operands) {
            (TYPE_FLOAT, [result, ..]) => {
                floats.insert(*result);
            }
            (TYPE_VECTOR | TYPE_MATRIX, [result, of, ..]) if floats.contains(of) => {
                floats.insert(*result);
            }
            (DECORATE, [target, NO_CONTRACTION]) => {
                decorated.insert(*target);
            }
            (op, [kind, result, ..]) if ARITHMETIC.contains(&op) && floats.contains(kind) => {
                results.push(*result)
            }
            _ => {}
        }
    }
    let bare = results.iter().copied().filter(|result| !decorated.contains(result)).collect();
    (results, bare)
}

fn words(variant: &Variant) -> Vec<u32> {
    write_spirv(&assemble(SOURCES, "render", "render", variant).unwrap(), variant, &Promises::default())
        .unwrap()
}

#[test]
fn every_float_operation_of_every_strict_variant_is_decorated() {
    for variant in variants::all() {
        let (results, bare) = float_arithmetic(&words(&variant));
        assert!(results.len() > 80, "{variant:?}: {} operations", results.len());
        assert_eq!(bare, Vec::<u32>::new(), "{variant:?}");
    }
}

#[test]
fn one_operation_without_decoration_is_caught() {
    let mut words = words(&variants::all()[0]);
    let decoration = words
        .windows(3)
        .position(|three| three[0] == 3 << 16 | DECORATE && three[2] == NO_CONTRACTION)
        .unwrap();
    let target = words[decoration + 1];
    words.drain(decoration..decoration + 3);
    assert_eq!(float_arithmetic(&words).1, [target]);
}

#[test]
fn fast_variants_are_left_to_the_compiler() {
    let (results, bare) = float_arithmetic(&words(&Variant { float: Float::Fast, ..variants::all()[0] }));
    assert!(!results.is_empty() && results == bare);
}
