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
        case: "T3",
        what: "boxes without padding",
        change: ("bvh", "origin + delta, origin - delta,", "origin, origin,"),
    },
    Fault {
        case: "T4",
        what: "a face that may be met again",
        change: ("bvh", "if tri.id == ray.origin_face {", "if false {"),
    },
    Fault {
        case: "T5",
        what: "a fixed epsilon",
        change: ("surface", "reach * (SPAWN_ROUNDOFFS * ROUNDOFF)", "real(1e-4)"),
    },
    Fault {
        case: "T6",
        what: "total reflection by sin²θt ≥ 1",
        change: ("material", "if g2 <= 0.0 {", "if (1.0 - c * c) / (eta * eta) >= 1.0 {"),
    },
    Fault {
        case: "T7",
        what: "total reflection by sin²θt ≥ 1, without a look at η = 1",
        change: (
            "material",
            "if step == 0.0 {\n        return Fresnel(0.0, 0.0, false);",
            "if (1.0 - c * c) / (eta * eta) >= 1.0 {\n        return Fresnel(1.0, 0.0, true);",
        ),
    },
    Fault { case: "T8", what: "Schlick's approximation", change: SCHLICK },
    Fault { case: "T9", what: "Schlick's approximation", change: SCHLICK },
    Fault {
        case: "T10",
        what: "kt that is lost on total reflection",
        change: ("material", "reflection = kr + kt;", "reflection = kr;"),
    },
    Fault {
        case: "T11",
        what: "a tree that ends one level early",
        change: ("whitted", "branch.depth <= frame.view.depth", "branch.depth < frame.view.depth"),
    },
    Fault {
        case: "T12",
        what: "the medium entered last, not that of the highest priority",
        change: ("media", "countTrailingZeros(mask)", "firstLeadingBit(mask)"),
    },
    Fault {
        case: "T13",
        what: "media that are toggled on the way out, not cleared",
        change: ("media", "let others = mask & ~bit;", "let others = mask ^ bit;"),
    },
    Fault {
        case: "T13",
        what: "points that may lie on edges",
        change: ("surface", "(EDGE_ROUNDOFFS * ROUNDOFF)", "0.0"),
    },
    Fault {
        case: "T14",
        what: "ties that go to the face met first",
        change: ("bvh", "(t == best.t && tri.id < best.id)", "false"),
    },
    Fault {
        case: "T14",
        what: "ties that go to the face met last",
        change: ("bvh", "tri.id < best.id", "true"),
    },
    Fault {
        case: "T15",
        what: "the weight of a corner forgotten",
        change: ("surface", "let b0 = 1.0 - hit.b1 - hit.b2;", "let b0 = 1.0 - hit.b1;"),
    },
    Fault {
        case: "T16",
        what: "a fixed epsilon",
        change: ("surface", "reach * (SPAWN_ROUNDOFFS * ROUNDOFF)", "real(1e-4)"),
    },
    Fault {
        case: "T17",
        what: "weights that do not quite add up to one",
        change: ("surface", "let b0 = 1.0 - hit.b1 - hit.b2;", "let b0 = 1.000002 - hit.b1 - hit.b2;"),
    },
    Fault {
        case: "T18",
        what: "rays that enter boxes with a NaN",
        change: ("bvh", "if !is_usable(ray) {", "if false {"),
    },
    Fault {
        case: "T19",
        what: "reflected rays that enter the face",
        change: ("material", "turn_towards(mirrored, surface.face_normal)", "mirrored"),
    },
    Fault {
        case: "T19",
        what: "shadow rays from the flat face",
        change: ("surface", "if height < 0.0 {", "if height < -1e30 {"),
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
    Fault {
        case: "C1",
        what: "one polarisation counted twice",
        change: ("material", "0.5 * ratio * ratio", "ratio * ratio"),
    },
    Fault {
        case: "C2",
        what: "total reflection a little early",
        change: ("material", "if g2 <= 0.0 {", "if g2 <= 1e-5 {"),
    },
    Fault { case: "C3", what: "Schlick's approximation", change: SCHLICK },
    Fault {
        case: "C4",
        what: "interfaces that transmit what they reflect as well",
        change: (
            "material",
            "result.transmission = kt * (1.0 - f.reflectance);",
            "result.transmission = kt;",
        ),
    },
    Fault {
        case: "C5",
        what: "the inverse index",
        change: ("material", "index_of(inner) / index_of(before)", "index_of(before) / index_of(inner)"),
    },
    Fault {
        case: "C6",
        what: "the inverse index",
        change: ("material", "index_of(inner) / index_of(before)", "index_of(before) / index_of(inner)"),
    },
    Fault {
        case: "C7",
        what: "a bend that is off by a thousandth",
        change: ("material", "n * f.bend", "n * (f.bend * 1.001)"),
    },
    Fault {
        case: "C8",
        what: "a bend that is off by a thousandth",
        change: ("material", "n * f.bend", "n * (f.bend * 1.001)"),
    },
    Fault {
        case: "C9",
        what: "flat normals",
        change: ("surface", "surface.normal = turn_towards(smoothed, -ray.direction);", ""),
    },
    Fault {
        case: "C10",
        what: "absorption that forgets the length of the path",
        change: ("media", "exp_neg(real(sigma) * t)", "exp_neg(real(sigma))"),
    },
    Fault {
        case: "C11",
        what: "a mirror that is turned by a ten-thousandth",
        change: ("material", "n * (c + c)", "(n + vec3r(1e-4, 0.0, 0.0)) * (c + c)"),
    },
    Fault {
        case: "C12",
        what: "a mirror that forgets the factor of two",
        change: ("material", "n * (c + c)", "n * c"),
    },
    Fault {
        case: "C13",
        what: "a cut-off that cuts what is just bright enough",
        change: ("whitted", "max3(branch.weight) >= real", "max3(branch.weight) > real"),
    },
    Fault {
        case: "S1",
        what: "a number that is off by one ULP",
        change: ("material", "let k = (c * sum - 1.0)", "let k = (c * sum - 1.0000001)"),
    },
];

/// R₀ + (1 − R₀)(1 − c)⁵, which is not reciprocal, and off at grazing angles (Schlick 1994).
const SCHLICK: (&str, &str, &str) = (
    "material",
    "let reflectance = 0.5 * ratio * ratio * (1.0 + k * k);",
    "let r0 = (eta - 1.0) * (eta - 1.0) / ((eta + 1.0) * (eta + 1.0));
     let away = 1.0 - c;
     let reflectance = r0 + (1.0 - r0) * away * away * away * away * away;",
);

#[test]
fn every_planted_fault_is_caught_by_its_case() {
    let Some(options) = find("llvmpipe") else { return };
    let mut missed = Vec::new();
    for fault in FAULTS {
        let (stem, sound, broken) = fault.change;
        let mut device = adapter(&options, Planted::new(stem, sound, broken).leak());
        let case = CASES.iter().find(|case| case.id == fault.case).unwrap();
        match fallen(case, &mut device).map(|found| found.into_iter().next()) {
            Ok(None) => missed.push(format!("{} misses {}", fault.case, fault.what)),
            Ok(Some(found)) => eprintln!("{}: {} → {found:?}", fault.case, fault.what),
            // Rays without end, say.
            Err(error) => eprintln!("{}: {} → {error}", fault.case, fault.what),
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
