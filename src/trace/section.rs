//! The scene cut open along the plane of the first ray, with the rays seen from the side.

use crate::layout::{FlatScene, TreeNode};

/// A point of the drawing plane: onwards, and up.
pub(super) type Flat = [f64; 2];

/// A plane through the first ray, upright where the ray is not.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    origin: [f64; 3],
    onwards: [f64; 3],
    up: [f64; 3],
    normal: [f64; 3],
}

impl Plane {
    /// The plane of the first ray and the vertical; of the ray and an axis across where it is vertical itself.
    pub(super) fn of(first: &TreeNode) -> Self {
        let direction = unit(widen(first.direction));
        let up = if direction[1].abs() > 0.99 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
        let normal = unit(cross(direction, up));
        Self { origin: widen(first.origin), onwards: cross(up, normal), up, normal }
    }

    /// Where a point is seen.
    pub(super) fn project(&self, point: [f64; 3]) -> Flat {
        let from = sub(point, self.origin);
        [dot(from, self.onwards), dot(from, self.up)]
    }

    /// How far a point is in front of the plane.
    fn height(&self, point: [f64; 3]) -> f64 {
        dot(sub(point, self.origin), self.normal)
    }

    /// Where the triangles of the scene pierce the plane: segments, each with its body.
    pub(super) fn cut(&self, scene: &FlatScene) -> Vec<(u32, [Flat; 2])> {
        let body = |id: u32| scene.attributes.get(id as usize).map_or(0, |face| face.body);
        let segment = |triangle: &crate::layout::Triangle| {
            let corners = [triangle.v0, triangle.v1, triangle.v2].map(widen);
            Some((body(triangle.id), self.cut_triangle(corners)?))
        };
        scene.triangles.iter().filter_map(segment).collect()
    }

    /// The two points where the plane cuts a triangle's edges; `None` where all of it lies on one side.
    fn cut_triangle(&self, corners: [[f64; 3]; 3]) -> Option<[Flat; 2]> {
        let heights = corners.map(|corner| self.height(corner));
        let mut ends = Vec::with_capacity(2);
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (a, b) = (heights[i], heights[j]);
            if (a < 0.0) != (b < 0.0) {
                let t = a / (a - b);
                ends.push(
                    self.project(std::array::from_fn(|k| {
                        corners[i][k] + (corners[j][k] - corners[i][k]) * t
                    })),
                );
            }
        }
        <[Flat; 2]>::try_from(ends).ok()
    }
}

pub(super) fn widen(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt().max(f64::MIN_POSITIVE);
    v.map(|x| x / length)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn plane() -> Plane {
        let first = TreeNode { origin: [0.0, 1.0, 5.0], direction: [0.0, 0.0, -1.0], ..TreeNode::default() };
        Plane::of(&first)
    }

    #[test]
    fn the_first_ray_runs_onwards_and_up_is_up() {
        assert_eq!(plane().project([7.0, 1.0, 2.0]), [3.0, 0.0]);
        assert_eq!(plane().project([0.0, 3.0, 5.0]), [0.0, 2.0]);
    }

    #[test]
    fn a_triangle_is_cut_where_its_edges_cross_the_plane() {
        let plane = plane();
        let cut = plane.cut_triangle([[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, -2.0]]).unwrap();
        let mut along = cut.map(|point| point[0]);
        along.sort_by(f64::total_cmp);
        assert_eq!(along, [5.0, 6.0]);
        assert!(plane.cut_triangle([[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]).is_none());
    }

    #[test]
    fn a_vertical_ray_has_a_plane_too() {
        let first = TreeNode { direction: [0.0, 1.0, 0.0], ..TreeNode::default() };
        let plane = Plane::of(&first);
        assert!((dot(plane.up, plane.onwards)).abs() < 1e-12 && dot(plane.onwards, plane.onwards) > 0.99);
    }
}
