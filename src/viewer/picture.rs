//! The picture's part of the window: mouse, wheel and keys move the camera.

use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Rect, Response, Sense, Ui};
use glam::{DVec2, DVec3};

use super::inspection;
use super::orbit::Side;
use super::session::{Order, Session};

/// What a line of the wheel multiplies the distance by.
const WHEEL_LINE: f64 = 0.9;
/// Points of a touch pad that count as a line.
const POINTS_OF_LINE: f64 = 40.0;
/// Way of a flight in radii of the scene a second.
const FLIGHT: f64 = 0.5;
/// Times that with Shift.
const FAST: f64 = 4.0;
/// What an arrow key turns by, in parts of a drag over the picture's height: 5 degrees.
const ARROW: f64 = 5.0 / 180.0;
/// How near the wipe bar a drag must begin to move it, in points.
const BAR: f32 = 10.0;
/// Longest time between two frames that a flight counts, in seconds.
const LONGEST_STEP: f64 = 0.1;

/// Show the picture's part of the window, and let it move the camera.
pub(super) fn show(ui: &mut Ui, session: &mut Session) -> Rect {
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    drag(ui, &response, session);
    wheel(ui, &response, session);
    if let Some(at) = response.interact_pointer_pos() {
        let pixel = pixel(ui, rect, at);
        if response.double_clicked() {
            session.orders.push(Order::SetPivot(pixel));
        } else if response.clicked() {
            session.orders.push(Order::Inspect(pixel));
        }
    }
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    // Arrows are the picture's own while it has them.
    let filter = egui::EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    if ui.memory(egui::Memory::focused).is_none_or(|id| id == response.id) {
        keys(ui, session);
        fly(ui, session);
    }
    inspection::draw(ui, session, rect);
    if session.look.second.is_some() {
        let bar = rect.min.x + (session.look.wipe * rect.width()).round();
        ui.painter().vline(bar, rect.y_range(), egui::Stroke::new(2.0, egui::Color32::WHITE));
    }
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "picture"));
    rect
}

/// The picture's pixel under a point.
fn pixel(ui: &Ui, rect: Rect, at: egui::Pos2) -> [u32; 2] {
    let scale = ui.ctx().pixels_per_point();
    let most = [rect.width() * scale - 1.0, rect.height() * scale - 1.0];
    let offset = (at - rect.min) * scale;
    [offset.x.clamp(0.0, most[0].max(0.0)) as u32, offset.y.clamp(0.0, most[1].max(0.0)) as u32]
}

fn drag(ui: &Ui, response: &Response, session: &mut Session) {
    let rect = response.rect;
    let wipes = is_wiping(ui, response, session);
    let height = f64::from(rect.height().max(1.0));
    let delta = response.drag_delta();
    let way = DVec2::new(f64::from(delta.x), f64::from(delta.y)) / height;
    if way == DVec2::ZERO {
        return;
    }
    if wipes {
        session.look.wipe = (session.look.wipe + delta.x / rect.width().max(1.0)).clamp(0.02, 0.98);
    } else if response.dragged_by(PointerButton::Primary) && !ui.input(|input| input.modifiers.shift) {
        session.orbit.orbit(way);
    } else {
        session.orbit.pan(way);
    }
}

/// Whether the drag under way began at the wipe bar.
fn is_wiping(ui: &Ui, response: &Response, session: &Session) -> bool {
    if session.look.second.is_none() {
        return false;
    }
    let bar = response.rect.min.x + session.look.wipe * response.rect.width();
    let is_at_bar = |at: egui::Pos2| (at.x - bar).abs() < BAR;
    if response.hover_pos().is_some_and(is_at_bar) {
        ui.ctx().set_cursor_icon(egui::CursorIcon::ResizeHorizontal);
    }
    let id = response.id.with("wipes");
    if response.drag_started() {
        let began = ui.input(|input| input.pointer.press_origin()).is_some_and(is_at_bar);
        ui.data_mut(|data| data.insert_temp(id, began));
    }
    response.dragged() && ui.data(|data| data.get_temp(id)).unwrap_or(false)
}

fn wheel(ui: &Ui, response: &Response, session: &mut Session) {
    if !response.contains_pointer() {
        return;
    }
    let rect = response.rect;
    let place = ui.input(|input| input.pointer.hover_pos()).map_or(DVec2::ZERO, |at| {
        let offset = at - rect.center();
        DVec2::new(f64::from(offset.x), -f64::from(offset.y)) / f64::from(rect.height().max(1.0))
    });
    let (events, pinch) = ui.input(|input| (input.events.clone(), input.multi_touch()));
    for event in events {
        match event {
            Event::MouseWheel { unit, delta, modifiers, .. } => {
                let lines = f64::from(delta.y)
                    * match unit {
                        MouseWheelUnit::Point => 1.0 / POINTS_OF_LINE,
                        MouseWheelUnit::Line => 1.0,
                        MouseWheelUnit::Page => 10.0,
                    };
                let factor = WHEEL_LINE.powf(lines);
                if modifiers.ctrl {
                    session.orbit.dolly_to(factor, place);
                } else {
                    session.orbit.dolly(factor);
                }
            }
            Event::Zoom(factor) if factor > 0.0 => session.orbit.dolly_to(1.0 / f64::from(factor), place),
            _ => {}
        }
    }
    if let Some(touch) = pinch.filter(|touch| touch.zoom_delta > 0.0) {
        session.orbit.dolly_to(1.0 / f64::from(touch.zoom_delta), place);
    }
}

/// Keys that act once.
fn keys(ui: &Ui, session: &mut Session) {
    let pressed = |modifiers: Modifiers, key| ui.input_mut(|input| input.consume_key(modifiers, key));
    let plain = |key| pressed(Modifiers::NONE, key);
    let sides = [
        (Key::Num1, Side::Front, Side::Back),
        (Key::Num3, Side::Right, Side::Left),
        (Key::Num7, Side::Top, Side::Bottom),
    ];
    for (key, side, opposite) in sides {
        if pressed(Modifiers::CTRL, key) {
            session.orbit.look_from(opposite);
        } else if plain(key) {
            session.orbit.look_from(side);
        }
    }
    if plain(Key::Num5) {
        session.orbit.toggle_telephoto();
    }
    if plain(Key::F) {
        session.orbit.frame();
    }
    if plain(Key::Home) || plain(Key::R) {
        session.orbit.reset();
    }
    let arrows = [
        (Key::ArrowLeft, DVec2::new(ARROW, 0.0)),
        (Key::ArrowRight, DVec2::new(-ARROW, 0.0)),
        (Key::ArrowUp, DVec2::new(0.0, ARROW)),
        (Key::ArrowDown, DVec2::new(0.0, -ARROW)),
    ];
    for (key, way) in arrows {
        if pressed(Modifiers::SHIFT, key) {
            session.orbit.pan(way);
        } else if plain(key) {
            session.orbit.orbit(way);
        }
    }
    if plain(Key::Plus) || plain(Key::Equals) {
        session.orbit.dolly(WHEEL_LINE);
    }
    if plain(Key::Minus) {
        session.orbit.dolly(1.0 / WHEEL_LINE);
    }
    if plain(Key::H) || plain(Key::Questionmark) || pressed(Modifiers::SHIFT, Key::Slash) {
        session.is_help_open = !session.is_help_open;
    }
    if plain(Key::Escape) {
        session.is_help_open = false;
        session.toasts.clear();
    }
    if plain(Key::P) {
        session.is_panel_open = !session.is_panel_open;
    }
    if pressed(Modifiers::COMMAND, Key::S) {
        session.orders.push(Order::SaveScene);
    }
    // With its modifier it is copied already, as an event of its own.
    if plain(Key::C) {
        session.orders.push(Order::Copy(session.orbit.table()));
        session.say("the [camera] table is on the clipboard");
    }
    if plain(Key::F12) {
        session.orders.push(Order::Screenshot);
    }
    if pressed(Modifiers::COMMAND, Key::Q) {
        session.orders.push(Order::Quit);
    }
}

/// Keys that act as long as they are down.
fn fly(ui: &Ui, session: &mut Session) {
    let (down, modifiers, step) =
        ui.input(|input| (input.keys_down.clone(), input.modifiers, f64::from(input.stable_dt)));
    if modifiers.ctrl || modifiers.alt || modifiers.command {
        return;
    }
    let axis = |more, less| {
        let way = |key| if down.contains(&key) { 1.0 } else { 0.0 };
        way(more) - way(less)
    };
    let way = DVec3::new(axis(Key::D, Key::A), axis(Key::E, Key::Q), axis(Key::W, Key::S));
    if way == DVec3::ZERO {
        return;
    }
    let speed = if modifiers.shift { FLIGHT * FAST } else { FLIGHT };
    session.orbit.fly(way * speed * step.min(LONGEST_STEP));
    ui.ctx().request_repaint();
}
