//! The panels under a hand, without a window.

#![cfg(test)]
#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use egui::accesskit::Toggled;
use egui::{Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use glam::DVec3;

use super::{show, style};
use crate::film::AovKind;
use crate::gpu::{AdapterKind, AdapterReport, Promises};
use crate::layout::{Effect, EffectChoice, Settings};
use crate::viewer::inspection::{Inspection, line};
use crate::viewer::session::{Order, Session};
use crate::viewer::stage::Stage;
use crate::viewer::{Backend, Kind, Orbit, Turning, ViewKind};

fn adapter(name: &str, strict_float: bool, f64: bool) -> AdapterReport {
    AdapterReport {
        name: name.to_owned(),
        kind: AdapterKind::Software,
        driver: "driver".to_owned(),
        driver_info: "1.2".to_owned(),
        strict_float,
        promises: Promises::default(),
        f64,
        timestamps: false,
        subgroup: [8, 8],
        max_storage_binding: 0,
        max_buffer: 0,
        max_storage_buffers: 8,
    }
}

fn session() -> Session {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/prism.toml");
    let stage = Arc::new(Stage::load(&path).unwrap());
    let settings = Settings { samples: 4, ..Settings::default() };
    let adapters = vec![adapter("Card", true, true), adapter("Other", false, false)];
    Session::new(stage, settings, Backend::Gpu, 0, adapters[0].clone(), adapters)
}

/// Seconds between two frames: clicks that follow each other are double clicks.
const STEP: f32 = 0.02;
/// The window in points, panel and all.
const WINDOW: Vec2 = Vec2::new(960.0, 900.0);
/// What the harness leaves free around what it shows.
const MARGIN: Vec2 = Vec2::splat(8.0);

fn harness() -> Harness<'static, Session> {
    let show = |ui: &mut egui::Ui, session: &mut Session| {
        show(ui, session);
    };
    let mut harness = Harness::builder().with_step_dt(STEP).with_size(WINDOW).build_ui_state(show, session());
    style(&harness.ctx);
    harness.run_steps(4);
    harness
}

/// Drag over the picture.
fn drag(harness: &mut Harness<'_, Session>, button: PointerButton, by: Vec2) {
    let start = Pos2::new(300.0, 400.0);
    let press =
        |pos, pressed| egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
    for event in [
        egui::Event::PointerMoved(start),
        press(start, true),
        egui::Event::PointerMoved(start + by / 2.0),
        egui::Event::PointerMoved(start + by),
        press(start + by, false),
    ] {
        harness.event(event);
        harness.step();
    }
}

fn camera_of(orbit: &Orbit) -> (DVec3, DVec3) {
    (orbit.camera.eye, orbit.pivot())
}

#[test]
fn a_drag_with_the_left_button_turns_and_with_the_right_one_moves() {
    let mut harness = harness();
    let (eye, pivot) = camera_of(&harness.state().orbit);
    drag(&mut harness, PointerButton::Primary, Vec2::new(80.0, 30.0));
    let turned = camera_of(&harness.state().orbit);
    assert!((turned.0 - eye).length() > 0.1 && (turned.1 - pivot).length() < 1e-9);
    drag(&mut harness, PointerButton::Secondary, Vec2::new(80.0, 30.0));
    let moved = camera_of(&harness.state().orbit);
    assert!((moved.0 - turned.0 - (moved.1 - turned.1)).length() < 1e-9 && moved.1 != pivot);
    harness.key_press(Key::Home);
    harness.step();
    assert_eq!(camera_of(&harness.state().orbit).0, eye);
}

#[test]
fn the_wheel_comes_nearer() {
    let mut harness = harness();
    let before = harness.state().orbit.camera.target_distance;
    harness.event(egui::Event::PointerMoved(Pos2::new(300.0, 400.0)));
    harness.step();
    harness.event(egui::Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        source: egui::MouseWheelSource::Wheel,
        delta: Vec2::new(0.0, 1.0),
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    harness.step();
    let after = harness.state().orbit.camera.target_distance;
    assert!((after / before - 0.9).abs() < 1e-6, "{}", after / before);
}

#[test]
fn a_click_asks_what_the_pixel_is_made_of_and_a_double_click_for_a_pivot() {
    let mut harness = harness();
    let at = Pos2::new(100.5, 50.5) + MARGIN;
    harness.hover_at(at);
    for _ in 0..2 {
        harness.drag_at(at);
        harness.step();
        harness.drop_at(at);
        harness.step();
    }
    assert_eq!(harness.state().orders, [Order::Inspect([100, 50]), Order::SetPivot([100, 50])]);
}

#[test]
fn every_effect_that_the_scene_calls_for_has_a_switch_with_its_reason() {
    let mut harness = harness();
    assert_eq!(harness.state().traced_settings().effects, EffectChoice::Auto);
    let switch = harness.get_by_label("transmission");
    assert_eq!(switch.accesskit_node().toggled(), Some(Toggled::True));
    switch.click();
    harness.run_steps(3);
    let EffectChoice::Only(set) = harness.state().traced_settings().effects else { panic!("still all") };
    assert!(!set.has(Effect::Transmission));
    harness.get_by_label_contains("lacks what the scene calls for");
    harness.get_by_label("simulate all of them again").click();
    harness.run_steps(3);
    assert_eq!(harness.state().traced_settings().effects, EffectChoice::Auto);
}

#[test]
fn a_view_that_needs_first_hits_asks_for_them() {
    let mut harness = harness();
    assert!(!harness.state().traced_settings().aovs);
    harness.state_mut().look.first = ViewKind::Aov(AovKind::Normal);
    harness.run_steps(2);
    assert!(harness.state().traced_settings().aovs);
}

#[test]
fn all_is_reached_and_changed_by_keys_alone() {
    let mut harness = harness();
    let depth = harness.state().settings.depth;
    let mut reached = std::collections::BTreeSet::new();
    for _ in 0..80 {
        harness.key_press(Key::Tab);
        harness.step();
        for node in harness.query_all_by(|node| node.is_focused()) {
            let node = node.accesskit_node();
            reached.insert(format!("{:?} {:?}", node.role(), node.label()));
        }
    }
    for kind in ["ComboBox", "Slider", "CheckBox", "Button"] {
        assert!(reached.iter().any(|name| name.starts_with(kind)), "{kind}: {reached:?}");
    }
    assert_eq!(harness.state().settings.depth, depth, "Tab changes nothing");
}

#[test]
fn the_list_of_shortcuts_opens_and_closes_by_its_key() {
    let mut harness = harness();
    assert!(harness.query_by_label("turn about the pivot").is_none());
    harness.key_press(Key::H);
    harness.run_steps(4);
    assert!(harness.query_by_label("turn about the pivot").is_some());
    harness.key_press(Key::H);
    harness.run_steps(8);
    assert!(!harness.state().is_help_open);
}

#[test]
fn a_clicked_pixel_shows_its_rays_as_an_outline() {
    let mut harness = harness();
    let inspection = Inspection::of(harness.state(), [600, 400], [300, 200]);
    let lines: Vec<String> = inspection.tree.nodes.iter().map(line).collect();
    assert!(lines.len() > 1, "a prism refracts: {lines:?}");
    harness.state_mut().inspection = Some(inspection);
    harness.run_steps(4);
    harness.get_by_label_contains("pixel 300, 200");
    harness.get_by_label(&lines[0]);
}

#[test]
fn a_turntable_is_ordered_and_stopped() {
    let mut harness = harness();
    harness.get_by_label("Files").scroll_to_me();
    harness.run_steps(20);
    harness.get_by_label("Files").click();
    harness.run_steps(20);
    harness.get_by_label("write turntable").scroll_to_me();
    harness.run_steps(20);
    harness.get_by_label("write turntable").click();
    harness.run_steps(3);
    assert_eq!(harness.state().orders, [Order::Turntable(36)]);
    let stop = Arc::new(AtomicBool::new(false));
    harness.state_mut().turning = Some(Turning { done: 5, of: 36, stop: Arc::clone(&stop) });
    harness.run_steps(3);
    harness.get_by_label("stop").click();
    harness.run_steps(3);
    assert!(stop.load(Ordering::Relaxed) && harness.state().turning.is_none());
    harness.get_by_label("stopped: 5 of 36 pictures are written");
}

#[test]
fn a_device_is_picked() {
    let mut harness = harness();
    harness.get_by_label("Device").scroll_to_me();
    harness.run_steps(20);
    harness.get_by_label("Device").click();
    harness.run_steps(20);
    harness.get_by_label("Other").scroll_to_me();
    harness.run_steps(20);
    harness.get_by_label("Other").click();
    harness.run_steps(3);
    assert_eq!(harness.state().orders, [Order::UseAdapter("Other".to_owned())]);
    harness.get_by_label("CPU").click();
    harness.run_steps(3);
    assert_eq!(harness.state().backend, Backend::Cpu { threads: 0 });
}

#[test]
fn an_edited_light_is_in_the_next_request_without_a_new_hierarchy() {
    let mut session = session();
    let mut scene = session.stage.scene.clone();
    let before = session.stage.flat.scene.clone();
    for light in &mut scene.lights {
        light.intensity *= 2.0;
    }
    scene.materials.iter_mut().for_each(|material| material.ior += 0.25);
    session.revise(scene);
    let after = &session.wanted([8, 8]).stage.flat.scene;
    assert_eq!(after.nodes, before.nodes);
    assert!(
        after.materials[1..]
            .iter()
            .zip(&before.materials[1..])
            .all(|(a, b)| (a.ior - b.ior - 0.25).abs() < 1e-6)
    );
    assert!(after.lights.iter().zip(&before.lights).all(|(a, b)| a.intensity[0] == 2.0 * b.intensity[0]));
    let anew = Stage::of(&session.stage.path, session.stage.scene.clone()).unwrap().flat.scene;
    assert_eq!((&anew.materials, &anew.lights), (&after.materials, &after.lights));
    assert_eq!(anew.radiance_bound, after.radiance_bound);
}

#[test]
fn matter_that_becomes_opaque_makes_other_bodies() {
    let mut session = session();
    let mut scene = session.stage.scene.clone();
    scene.materials.iter_mut().for_each(|material| material.transmission = DVec3::ZERO);
    session.revise(scene);
    assert_eq!(session.stage.flat.scene.transmissive_bodies, 0);
}

#[test]
fn a_failure_is_said_in_words() {
    let mut harness = harness();
    let session = harness.state_mut();
    session.status.kind = Some(Kind::Complete);
    session.status.failure = Some("the device was lost: tired".to_owned());
    session.complain("prism.toml:3:7: no such key");
    harness.run_steps(3);
    harness.get_by_label("the device was lost: tired");
    harness.get_by_label("prism.toml:3:7: no such key");
}
