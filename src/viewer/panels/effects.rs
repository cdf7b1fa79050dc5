//! What the scene calls for, why, and a switch for each.

use egui::{RichText, Ui};

use super::super::session::Session;
use super::warning;
use crate::layout::{Effect, EffectChoice, EffectSet};

/// Show every effect.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    let found = session.found();
    for finding in found.findings() {
        // What the settings decide has its switch there.
        if matches!(finding.effect, Effect::Antialiasing | Effect::Adaptive | Effect::Aovs) {
            continue;
        }
        let mut is_on = finding.on && !session.off.has(finding.effect);
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let switch = ui.add_enabled(finding.on, egui::Checkbox::new(&mut is_on, finding.effect.name()));
            switch.on_hover_text(&finding.reason).on_disabled_hover_text(&finding.reason);
            ui.label(RichText::new(&finding.reason).small().weak());
        });
        if finding.on {
            session.off =
                if is_on { session.off.without(finding.effect) } else { session.off.with(finding.effect) };
        }
    }
    if session.off != EffectSet::NONE {
        let color = warning(ui);
        ui.colored_label(color, "the picture lacks what the scene calls for");
        if ui.button("simulate all of them again").clicked() {
            session.off = EffectSet::NONE;
        }
    }
    let mut general = session.effects == EffectChoice::All;
    ui.checkbox(&mut general, "the general kernel").on_hover_text(
        "Trace with every effect simulated, called for or not: the same picture, more slowly (--effects all)",
    );
    if general != (session.effects == EffectChoice::All) {
        session.effects = if general { EffectChoice::All } else { EffectChoice::Auto };
    }
}
