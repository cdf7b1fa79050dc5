//! How much is traced, and how exactly.

use egui::{ComboBox, DragValue, Slider, Ui};

use super::super::Backend;
use super::super::cost::Cost;
use super::super::session::Session;
use super::super::tracer::Resolution;
use super::grid;
use crate::layout::constants::{BASE_SAMPLES, MAX_DEPTH};
use crate::layout::{Float, Intersector, Precision};

/// Samples that the panel offers at the most; the command line has more.
const MOST_SAMPLES: u32 = 4096;

/// Show the settings.
pub(super) fn show(ui: &mut Ui, session: &mut Session) {
    let has_f64 = matches!(session.backend, Backend::Cpu { .. }) || session.adapter.f64;
    let is_strict_offered = session.backend == Backend::Gpu && session.adapter.strict_float;
    let Session { settings, resolution, .. } = session;
    grid(ui, "quality", |ui| {
        ui.label("depth");
        ui.add(Slider::new(&mut settings.depth, 0..=MAX_DEPTH))
            .on_hover_text("Deepest ray that is traced; the ray from the eye has depth 0 (--depth)");
        ui.end_row();
        ui.label("cut-off");
        let cutoff = Slider::new(&mut settings.cutoff, 0.0..=1.0).logarithmic(true).smallest_positive(1e-7);
        ui.add(cutoff.custom_formatter(|value, _| cutoff_text(value)))
            .on_hover_text("Least weight of a ray that is traced, as a part of the pixel (--cutoff)");
        ui.end_row();
        ui.label("samples");
        ui.add(DragValue::new(&mut settings.samples).range(1..=MOST_SAMPLES).speed(0.1))
            .on_hover_text("Rays from the eye for each pixel, at rest (--samples)");
        ui.end_row();
        adaptive(ui, &mut settings.adaptive, settings.samples);
        ui.end_row();
        ui.label("triangles");
        let tests = [
            (Intersector::Watertight, "watertight", "No ray passes between two triangles (Woop et al. 2013)"),
            (Intersector::MollerTrumbore, "Möller–Trumbore", "The textbook's; leaks at edges"),
        ];
        choose(ui, "intersector", &mut settings.intersector, &tests);
        ui.end_row();
        if has_f64 {
            ui.label("precision");
            let precisions = [
                (Precision::F32, "f32", "32 bits: fast, the same bits on every strict device"),
                (Precision::F64, "f64", "64 bits: slower, to judge the other by"),
            ];
            choose(ui, "precision", &mut settings.precision, &precisions);
            ui.end_row();
        }
        if is_strict_offered {
            ui.label("arithmetic");
            let modes = [
                (Float::Strict, "strict", "Every operation as written: the CPU's bits"),
                (Float::Fast, "fast", "The driver may contract and reorder"),
            ];
            choose(ui, "float", &mut settings.float, &modes);
            ui.end_row();
        }
        ui.label("pixels");
        let resolutions = [
            (
                Resolution::Auto,
                "as time allows",
                "Fewer while something moves, so that a frame takes 30 ms; all at rest",
            ),
            (Resolution::Every(1), "every pixel", "Also while something moves"),
            (Resolution::Every(2), "one of 2×2", "Moving or at rest"),
            (Resolution::Every(4), "one of 4×4", "Moving or at rest"),
        ];
        choose(ui, "resolution", resolution, &resolutions);
        ui.end_row();
    });
    if let Some(Cost { change, ms: [before, after], moved }) = &session.cost {
        ui.separator();
        ui.label(egui::RichText::new(change).strong());
        let difference = after - before;
        ui.label(format!("{before:.1} ms → {after:.1} ms ({difference:+.1} ms)"))
            .on_hover_text("Tracing the picture at rest before and after the last change, measured");
        ui.label(format!("moves the picture by {moved:.2e}")).on_hover_text(
            "Root mean square over pixels and channels, in linear radiance clamped to [0, 1], between the two pictures",
        );
    }
    if !has_f64 {
        session.settings.precision = Precision::F32;
    }
}

fn adaptive(ui: &mut Ui, adaptive: &mut Option<f32>, samples: u32) {
    let mut is_on = adaptive.is_some();
    ui.add_enabled_ui(samples > BASE_SAMPLES, |ui| {
        ui.checkbox(&mut is_on, "adaptive").on_hover_text(
            "Give a pixel more samples only while one more is expected to move it by more than this part of the \
             display's range (--adaptive)",
        );
    })
    .response
    .on_disabled_hover_text(format!("Every pixel has {BASE_SAMPLES} samples at the least: nothing to choose"));
    if is_on != adaptive.is_some() {
        *adaptive = is_on.then_some(0.01);
    }
    if let Some(threshold) = adaptive {
        ui.add(Slider::new(threshold, 0.0..=0.2).logarithmic(true).smallest_positive(1e-3));
    }
}

fn choose<T: PartialEq + Copy>(ui: &mut Ui, name: &str, value: &mut T, choices: &[(T, &str, &str)]) {
    let chosen = choices.iter().find(|choice| choice.0 == *value);
    ComboBox::from_id_salt(name)
        .selected_text(chosen.map_or("", |choice| choice.1))
        .show_ui(ui, |ui| {
            for (choice, label, hint) in choices {
                ui.selectable_value(value, *choice, *label).on_hover_text(*hint);
            }
        })
        .response
        .on_hover_text(chosen.map_or("", |choice| choice.2));
}

/// A cut-off as it is written in scene files.
fn cutoff_text(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}
