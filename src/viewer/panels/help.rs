//! The list of shortcuts.

use egui::{Align2, RichText, Ui, Window};

use super::super::session::Session;

/// What keys and mouse do, by topic.
const SHORTCUTS: &[(&str, &[(&str, &str)])] = &[
    (
        "Mouse",
        &[
            ("drag", "turn about the pivot"),
            ("Shift+drag, right or middle drag", "move sideways"),
            ("wheel", "nearer, farther"),
            ("Ctrl+wheel, pinch", "the same towards the pointer"),
            ("click", "what the pixel is made of: its ray tree"),
            ("double click", "turn about this point from now on"),
        ],
    ),
    (
        "Camera",
        &[
            ("arrows", "turn by 5°; with Shift: move sideways"),
            ("+ −", "nearer, farther"),
            ("W A S D, Q E", "fly; with Shift four times as fast"),
            ("1 3 7", "from the front, the right, above; with Ctrl: from the other side"),
            ("5", "nearly without perspective (1° from afar), and back"),
            ("F", "see the whole scene"),
            ("Home, R", "back to the scene's own camera"),
            ("C", "copy the [camera] table"),
            ("Ctrl+S", "write the scene with this camera to a new file"),
        ],
    ),
    (
        "Window",
        &[
            ("F12", "write the picture to a new file"),
            ("P", "the panel, on and off"),
            ("H, ?", "this list"),
            ("Escape", "put away this list and all messages"),
            ("Tab, Space", "go through the controls, and press them"),
            ("Ctrl+Q", "quit"),
        ],
    ),
];

/// Show the list, if it is open.
pub(super) fn show(ui: &Ui, session: &mut Session) {
    let mut is_open = session.is_help_open;
    Window::new("Shortcuts")
        .open(&mut is_open)
        .anchor(Align2::CENTER_CENTER, egui::Vec2::ZERO)
        .resizable(false)
        .collapsible(false)
        .vscroll(true)
        .show(ui.ctx(), |ui| {
            for (topic, entries) in SHORTCUTS {
                ui.label(RichText::new(*topic).strong());
                egui::Grid::new(*topic).num_columns(2).spacing([18.0, 4.0]).show(ui, |ui| {
                    for (keys, action) in *entries {
                        ui.monospace(*keys);
                        ui.label(*action);
                        ui.end_row();
                    }
                });
                ui.add_space(6.0);
            }
        });
    session.is_help_open = is_open;
}
