//! The ray tree of a pixel, as an outline.

use egui::{RichText, ScrollArea, Sense, Ui};

use super::super::Backend;
use super::super::inspection::{Comparison, color, details, line};
use super::super::session::{Order, Session};

/// Points that a level of the tree is indented by.
const INDENT: f32 = 9.0;

/// Show the tree of the pixel that was clicked.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    let Some(inspection) = &mut session.inspection else {
        ui.weak("Click into the picture to see what a pixel is made of.");
        return;
    };
    let [x, y] = inspection.pixel;
    let mut is_closed = false;
    ui.horizontal(|ui| {
        ui.label(format!("pixel {x}, {y}: {} rays", inspection.tree.rays()));
        is_closed = ui.small_button("×").on_hover_text("Forget it").clicked();
    });
    let [r, g, b] = inspection.tree.radiance();
    ui.weak(format!("first sample: {r:.4} {g:.4} {b:.4}, linear"));
    if session.backend == Backend::Gpu {
        match inspection.comparison {
            Comparison::None => {
                let button = ui.small_button("compare with the adapter");
                if button
                    .on_hover_text("Trace the same tree on the adapter, and find where the two part")
                    .clicked()
                {
                    inspection.comparison = Comparison::Awaited;
                    session.orders.push(Order::Compare(inspection.pixel));
                }
            }
            Comparison::Awaited => drop(ui.weak("the adapter is asked …")),
            Comparison::Same => drop(ui.weak("the adapter traces the same tree")),
            Comparison::Parted(parting) => {
                ui.weak(format!("the adapter's tree parts at ray {}: {}", parting.node, parting.what));
            }
        }
    }
    let nodes = &inspection.tree.nodes;
    let height = ui.text_style_height(&egui::TextStyle::Small) + 3.0;
    let mut pointed = None;
    ScrollArea::both().id_salt("rays").max_height(240.0).auto_shrink([false, true]).show_rows(
        ui,
        height,
        nodes.len(),
        |ui, rows| {
            for node in &nodes[rows] {
                ui.horizontal(|ui| {
                    ui.add_space(INDENT * node.depth as f32);
                    let (rect, _) = ui.allocate_exact_size(egui::vec2(8.0, 8.0), Sense::hover());
                    ui.painter().rect_filled(rect, 2.0, color(node));
                    let text = RichText::new(line(node)).small();
                    let label = ui.add(egui::Label::new(text).wrap_mode(egui::TextWrapMode::Extend));
                    if label.hovered() {
                        pointed = Some(node.id);
                    }
                    label.on_hover_text(RichText::new(details(node)).monospace());
                });
            }
        },
    );
    inspection.pointed = pointed;
    if is_closed {
        session.inspection = None;
    }
}
