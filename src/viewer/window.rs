//! An open window: what comes to it, and what it shows.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_winit::accesskit_winit;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::Window;

use super::app::Message;
use super::canvas::{Canvas, Painted};
use super::cost::Finished;
use super::files::Watch;
use super::lost::{LOST, input_of, tracer};
use super::orders::{title, watch};
use super::panels::{self, PANEL};
use super::player::Player;
use super::session::{Order, Session};
use super::tracer::{Kind, Report, Traced, Tracer, Wanted};
use super::{Options, Screenshot, TraceError, ViewerError};
use crate::gpu::{GpuError, GpuOptions, adapters};

/// How long a file rests until it is read again: editors write in parts.
const SETTLE: Duration = Duration::from_millis(120);

/// An open window.
pub(super) struct Shown {
    pub(super) proxy: EventLoopProxy<Message>,
    pub(super) window: Arc<Window>,
    pub(super) tracer: Tracer,
    pub(super) canvas: Canvas,
    pub(super) gpu: GpuOptions,
    /// Number of the device: one is opened after the other.
    pub(super) device: u32,
    /// When the device was lost last.
    pub(super) lost: Option<Instant>,
    pub(super) context: egui::Context,
    pub(super) input: egui_winit::State,
    pub(super) session: Session,
    /// What was asked for last.
    pub(super) wanted: Option<Wanted>,
    /// The last finished picture.
    pub(super) finished: Option<(Wanted, Finished)>,
    /// The picture whose pixel was clicked.
    pub(super) inspected: Option<Wanted>,
    /// Requests that no picture has answered yet, with the time of their cause.
    pub(super) unanswered: VecDeque<(u64, Instant)>,
    /// Number of the last request.
    pub(super) asked: u64,
    /// Request that the newest picture answers.
    pub(super) newest: u64,
    /// When the next frame is due without any event.
    pub(super) wake: Option<Instant>,
    /// Whether the last finished picture's ranges are on the device.
    pub(super) is_measured: bool,
    /// The picture's part of the window in pixels.
    pub(super) area: [u32; 4],
    pub(super) screenshot: Option<Screenshot>,
    pub(super) frames: u32,
    /// Frame in which a script's input has its effect.
    pub(super) awaited: u32,
    /// Files of the scene are watched; not where the system does not let them.
    pub(super) watch: Option<Watch>,
    /// When the scene is to be read again.
    pub(super) reload: Option<Instant>,
    pub(super) player: Option<Player>,
}

impl Shown {
    pub(super) fn open(
        event_loop: &ActiveEventLoop,
        proxy: EventLoopProxy<Message>,
        options: Options,
    ) -> Result<Self, ViewerError> {
        let Options { stage, settings, backend, threads, gpu, size: [width, height], screenshot, script } =
            options;
        let attributes = Window::default_attributes()
            .with_title(title(&stage.path))
            .with_inner_size(PhysicalSize::new(width + PANEL as u32, height))
            // A screen reader's adapter wants to be there first.
            .with_visible(false);
        let window = Arc::new(event_loop.create_window(attributes)?);
        // The panel is measured in points.
        let panel = (f64::from(PANEL) * window.scale_factor()).round() as u32;
        let _ = window.request_inner_size(PhysicalSize::new(width + panel, height));
        let context = egui::Context::default();
        panels::style(&context);
        let mut input = input_of(&context, &window);
        input.init_accesskit(event_loop, &window, proxy.clone());
        window.set_visible(true);
        let canvas = Canvas::new(Arc::clone(&window), &gpu)?;
        input.set_max_texture_side(canvas.device.device().limits().max_texture_dimension_2d as usize);
        let tracer = tracer(&canvas, &proxy, 0);
        let adapter = canvas.device.adapter().clone();
        let session = Session::new(Arc::new(stage), settings, backend, threads, adapter, adapters());
        let watch = watch(&session.stage, &proxy);
        window.request_redraw();
        Ok(Self {
            proxy,
            window,
            tracer,
            canvas,
            gpu,
            device: 0,
            lost: None,
            context,
            input,
            session,
            wanted: None,
            finished: None,
            inspected: None,
            unanswered: VecDeque::new(),
            asked: 0,
            newest: 0,
            wake: None,
            is_measured: false,
            area: [0; 4],
            screenshot,
            frames: 0,
            awaited: 0,
            watch,
            reload: None,
            player: script.map(|script| Player::new(script.path, script.events)),
        })
    }

    pub(super) fn window_event(
        &mut self,
        event_loop: &ActiveEventLoop,
        event: WindowEvent,
    ) -> Result<(), ViewerError> {
        let response = self.input.on_window_event(&self.window, &event);
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => {
                self.canvas.resize(size.into());
                self.window.request_redraw();
            }
            WindowEvent::ScaleFactorChanged { .. } => self.window.request_redraw(),
            WindowEvent::RedrawRequested => return self.redraw(event_loop),
            WindowEvent::DroppedFile(path) => {
                self.session.orders.push(Order::Open(path));
                self.window.request_redraw();
            }
            _ if response.repaint => self.window.request_redraw(),
            _ => {}
        }
        Ok(())
    }

    pub(super) fn message(&mut self, message: Message) -> Result<(), ViewerError> {
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
    fn measure(&mut self) -> Result<(), GpuError> {
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

    /// Run the panels, ask for what changed, and paint.
    fn redraw(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let now = Instant::now();
        let painted = self.run_panels(now);
        self.carry_out(event_loop)?;
        self.ask(now);
        let measured = self.measure().map_err(ViewerError::Gpu);
        let shown = measured.and_then(|()| self.canvas.paint(painted, &self.session.look, self.area));
        match shown {
            Ok(is_shown) => {
                self.frames += u32::from(is_shown);
                self.answer();
            }
            Err(ViewerError::Gpu(error)) if error.exit_code() == LOST => self.recover(error)?,
            Err(error) => return Err(error),
        }
        if let Some(player) = &mut self.player {
            player.frame(now.elapsed());
        }
        self.take_screenshot(event_loop)
    }

    /// The newest picture is on the window: what asked for it, or was overtaken by it, has its answer.
    fn answer(&mut self) {
        while let Some((_, since)) = self.unanswered.front().filter(|(serial, _)| *serial <= self.newest) {
            let time = since.elapsed();
            self.player.iter_mut().for_each(|player| player.answer(time));
            self.unanswered.pop_front();
        }
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

    /// Ask the tracer for what the window is to show, if that changed.
    pub(super) fn ask(&mut self, now: Instant) {
        let [_, _, width, height] = self.area;
        if width == 0 || height == 0 || self.canvas.size().contains(&0) {
            return;
        }
        let wanted = self.session.wanted([width, height]);
        if self.wanted.as_ref().is_none_or(|last| !last.is(&wanted)) {
            self.session.status.failure = None;
            let serial = self.tracer.want(wanted.clone());
            self.asked = serial;
            self.unanswered.push_back((serial, now));
            self.wanted = Some(wanted);
        }
    }

    /// When something is due without any event.
    pub(super) fn until(&mut self, event_loop: &ActiveEventLoop) -> Result<Option<Instant>, ViewerError> {
        let now = Instant::now();
        if self.wake.is_some_and(|wake| wake <= now) {
            self.wake = None;
            self.window.request_redraw();
        }
        if self.reload.is_some_and(|reload| reload <= now) {
            self.reload = None;
            self.load(self.session.stage.path.clone());
        }
        let play = self.play(event_loop)?;
        Ok([self.wake, self.reload, play].into_iter().flatten().min())
    }

    /// Whether the picture is what was asked for, complete and on the window, and compared where that is asked for.
    pub(super) fn is_at_rest(&self) -> bool {
        let look = &self.session.look;
        let is_compared = look.reference.is_some() || !look.needs_reference();
        self.session.is_complete() && self.unanswered.is_empty() && self.wanted.is_some() && is_compared
    }
}
