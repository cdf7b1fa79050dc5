//! Plays a script: turns its events into those of a hand, one after the other's effect.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use egui::{Event as Input, Modifiers, MouseWheelUnit, PointerButton, Pos2, Vec2};
use serde::Serialize;

use super::look::ViewKind;
use super::script::{Event, Expectation};

/// How long an event's effect may take.
const PATIENCE: Duration = Duration::from_secs(180);
/// How long a message may take.
const TOAST_PATIENCE: Duration = Duration::from_secs(10);

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
    /// What is to be.
    Expect(Expectation),
    /// Note the processor's time.
    StartIdle,
    /// Compare with it: percent of one core.
    EndIdle(f64),
    /// Close the window.
    Quit,
}

/// What a script's session took, in milliseconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Timings {
    /// Frames of the window while a drag or the wheel moved the camera.
    pub frames: usize,
    /// The longest of them: as long the window answered nobody.
    pub slowest_frame_ms: f64,
    /// Pictures that came while a drag or the wheel moved the camera.
    pub answers: usize,
    /// From an input to the first changed pixels, the median.
    pub median_answer_ms: f64,
    /// The same, the longest.
    pub slowest_answer_ms: f64,
    /// Processor time while nothing was to be done, in percent of one core, where it was asked for.
    pub idle_percent: Option<f64>,
}

/// A script in play.
pub(super) struct Player {
    path: PathBuf,
    events: VecDeque<(usize, Event)>,
    acts: VecDeque<Act>,
    /// Line of the event in play.
    line: usize,
    /// Since when the act in play is waited for.
    since: Option<Instant>,
    /// Processor time and time of day when idling began.
    idle: Option<(Duration, Instant)>,
    frames: Vec<Duration>,
    answers: Vec<Duration>,
    /// Whether the event in play moves the camera again and again.
    is_moving: bool,
    idle_percent: Option<f64>,
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

impl Player {
    pub(super) fn new(path: PathBuf, events: Vec<(usize, Event)>) -> Self {
        // Nothing can be dragged before there is a window with a picture.
        let acts = VecDeque::from([Act::AwaitPicture]);
        Self {
            path,
            events: events.into(),
            acts,
            line: 0,
            since: None,
            idle: None,
            frames: Vec::new(),
            answers: Vec::new(),
            is_moving: false,
            idle_percent: None,
        }
    }

    /// The act in play; none at the end of the script.
    pub(super) fn act(&mut self, place: Place) -> Option<Act> {
        while self.acts.is_empty() {
            let (line, event) = self.events.pop_front()?;
            self.line = line;
            self.is_moving = matches!(event, Event::Drag { .. } | Event::Wheel { .. });
            self.acts = acts(event, place).into();
        }
        self.since.get_or_insert_with(Instant::now);
        self.acts.front().cloned()
    }

    /// How long the act in play has been waited for.
    pub(super) fn waited(&self) -> Duration {
        self.since.map_or(Duration::ZERO, |since| since.elapsed())
    }

    /// The act in play has had its effect.
    pub(super) fn next(&mut self) {
        self.acts.pop_front();
        self.since = None;
    }

    /// Why the act in play is waited for in vain, if it is.
    pub(super) fn overdue(&self) -> Option<String> {
        let act = self.acts.front()?;
        let (patience, what) = match act {
            Act::Inputs(_) => (PATIENCE, "no frame came".to_owned()),
            Act::AwaitPicture => (PATIENCE, "no picture came".to_owned()),
            Act::AwaitRest => (PATIENCE, "the picture is not complete".to_owned()),
            Act::Expect(Expectation::Toast(text)) => (TOAST_PATIENCE, format!("no message holds `{text}`")),
            _ => return None,
        };
        (self.waited() > patience).then_some(what)
    }

    /// An error at the line in play.
    pub(super) fn fault(&self, message: String) -> (PathBuf, usize, String) {
        (self.path.clone(), self.line, message)
    }

    /// Begin to idle.
    pub(super) fn start_idle(&mut self) {
        self.idle = processor_time().map(|time| (time, Instant::now()));
    }

    /// Processor time since, in percent of one core; none where it cannot be told.
    pub(super) fn end_idle(&mut self) -> Option<f64> {
        let (before, since) = self.idle.take()?;
        let used = processor_time()?.saturating_sub(before);
        self.idle_percent = Some(100.0 * used.as_secs_f64() / since.elapsed().as_secs_f64());
        self.idle_percent
    }

    /// Note what a frame of the window took, if it was one of a movement.
    pub(super) fn frame(&mut self, time: Duration) {
        if self.is_moving {
            self.frames.push(time);
        }
    }

    /// Note what the answer to an input took, if that was one of a movement.
    pub(super) fn answer(&mut self, time: Duration) {
        if self.is_moving {
            self.answers.push(time);
        }
    }

    /// What all took.
    pub(super) fn timings(&self) -> Timings {
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let mut sorted = self.answers.clone();
        sorted.sort_unstable();
        let greatest = |times: &[Duration]| times.iter().copied().max().map_or(0.0, ms);
        Timings {
            frames: self.frames.len(),
            slowest_frame_ms: greatest(&self.frames),
            answers: sorted.len(),
            median_answer_ms: sorted.get(sorted.len() / 2).copied().map_or(0.0, ms),
            slowest_answer_ms: greatest(&sorted),
            idle_percent: self.idle_percent,
        }
    }
}

/// What a hand does for an event.
fn acts(event: Event, place: Place) -> Vec<Act> {
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

/// Processor time of this process, where Linux tells it (proc(5): fields 14 and 15 of /proc/self/stat, in ticks of which
/// a second has 100).
fn processor_time() -> Option<Duration> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name in parentheses may hold anything.
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field)?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (ticks(11)? + ticks(12)?)))
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

    #[test]
    fn the_median_is_of_the_answers() {
        let mut player = Player::new("a".into(), Vec::new());
        player.answer(Duration::from_secs(9));
        player.is_moving = true;
        [30, 10, 500].into_iter().for_each(|ms| player.answer(Duration::from_millis(ms)));
        player.frame(Duration::from_millis(7));
        let timings = player.timings();
        assert_eq!((timings.median_answer_ms, timings.slowest_answer_ms), (30.0, 500.0));
        assert_eq!((timings.frames, timings.slowest_frame_ms, timings.idle_percent), (1, 7.0, None));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_processor_time_grows_with_work() {
        let before = processor_time();
        let mut x = 1_u64;
        while processor_time() < before.map(|time| time + Duration::from_millis(20)) {
            x = std::hint::black_box(x.wrapping_mul(3));
        }
        assert!(processor_time() > before && x != 0);
    }
}
