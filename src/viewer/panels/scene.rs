//! Lights and materials, which change while one looks.

use egui::{CollapsingHeader, DragValue, Ui};
use glam::DVec3;

use super::super::session::Session;
use super::grid;
use crate::scene::{Falloff, Light, Material};

/// Edit the lights.
pub(super) fn lights(ui: &mut Ui, session: &mut Session) {
    let mut scene = session.stage.scene.clone();
    if scene.lights.is_empty() {
        ui.weak("The scene has no point lights.");
    }
    let step = session.orbit.radius() / 200.0;
    let mut is_changed = false;
    for (index, light) in scene.lights.iter_mut().enumerate() {
        CollapsingHeader::new(format!("light {}", index + 1))
            .id_salt(("light", index))
            .default_open(index == 0)
            .show(ui, |ui| is_changed |= edit_light(ui, index, light, step));
    }
    if is_changed {
        session.revise(scene);
    }
}

fn edit_light(ui: &mut Ui, index: usize, light: &mut Light, step: f64) -> bool {
    let before = light.clone();
    grid(ui, &format!("light {index}"), |ui| {
        ui.label("position").on_hover_text("World coordinates in scene units");
        vector(ui, &mut light.position, step, f64::MIN..=f64::MAX);
        ui.end_row();
        ui.label("intensity").on_hover_text("Linear red, green, blue");
        vector(ui, &mut light.intensity, 0.01, 0.0..=1e6);
        ui.end_row();
        ui.label("falloff");
        let mut fades = light.falloff == Falloff::InverseSquare;
        ui.checkbox(&mut fades, "by the squared distance");
        light.falloff = if fades { Falloff::InverseSquare } else { Falloff::None };
        ui.end_row();
    });
    *light != before
}

/// Edit the materials that some model wears.
pub(super) fn materials(ui: &mut Ui, session: &mut Session) {
    let mut scene = session.stage.scene.clone();
    let worn = session.stage.flat.scene.material_names.clone();
    let mut is_changed = false;
    for (index, material) in scene.materials.iter_mut().enumerate() {
        if !worn.contains(&material.name) {
            continue;
        }
        CollapsingHeader::new(&material.name)
            .id_salt(("material", index))
            .show(ui, |ui| is_changed |= edit_material(ui, index, material));
    }
    if is_changed {
        session.revise(scene);
    }
}

fn edit_material(ui: &mut Ui, index: usize, material: &mut Material) -> bool {
    let before = material.clone();
    grid(ui, &format!("material {index}"), |ui| {
        let colors = [
            ("ambient", "ka × colour, linear", &mut material.ambient),
            ("diffuse", "kd × colour, linear", &mut material.diffuse),
            ("specular", "ks × colour, linear", &mut material.specular),
            ("reflection", "kr × colour, linear", &mut material.reflection),
            (
                "transmission",
                "kt × colour, linear; any channel above 0 makes the body transmissive",
                &mut material.transmission,
            ),
            ("absorption", "σ for each scene unit and channel", &mut material.absorption),
        ];
        for (name, hint, color) in colors {
            ui.label(name).on_hover_text(hint);
            vector(ui, color, 0.005, 0.0..=1e6);
            ui.end_row();
        }
        ui.label("shininess").on_hover_text("β: the exponent of the highlight");
        ui.add(DragValue::new(&mut material.shininess).range(0.0..=1e5).speed(1.0));
        ui.end_row();
        ui.label("index").on_hover_text("Refractive index against the vacuum");
        ui.add(DragValue::new(&mut material.ior).range(0.01..=10.0).speed(0.002).max_decimals(4));
        ui.end_row();
        ui.label("weights");
        ui.checkbox(&mut material.fresnel, "by Fresnel's equations");
        ui.end_row();
    });
    *material != before
}

fn vector(ui: &mut Ui, vector: &mut DVec3, speed: f64, range: std::ops::RangeInclusive<f64>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.spacing_mut().interact_size.x = 52.0;
        for component in [&mut vector.x, &mut vector.y, &mut vector.z] {
            ui.add(DragValue::new(component).speed(speed).range(range.clone()).max_decimals(4));
        }
    });
}
