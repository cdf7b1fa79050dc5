//! What is shown of the picture.

use egui::{Align2, ComboBox, FontId, Rect, Slider, Ui};

use super::super::look::ViewKind;
use super::super::session::Session;
use super::grid;
use crate::film::AovKind;

/// Choose what is shown.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    let look = &mut session.look;
    grid(ui, "views", |ui| {
        ui.label("show");
        choose(ui, "first view", &mut look.first);
        ui.end_row();
        let mut compares = look.second.is_some();
        ui.checkbox(&mut compares, "beside").on_hover_text(
            "A second view right of a bar, which is dragged with the mouse. Both are of the same picture.",
        );
        if compares != look.second.is_some() {
            look.second = compares.then_some(ViewKind::Aov(AovKind::Rays));
        }
        if let Some(second) = &mut look.second {
            choose(ui, "second view", second);
        }
        ui.end_row();
        ui.label("exposure");
        ui.add(Slider::new(&mut look.exposure, -8.0..=8.0).suffix(" EV")).on_hover_text(
            "Stops: radiance is multiplied by 2^EV. It changes what is shown, not what is traced.",
        );
        ui.end_row();
    });
}

fn choose(ui: &mut Ui, name: &str, kind: &mut ViewKind) {
    ComboBox::from_id_salt(name)
        .selected_text(kind.name())
        .show_ui(ui, |ui| {
            for one in ViewKind::all() {
                ui.selectable_value(kind, one, one.name()).on_hover_text(one.description());
            }
        })
        .response
        .on_hover_text(kind.description());
}

/// What the colours of a view mean, over the picture's lower edge.
pub(super) fn legend(ui: &Ui, session: &Session, rect: Rect) {
    let look = &session.look;
    let text = |kind: ViewKind| match kind {
        ViewKind::Beauty => None,
        ViewKind::Difference if session.look.reference.is_none() => {
            Some("difference: the CPU traces the picture …".to_owned())
        }
        ViewKind::Difference => Some(
            "difference 1e-7 or less (dark blue) to 1 or more (yellow), logarithmic; black: the CPU's bits"
                .to_owned(),
        ),
        ViewKind::Aov(kind) => Some(format!("{}: {}", kind.name(), meaning(kind, session))),
    };
    let corners = [
        (look.first, rect.left_bottom() + egui::vec2(10.0, -10.0), Align2::LEFT_BOTTOM),
        (
            look.second.unwrap_or_default(),
            rect.right_bottom() + egui::vec2(-10.0, -10.0),
            Align2::RIGHT_BOTTOM,
        ),
    ];
    for (kind, at, align) in corners {
        let Some(text) = text(kind) else { continue };
        let painter = ui.ctx().layer_painter(egui::LayerId::background()).with_clip_rect(rect);
        let wrap = rect.width() * if look.second.is_some() { 0.45 } else { 0.9 };
        let text = painter.layout(text, FontId::proportional(12.5), egui::Color32::WHITE, wrap);
        let place = align.anchor_size(at, text.size());
        painter.rect_filled(place.expand(5.0), 4.0, egui::Color32::from_black_alpha(190));
        painter.galley(place.min, text, egui::Color32::WHITE);
    }
}

/// What the colours stand for, with figures once the picture is complete.
fn meaning(kind: AovKind, session: &Session) -> String {
    let Some(ranges) = session.ranges else { return kind.description().to_owned() };
    match kind {
        AovKind::Depth if ranges.depth[0] <= ranges.depth[1] => {
            format!(
                "{:.4} scene units (white) to {:.4} (dark); black: nothing met",
                ranges.depth[0], ranges.depth[1]
            )
        }
        AovKind::Depth => "black: nothing met".to_owned(),
        AovKind::Normal => "x, y, z from −1 to 1 as red, green, blue; black: nothing met".to_owned(),
        AovKind::Body => "one colour for each body; black: nothing met".to_owned(),
        AovKind::Medium => "one colour for each medium; dark grey: air; black: nothing met".to_owned(),
        AovKind::Rays => format!("0 (dark blue) to {} rays (yellow), logarithmic", ranges.rays),
        AovKind::Samples => format!("0 (dark blue) to {} samples (yellow), logarithmic", ranges.samples),
        AovKind::Dropped => decades(ranges.dropped, "weight"),
        AovKind::Bound => decades(ranges.bound, "radiance"),
        AovKind::PrimitiveHash | AovKind::BodyHash => "one colour for each hash".to_owned(),
    }
}

fn decades(most: f32, unit: &str) -> String {
    if most > 0.0 {
        format!("up to {most:.2e} {unit} (yellow), six decades down (dark blue); black: 0")
    } else {
        "black: 0 everywhere".to_owned()
    }
}
