//! The window under a script's hand.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;

use super::acts::{Act, Place};
use super::inspection::line;
use super::panels::PANEL;
use super::script::Expectation;
use super::session::Order;
use super::window::Shown;
use super::{Backend, ViewerError};
use crate::film::Output;

/// How often something that is waited for is looked at, where no event tells.
const LOOK: Duration = Duration::from_millis(20);

/// Time until a new size of the window, or a click into the picture, has shown its effect.
const PATIENCE: Duration = Duration::from_secs(5);

/// What became of an act.
enum Effect {
    /// The next one may come.
    Done,
    /// It is waited for; an event will tell.
    Awaited,
    /// It is waited for until then.
    Until(Instant),
}

impl Shown {
    /// Play the script as far as it goes; returns when to look again.
    pub(super) fn play(&mut self, event_loop: &ActiveEventLoop) -> Result<Option<Instant>, ViewerError> {
        loop {
            let place = Place { area: self.area, scale: self.context.pixels_per_point() };
            let Some(player) = &mut self.player else { return Ok(None) };
            let is_new = player.waited() == Duration::ZERO;
            let Some(act) = player.act(place) else {
                event_loop.exit();
                return Ok(None);
            };
            if let Some(message) = player.overdue() {
                return Err(self.fault(message));
            }
            match self.perform(act, is_new, event_loop)? {
                Effect::Done => {
                    if let Some(player) = &mut self.player {
                        player.next();
                    }
                }
                Effect::Awaited => return Ok(Some(Instant::now() + LOOK)),
                Effect::Until(time) => return Ok(Some(time)),
            }
        }
    }

    fn fault(&self, message: String) -> ViewerError {
        let (path, line, message) = match &self.player {
            Some(player) => player.fault(message),
            None => (PathBuf::new(), 0, message),
        };
        ViewerError::Script { path, line, message }
    }

    fn perform(
        &mut self,
        act: Act,
        is_new: bool,
        event_loop: &ActiveEventLoop,
    ) -> Result<Effect, ViewerError> {
        match act {
            Act::Inputs(inputs) => {
                if is_new {
                    self.touched.get_or_insert_with(Instant::now);
                    self.input.egui_input_mut().events.extend(inputs);
                    self.awaited = self.frames + 1;
                } else if self.frames >= self.awaited {
                    return Ok(Effect::Done);
                }
                // A frame that waits for its picture comes with that.
                if self.left_out.is_none() {
                    self.window.request_redraw();
                }
                return Ok(Effect::Awaited);
            }
            Act::AwaitPicture if self.wanted.is_none() || !self.unanswered.is_empty() => {
                return Ok(Effect::Awaited);
            }
            Act::AwaitRest if !self.is_at_rest() => return Ok(Effect::Awaited),
            Act::Sleep(time) => {
                let waited = self.player.as_ref().map_or(time, |player| player.waited());
                if waited < time {
                    return Ok(Effect::Until(Instant::now() + (time - waited)));
                }
            }
            Act::Resize([width, height]) => {
                let panel = (f64::from(PANEL) * self.window.scale_factor()).round() as u32;
                let wanted = PhysicalSize::new(width + panel, height);
                if is_new {
                    let _ = self.window.request_inner_size(wanted);
                    self.window.request_redraw();
                }
                if self.area[2..] != [width, height] {
                    return Ok(Effect::Awaited);
                }
                self.show_change();
            }
            Act::Minimise(is_down) => {
                self.window.set_minimized(is_down);
                // Not every system tells the size of a minimised window, which is none.
                let size = if is_down { [0, 0] } else { self.window.inner_size().into() };
                self.canvas.resize(size);
                self.window.request_redraw();
            }
            Act::Drop(path) => self.order(Order::Open(path)),
            Act::Copy(from, to) => {
                std::fs::copy(&from, &to)
                    .map_err(|error| self.fault(format!("{}: {error}", from.display())))?;
            }
            Act::View(first, second) => {
                (self.session.look.first, self.session.look.second) = (first, second);
                self.show_change();
            }
            Act::Backend(is_cpu) => {
                let threads = self.session.threads;
                self.session.backend = if is_cpu { Backend::Cpu { threads } } else { Backend::Gpu };
                self.show_change();
            }
            Act::Theme(theme) => {
                self.context.set_theme(theme);
                self.show_change();
            }
            Act::Lose => {
                self.canvas.device.device().destroy();
                self.window.request_redraw();
            }
            Act::Screenshot(path) => {
                let output = Output::new(&path)?;
                self.write_window(&output)?;
            }
            Act::Expect(expectation) => return self.expect(&expectation),
            Act::Turntable(pictures) => self.order(Order::Turntable(pictures)),
            Act::StartIdle => self.player.iter_mut().for_each(|player| player.watch.start_idle()),
            Act::EndIdle(percent) => {
                let used = self.player.as_mut().and_then(|player| player.watch.end_idle());
                match used {
                    Some(used) if used < percent => {}
                    Some(used) => return Err(self.fault(format!("{used:.2} % of a core while idle"))),
                    None => return Err(self.fault("processor time is told by Linux only".to_owned())),
                }
            }
            Act::Quit => event_loop.exit(),
            Act::AwaitPicture | Act::AwaitRest => {}
        }
        Ok(Effect::Done)
    }

    fn order(&mut self, order: Order) {
        self.session.orders.push(order);
        self.window.request_redraw();
    }

    /// Ask for what changed at once, so that the next act waits for its picture.
    fn show_change(&mut self) {
        self.ask(Instant::now());
        self.window.request_redraw();
    }

    fn expect(&self, expectation: &Expectation) -> Result<Effect, ViewerError> {
        let (is_met, found) = match expectation {
            Expectation::Toast(text) => {
                let is_said = self.session.toasts.iter().any(|toast| toast.text.contains(text));
                return Ok(if is_said { Effect::Done } else { Effect::Awaited });
            }
            Expectation::Size(size) => {
                let shown = self.session.status.size;
                (self.session.is_complete() && shown == *size, format!("the picture has {shown:?} pixels"))
            }
            Expectation::Backend { is_cpu } => {
                let traced = matches!(self.session.backend, Backend::Cpu { .. });
                (traced == *is_cpu, format!("{:?} traces", self.session.backend))
            }
            Expectation::Tree(text) => {
                let rays = self.session.inspection.iter().flat_map(|inspection| &inspection.tree.nodes);
                let lines: Vec<String> = rays.map(line).collect();
                let is_there = lines.iter().any(|line| line.contains(text));
                (is_there, format!("no line of the pixel's tree holds `{text}`: {lines:?}"))
            }
            Expectation::Frame(most) => {
                let slowest = self.player.as_ref().map_or(0.0, |player| player.watch.slowest_frame());
                (slowest <= *most, format!("a frame took {slowest:.0} ms"))
            }
            Expectation::Answer(most) => {
                let median = self.player.as_ref().map_or(0.0, |player| player.watch.median_answer());
                (median <= *most, format!("the median of the answers is {median:.0} ms"))
            }
            Expectation::Idle { .. } => (true, String::new()),
        };
        // A window system takes its time, and may tell of an old size once more.
        let comes_late = matches!(expectation, Expectation::Size(_) | Expectation::Tree(_));
        let waited = self.player.as_ref().map_or(PATIENCE, |player| player.waited());
        match is_met {
            true => Ok(Effect::Done),
            false if comes_late && waited < PATIENCE => Ok(Effect::Awaited),
            false => Err(self.fault(found)),
        }
    }
}
