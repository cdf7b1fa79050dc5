//! Where names can stand without hiding anything.

use super::canvas::{Anchor, width_of};

/// An area of the sheet: left, top, right, bottom.
pub(super) type Area = [f64; 4];

/// What is already taken on a sheet.
#[derive(Debug, Clone, Default)]
pub(super) struct Taken {
    areas: Vec<Area>,
    inside: Area,
}

/// Where a name stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// Its anchor, on its base line.
    pub(super) at: [f64; 2],
    pub(super) anchor: Anchor,
    /// Whether it needs a line to its point.
    pub(super) is_far: bool,
}

impl Taken {
    /// Nothing yet; names must lie inside this area.
    pub(super) fn inside(inside: Area) -> Self {
        Self { areas: Vec::new(), inside }
    }

    /// Keep an area free of names.
    pub(super) fn take(&mut self, area: Area) {
        self.areas.push(area);
    }

    /// Keep a mark free.
    pub(super) fn take_mark(&mut self, [x, y]: [f64; 2], radius: f64) {
        self.take([x - radius, y - radius, x + radius, y + radius]);
    }

    /// A place for a name near a point, which is then taken: right of it, left, above, below, then further off.
    pub(super) fn place(&mut self, point: [f64; 2], text: &str, size: f64) -> Option<Place> {
        self.place_at(point, text, size, &[1.0, 2.4, 4.0, 6.0])
    }

    /// The same, but only beside the point.
    pub(super) fn place_beside(&mut self, point: [f64; 2], text: &str, size: f64) -> Option<Place> {
        self.place_at(point, text, size, &[1.0])
    }

    fn place_at(&mut self, [x, y]: [f64; 2], text: &str, size: f64, distances: &[f64]) -> Option<Place> {
        let width = width_of(text, size);
        let candidates = distances.iter().flat_map(|&far| {
            let (dx, dy) = (8.0 * far, size * far);
            [
                ([x + dx, y + size * 0.35], Anchor::Start),
                ([x - dx, y + size * 0.35], Anchor::End),
                ([x + dx * 0.6, y - dy * 0.6], Anchor::Start),
                ([x + dx * 0.6, y + dy * 1.1], Anchor::Start),
                ([x - dx * 0.6, y - dy * 0.6], Anchor::End),
                ([x - dx * 0.6, y + dy * 1.1], Anchor::End),
                ([x, y - dy * 0.8], Anchor::Middle),
                ([x, y + dy * 1.5], Anchor::Middle),
            ]
            .map(|(at, anchor)| Place { at, anchor, is_far: far > 1.0 })
        });
        for place in candidates {
            let Place { at, anchor, .. } = place;
            let left = match anchor {
                Anchor::Start => at[0],
                Anchor::Middle => at[0] - width / 2.0,
                Anchor::End => at[0] - width,
            };
            let area = [left, at[1] - size * 0.85, left + width, at[1] + size * 0.25];
            if self.is_free(area) {
                self.take(area);
                return Some(place);
            }
        }
        None
    }

    fn is_free(&self, area: Area) -> bool {
        let within = area[0] >= self.inside[0]
            && area[1] >= self.inside[1]
            && area[2] <= self.inside[2]
            && area[3] <= self.inside[3];
        let overlaps = |other: &Area| {
            area[0] < other[2] && other[0] < area[2] && area[1] < other[3] && other[1] < area[3]
        };
        within && !self.areas.iter().any(overlaps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_near_points_do_not_overlap() {
        let mut taken = Taken::inside([0.0, 0.0, 400.0, 300.0]);
        let names = ["depth 8", "cut-off 0.001", "baseline", "f64"];
        let points = [[200.0, 150.0], [203.0, 151.0], [199.0, 149.0], [205.0, 154.0]];
        points.iter().for_each(|&point| taken.take_mark(point, 4.0));
        for (point, name) in points.into_iter().zip(names) {
            assert!(taken.place(point, name, 12.0).is_some(), "{name}");
        }
        let areas = &taken.areas[4..];
        for (i, a) in areas.iter().enumerate() {
            for b in &areas[i + 1..] {
                assert!(a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1]);
            }
        }
    }

    #[test]
    fn a_name_that_fits_nowhere_is_not_written() {
        let mut taken = Taken::inside([0.0, 0.0, 20.0, 20.0]);
        assert!(taken.place([10.0, 10.0], "a very long name", 12.0).is_none());
    }

    #[test]
    fn a_name_at_the_right_edge_stands_left_of_its_point() {
        let mut taken = Taken::inside([0.0, 0.0, 100.0, 100.0]);
        assert_eq!(taken.place([95.0, 50.0], "baseline", 12.0).map(|place| place.anchor), Some(Anchor::End));
    }
}
