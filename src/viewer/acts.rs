//! A script's events as small acts, one after the other's effect: what a hand does, and what it waits for.

use std::path::PathBuf;
use std::time::Duration;

use egui::{Event as Input, Modifiers, MouseWheelUnit, PointerButton, Pos2, Vec2};

use super::look::ViewKind;
use super::script::{Event, Expectation};

/// A small thing to do or to wait for.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Act {
    /// Hand these to egui, and wait for the frame.
    Inputs(Vec<Input>),
    /// Until every request has its picture.
    AwaitPicture,
    /// Until the picture is complete.
    AwaitRest,
    /// Until then.
    Sleep(Duration),
    /// Make the picture so large.
    Resize([u32; 2]),
    /// Minimise the window, or restore it.
    Minimise(bool),
    /// Drop a file.
    Drop(PathBuf),
    /// Copy a file over another.
    Copy(PathBuf, PathBuf),
    /// Show this, and that beside it.
    View(ViewKind, Option<ViewKind>),
    /// Trace on the CPU, or not.
    Backend(bool),
    /// Dark or light.
    Theme(egui::Theme),
    /// Lose the device.
    Lose,
    /// Write the window to a file.
    Screenshot(PathBuf),
    /// Write so many pictures from round the pivot.
    Turntable(u32),
    /// What is to be.
    Expect(Expectation),
    /// Note the processor's time.
    StartIdle,
    /// Compare with it: percent of one core.
    EndIdle(f64),
    /// Close the window.
    Quit,
}

/// Where the picture lies in the window, in points, and how many pixels a point has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) area: [u32; 4],
    pub(super) scale: f32,
}

impl Place {
    fn at(self, [x, y]: [f32; 2]) -> Pos2 {
        let [left, top, ..] = self.area.map(|side| side as f32);
        // The middle of the pixel.
        Pos2::new((left + x + 0.5) / self.scale, (top + y + 0.5) / self.scale)
    }

    fn middle(self) -> [f32; 2] {
        let [_, _, width, height] = self.area.map(|side| side as f32);
        [(width / 2.0).floor(), (height / 2.0).floor()]
    }
}

/// What a hand does for an event.
pub(super) fn acts(event: Event, place: Place) -> Vec<Act> {
    match event {
        Event::Drag { by, steps, pans } => {
            drag(place, by, steps, if pans { PointerButton::Secondary } else { PointerButton::Primary })
        }
        Event::Wheel { lines, steps } => {
            let middle = Input::PointerMoved(place.at(place.middle()));
            let turn = Act::Inputs(vec![Input::MouseWheel {
                unit: MouseWheelUnit::Line,
                source: egui::MouseWheelSource::Wheel,
                delta: Vec2::new(0.0, lines / steps as f32),
                phase: egui::TouchPhase::Move,
                modifiers: Modifiers::NONE,
            }]);
            let turns = (0..steps).flat_map(|_| [turn.clone(), Act::AwaitPicture]);
            std::iter::once(Act::Inputs(vec![middle])).chain(turns).collect()
        }
        Event::Click { at, times } => {
            let at = place.at(at);
            let press = |pressed| Act::Inputs(vec![button(at, PointerButton::Primary, pressed)]);
            let clicks = (0..times).flat_map(|_| [press(true), press(false)]);
            std::iter::once(Act::Inputs(vec![Input::PointerMoved(at)])).chain(clicks).collect()
        }
        Event::Key(modifiers, key) => {
            let press = |pressed| Input::Key { key, physical_key: None, pressed, repeat: false, modifiers };
            vec![
                Act::Inputs(vec![Input::ModifiersChanged(modifiers), press(true)]),
                Act::Inputs(vec![press(false), Input::ModifiersChanged(Modifiers::NONE)]),
                Act::AwaitPicture,
            ]
        }
        Event::Resize(size) => vec![Act::Resize(size), Act::AwaitPicture],
        Event::Minimise(is_down) => vec![Act::Minimise(is_down)],
        Event::Drop(path) => vec![Act::Drop(path)],
        Event::Copy(from, to) => vec![Act::Copy(from, to)],
        Event::View(first, second) => vec![Act::View(first, second), Act::AwaitPicture],
        Event::Backend { is_cpu } => vec![Act::Backend(is_cpu), Act::AwaitPicture],
        Event::Theme(theme) => vec![Act::Theme(theme)],
        Event::Lose => vec![Act::Lose],
        Event::Screenshot(path) => vec![Act::Screenshot(path)],
        Event::Rest => vec![Act::AwaitPicture, Act::AwaitRest],
        Event::Turntable(pictures) => vec![Act::Turntable(pictures)],
        Event::Sleep(milliseconds) => vec![Act::Sleep(Duration::from_millis(milliseconds))],
        Event::Expect(Expectation::Idle { percent, milliseconds }) => vec![
            Act::AwaitRest,
            // What was begun may end.
            Act::Sleep(Duration::from_millis(1500)),
            Act::StartIdle,
            Act::Sleep(Duration::from_millis(milliseconds)),
            Act::EndIdle(percent),
        ],
        Event::Expect(expectation) => vec![Act::Expect(expectation)],
        Event::Quit => vec![Act::Quit],
    }
}

fn drag(place: Place, [x, y]: [f32; 2], steps: u32, with: PointerButton) -> Vec<Act> {
    let [left, top] = place.middle();
    let start = place.at([left, top]);
    let mut acts =
        vec![Act::Inputs(vec![Input::PointerMoved(start)]), Act::Inputs(vec![button(start, with, true)])];
    for step in 1..=steps {
        let part = step as f32 / steps as f32;
        let at = place.at([left + x * part, top + y * part]);
        acts.extend([Act::Inputs(vec![Input::PointerMoved(at)]), Act::AwaitPicture]);
    }
    let end = place.at([left + x, top + y]);
    acts.push(Act::Inputs(vec![button(end, with, false)]));
    acts
}

fn button(pos: Pos2, button: PointerButton, pressed: bool) -> Input {
    Input::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACE: Place = Place { area: [0, 0, 200, 100], scale: 2.0 };

    #[test]
    fn a_drag_begins_in_the_middle_and_waits_for_each_picture() {
        let acts = acts(Event::Drag { by: [40.0, -20.0], steps: 2, pans: false }, PLACE);
        let moved = |x, y| Act::Inputs(vec![Input::PointerMoved(PLACE.at([x, y]))]);
        assert_eq!(acts[0], moved(100.0, 50.0));
        assert_eq!(
            acts[2..],
            [
                moved(120.0, 40.0),
                Act::AwaitPicture,
                moved(140.0, 30.0),
                Act::AwaitPicture,
                Act::Inputs(vec![button(PLACE.at([140.0, 30.0]), PointerButton::Primary, false)]),
            ]
        );
        assert_eq!(PLACE.at([0.0, 0.0]), Pos2::new(0.25, 0.25));
    }
}
