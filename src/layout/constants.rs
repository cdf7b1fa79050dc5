//! Numbers that both devices share. Injected into the shaders under the same names.

/// A shared number, as the shaders need it declared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shared {
    /// `const NAME: u32`.
    U32(u32),
    /// `const NAME: f32`.
    F32(f32),
    /// `const NAME: real`: f32 or f64 by the precision of the variant.
    Real(f64),
}

impl From<u32> for Shared {
    fn from(value: u32) -> Self {
        Self::U32(value)
    }
}

impl From<f32> for Shared {
    fn from(value: f32) -> Self {
        Self::F32(value)
    }
}

impl From<f64> for Shared {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}

macro_rules! shared {
    ($($(#[$doc:meta])* $name:ident: $kind:ty = $value:expr;)*) => {
        $($(#[$doc])* pub const $name: $kind = $value;)*

        /// Every shared number by name.
        pub const SHARED: &[(&str, fn() -> Shared)] = &[$((stringify!($name), || Shared::from($name))),*];
    };
}

shared! {
    /// D*: the tree of this depth is the truth of every error bound, and the deepest that may be asked for.
    MAX_DEPTH: u32 = 64;
    /// Transmissive bodies that the media mask holds.
    MAX_MEDIA: u32 = 32;
    /// Nodes on a path from the root of the BVH; the traversal stack holds one fewer.
    MAX_BVH_DEPTH: u32 = 64;
    /// Bits of a word on an adapter's traversal stack that tell which siblings are to be visited; above them, where they stand.
    SIBLING_BITS: u32 = 8;
    /// Side of the square block of pixels that one workgroup traces.
    BLOCK: u32 = 8;
    /// Invocations of one workgroup of a probe.
    PROBE_GROUP: u32 = 64;
    /// Surfaces that a bent ray of the self-test may meet.
    BEND_LIMIT: u32 = 16;
    /// How a bent ray ended: it met nothing more.
    BEND_FREE: u32 = 0;
    /// It met as many surfaces as it may.
    BEND_LIMITED: u32 = 1;
    /// The last surface has no children.
    BEND_ABSORBED: u32 = 2;
    /// Interfaces without effect that a ray, or interfaces of any kind that a shadow ray, may pass;
    /// one that met this many is stuck and is cut.
    MAX_PASSES: u32 = 4096;
    /// Passes that a GPU invocation books for a round of a loop: the round, and one that finds the loop's end.
    LOOP_STEPS: u32 = 2;
    /// Passes that it books for a node of the BVH, or a triangle.
    NODE_STEPS: u32 = 1;
    /// Passes that it books for a walk to a node with triangles: the round, and those that find the ends of both of its loops.
    WALK_STEPS: u32 = 3;
    /// Rows of four in [`View::media`](super::View::media).
    MEDIA_ROWS: u32 = MAX_MEDIA.div_ceil(4);
    /// Rows of four in [`View::radiance_bound`](super::View::radiance_bound): 0 to `MAX_DEPTH` levels.
    BOUND_ROWS: u32 = (MAX_DEPTH + 1).div_ceil(4);
    /// Index of primary rays in counts by kind.
    RAY_PRIMARY: u32 = 0;
    /// Index of reflected rays in counts by kind.
    RAY_REFLECTION: u32 = 1;
    /// Index of refracted rays in counts by kind.
    RAY_REFRACTION: u32 = 2;
    /// Index of shadow rays in counts by kind.
    RAY_SHADOW: u32 = 3;
    /// Samples that adaptive antialiasing gives to every pixel: the fewest that tell how much they vary.
    BASE_SAMPLES: u32 = 2;
    /// Marks pixels whose samples met several bodies first.
    SEVERAL: u32 = u32::MAX - 1;
    /// Material index of the air.
    AIR: u32 = 0;
    /// How a ray of a recorded tree ended: it met a surface.
    END_SURFACE: u32 = 0;
    /// It met nothing.
    END_BACKGROUND: u32 = 1;
    /// It was not traced: too deep.
    END_DEPTH: u32 = 2;
    /// It was not traced: too faint.
    END_WEIGHT: u32 = 3;
    /// It met too many interfaces without effect.
    END_STUCK: u32 = 4;
    /// Flag of a recorded ray's children: a reflected one.
    CHILD_REFLECTION: u32 = 1;
    /// Flag of a recorded ray's children: a refracted one.
    CHILD_REFRACTION: u32 = 2;
    /// Rays of a recorded tree that a GPU keeps: the rest is counted.
    TREE_NODES: u32 = 65_536;
    /// Marks an absent index.
    NONE: u32 = u32::MAX;
    /// Flag in [`Attribute::other`](super::Attribute::other): the second body's outside is on the other side.
    OPPOSITE: u32 = 1 << 31;

    /// 2^120: beyond every scene, a ray without end. Finite, since WGSL promises no infinities.
    FAR: f64 = 1.329_227_995_784_916e36;
    /// 2^64: farther than any ray of a scene within ±2^60 begins from its boxes. A ray with a number beyond it, or with
    /// one that is none, meets nothing.
    MOST_REACH: f64 = 18_446_744_073_709_551_616.0;
    /// 2^-40: direction components below this count as this much in the slab test, so that every reciprocal and
    /// every product with it is finite. That much of the distance is far less than [`SLAB_PADDING`] of it.
    LEAST_DIRECTION: f64 = 9.094_947_017_729_282e-13;
    /// Slabs are widened by this much (2^-19) of the distance to the farthest corner of the scene's box: more
    /// than the rounding of the slab and triangle tests, so that no box misses what its triangle hits.
    SLAB_PADDING: f64 = 1.907_348_632_812_5e-6;
    /// And by this much (2^-22) of the origin's own coordinate on each axis: four roundoffs (two where the driver may
    /// rewrite), so that the sum of origin and padding is not rounded back below the padding far away from (0, 0, 0).
    ORIGIN_PADDING: f64 = 2.384_185_791_015_625e-7;
    /// A ray that leaves a face never meets that face again, at any angle, because it is told which one it is. It starts
    /// off its plane all the same, so that the faces beside it and upon it lie on the right side: by this many unit
    /// roundoffs of the face's coordinates, weighted by the hit's barycentrics, of which 7 bound the rounding of the hit
    /// point (Pharr, Jakob, Humphreys, 4th ed., section 6.8.5), and half as many of the face's greatest extent: what the
    /// test of another face in the same plane subtracts and shears.
    SPAWN_ROUNDOFFS: f64 = 8.0;
    /// Points keep off the edges of their face: each corner counts for this many unit roundoffs at least, times one and
    /// the point's coordinates over the face's extent. Where two faces of a body meet, a ray that leaves one of them must
    /// be on the right side of the other too, or it never meets it and the body is never left. 15 bound the rounding of
    /// where it starts, as above; the rest is for faces of less height than extent.
    EDGE_ROUNDOFFS: f64 = 128.0;
    /// But no corner counts for more: far from the origin, where coordinates are coarser than faces.
    MOST_EDGE_WEIGHT: f64 = 0.125;

    /// Weyl steps of the sample pattern, as fractions of 2^32: 1/φ₂ and 1/φ₂² of the plastic number φ₂
    /// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences", R2).
    WEYL_X: u32 = 3_242_174_889;
    /// See [`WEYL_X`].
    WEYL_Y: u32 = 2_447_445_414;
    /// 2^-24: sample offsets are 24-bit fractions, exact in f32.
    FRACTION: f64 = 5.960_464_477_539_063e-8;
    /// Odd multiplier of the path hashes (Steele and Vigna 2021, "Computationally easy, spectrally good
    /// multipliers", 32 bits).
    HASH_MULTIPLIER: u32 = 0x915f_77f5;

    /// log2(e).
    LOG2_E: f32 = std::f32::consts::LOG2_E;
    /// Upper bits of ln 2: 12 bits, so that its product with a whole number below 2^12 is exact.
    LN2_HI: f32 = 0.69311523;
    /// ln 2 − [`LN2_HI`].
    LN2_LO: f32 = 3.1946183e-05;
    /// ln 2.
    LN2: f32 = std::f32::consts::LN_2;
    /// Upper 12 bits of 2/ln 2.
    TWO_OVER_LN2_HI: f32 = 2.8847656;
    /// 2/ln 2 − [`TWO_OVER_LN2_HI`].
    TWO_OVER_LN2_LO: f32 = 0.0006244568;
    /// Upper bits of log2(1.25): 12 after the point.
    LOG2_5_4_HI: f32 = 0.32177734;
    /// log2(1.25) − [`LOG2_5_4_HI`].
    LOG2_5_4_LO: f32 = 0.00015075113;
    /// Upper bits of log2(1.5): 12 after the point.
    LOG2_3_2_HI: f32 = 0.58496094;
    /// log2(1.5) − [`LOG2_3_2_HI`].
    LOG2_3_2_LO: f32 = 1.5632212e-06;
    /// Upper bits of log2(1.75): 12 after the point.
    LOG2_7_4_HI: f32 = 0.8071289;
    /// log2(1.75) − [`LOG2_7_4_HI`].
    LOG2_7_4_LO: f32 = 0.0002260158;
    /// π/4 rounded to f32.
    PI_4_HI: f32 = std::f32::consts::FRAC_PI_4;
    /// π/4 − [`PI_4_HI`].
    PI_4_LO: f32 = -2.1855694e-08;
    /// tan(π/8): beyond it the arctangent is reduced by π/4.
    TAN_PI_8: f32 = 0.41421357;
    /// π.
    PI: f64 = std::f64::consts::PI;
    /// ln 2 to 53 bits, for the series in f64.
    LN2_DOUBLE: f64 = std::f64::consts::LN_2;
    /// 1/π.
    INV_PI: f64 = std::f64::consts::FRAC_1_PI;
    /// 2^-126: the least normal f32; the film keeps nothing below.
    LEAST_NORMAL: f32 = 1.1754944e-38;
    /// exp(−x) of an f32 is below 2^-126 from here on, and returned as 0.
    EXP_LIMIT: f32 = 87.0;
}

/// 2^-24 or 2^-53: the unit roundoff, injected as `ROUNDOFF`.
pub const ROUNDOFF_F32: f64 = 5.960_464_477_539_063e-8;
/// See [`ROUNDOFF_F32`].
pub const ROUNDOFF_F64: f64 = 1.110_223_024_625_156_5e-16;
