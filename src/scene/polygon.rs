//! Cutting a face of any shape into triangles.
//!
//! Ear clipping (Meisters 1975, "Polygons have ears"; Eberly, "Triangulation by Ear Clipping") in the plane
//! of Newell's normal. Every corner stays a corner, collinear ones too, so that n corners always give n − 2
//! triangles whose outer edges are the face's edges: no T-junction arises between neighbouring faces.

use std::cmp::Ordering;

use glam::{DVec2, DVec3};

/// Cut a polygon of n ≥ 3 corners into n − 2 triangles of the same orientation, which index the corners.
///
/// The cut does not depend on the corner that the polygon is written from, nor on the way round: faces of two
/// bodies that coincide are cut alike. A convex polygon becomes the fan of its least corner by x, then y, then z.
/// Where the polygon crosses itself or has no area there is no right answer; the result still has n − 2
/// triangles and the same outer edges. Time is O(n²) at worst.
pub(super) fn triangulate(corners: &[DVec3]) -> Vec<[usize; 3]> {
    if corners.len() < 3 {
        return Vec::new();
    }
    let (order, is_turned) = canonical_order(corners);
    let points: Vec<DVec3> = order.iter().map(|&corner| corners[corner]).collect();
    let restore = |triangle: [usize; 3]| {
        let [a, b, c] = triangle.map(|corner| order[corner]);
        if is_turned { [a, c, b] } else { [a, b, c] }
    };
    cut(&points).into_iter().map(restore).collect()
}

/// The corners from the least one on, towards its lesser neighbour, and whether that is against their order.
fn canonical_order(corners: &[DVec3]) -> (Vec<usize>, bool) {
    let count = corners.len();
    let key = |corner: usize| corners[corner % count].to_array();
    let less = |a: usize, b: usize| key(a).partial_cmp(&key(b)) == Some(Ordering::Less);
    let start = (0..count).fold(0, |least, corner| if less(corner, least) { corner } else { least });
    let is_turned = less(start + count - 1, start + 1);
    let order = (0..count).map(|step| if is_turned { start + count - step } else { start + step } % count);
    (order.collect(), is_turned)
}

/// Clip ears, from the second corner on.
fn cut(corners: &[DVec3]) -> Vec<[usize; 3]> {
    let mut triangles = Vec::with_capacity(corners.len().saturating_sub(2));
    let mut ring = Ring::new(corners);
    let mut corner = 1;
    let mut tried = 0;
    while ring.left > 3 {
        // Where no ear is left, which happens to faces that cross themselves only, any corner will do.
        if ring.is_ear(corner) || tried > ring.left {
            triangles.push(ring.triangle(corner));
            corner = ring.clip(corner);
            tried = 0;
        } else {
            corner = ring.links[corner].next;
            tried += 1;
        }
    }
    if ring.left == 3 {
        let last = ring.triangle(corner);
        let lowest = last.into_iter().min().unwrap_or(corner);
        triangles.push(ring.triangle(ring.links[lowest].next));
    }
    triangles
}

/// Newell's normal (Sutherland, Sproull, Schumacker 1974): its length is twice the area.
fn newell_normal(corners: &[DVec3]) -> DVec3 {
    let origin = corners.first().copied().unwrap_or_default();
    let following = corners.iter().cycle().skip(1);
    corners.iter().zip(following).map(|(&a, &b)| (a - origin).cross(b - origin)).sum()
}

/// The projection along the axis to which a polygon's normal is nearest, under which the polygon runs
/// counter-clockwise.
fn projection(normal: DVec3) -> impl Fn(DVec3) -> DVec2 {
    let size = normal.abs();
    let [right, up] = if size.x >= size.y && size.x >= size.z {
        [1, 2]
    } else if size.y >= size.z {
        [2, 0]
    } else {
        [0, 1]
    };
    let [right, up] = if normal[3 - right - up] < 0.0 { [up, right] } else { [right, up] };
    move |point| DVec2::new(point[right], point[up])
}

/// Twice the signed area of a triangle, positive where it runs counter-clockwise.
fn area2([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

/// A corner in the ring of those that are left.
struct Link {
    point: DVec2,
    previous: usize,
    next: usize,
    is_cut: bool,
    /// The first point that is not yet known to lie outside this corner's triangle. Points never move, so it
    /// goes back only when the corner gets a new neighbour: this makes O(n²).
    untested: usize,
}

/// The corners that are not yet cut off.
struct Ring {
    links: Vec<Link>,
    left: usize,
}

impl Ring {
    fn new(corners: &[DVec3]) -> Self {
        let (count, project) = (corners.len(), projection(newell_normal(corners)));
        let link = |(corner, &point): (usize, &DVec3)| Link {
            point: project(point),
            previous: (corner + count - 1) % count,
            next: (corner + 1) % count,
            is_cut: false,
            untested: 0,
        };
        Self { links: corners.iter().enumerate().map(link).collect(), left: count }
    }

    /// A corner between its neighbours.
    fn triangle(&self, corner: usize) -> [usize; 3] {
        [self.links[corner].previous, corner, self.links[corner].next]
    }

    /// Whether a corner is convex and no other point lies in its triangle.
    fn is_ear(&mut self, corner: usize) -> bool {
        let [a, b, c] = self.triangle(corner).map(|corner| self.links[corner].point);
        if area2([a, b, c]) <= 0.0 {
            return false;
        }
        let blocks = |link: &Link| {
            let p = link.point;
            // A point at a corner's own place (a doubled corner of a bridge to a hole) does not block.
            !link.is_cut
                && ![a, b, c].contains(&p)
                && [[a, b, p], [b, c, p], [c, a, p]].into_iter().all(|triangle| area2(triangle) >= 0.0)
        };
        let start = self.links[corner].untested;
        let blocker = self.links[start..].iter().position(blocks);
        self.links[corner].untested = blocker.map_or(self.links.len(), |offset| start + offset);
        blocker.is_none()
    }

    /// Take a corner out; returns the one after it.
    fn clip(&mut self, corner: usize) -> usize {
        let [before, _, after] = self.triangle(corner);
        self.links[before].next = after;
        self.links[after].previous = before;
        self.links[before].untested = 0;
        self.links[after].untested = 0;
        self.links[corner].is_cut = true;
        self.left -= 1;
        after
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(points: &[[f64; 2]]) -> Vec<DVec3> {
        points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
    }

    /// Areas add up and none is negative; each edge of the polygon occurs once, each diagonal both ways.
    fn check(corners: &[DVec3]) -> Vec<[usize; 3]> {
        let triangles = triangulate(corners);
        let normal = newell_normal(corners);
        assert_eq!(triangles.len(), corners.len() - 2);
        let area = |[a, b, c]: [usize; 3]| {
            (corners[b] - corners[a]).cross(corners[c] - corners[a]).dot(normal.normalize())
        };
        let total: f64 = triangles.iter().map(|&triangle| area(triangle)).sum();
        assert!(triangles.iter().all(|&triangle| area(triangle) >= -1e-12 * total), "{triangles:?}");
        assert!((total - normal.length()).abs() <= 1e-9 * total);
        let mut edges: Vec<_> = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        edges.sort_unstable();
        let count = edges.len();
        edges.dedup();
        assert_eq!(edges.len(), count, "an edge occurs twice in one direction");
        for &[a, b] in &edges {
            let is_outer = (a + 1) % corners.len() == b;
            assert_ne!(edges.binary_search(&[b, a]).is_ok(), is_outer, "edge {a} {b}");
        }
        triangles
    }

    #[test]
    fn the_cut_depends_neither_on_the_first_corner_nor_on_the_way_round() {
        let arrow = flat(&[[0., 0.], [4., 1.], [0., 2.], [1., 1.], [-1., 1.5]]);
        let places = |corners: &[DVec3]| {
            let sorted = |triangle: [usize; 3]| {
                let mut points = triangle.map(|corner| corners[corner].to_array());
                points.sort_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
                points
            };
            let mut triangles: Vec<_> = triangulate(corners).into_iter().map(sorted).collect();
            triangles.sort_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
            triangles
        };
        let expected = places(&arrow);
        for turn in 0..arrow.len() {
            let mut corners = arrow.clone();
            corners.rotate_left(turn);
            assert_eq!(places(&corners), expected);
            corners.reverse();
            assert_eq!(places(&corners), expected);
        }
    }

    #[test]
    fn a_convex_face_becomes_the_fan_of_its_least_corner() {
        let hexagon: Vec<_> = (0..6)
            .map(|i| f64::from(i).to_radians() * 60.0)
            .map(|a| DVec3::new(a.cos(), 0.0, a.sin()))
            .collect();
        assert_eq!(check(&hexagon), [[3, 4, 5], [3, 5, 0], [3, 0, 1], [3, 1, 2]]);
    }

    #[test]
    fn concave_faces_are_cut_inside() {
        check(&flat(&[[0., 0.], [4., 0.], [4., 4.], [2., 1.], [0., 4.]]));
        check(&flat(&[[0., 0.], [2., 1.], [4., 0.], [2., 8.]]));
    }

    #[test]
    fn orientation_is_kept_in_every_plane() {
        let arrow = [[0., 0.], [2., 1.], [4., 0.], [2., 8.]];
        for axes in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]] {
            let corners: Vec<_> = arrow
                .iter()
                .map(|&[x, y]| {
                    let p = [x, y, 0.5 * x + 0.1 * y + 7.0];
                    DVec3::from_array(axes.map(|axis| p[axis]))
                })
                .collect();
            check(&corners);
            check(&corners.iter().rev().copied().collect::<Vec<_>>());
        }
    }

    #[test]
    fn collinear_corners_stay_corners() {
        check(&flat(&[[0., 0.], [1., 0.], [2., 0.], [2., 2.], [1., 2.], [0., 2.], [0., 1.]]));
        check(&flat(&[[0., 0.], [1., 0.], [2., 0.], [1., 1.]]));
    }

    #[test]
    fn a_hole_joined_by_a_bridge_is_cut_around() {
        check(&flat(&[
            [0., 0.],
            [6., 0.],
            [6., 6.],
            [0., 6.],
            [0., 0.], // outside, and back to its first corner
            [2., 2.],
            [2., 4.],
            [4., 4.],
            [4., 2.],
            [2., 2.], // the hole, clockwise
        ]));
    }

    #[test]
    fn a_comb_and_a_spiral_are_cut() {
        let mut comb = vec![[0., -1.], [20., -1.]];
        comb.extend((0..=20).rev().map(|i| [f64::from(i), if i % 2 == 0 { 5.0 } else { 0.0 }]));
        check(&flat(&comb));
        let turn = |i: i32, inset: f64| {
            let angle = f64::from(i) * 0.3;
            [(angle + 1.0 - inset) * angle.cos(), (angle + 1.0 - inset) * angle.sin()]
        };
        let spiral: Vec<_> =
            (0..80).map(|i| turn(i, 0.0)).chain((0..80).rev().map(|i| turn(i, 0.5))).collect();
        check(&flat(&spiral));
    }

    #[test]
    fn faces_without_an_answer_still_give_their_triangles() {
        let bow_tie = flat(&[[0., 0.], [1., 1.], [1., 0.], [0., 1.]]);
        assert_eq!(triangulate(&bow_tie).len(), 2);
        assert_eq!(triangulate(&flat(&[[0., 0.]; 7])).len(), 5);
        assert_eq!(triangulate(&flat(&[[0., 0.], [1., 1.], [2., 2.], [3., 3.]])).len(), 2);
        assert!(triangulate(&flat(&[[0., 0.], [1., 1.]])).is_empty());
        assert!(triangulate(&[]).is_empty());
    }
}
