//! The panel beside the picture, and what lies over it.

mod device;
mod effects;
mod files;
mod help;
mod pixel;
mod quality;
mod scene;
mod statistics;
mod tests;
mod toasts;
mod views;

use egui::{CollapsingHeader, Color32, Panel, Rect, RichText, ScrollArea, TextStyle, Ui};

use super::picture;
use super::session::Session;

/// Width of the panel in points.
pub(super) const PANEL: f32 = 320.0;

/// egui's fonts, and for what the proportional ones lack (arrows) that of even width.
pub(super) fn fonts() -> egui::FontDefinitions {
    let mut fonts = egui::FontDefinitions::default();
    let even = fonts.families.get(&egui::FontFamily::Monospace).cloned().unwrap_or_default();
    let proportional = fonts.families.entry(egui::FontFamily::Proportional).or_default();
    let lacking: Vec<_> = even.into_iter().filter(|name| !proportional.contains(name)).collect();
    proportional.extend(lacking);
    fonts
}

/// Fonts and spacing of both themes, and what counts as a click.
pub(super) fn style(context: &egui::Context) {
    context.set_fonts(fonts());
    // Nothing here is done by a long press, and on a slow device a short one lasts over several frames.
    context.options_mut(|options| options.input_options.max_click_duration = f64::INFINITY);
    context.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(8.0, 6.0);
        style.spacing.slider_width = 130.0;
        style.spacing.combo_width = 130.0;
        style.interaction.tooltip_delay = 0.4;
        style.text_styles.insert(TextStyle::Heading, egui::FontId::proportional(17.0));
    });
}

/// Show everything; returns where the picture is to be.
pub(super) fn show(ui: &mut Ui, session: &mut Session) -> Rect {
    if session.is_panel_open {
        Panel::right("panel").exact_size(PANEL).resizable(false).show(ui, |ui| panel(ui, session));
    }
    let rect = picture::show(ui, session);
    views::legend(ui, session, rect);
    toasts::show(ui, session, rect);
    help::show(ui, session);
    rect
}

fn panel(ui: &mut Ui, session: &mut Session) {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let name = session.stage.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        ui.heading(name).on_hover_text(session.stage.path.display().to_string());
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if ui.button("?").on_hover_text("Shortcuts (H)").clicked() {
                session.is_help_open = !session.is_help_open;
            }
            theme(ui);
        });
    });
    statistics::status(ui, session);
    ui.separator();
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        section(ui, "View", true, |ui| views::show(ui, session));
        section(ui, "Quality", true, |ui| quality::show(ui, session));
        section(ui, "Effects", true, |ui| effects::show(ui, session));
        section(ui, "Pixel", true, |ui| pixel::show(ui, session));
        section(ui, "Files", false, |ui| files::show(ui, session));
        section(ui, "Lights", false, |ui| scene::lights(ui, session));
        section(ui, "Materials", false, |ui| scene::materials(ui, session));
        section(ui, "Device", false, |ui| device::show(ui, session));
        section(ui, "Statistics", false, |ui| statistics::show(ui, session));
    });
}

/// Dark, light, or as the desktop has it.
fn theme(ui: &mut Ui) {
    let mut wanted = ui.options(|options| options.theme_preference);
    let shown =
        egui::ComboBox::from_id_salt("theme").width(70.0).selected_text(name_of(wanted)).show_ui(ui, |ui| {
            for one in
                [egui::ThemePreference::System, egui::ThemePreference::Dark, egui::ThemePreference::Light]
            {
                ui.selectable_value(&mut wanted, one, name_of(one));
            }
        });
    shown.response.accessible_name("theme");
    ui.ctx().set_theme(wanted);
}

fn name_of(theme: egui::ThemePreference) -> &'static str {
    match theme {
        egui::ThemePreference::System => "system",
        egui::ThemePreference::Dark => "dark",
        egui::ThemePreference::Light => "light",
    }
}

fn section(ui: &mut Ui, title: &str, is_open: bool, contents: impl FnOnce(&mut Ui)) {
    CollapsingHeader::new(RichText::new(title).strong()).default_open(is_open).show_unindented(ui, |ui| {
        ui.add_space(2.0);
        contents(ui);
        ui.add_space(6.0);
    });
}

/// Two columns of labels and controls.
fn grid(ui: &mut Ui, name: &str, rows: impl FnOnce(&mut Ui)) {
    egui::Grid::new(name).num_columns(2).min_col_width(92.0).spacing([10.0, 6.0]).show(ui, rows);
}

/// The colour of what went wrong, readable in both themes.
fn warning(ui: &Ui) -> Color32 {
    ui.visuals().error_fg_color
}

/// A number in short: three digits and a unit's prefix.
fn short(value: f64) -> String {
    match value.abs() {
        v if v >= 1e9 => format!("{:.2} G", value / 1e9),
        v if v >= 1e6 => format!("{:.2} M", value / 1e6),
        v if v >= 1e3 => format!("{:.1} k", value / 1e3),
        _ => format!("{value:.0}"),
    }
}
