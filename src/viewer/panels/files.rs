//! What can be written, by buttons.

use std::sync::atomic::Ordering;

use egui::{DragValue, ProgressBar, RichText, Ui};

use super::super::session::{Order, Session};

/// Most pictures of a turntable.
const MOST_PICTURES: u32 = 3600;

/// Write the picture, the scene, or pictures from all around.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    ui.horizontal(|ui| {
        if ui.button("write picture").on_hover_text("To a new PNG file of the working folder (F12)").clicked()
        {
            session.orders.push(Order::Screenshot);
        }
        let hint = "The scene with this camera, to a new file beside it (Ctrl+S)";
        if ui.button("write scene").on_hover_text(hint).clicked() {
            session.orders.push(Order::SaveScene);
        }
    });
    if let Some(turning) = &session.turning {
        let (done, of) = (turning.done, turning.of);
        let mut is_stopped = false;
        ui.horizontal(|ui| {
            let text = RichText::new(format!("{done} of {of} pictures")).small();
            let part = done as f32 / of.max(1) as f32;
            ui.add(
                ProgressBar::new(part).text(text).desired_width(200.0).desired_height(16.0).corner_radius(3),
            );
            is_stopped = ui.button("stop").on_hover_text("What is written stays").clicked();
        });
        if is_stopped {
            turning.stop.store(true, Ordering::Relaxed);
            session.turning = None;
            session.say(format!("stopped: {done} of {of} pictures are written"));
        }
        return;
    }
    ui.horizontal(|ui| {
        let pictures = DragValue::new(&mut session.turntable_pictures).range(1..=MOST_PICTURES).suffix(" pictures");
        ui.add(pictures).on_hover_text("At equal angles round the pivot");
        let hint = "Pictures from all around at full quality, in a new folder of the working folder: those of \
                    `snellius render --turntable`. The window can be used meanwhile; they wait for it.";
        if ui.button("write turntable").on_hover_text(hint).clicked() {
            session.orders.push(Order::Turntable(session.turntable_pictures));
        }
    });
}
