//! The tree drawn, and beside it the path of its rays through the scene cut open.

use std::collections::BTreeMap;

use super::section::{Flat, Plane, widen};
use super::{End, Node, Tree};
use crate::film::srgb_code;
use crate::layout::{FlatScene, TreeNode};
use crate::plot::{Anchor, BLACK, BLUE, Canvas, GREEN, GREY, ORANGE, PURPLE, SKY, Type, VERMILLION};

/// Rays that are drawn at most: the heaviest, with all that they came from.
const MOST_RAYS: usize = 160;
/// Room for a leaf and for a level of the tree.
const LEAF: f64 = 26.0;
const LEVEL: f64 = 62.0;
/// Least and greatest width of the tree, and the size of the side view.
const TREE_WIDTH: [f64; 2] = [420.0, 4000.0];
const SIDE: [f64; 2] = [720.0, 560.0];
const MARGIN: f64 = 30.0;
/// What the signs mean.
const LEGEND: &str = "blue: refracted; red: reflected; grey circle: met from inside; square: the background that is seen; \
                      crossed and dashed: cut";
/// Colours of bodies, in turn.
const BODIES: [&str; 6] = [SKY, ORANGE, GREEN, PURPLE, BLUE, GREY];

/// An SVG document: left the tree from the eye downwards, right the rays from the side, over the scene's section along
/// the first ray. Blue rays are refracted, red ones reflected; a line is as thick as its weight.
#[must_use]
pub fn drawing(tree: &Tree, records: &[TreeNode], scene: &FlatScene, title: &str) -> String {
    let shown = heaviest(tree);
    let layout = Layout::new(tree, &shown);
    let side_at = [layout.width + 2.0 * MARGIN, MARGIN + 20.0];
    let side = records.first().map(|first| Side::new(first, tree, side_at));
    let side_height = side.as_ref().map_or(0.0, |side| side.frame.height());
    let height = layout.height.max(side_height) + 2.0 * MARGIN + 40.0;
    let width = layout.width + SIDE[0] + 3.0 * MARGIN;
    let mut canvas = Canvas::new([width, height], title);
    canvas.text([MARGIN, 26.0], title, text(14.0, BLACK, Anchor::Start));
    draw_tree(&mut canvas, tree, &shown, &layout);
    if let Some(side) = side {
        side.draw(&mut canvas, tree, &shown, scene, side_at);
    }
    let hidden = match tree.nodes.len() - shown.len() {
        0 => String::new(),
        rays => format!("; {rays} fainter rays are not drawn"),
    };
    canvas.text([MARGIN, height - 12.0], &format!("{LEGEND}{hidden}"), text(11.0, "#5a5a5a", Anchor::Start));
    canvas.finish()
}

/// The heaviest rays with their ancestors, in the order of tracing.
fn heaviest(tree: &Tree) -> Vec<usize> {
    let mut order: Vec<usize> = (0..tree.nodes.len()).collect();
    order.sort_by(|&a, &b| tree.nodes[b].greatest_weight().total_cmp(&tree.nodes[a].greatest_weight()));
    let mut shown = std::collections::BTreeSet::new();
    for id in order {
        if shown.len() >= MOST_RAYS {
            break;
        }
        let mut next = Some(id);
        while let Some(id) = next {
            shown.insert(id);
            next = tree.nodes[id].parent;
        }
    }
    shown.into_iter().collect()
}

/// Where the rays of the tree are drawn.
struct Layout {
    places: Vec<Option<Flat>>,
    width: f64,
    height: f64,
}

impl Layout {
    /// Leaves side by side in the order of tracing, parents over the middle of their children.
    fn new(tree: &Tree, shown: &[usize]) -> Self {
        let mut places: Vec<Option<Flat>> = vec![None; tree.nodes.len()];
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); tree.nodes.len()];
        for &id in shown {
            if let Some(parent) = tree.nodes[id].parent {
                children[parent].push(id);
            }
        }
        let leaves = shown.iter().filter(|&&id| children[id].is_empty()).count().max(1);
        let width = (leaves as f64 * LEAF).clamp(TREE_WIDTH[0], TREE_WIDTH[1]);
        let mut leaf = 0;
        // Children have higher ids than their parents, so that going backwards meets them first; leaves are counted
        // in the order in which they are met, from the right.
        for &id in shown.iter().rev() {
            let x = if children[id].is_empty() {
                leaf += 1;
                MARGIN + width * (1.0 - (f64::from(leaf) - 0.5) / leaves as f64)
            } else {
                let xs = children[id].iter().filter_map(|&child| places[child]).map(|place| place[0]);
                xs.sum::<f64>() / children[id].len() as f64
            };
            places[id] = Some([x, MARGIN + 36.0 + f64::from(tree.nodes[id].depth) * LEVEL]);
        }
        let deepest = shown.iter().map(|&id| tree.nodes[id].depth).max().unwrap_or(0);
        Self { places, width, height: f64::from(deepest) * LEVEL + 80.0 }
    }
}

fn draw_tree(canvas: &mut Canvas, tree: &Tree, shown: &[usize], layout: &Layout) {
    for &id in shown {
        let node = &tree.nodes[id];
        if let (Some(place), Some(above)) = (layout.places[id], node.parent.and_then(|p| layout.places[p])) {
            canvas.line(above, place, color_of(node), width_of(node), dash_of(node));
        }
    }
    for &id in shown {
        let (node, Some([x, y])) = (&tree.nodes[id], layout.places[id]) else { continue };
        match &node.hit {
            Some(hit) => {
                canvas.circle([x, y], 6.0, if hit.side == "outside" { "white" } else { "#d8d8d8" }, BLACK);
                let name = if hit.is_total { format!("{} total", hit.body) } else { hit.body.clone() };
                canvas.text([x + 9.0, y + 4.0], &name, text(10.0, BLACK, Anchor::Start));
            }
            None => draw_leaf(canvas, node, [x, y]),
        }
    }
}

/// A ray that met nothing: a square in the colour that it sees, crossed out if it was cut.
fn draw_leaf(canvas: &mut Canvas, node: &Node, [x, y]: Flat) {
    let greatest = node.greatest_weight().max(f32::MIN_POSITIVE);
    let seen = node.contribution.map(|v| srgb_code((v / greatest).clamp(0.0, 1.0), 255));
    let fill = format!("rgb({},{},{})", seen[0], seen[1], seen[2]);
    let r = 5.0;
    canvas.polygon(&[[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r]], &fill, BLACK, 1.0);
    if node.end != End::Background {
        canvas.line([x - r, y - r], [x + r, y + r], BLACK, 1.0, "");
        canvas.line([x - r, y + r], [x + r, y - r], BLACK, 1.0, "");
    }
}

/// The rays from the side, over the scene cut open.
struct Side {
    plane: Plane,
    frame: Frame,
}

impl Side {
    /// Along the first ray, around all points where rays meet surfaces.
    fn new(first: &TreeNode, tree: &Tree, area: Flat) -> Self {
        let plane = Plane::of(first);
        let hits = tree.nodes.iter().filter_map(|node| node.hit.as_ref());
        let points: Vec<_> = hits.map(|hit| plane.project(widen(hit.point))).collect();
        Self { plane, frame: Frame::around(&points, area) }
    }

    fn draw(&self, canvas: &mut Canvas, tree: &Tree, shown: &[usize], scene: &FlatScene, [x, y]: Flat) {
        let caption = "from the side, cut along the first ray";
        canvas.text([x, y - 8.0], caption, text(12.0, "#5a5a5a", Anchor::Start));
        self.draw_bodies(canvas, scene);
        for &id in shown.iter().rev() {
            let node = &tree.nodes[id];
            if node.end.is_untraced() {
                continue;
            }
            let ends = [widen(node.origin), self.end_of(node)].map(|point| self.plane.project(point));
            if let Some([a, b]) = self.frame.clip(ends) {
                canvas.line(a, b, color_of(node), width_of(node), dash_of(node));
            }
        }
    }

    /// Each body's section, and its name over the highest point of it.
    fn draw_bodies(&self, canvas: &mut Canvas, scene: &FlatScene) {
        let mut tops: BTreeMap<u32, Flat> = BTreeMap::new();
        for (body, ends) in self.plane.cut(scene) {
            if let Some([a, b]) = self.frame.clip(ends) {
                canvas.line(a, b, BODIES[body as usize % BODIES.len()], 1.0, "");
                let top = tops.entry(body).or_insert(a);
                *top = if a[1] < top[1] { a } else { *top };
            }
        }
        for (body, [x, y]) in tops {
            let name = scene.bodies.get(body as usize).map_or("", |body| body.name.as_str());
            canvas.text([x, y - 4.0], name, text(11.0, BODIES[body as usize % BODIES.len()], Anchor::Middle));
        }
    }

    /// Where a ray meets a surface; beyond the frame if it meets none.
    fn end_of(&self, node: &Node) -> [f64; 3] {
        match &node.hit {
            Some(hit) => widen(hit.point),
            None => std::array::from_fn(|i| {
                f64::from(node.origin[i]) + self.frame.reach * f64::from(node.direction[i])
            }),
        }
    }
}

/// The part of the plane that is drawn, and where.
struct Frame {
    low: Flat,
    high: Flat,
    area: Flat,
    scale: f64,
    /// Longer than any line in the frame.
    reach: f64,
}

impl Frame {
    /// Around the points where rays meet surfaces, with room to leave.
    fn around(points: &[Flat], area: Flat) -> Self {
        let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
        for point in points {
            for axis in 0..2 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        if points.is_empty() {
            (low, high) = ([0.0; 2], [1.0; 2]);
        }
        let room = (high[0] - low[0]).max(high[1] - low[1]).max(1e-9) * 0.25;
        let (low, high) = (low.map(|v| v - room), high.map(|v| v + room));
        let scale = (SIDE[0] / (high[0] - low[0])).min(SIDE[1] / (high[1] - low[1]));
        Self { low, high, area, scale, reach: 4.0 * (room + high[0] - low[0] + high[1] - low[1]) }
    }

    /// What it takes on the sheet.
    fn height(&self) -> f64 {
        (self.high[1] - self.low[1]) * self.scale
    }

    /// A segment's part in the frame, on the sheet (Liang and Barsky 1984).
    fn clip(&self, [a, b]: [Flat; 2]) -> Option<[Flat; 2]> {
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let step = b[axis] - a[axis];
            for (from, room) in [(-step, a[axis] - self.low[axis]), (step, self.high[axis] - a[axis])] {
                if from == 0.0 && room < 0.0 {
                    return None;
                }
                if from < 0.0 {
                    enter = enter.max(room / from);
                } else if from > 0.0 {
                    leave = leave.min(room / from);
                }
            }
        }
        (enter < leave).then(|| [enter, leave].map(|t| self.place([0, 1].map(|i| a[i] + t * (b[i] - a[i])))))
    }

    fn place(&self, [x, y]: Flat) -> Flat {
        [self.area[0] + (x - self.low[0]) * self.scale, self.area[1] + (self.high[1] - y) * self.scale]
    }
}

fn color_of(node: &Node) -> &'static str {
    match node.kind {
        "reflection" => VERMILLION,
        "refraction" => BLUE,
        _ => BLACK,
    }
}

/// From a hair for a ten-thousandth to 4 for everything.
fn width_of(node: &Node) -> f64 {
    let decades = f64::from(node.greatest_weight().max(1e-8)).log10();
    (4.0 + decades).clamp(0.5, 4.0)
}

fn dash_of(node: &Node) -> &'static str {
    if node.end.is_untraced() { "2 3" } else { "" }
}

fn text(size: f64, color: &'static str, anchor: Anchor) -> Type {
    Type { size, color, anchor, bold: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_frame() {
        let frame = Frame::around(&[[0.0, 0.0], [1.0, 1.0]], [0.0, 0.0]);
        let [a, b] = frame.clip([[-100.0, 0.5], [100.0, 0.5]]).unwrap_or_default();
        assert!(a[0].abs() < 1e-9 && b[0] > 400.0 && b[0] <= SIDE[0] + 1e-9, "{a:?} {b:?}");
        assert!(frame.clip([[-100.0, 50.0], [100.0, 50.0]]).is_none());
    }

    #[test]
    fn an_empty_frame_is_no_division_by_nothing() {
        let frame = Frame::around(&[], [0.0, 0.0]);
        assert!(frame.scale.is_finite() && frame.scale > 0.0);
    }
}
