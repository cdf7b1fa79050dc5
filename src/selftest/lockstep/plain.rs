//! Functions of numbers alone. Twin of shaders/probe_plain.wgsl.

use crate::kernel::Vec3;
use crate::kernel::adaptive::{Surroundings, display, round_end, tally, variance, wants_more};
use crate::kernel::bvh::safe_reciprocal;
use crate::kernel::film::flush;
use crate::kernel::hash::{mix_hash, sample_offset};
use crate::kernel::light::phong;
use crate::kernel::material::fresnel;
use crate::kernel::math::{Transcendental, cross3, dot3, length3, max3, unit3};
use crate::kernel::surface::{lift, turn_towards};
use crate::kernel::texture::{blend, wrap};
use crate::kernel::triangle::{Crossing, moller_trumbore, shear_of, watertight};
use crate::layout::{Statistics, Tile, Triangle};
use bytemuck::Zeroable;

use super::Probe;
use super::inputs::Input::{self, Bits, Direction, Fraction, Number, Point, Positive, Word};
use super::record::Record;

pub(super) const PROBES: &[Probe] = &[
    Probe {
        name: "dot3",
        inputs: &[Direction, Point],
        outputs: 1,
        run: |_, io| {
            let a = io.take3();
            let b = io.take3();
            io.put(dot3(a, b));
        },
    },
    Probe {
        name: "cross3",
        inputs: &[Direction, Point],
        outputs: 3,
        run: |_, io| {
            let a = io.take3();
            let b = io.take3();
            io.put3(cross3(a, b));
        },
    },
    Probe {
        name: "length3",
        inputs: &[Number, Number, Number],
        outputs: 1,
        run: |_, io| {
            let v = io.take3();
            io.put(length3(v));
        },
    },
    Probe {
        name: "unit3",
        inputs: &[Number, Number, Number],
        outputs: 3,
        run: |_, io| {
            let v = io.take3();
            io.put3(unit3(v));
        },
    },
    Probe {
        name: "max3",
        inputs: &[Number, Number, Number],
        outputs: 1,
        run: |_, io| {
            let v = io.take3();
            io.put(max3(v));
        },
    },
    Probe {
        name: "exp_neg",
        inputs: &[Positive],
        outputs: 1,
        run: |_, io| {
            let x = io.take();
            io.put(f32::exp_neg(x));
        },
    },
    Probe {
        name: "power",
        inputs: &[Fraction, Positive],
        outputs: 1,
        run: |_, io| {
            let x = io.take();
            let y = io.take();
            io.put(f32::power(x, y));
        },
    },
    Probe {
        name: "arctangent",
        inputs: &[Number, Number],
        outputs: 1,
        run: |_, io| {
            let y = io.take();
            let x = io.take();
            io.put(f32::arctangent(y, x));
        },
    },
    Probe {
        name: "mix_hash",
        inputs: &[Bits, Bits],
        outputs: 1,
        run: |_, io| {
            let hash = io.take_word();
            let word = io.take_word();
            io.put_word(mix_hash(hash, word));
        },
    },
    Probe {
        name: "sample_offset",
        inputs: &[Bits],
        outputs: 2,
        run: |_, io| {
            let [x, y] = sample_offset(io.take_word());
            io.put(x);
            io.put(y);
        },
    },
    Probe {
        name: "flush",
        inputs: &[Number],
        outputs: 1,
        run: |_, io| {
            let x = io.take();
            io.put(flush(x));
        },
    },
    Probe {
        name: "safe_reciprocal",
        inputs: &[Number],
        outputs: 1,
        run: |_, io| {
            let d = io.take();
            io.put(safe_reciprocal(d));
        },
    },
    Probe {
        name: "shear_of",
        inputs: &[Direction],
        outputs: 4,
        run: |_, io| {
            let shear = shear_of(io.take3());
            io.put_word(shear.axis);
            io.put3(shear.by);
        },
    },
    Probe {
        name: "watertight",
        inputs: &[Point, Direction, Point, Point, Point],
        outputs: 5,
        run: |_, io| {
            let (origin, direction) = (io.take3(), io.take3());
            let triangle = take_triangle(io);
            put_crossing(io, watertight(origin, &shear_of(direction), &triangle));
        },
    },
    Probe {
        name: "moller_trumbore",
        inputs: &[Point, Direction, Point, Point, Point],
        outputs: 5,
        run: |_, io| {
            let (origin, direction) = (io.take3(), io.take3());
            let triangle = take_triangle(io);
            put_crossing(io, moller_trumbore(origin, direction, &triangle));
        },
    },
    Probe {
        name: "turn_towards",
        inputs: &[Direction, Direction],
        outputs: 3,
        run: |_, io| {
            let v = io.take3();
            let axis = io.take3();
            io.put3(turn_towards(v, axis));
        },
    },
    Probe {
        name: "lift",
        inputs: &[Point, Point, Direction],
        outputs: 3,
        run: |_, io| {
            let point = io.take3();
            let corner = io.take3();
            let normal = io.take3();
            io.put3(lift(point, corner, normal));
        },
    },
    Probe {
        name: "fresnel",
        inputs: &[Fraction, Positive],
        outputs: 3,
        run: |_, io| {
            let cosine = io.take();
            let result = fresnel(cosine, io.take());
            io.put(result.reflectance);
            io.put(result.bend);
            io.put_flag(result.total);
        },
    },
    Probe {
        name: "phong",
        inputs: &[Direction, Direction, Direction, Positive, Point],
        outputs: 3,
        run: |_, io| {
            let (n, l, direction) = (io.take3(), io.take3(), io.take3());
            let shininess = io.take();
            let specular = io.take3();
            io.put3(phong(n, l, direction, dot3(n, l), shininess, specular));
        },
    },
    Probe {
        name: "wrap",
        inputs: &[Number, Word(4096)],
        outputs: 2,
        run: |_, io| {
            let u = io.take();
            let [x, fx] = wrap(u, io.take_word());
            io.put(x);
            io.put(fx);
        },
    },
    Probe {
        name: "display",
        inputs: &[Point],
        outputs: 3,
        run: |_, io| {
            let v = io.take3();
            let [x, y, z] = display([v.x, v.y, v.z]);
            io.put3(Vec3::new(x, y, z));
        },
    },
    Probe {
        name: "tally",
        inputs: &[Number, Number, Number, Number, Word(5), Word(3), Point, Word(3)],
        outputs: 6,
        run: |_, io| {
            let mut statistics = take_statistics(io);
            let radiance = io.take3();
            tally(&mut statistics, [radiance.x, radiance.y, radiance.z], io.take_word());
            put_statistics(io, &statistics);
        },
    },
    Probe {
        name: "variance",
        inputs: STATISTICS,
        outputs: 1,
        run: |_, io| {
            let statistics = take_statistics(io);
            io.put(variance(&statistics));
        },
    },
    Probe {
        name: "wants_more",
        inputs: &[
            Fraction,
            Fraction,
            Fraction,
            Fraction,
            Word(70),
            Word(3), // here
            Fraction,
            Fraction,
            Fraction,
            Fraction,
            Word(70),
            Word(3), // around
            Fraction,
            Word(2),
            Fraction,
            Word(100),
        ],
        outputs: 1,
        run: |_, io| {
            let (here, pooled) = (take_statistics(io), take_statistics(io));
            let around = Surroundings { pooled, variance: io.take() };
            let tile = Tile { round: io.take_word(), threshold: io.take(), ..Tile::default() };
            let limit = io.take_word();
            io.put_flag(wants_more(&here, &around, &tile, limit));
        },
    },
    Probe {
        name: "round_end",
        inputs: &[Word(1 << 17), Word(1 << 17)],
        outputs: 1,
        run: |_, io| {
            let (start, limit) = (io.take_word(), io.take_word());
            io.put_word(round_end(start, limit));
        },
    },
    Probe {
        name: "blend",
        inputs: &[Point, Point, Point, Point, Fraction, Fraction],
        outputs: 3,
        run: |_, io| {
            let (a, b, c, d) = (io.take3(), io.take3(), io.take3(), io.take3());
            let (fx, fy) = (io.take(), io.take());
            io.put3(blend(a, b, c, d, fx, fy));
        },
    },
];

/// What [`take_statistics`] takes.
const STATISTICS: &[Input] = &[Fraction, Fraction, Fraction, Fraction, Word(70), Word(3)];

fn take_statistics(io: &mut Record) -> Statistics {
    let sum = io.take3();
    Statistics {
        sum: [sum.x, sum.y, sum.z],
        squares: io.take(),
        samples: io.take_word(),
        body: io.take_word(),
        ..Statistics::default()
    }
}

fn put_statistics(io: &mut Record, statistics: &Statistics) {
    let [x, y, z] = statistics.sum;
    io.put3(Vec3::new(x, y, z));
    io.put(statistics.squares);
    io.put_word(statistics.samples);
    io.put_word(statistics.body);
}

fn take_triangle(io: &mut Record) -> Triangle {
    let mut corner = || {
        let v = io.take3();
        [v.x, v.y, v.z]
    };
    Triangle { v0: corner(), v1: corner(), v2: corner(), ..Triangle::zeroed() }
}

fn put_crossing(io: &mut Record, crossing: Option<Crossing<f32>>) {
    io.put_flag(crossing.is_some());
    if let Some(crossing) = crossing {
        io.put(crossing.t);
        io.put(crossing.b1);
        io.put(crossing.b2);
        io.put_flag(crossing.front);
    }
}
