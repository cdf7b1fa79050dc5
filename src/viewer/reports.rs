//! What comes to the window from other threads: pictures, scenes, files that were written.

use std::time::Instant;

use egui_winit::accesskit_winit;

use super::app::Message;
use super::lost::LOST;
use super::tracer::{Kind, Report, Traced};
use super::window::{SETTLE, Shown};
use super::{TraceError, ViewerError};
use crate::gpu::GpuError;

impl Shown {
    pub(super) fn message(&mut self, message: Message) -> Result<(), ViewerError> {
        let start = Instant::now();
        let taken = self.take(message);
        self.busy += start.elapsed();
        taken
    }

    fn take(&mut self, message: Message) -> Result<(), ViewerError> {
        match message {
            Message::Report(device, report) if device == self.device => self.report(*report)?,
            // Its films lie on a device that is gone.
            Message::Report(..) => {}
            Message::Access(accesskit_winit::Event { window_event, .. }) => match window_event {
                accesskit_winit::WindowEvent::InitialTreeRequested => self.context.enable_accesskit(),
                accesskit_winit::WindowEvent::AccessibilityDeactivated => self.context.disable_accesskit(),
                accesskit_winit::WindowEvent::ActionRequested(request) => {
                    self.input.on_accesskit_action_request(request);
                }
            },
            Message::Written => {
                self.reload = Some(Instant::now() + SETTLE);
                return Ok(());
            }
            Message::ShadersWritten => {
                self.reassembly = Some(Instant::now() + SETTLE);
                return Ok(());
            }
            Message::Loaded(loaded) => self.loaded(*loaded),
        }
        self.window.request_redraw();
        Ok(())
    }

    fn report(&mut self, report: Report) -> Result<(), ViewerError> {
        match report {
            Report::Traced(traced) => self.show(traced)?,
            Report::Tree { pixel, nodes, is_strict } => {
                if let Some(inspection) = &mut self.session.inspection {
                    inspection.compare(pixel, &nodes, is_strict);
                }
            }
            Report::Shaders(Ok(())) => self.session.say("the shaders are compiled"),
            Report::Shaders(Err(error)) => {
                self.session.complain(format!("{error}\nthe shaders before stay in use"));
            }
            Report::Turned { done, of, folder } => {
                let is_over = done == of;
                self.session.turning.iter_mut().for_each(|turning| turning.done = done);
                if is_over && self.session.turning.take().is_some() {
                    self.session.say(format!("{of} pictures are in {}", folder.display()));
                }
            }
            Report::TurnedNoMore(message) => {
                self.session.turning = None;
                self.session.complain(format!("the turntable has ended: {message}"));
            }
            Report::Compiling(is_compiling) => self.session.status.is_compiling = is_compiling,
            Report::Failed(TraceError::Gpu(error)) if error.exit_code() == LOST => self.recover(error)?,
            Report::Failed(error) => {
                self.unanswered.clear();
                self.session.status.failure = Some(error.to_string());
                self.session.complain(error.to_string());
                if self.screenshot.is_some() {
                    return Err(error.into());
                }
            }
        }
        Ok(())
    }

    /// Put a picture on the window, with what is known of it.
    fn show(&mut self, traced: Traced) -> Result<(), ViewerError> {
        self.newest = self.newest.max(traced.serial);
        self.newest_age = traced.age;
        self.has_news = true;
        let look = &mut self.session.look;
        if traced.kind == Kind::Reference {
            look.reference = Some(traced.exposure);
            return Ok(());
        }
        let status = &mut self.session.status;
        status.learn(&traced);
        look.reference = None;
        match traced.kind {
            Kind::Growing => look.fine = Some(traced.exposure),
            Kind::Reference => {}
            Kind::Motion | Kind::Complete => {
                look.fine = None;
                look.coarse = Some(traced.exposure);
                self.is_measured = false;
            }
        }
        if traced.kind == Kind::Complete && traced.serial == self.asked {
            self.measure_cost()?;
        }
        self.session.ranges = None;
        Ok(())
    }

    /// Measure the picture, once, if a view needs its ranges; of a finished one the panels show them.
    pub(super) fn measure(&mut self) -> Result<(), GpuError> {
        let look = &self.session.look;
        if !look.needs_ranges() {
            return Ok(());
        }
        if !self.is_measured {
            self.canvas.presenter.measure(look);
            self.is_measured = true;
        }
        if self.session.ranges.is_none() && self.session.is_complete() {
            self.session.ranges = Some(self.canvas.presenter.ranges()?);
            // The legend was laid out before.
            self.window.request_redraw();
        }
        Ok(())
    }
}
