//! Triangles in, hierarchy out.

use thiserror::Error;

use super::binned::{self, Leaves};
use super::tree::{Size, Tree};
use super::{encode, reinsertion};
use crate::layout::constants::MAX_BVH_DEPTH;
use crate::layout::{Node, Triangle};

/// A bounding volume hierarchy over triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Bvh {
    /// Root first, each node before its descendants.
    pub nodes: Vec<Node>,
    /// The triangle (index into what was given) at each place that the leaves name.
    pub order: Vec<u32>,
    /// Nodes on the longest path from the root, in 1..=[`MAX_BVH_DEPTH`].
    pub depth: u32,
}

/// Why no hierarchy can be built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum BvhError {
    /// There is nothing to build over.
    #[error("a hierarchy needs at least one triangle")]
    Empty,
    /// Node and triangle indices have 32 bits.
    #[error("{0} triangles are more than the {max} that 32-bit indices reach", max = MAX_TRIANGLES)]
    TooMany(usize),
}

/// Triangles, at most: twice as many nodes must have an index.
const MAX_TRIANGLES: usize = 1 << 30;

/// Time to build against time to trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preset {
    /// Top down with a binned surface area heuristic.
    Fast,
    /// The same, then reinsertion: slower to build, faster to trace.
    #[default]
    Best,
}

/// Build a hierarchy over triangles with finite corners, in any number, form and order.
///
/// Where [`Preset::Best`] would grow deeper than the traversal's stack, the hierarchy is [`Preset::Fast`]'s, which is
/// bounded.
///
/// # Errors
/// No triangles, or more than 2^30.
pub fn build(triangles: &[Triangle], preset: Preset) -> Result<Bvh, BvhError> {
    match triangles.len() {
        0 => Err(BvhError::Empty),
        count if count > MAX_TRIANGLES => Err(BvhError::TooMany(count)),
        _ => {
            let (tree, sizes) = choose(triangles, preset);
            Ok(encode::encode(triangles, &tree, &sizes))
        }
    }
}

/// The preset's tree, unless it is too deep, and its sizes.
fn choose(triangles: &[Triangle], preset: Preset) -> (Tree, Vec<Size>) {
    let measured = |tree: Tree| {
        let sizes = tree.sizes();
        (tree, sizes)
    };
    match preset {
        Preset::Fast => measured(binned::build(triangles, Leaves::Full)),
        Preset::Best => {
            let binned = binned::build(triangles, Leaves::Cheapest);
            Some(measured(reinsertion::improve(triangles, &binned)))
                .filter(|(_, sizes)| sizes[0].depth <= MAX_BVH_DEPTH)
                .unwrap_or_else(|| measured(binned))
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::bvh::testing::{soup, triangle};
    use crate::bvh::{CheckError, MAX_LEAF, Statistics, check};

    const PRESETS: [Preset; 2] = [Preset::Fast, Preset::Best];

    fn assert_sound(triangles: &[Triangle]) {
        for preset in PRESETS {
            let bvh = build(triangles, preset).unwrap();
            assert_eq!(check(&bvh, triangles), Ok(()), "{preset:?}");
        }
    }

    #[test]
    fn random_triangles_of_every_number() {
        for count in [1, 2, 3, 4, 5, 8, 9, 17, 33, 1000, 20_000] {
            assert_sound(&soup(count, 1.0));
        }
    }

    #[test]
    fn nothing_to_build_over_is_an_error() {
        assert_eq!(build(&[], Preset::Best), Err(BvhError::Empty));
    }

    #[test]
    fn a_lone_triangle_is_named_twice() {
        let bvh = build(&soup(1, 1.0), Preset::Best).unwrap();
        assert_eq!((bvh.nodes[0].a_count, bvh.nodes[0].b_count, bvh.order.len()), (1, 1, 1));
    }

    #[test]
    fn identical_triangles_are_split_by_count() {
        let one = soup(1, 1.0)[0];
        assert_sound(&vec![one; 10_000]);
    }

    #[test]
    fn points_and_lines() {
        let point = |x: f32| triangle([[x, 0.0, 0.0]; 3], 0);
        assert_sound(&vec![point(0.0); 100]);
        assert_sound(&(0..5000).map(|x| point(x as f32)).collect::<Vec<_>>());
    }

    #[test]
    fn equally_spaced_triangles_are_built_in_time() {
        let place = |x: usize, z: usize| {
            let (x, z) = (x as f32 * 2.0, z as f32 * 2.0);
            triangle([[x, 0.0, z], [x + 1.0, 0.0, z], [x, 1.0, z]], 0)
        };
        assert_sound(&(0..200).flat_map(|x| (0..200).map(move |z| place(x, z))).collect::<Vec<_>>());
        assert_sound(&(0..40_000).map(|x| place(x, 0)).collect::<Vec<_>>());
    }

    #[test]
    fn a_floor_under_a_dense_object_does_not_swell_a_leaf() {
        let mut triangles = soup(5000, 1.0);
        let [a, b, c, d] = [[-1e4, 0.0, -1e4], [1e4, 0.0, -1e4], [1e4, 0.0, 1e4], [-1e4, 0.0, 1e4]];
        triangles.extend([triangle([a, b, c], 5000), triangle([a, c, d], 5001)]);
        assert_sound(&triangles);
        let leaves = Statistics::of(&build(&triangles, Preset::Best).unwrap()).leaf_sizes;
        assert_eq!(leaves.iter().zip(0..).map(|(&leaves, size)| leaves * size).sum::<usize>(), 5002);
    }

    #[test]
    fn coordinates_of_every_magnitude() {
        for size in [1e-38, 1e-30, 1e-10, 1e10, 1e18, 1e30, 3e38] {
            assert_sound(&soup(500, size));
        }
    }

    #[test]
    fn a_geometric_series_stays_within_the_stack() {
        let nested = |k: i32| {
            let size = 1.5_f32.powi(k);
            triangle([[0.0; 3], [size, 0.0, 0.0], [0.0, size, size]], 0)
        };
        assert_sound(&(-100..100).flat_map(|k| [nested(k); 5]).collect::<Vec<_>>());
    }

    #[test]
    fn the_best_preset_costs_less_than_the_fast_one() {
        let triangles = soup(20_000, 1.0);
        let cost = |preset| Statistics::of(&build(&triangles, preset).unwrap()).sah_cost;
        let (best, fast) = (cost(Preset::Best), cost(Preset::Fast));
        assert!(best < fast, "{best} {fast}");
    }

    #[test]
    fn the_fast_preset_fills_leaves() {
        let triangles = soup(20_000, 1.0);
        let nodes = |preset| build(&triangles, preset).unwrap().nodes.len();
        assert!(nodes(Preset::Fast) < nodes(Preset::Best) * 3 / 4);
    }

    #[test]
    fn the_check_finds_planted_faults() {
        let triangles = soup(100, 1.0);
        let sound = build(&triangles, Preset::Best).unwrap();
        let planted = |plant: fn(&mut Bvh)| {
            let mut bvh = sound.clone();
            plant(&mut bvh);
            check(&bvh, &triangles)
        };
        assert!(matches!(planted(|bvh| bvh.order[0] = bvh.order[1]), Err(CheckError::Box { .. })));
        assert!(matches!(planted(|bvh| bvh.nodes[0].b_hi[1] += 1.0), Err(CheckError::Box { node: 0 })));
        assert!(matches!(planted(|bvh| bvh.nodes[0].a_first = 0), Err(CheckError::Tree { .. })));
        assert!(matches!(planted(|bvh| bvh.depth += 1), Err(CheckError::Depth { .. })));
        assert!(matches!(planted(|bvh| bvh.order.truncate(7)), Err(CheckError::Order(7))));
        assert!(matches!(planted(|bvh| bvh.nodes.push(bvh.nodes[0])), Err(CheckError::Unreached(1))));
        let swollen = planted(|bvh| {
            bvh.nodes[0].a_count = MAX_LEAF + 1;
            bvh.nodes[0].a_first = 0;
        });
        assert!(matches!(swollen, Err(CheckError::Leaf { node: 0, .. })));
    }
}
