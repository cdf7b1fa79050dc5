//! Mutation controls: faults planted in the shaders, and the case that must catch each.

use snellius::selftest::CASES;

use super::{adapter, fallen};
use crate::lockstep::devices::find;
use crate::lockstep::planted::Planted;

/// A fault, and who catches it.
struct Fault {
    case: &'static str,
    /// In words.
    what: &'static str,
    /// Shader file, what stands there, and what takes its place.
    change: (&'static str, &'static str, &'static str),
}

/// In the order of cases; each has one fault at least.
const FAULTS: &[Fault] = &[
    Fault {
        case: "T1",
        what: "Möller and Trumbore's test",
        change: (
            "triangle",
            "return watertight(origin, shear, tri);",
            "return moller_trumbore(origin, direction, tri);",
        ),
    },
    Fault {
        case: "T1",
        what: "padding that is lost when it is added to a large coordinate",
        change: ("bvh", "abs(origin) * ORIGIN_PADDING + ", ""),
    },
    Fault {
        case: "T2",
        what: "a rounding of its own for one corner",
        change: (
            "triangle",
            "let cx = c.x - shear.by.x * c.z;",
            "let cx = c.x - (shear.by.x * 1.0000001) * c.z;",
        ),
    },
    Fault {
        case: "T14",
        what: "ties that go to the highest id",
        change: ("bvh", "tri.id < best.id", "tri.id > best.id"),
    },
    Fault {
        case: "T18",
        what: "boxes that every NaN enters",
        change: (
            "bvh",
            "let hit = entry <= exit && entry <= best.t;",
            "let hit = !(entry > exit || entry > best.t) || ray.reciprocal.x != ray.reciprocal.x;",
        ),
    },
    Fault {
        case: "T20",
        what: "a mirror that is off by an ULP",
        change: (
            "material",
            "let mirrored = direction + n * (c + c);",
            "let mirrored = direction + n * (c + c) * 1.0000001;",
        ),
    },
    Fault {
        case: "T21",
        what: "a rest that forgets the waiting rays",
        change: ("whitted", "film.lanes[lane].stack_size = stack_size;", "film.lanes[lane].stack_size = 0u;"),
    },
    Fault {
        case: "T22",
        what: "rays that are cut without account",
        change: ("whitted", "sample.dropped = sample.dropped + weight;", ""),
    },
];

#[test]
fn every_planted_fault_is_caught_by_its_case() {
    let Some(options) = find("llvmpipe") else { return };
    let mut missed = Vec::new();
    for fault in FAULTS {
        let (stem, sound, broken) = fault.change;
        let mut device = adapter(&options, Planted::new(stem, sound, broken).leak());
        let case = CASES.iter().find(|case| case.id == fault.case).unwrap();
        let found = fallen(case, &mut device);
        eprintln!("{}: {} → {found:?}", fault.case, fault.what);
        if found.is_empty() {
            missed.push(format!("{} misses {}", fault.case, fault.what));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn every_case_has_a_fault_to_catch() {
    for case in CASES {
        assert!(FAULTS.iter().any(|fault| fault.case == case.id), "{} catches nothing", case.id);
    }
}
