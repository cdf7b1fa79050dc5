//! Every instruction set against the scalar kernel, bit for bit.

#![cfg(test)]
#![allow(clippy::unwrap_used)]

use bytemuck::Zeroable;
use proptest::prelude::*;

use super::*;
use crate::bvh::{Preset, build};
use crate::kernel::bvh::{intersect, make_ray, occluded};
use crate::kernel::{Vec3, World};
use crate::layout::{EffectSet, FlatScene, Intersector, View};

/// A scene of triangles, and its tree for every instruction set.
struct Subject {
    scene: FlatScene,
    view: View,
    trees: Vec<WideBvh>,
}

impl Subject {
    fn new(corners: &[[[f32; 3]; 3]]) -> Self {
        let triangle = |(id, &[v0, v1, v2]): (usize, &[[f32; 3]; 3])| Triangle {
            v0,
            id: id as u32,
            v1,
            reserved1: 0,
            v2,
            reserved2: 0,
        };
        let triangles: Vec<Triangle> = corners.iter().enumerate().map(triangle).collect();
        let tree = build(&triangles, Preset::Best).unwrap();
        let triangles: Vec<Triangle> = tree.order.iter().map(|&index| triangles[index as usize]).collect();
        let wide = Tree::new(&tree.nodes, &triangles);
        let [scene_lo, scene_hi] = wide.bounds;
        let view = View { scene_lo, scene_hi, ..View::zeroed() };
        let trees =
            Level::available().into_iter().map(|level| WideBvh { tree: wide.clone(), level }).collect();
        let scene = FlatScene::of_triangles(tree.nodes, triangles, [scene_lo, scene_hi], tree.depth);
        Self { scene, view, trees }
    }

    /// How often anything was hit; panics where any way to trace differs from the scalar kernel.
    fn agree(&self, casts: &[Cast]) -> usize {
        let world = World {
            scene: &self.scene,
            view: &self.view,
            intersector: Intersector::Watertight,
            effects: EffectSet::NONE,
        };
        let rays: Vec<_> = casts
            .iter()
            .map(|cast| {
                make_ray(&world, Vec3::load(cast.origin), Vec3::load(cast.direction), cast.origin_face)
            })
            .collect();
        let nearest: Vec<_> =
            rays.iter().zip(casts).map(|(ray, cast)| bits(&intersect(&world, ray, cast.limit))).collect();
        let blocked: Vec<_> =
            rays.iter().zip(casts).map(|(ray, cast)| occluded(&world, ray, cast.limit)).collect();
        for tree in &self.trees {
            let name = tree.instructions();
            for ((ray, cast), (nearest, &blocked)) in rays.iter().zip(casts).zip(nearest.iter().zip(&blocked))
            {
                assert_eq!(bits(&tree.intersect(ray, cast.limit)), *nearest, "{name}: {cast:?}");
                assert_eq!(tree.occluded(ray, cast.limit), blocked, "{name}: {cast:?}");
            }
            let none = Hit { t: 0.0, id: 0, index: 0, b1: 0.0, b2: 0.0, front: false };
            let (mut hits, mut dark) = (vec![none; casts.len()], vec![false; casts.len()]);
            tree.intersect_stream(casts, &mut hits);
            tree.occluded_stream(casts, &mut dark);
            assert_eq!(hits.iter().map(bits).collect::<Vec<_>>(), nearest, "{name}, stream");
            assert_eq!(dark, blocked, "{name}, stream");
        }
        blocked.iter().filter(|&&blocked| blocked).count()
    }
}

fn bits(hit: &Hit<f32>) -> (u32, u32, u32, u32, u32, bool) {
    (hit.t.to_bits(), hit.id, hit.index, hit.b1.to_bits(), hit.b2.to_bits(), hit.front)
}

/// Numbers on and off a coarse grid, so that rays meet edges, corners, planes and equal distances.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        (-4_i32..=4).prop_map(|x| x as f32),
        -4.0_f32..4.0,
        prop_oneof![Just(0.0), Just(-0.0), Just(1e-30), Just(-1e-40), Just(4.000_000_5)],
    ]
}

fn point() -> impl Strategy<Value = [f32; 3]> {
    [coordinate(), coordinate(), coordinate()]
}

/// Numbers that no scene should make, too.
fn hostile() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => coordinate(),
        1 => prop_oneof![
            Just(f32::NAN), Just(f32::INFINITY), Just(-f32::MAX), Just(1e19), Just(-1e25), Just(1e-20), Just(3e7)
        ],
    ]
}

fn cast() -> impl Strategy<Value = Cast> {
    let limit = prop_oneof![
        4 => Just(f32::MAX), 2 => 0.0_f32..9.0, 1 => prop_oneof![Just(0.0), Just(-1.0), Just(f32::NAN), Just(1.0)]
    ];
    let face = prop_oneof![2 => Just(NONE), 1 => 0_u32..40];
    ([hostile(), hostile(), hostile()], limit, [hostile(), hostile(), hostile()], face)
        .prop_map(|(origin, limit, direction, origin_face)| Cast { origin, limit, direction, origin_face })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn every_way_gives_the_scalar_bits(
        corners in prop::collection::vec([point(), point(), point()], 1..60),
        casts in prop::collection::vec(cast(), 1..70),
    ) {
        Subject::new(&corners).agree(&casts);
    }

    #[test]
    fn rays_side_by_side_give_the_scalar_bits(
        corners in prop::collection::vec([point(), point(), point()], 1..60),
        eye in point(),
        towards in point(),
    ) {
        let cast = |i: u32| {
            let by = [(i % 8) as f32, (i / 8) as f32].map(|x| (x - 3.5) / 16.0);
            let direction = [towards[0] + by[0], towards[1] + by[1], towards[2]];
            Cast { origin: eye, limit: f32::MAX, direction, origin_face: NONE }
        };
        Subject::new(&corners).agree(&(0..64).map(cast).collect::<Vec<_>>());
    }
}

/// A closed grid of squares over a height that rays meet at corners and edges.
fn terrain(side: u16) -> Vec<[[f32; 3]; 3]> {
    let at = |x: u16, z: u16| [f32::from(x), f32::from((x * 7 + z * 5) % 3), f32::from(z)];
    let square = |x: u16, z: u16| {
        let [a, b, c, d] = [at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)];
        [[a, b, c], [a, c, d]]
    };
    (0..side).flat_map(|x| (0..side).flat_map(move |z| square(x, z))).collect()
}

#[test]
fn a_beam_at_corners_edges_and_faces_misses_nothing() {
    let subject = Subject::new(&terrain(24));
    let down = |i: u16, step: f32| Cast {
        origin: [f32::from(i % 64) * step, 9.0, f32::from(i / 64) * step],
        limit: f32::MAX,
        direction: [0.0, -1.0, 0.0],
        origin_face: NONE,
    };
    for step in [0.25, 0.37] {
        let casts: Vec<_> = (0..4096).map(|i| down(i, step)).collect();
        let inside = casts.iter().filter(|cast| cast.origin[0] <= 24.0 && cast.origin[2] <= 24.0).count();
        assert_eq!(subject.agree(&casts), inside);
    }
}

#[test]
fn copies_of_a_face_give_the_lowest_id_but_the_one_that_is_left() {
    let face = [[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    let subject = Subject::new(&[face; 21]);
    let cast =
        |origin_face| Cast { origin: [0.0, 1.0, 0.0], limit: 9.0, direction: [0.0, -1.0, 0.0], origin_face };
    assert_eq!(subject.agree(&[cast(NONE), cast(0), cast(20)]), 3);
    let mut hits = [Hit { t: 0.0, id: 9, index: 0, b1: 0.0, b2: 0.0, front: false }; 3];
    subject.trees[0].intersect_stream(&[cast(NONE), cast(0), cast(20)], &mut hits);
    assert_eq!(hits.map(|hit| hit.id), [0, 1, 0]);
}

#[test]
fn the_judge_finds_a_planted_fault() {
    let mut subject = Subject::new(&terrain(8));
    let casts =
        [Cast { origin: [4.3, 9.0, 4.4], limit: 99.0, direction: [0.0, -1.0, 0.0], origin_face: NONE }];
    assert_eq!(subject.agree(&casts), 1);
    // An ulp of one coordinate.
    for tree in &mut subject.trees {
        for leaf in &mut tree.tree.leaves {
            leaf.nudge();
        }
    }
    let failed = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| subject.agree(&casts)));
    assert!(failed.is_err());
}
