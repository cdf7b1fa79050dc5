//! The records of the wide tree.

/// Children of a node, and triangles of a leaf, at most: the lanes of a vector.
pub(super) use crate::bvh::WIDTH;
use crate::layout::Triangle;

/// Marks a child that is a leaf; below it the leaf's index and how many triangles it holds, less one.
const LEAF: u32 = 1 << 31;
/// Bits of a leaf's index.
const INDEX_BITS: u32 = 28;
/// Leaves, at most.
pub(super) const MOST_LEAVES: usize = 1 << INDEX_BITS;

/// A child as its parent names it: a node, or a leaf and its size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Child {
    Node(usize),
    Leaf { index: usize, count: usize },
}

impl Child {
    #[inline(always)]
    pub(super) fn unpack(word: u32) -> Self {
        if word & LEAF == 0 {
            return Self::Node(word as usize);
        }
        let index = (word & (MOST_LEAVES as u32 - 1)) as usize;
        Self::Leaf { index, count: (word >> INDEX_BITS & (WIDTH as u32 - 1)) as usize + 1 }
    }

    pub(super) fn pack(self) -> u32 {
        match self {
            Self::Node(index) => index as u32,
            Self::Leaf { index, count } => LEAF | (count as u32 - 1) << INDEX_BITS | index as u32,
        }
    }
}

/// 0, 1 or 2.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis(usize);

impl Axis {
    /// The axes in the order of [`permute`](crate::kernel::triangle::permute): `last` comes last.
    #[inline(always)]
    pub(super) fn sheared(last: u32) -> [Self; 3] {
        match last {
            0 => [Self(1), Self(2), Self(0)],
            1 => [Self(2), Self(0), Self(1)],
            _ => Self::ALL,
        }
    }

    pub(super) const ALL: [Self; 3] = [Self(0), Self(1), Self(2)];

    #[inline(always)]
    pub(super) fn of<T>(self, three: &[T; 3]) -> &T {
        // SAFETY: an axis is below 3.
        unsafe { three.get_unchecked(self.0) }
    }
}

/// One of the six planes of a box: below 6.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row(usize);

impl Row {
    /// The plane of an axis that a ray meets first: the lower, or the upper where it goes down.
    #[inline(always)]
    pub(super) fn near(axis: Axis, falls: bool) -> Self {
        Self(axis.0 * 2 + usize::from(falls))
    }

    #[inline(always)]
    pub(super) fn is_upper(self) -> bool {
        self.0 & 1 == 1
    }

    /// The other plane of the axis.
    #[inline(always)]
    pub(super) fn other(self) -> Self {
        Self(self.0 ^ 1)
    }
}

/// Up to eight children with their boxes.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Lower and upper planes of x, y and z; upside down where there is no child.
    planes: [[f32; WIDTH]; 6],
    pub(super) children: [u32; WIDTH],
}

impl Node {
    pub(super) const EMPTY: Self = Self {
        planes: {
            let (lo, hi) = ([f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]);
            [lo, hi, lo, hi, lo, hi]
        },
        children: [0; WIDTH],
    };

    pub(super) fn set(&mut self, lane: usize, lo: [f32; 3], hi: [f32; 3], child: Child) {
        for axis in 0..3 {
            self.planes[axis * 2][lane] = lo[axis];
            self.planes[axis * 2 + 1][lane] = hi[axis];
        }
        self.children[lane] = child.pack();
    }

    #[inline(always)]
    pub(super) fn plane(&self, row: Row) -> &[f32; WIDTH] {
        // SAFETY: a row is below 6.
        unsafe { self.planes.get_unchecked(row.0) }
    }
}

/// Up to eight triangles; where there is none, one without extent that nothing hits.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub(super) struct Leaf {
    /// By corner, axis, lane.
    corners: [[[f32; WIDTH]; 3]; 3],
    pub(super) ids: [u32; WIDTH],
}

impl Leaf {
    pub(super) fn new(triangles: &[Triangle]) -> Self {
        let mut leaf = Self { corners: [[[0.0; WIDTH]; 3]; 3], ids: [0; WIDTH] };
        for (lane, triangle) in triangles.iter().enumerate() {
            for (corner, v) in [triangle.v0, triangle.v1, triangle.v2].into_iter().enumerate() {
                leaf.corners[corner].iter_mut().zip(v).for_each(|(row, x)| row[lane] = x);
            }
            leaf.ids[lane] = triangle.id;
        }
        leaf
    }

    /// The triangle of a lane.
    #[inline(always)]
    pub(super) fn triangle(&self, lane: usize) -> Triangle {
        let [v0, v1, v2] = &self.corners;
        let corner = |[x, y, z]: &[[f32; WIDTH]; 3]| [x[lane], y[lane], z[lane]];
        let (v0, v1, v2) = (corner(v0), corner(v1), corner(v2));
        Triangle { v0, id: self.ids[lane], v1, reserved1: 0, v2, reserved2: 0 }
    }

    /// A coordinate of all first, second and third corners.
    #[inline(always)]
    pub(super) fn corners(&self, axis: Axis) -> [&[f32; WIDTH]; 3] {
        let [a, b, c] = &self.corners;
        [axis.of(a), axis.of(b), axis.of(c)]
    }

    /// Raise all corners by an ulp.
    #[cfg(test)]
    pub(super) fn nudge(&mut self) {
        self.corners.as_flattened_mut().iter_mut().flatten().for_each(|x| *x = x.next_up());
    }
}
