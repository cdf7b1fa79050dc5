//! What a pixel is made of: its ray tree, as an outline and as segments in the scene.

use egui::{Color32, Painter, Pos2, Rect, Stroke, Ui};
use glam::DVec3;

use super::session::Session;
use crate::flatten::view;
use crate::layout::constants::TREE_NODES;
use crate::layout::{Settings, TreeNode};
use crate::trace::{End, Node, Parting, Tree, on_cpu, part};

/// Segments that are drawn at most: the first, which weigh most.
const MOST_SEGMENTS: usize = 400;
/// Length of a ray that meets nothing, in radii of the scene.
const AWAY: f64 = 2.0;
/// Rays of less weight are drawn as thin as this one.
const FAINT: f32 = 0.02;

/// The ray tree of a pixel's first sample, traced on the CPU.
#[derive(Debug, Clone)]
pub struct Inspection {
    /// The pixel.
    pub pixel: [u32; 2],
    /// Its tree.
    pub tree: Tree,
    /// The same as the devices record it.
    records: Vec<TreeNode>,
    /// What became of the comparison with the adapter.
    pub comparison: Comparison,
    /// The ray that the pointer rests on in the outline.
    pub pointed: Option<usize>,
}

/// What became of the comparison of a tree with the adapter's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Comparison {
    /// Nobody has asked.
    #[default]
    None,
    /// The adapter has not answered yet.
    Awaited,
    /// The same rays, and where both are strict the same bits.
    Same,
    /// The first ray at which they part.
    Parted(Parting),
}

impl Inspection {
    /// Trace the tree of a pixel of a picture of this size, as the session stands.
    #[must_use]
    pub fn of(session: &Session, size: [u32; 2], pixel: [u32; 2]) -> Self {
        let scene = &session.stage.flat.scene;
        let settings = Settings { samples: 1, ..session.settings };
        let view = view(&session.orbit.camera, scene, size, None, &settings);
        let records = on_cpu(scene, &view, &settings, pixel).nodes;
        let tree = Tree::new(&records, scene, &view);
        Self { pixel, tree, records, comparison: Comparison::None, pointed: None }
    }

    /// Compare with the tree of an adapter.
    pub fn compare(&mut self, pixel: [u32; 2], nodes: &[TreeNode], is_strict: bool) {
        if pixel == self.pixel {
            let kept = &self.records[..self.records.len().min(TREE_NODES as usize)];
            self.comparison = part(kept, nodes, is_strict).map_or(Comparison::Same, Comparison::Parted);
        }
    }

    /// What the pixel's first ray meets.
    #[must_use]
    pub fn point(&self) -> Option<DVec3> {
        self.tree.nodes.first()?.hit.as_ref().map(|hit| wide(hit.point))
    }
}

/// Draw the rays over the picture.
pub(super) fn draw(ui: &Ui, session: &Session, rect: Rect) {
    let Some(inspection) = &session.inspection else { return };
    let painter = ui.painter().with_clip_rect(rect);
    let nodes = &inspection.tree.nodes;
    for node in nodes.iter().take(MOST_SEGMENTS).filter(|node| !node.end.is_untraced()) {
        let color = color(node);
        let weight = node.greatest_weight().clamp(FAINT, 1.0);
        let is_pointed = inspection.pointed == Some(node.id);
        let width = if is_pointed { 4.0 } else { 1.0 + 1.6 * weight.sqrt() };
        let color =
            if is_pointed { Color32::YELLOW } else { color.gamma_multiply(0.35 + 0.65 * weight.sqrt()) };
        segment(&painter, session, rect, ends(node, session.orbit.radius()), Stroke::new(width, color));
    }
    if let Some(at) = inspection.point().and_then(|point| place(session, rect, point)) {
        painter.circle(at, 4.0, Color32::TRANSPARENT, Stroke::new(1.5, Color32::WHITE));
    }
}

/// A colour for a ray's kind: as in the drawings of `snellius trace --svg`.
pub(super) fn color(node: &Node) -> Color32 {
    match node.kind {
        "reflection" => Color32::from_rgb(235, 98, 40),
        "refraction" => Color32::from_rgb(80, 170, 255),
        _ => Color32::from_rgb(235, 235, 235),
    }
}

/// Where a ray begins and ends.
fn ends(node: &Node, radius: f64) -> [DVec3; 2] {
    let origin = wide(node.origin);
    let end = match &node.hit {
        Some(hit) => wide(hit.point),
        None => origin + wide(node.direction) * (AWAY * radius),
    };
    [origin, end]
}

fn segment(painter: &Painter, session: &Session, rect: Rect, ends: [DVec3; 2], stroke: Stroke) {
    if let Some([a, b]) = session.orbit.in_front(ends)
        && let (Some(a), Some(b)) = (place(session, rect, a), place(session, rect, b))
    {
        painter.line_segment([a, b], stroke);
    }
}

fn place(session: &Session, rect: Rect, point: DVec3) -> Option<Pos2> {
    let aspect = f64::from(rect.width()) / f64::from(rect.height().max(1.0));
    let place = session.orbit.project(point, aspect)?;
    Some(rect.min + egui::vec2(place.x as f32 * rect.width(), place.y as f32 * rect.height()))
}

/// What a ray did, in a line.
pub(super) fn line(node: &Node) -> String {
    let Some(hit) = &node.hit else { return format!("{}: {}", node.kind, node.end.words()) };
    let mut text = format!("{} → {}", node.kind, hit.body);
    if hit.before != hit.behind {
        text += &format!(", {} → {}", hit.before, hit.behind);
    }
    text += &format!(", {:.1}°", hit.angle_deg);
    if hit.is_total {
        text += ", total";
    } else if let Some(reflectance) = hit.reflectance {
        text += &format!(", R {reflectance:.3}");
    }
    if node.end != End::Surface {
        text += &format!(", {}", node.end.words());
    }
    text
}

/// All that is known of a ray.
pub(super) fn details(node: &Node) -> String {
    let rgb = |v: [f32; 3]| format!("{:.4} {:.4} {:.4}", v[0], v[1], v[2]);
    let mut text = format!(
        "ray {}, depth {}\nweight {}\nadds {}\nin {}",
        node.id,
        node.depth,
        rgb(node.weight),
        rgb(node.contribution),
        node.medium
    );
    if let Some(hit) = &node.hit {
        text += &format!(
            "\nmeets {} ({}) from {}, after {:.4} units\nat {}\nweight left {}\n{} shadow rays",
            hit.body,
            hit.material,
            hit.side,
            hit.distance,
            rgb(hit.point),
            rgb(hit.weight),
            hit.shadow_rays
        );
    }
    text + &format!("\n{}", node.end.words())
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}
