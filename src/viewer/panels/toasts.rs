//! Messages that fade, over the picture's lower left.

use std::time::Instant;

use egui::{Align2, Area, Frame, Id, Rect, RichText, Ui};

use super::super::session::Session;
use super::warning;

/// Show what was said lately; a click puts one away, Escape all (`picture`).
pub(super) fn show(ui: &Ui, session: &mut Session, rect: Rect) {
    let now = Instant::now();
    session.toasts.retain(|toast| toast.until > now);
    let Some(next) = session.toasts.iter().map(|toast| toast.until).min() else { return };
    ui.ctx().request_repaint_after(next - now);
    let at = rect.left_top() + egui::vec2(12.0, 12.0);
    let error = warning(ui);
    Area::new(Id::unique("toasts")).fixed_pos(at).pivot(Align2::LEFT_TOP).show(ui.ctx(), |ui| {
        let mut gone = None;
        for (index, toast) in session.toasts.iter().enumerate() {
            let shown = Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width((rect.width() - 48.0).clamp(120.0, 560.0));
                let text = RichText::new(&toast.text);
                // Places in files stand below each other.
                let text = if toast.is_error { text.color(error).monospace() } else { text };
                ui.label(text);
            });
            if shown.response.interact(egui::Sense::click()).clicked() {
                gone = Some(index);
            }
        }
        if let Some(index) = gone {
            session.toasts.remove(index);
        }
    });
}
