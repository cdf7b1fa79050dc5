//! A frame of the window: panels, the request that they lead to, and what is painted.

use std::time::{Duration, Instant};

use winit::event_loop::ActiveEventLoop;

use super::ViewerError;
use super::canvas::Painted;
use super::lost::LOST;
use super::panels;
use super::timings::{AnswerTime, FrameTime, ms};
use super::window::Shown;

/// How long a frame that asks for a picture waits for it: the two are painted at once, and the device is free to trace.
const TOGETHER: Duration = Duration::from_millis(50);

impl Shown {
    /// Run the panels, ask for what changed, and paint.
    pub(super) fn redraw(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let now = Instant::now();
        let cause = self.touched.take().unwrap_or(now);
        let painted = self.run_panels(now);
        let panels = now.elapsed();
        self.carry_out(event_loop)?;
        let has_asked = self.ask(cause);
        if (has_asked || self.left_out.is_some()) && self.waits(now) {
            self.canvas.leave_out(painted);
        } else {
            self.paint(painted)?;
        }
        let all = std::mem::take(&mut self.busy) + now.elapsed();
        if let Some(player) = self.player.as_mut().filter(|player| player.line() > 0) {
            let (line, paint) = (player.line(), now.elapsed().saturating_sub(panels));
            player.watch.frame(FrameTime { line, ms: ms(all), panels_ms: ms(panels), paint_ms: ms(paint) });
        }
        self.take_screenshot(event_loop)
    }

    /// Whether frames are left out since one of them has asked for a picture, which will bring the next.
    fn waits(&mut self, now: Instant) -> bool {
        let since = *self.left_out.get_or_insert(now);
        let due = since + TOGETHER;
        let is_left_out = !self.has_news && now < due;
        if is_left_out {
            self.wake = Some(due);
        }
        is_left_out
    }

    fn paint(&mut self, painted: Painted) -> Result<(), ViewerError> {
        (self.left_out, self.has_news) = (None, false);
        let measured = self.measure().map_err(ViewerError::Gpu);
        let shown = measured.and_then(|()| self.canvas.paint(painted, &self.session.look, self.area));
        self.tracer.note_paint();
        match shown {
            Ok(is_shown) => {
                self.frames += u32::from(is_shown);
                self.answer()
            }
            Err(ViewerError::Gpu(error)) if error.exit_code() == LOST => self.recover(error),
            Err(error) => Err(error),
        }
    }

    /// The newest picture is on the window: what asked for it, or was overtaken by it, has its answer.
    fn answer(&mut self) -> Result<(), ViewerError> {
        while let Some((_, since)) = self.unanswered.front().filter(|(serial, _)| *serial <= self.newest) {
            let since = *since;
            self.unanswered.pop_front();
            if let Some(player) = self.player.as_mut().filter(|player| player.is_moving()) {
                // Not before the device has drawn it.
                self.canvas.finish()?;
                let line = player.line();
                let (traced_ms, size) = (ms(self.newest_age), self.session.status.size);
                player.watch.answer(AnswerTime { line, ms: ms(since.elapsed()), traced_ms, size });
            }
        }
        Ok(())
    }

    pub(super) fn run_panels(&mut self, now: Instant) -> Painted {
        let input = self.input.take_egui_input(&self.window);
        let mut rect = egui::Rect::ZERO;
        let output = self.context.run_ui(input, |ui| rect = panels::show(ui, &mut self.session));
        self.input.handle_platform_output(&self.window, output.platform_output);
        let delay = output.viewport_output.get(&egui::ViewportId::ROOT).map(|view| view.repaint_delay);
        self.wake = delay.and_then(|delay| now.checked_add(delay)).filter(|_| delay != Some(Duration::MAX));
        let scale = output.pixels_per_point;
        let triangles = self.context.tessellate(output.shapes, scale);
        let pixels = [rect.min.x, rect.min.y, rect.width(), rect.height()];
        self.area = pixels.map(|side| (side * scale).round().max(0.0) as u32);
        Painted { triangles, textures: output.textures_delta, pixels_per_point: scale }
    }

    /// Ask the tracer for what the window is to show, if that changed: by something that happened then.
    pub(super) fn ask(&mut self, cause: Instant) -> bool {
        let [_, _, width, height] = self.area;
        if width == 0 || height == 0 || self.canvas.size().contains(&0) {
            return false;
        }
        let wanted = self.session.wanted([width, height]);
        let is_new = self.wanted.as_ref().is_none_or(|last| !last.is(&wanted));
        if is_new {
            self.session.status.failure = None;
            let serial = self.tracer.want(wanted.clone());
            self.asked = serial;
            self.unanswered.push_back((serial, cause));
            self.wanted = Some(wanted);
        }
        is_new
    }
}
