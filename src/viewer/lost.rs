//! A device that goes is opened again, with all that lay there.

use std::time::{Duration, Instant};

use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use super::ViewerError;
use super::app::Message;
use super::canvas::Canvas;
use super::panels;
use super::session::Status;
use super::tracer::Tracer;
use super::window::Shown;
use crate::gpu::GpuError;

/// Exit code of errors by which the device is lost.
pub(super) const LOST: u8 = 4;
/// A device that is lost twice within this time is not opened again.
const AGAIN: Duration = Duration::from_secs(20);

impl Shown {
    /// Make a lost device anew, unless that was done a moment ago.
    pub(super) fn recover(&mut self, error: GpuError) -> Result<(), ViewerError> {
        if self.lost.is_some_and(|lost| lost.elapsed() < AGAIN) {
            return Err(error.into());
        }
        self.lost = Some(Instant::now());
        self.open_device()?;
        self.session.complain(format!("{error}; it was opened again"));
        Ok(())
    }

    /// Open the adapter that the options name, with all that lies there.
    pub(super) fn open_device(&mut self) -> Result<(), ViewerError> {
        self.session.look.fine = None;
        self.session.look.coarse = None;
        self.session.look.reference = None;
        self.session.status = Status::default();
        self.canvas.reopen(&self.gpu)?;
        self.device += 1;
        self.tracer = tracer(&self.canvas, &self.proxy, self.device);
        self.session.adapter = self.canvas.device.adapter().clone();
        // egui tells of its letters once only, unless its fonts change: by a family that nothing uses.
        let mut fonts = panels::fonts();
        fonts.families.insert(egui::FontFamily::Name(format!("device {}", self.device).into()), Vec::new());
        self.context.set_fonts(fonts);
        self.wanted = None;
        self.finished = None;
        self.session.turning = None;
        (self.asked, self.newest) = (0, 0);
        self.unanswered.clear();
        self.window.request_redraw();
        Ok(())
    }
}

/// egui's view of the window.
pub(super) fn input_of(context: &egui::Context, window: &Window) -> egui_winit::State {
    let scale = Some(window.scale_factor() as f32);
    egui_winit::State::new(context.clone(), egui::ViewportId::ROOT, window, scale, window.theme(), None)
}

/// A tracer that reports to the window.
pub(super) fn tracer(canvas: &Canvas, proxy: &EventLoopProxy<Message>, device: u32) -> Tracer {
    let proxy = proxy.clone();
    // Fails only when the loop has ended.
    Tracer::start(canvas.device.clone(), move |report| {
        drop(proxy.send_event(Message::Report(device, Box::new(report))))
    })
}
