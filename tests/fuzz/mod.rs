//! Readers of files under fire: no panic, no hang, no memory beyond 1 GB.
//!
//! The inputs are seeds of `corpus/`, changed by [`mutate`]; number n is the same for ever. Each target of
//! [`targets`] gets some with every run of the tests, and a hundred thousand are shared out among them by
//!
//! ```text
//! cargo test --release --test main -- --ignored --nocapture fuzz::a_hundred_thousand
//! ```
//!
//! `fuzz/` feeds the same targets by coverage.

#![allow(clippy::unwrap_used)]

mod attacks;
mod mutate;
mod targets;
mod worker;

use targets::TARGETS;
use worker::{Findings, Task, employ};

/// Feed a target; of its inputs some must be refused, and some be scenes.
fn assert_survives(target: &str, inputs: u64) -> Findings {
    let findings =
        employ(&Task::Inputs(target.to_owned(), 0..inputs)).unwrap_or_else(|fault| panic!("{fault}"));
    assert_eq!(findings.inputs, inputs);
    assert!(findings.traced > inputs / 100 && findings.traced < inputs, "{target}: {findings:?}");
    findings
}

#[test]
fn scene_files_are_refused_or_traced() {
    assert_survives("scene", 1500);
}

#[test]
fn meshes_are_refused_or_traced() {
    assert_survives("obj", 1500);
}

#[test]
fn material_libraries_are_refused_or_used() {
    assert_survives("mtl", 1500);
}

#[test]
fn pictures_are_refused_or_shine() {
    assert_survives("picture", 1500);
}

#[test]
fn files_that_ask_for_too_much_are_told_so() {
    let findings = employ(&Task::Attacks).unwrap_or_else(|fault| panic!("{fault}"));
    assert_eq!((findings.inputs, findings.traced), (attacks::all().len() as u64, 0));
}

#[test]
#[ignore = "takes minutes"]
fn a_hundred_thousand_inputs_are_refused_or_traced() {
    println!("target   inputs  traced  slowest  memory");
    for (target, inputs) in TARGETS.iter().zip([30_000, 30_000, 15_000, 25_000]) {
        let Findings { traced, slowest: (milliseconds, number), memory, .. } =
            assert_survives(target.name, inputs);
        let memory = memory * 1024 / 1_000_000;
        println!(
            "{:8} {inputs:6}  {traced:6}  {milliseconds} ms (number {number})  {memory} MB",
            target.name
        );
    }
}

/// The other tests start it in a process of its own, by an environment variable; without that it does nothing.
#[test]
#[ignore = "the other tests start it"]
fn worker_process() {
    worker::work();
}

#[test]
fn a_panic_of_the_worker_is_reported_with_its_input() {
    let fault = employ(&Task::Inputs("no such target".into(), 0..1)).unwrap_err();
    assert!(fault.contains("panicked"), "{fault}");
}
