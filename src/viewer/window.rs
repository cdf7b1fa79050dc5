//! An open window: what comes to it, and what it shows.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::Window;

use super::app::Message;
use super::canvas::Canvas;
use super::cost::Finished;
use super::files::{Watch, files_of, shader_files};
use super::lost::{input_of, tracer};
use super::orders::{title, watch};
use super::panels::{self, PANEL};
use super::player::Player;
use super::session::{Order, Session};
use super::tracer::{Tracer, Wanted};
use super::{Options, Screenshot, ViewerError};
use crate::gpu::{GpuOptions, adapters, sources_in};

/// How long a file rests until it is read again: editors write in parts.
pub(super) const SETTLE: Duration = Duration::from_millis(120);

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
    /// Request that the newest picture answers, and what the tracer took for it.
    pub(super) newest: u64,
    pub(super) newest_age: Duration,
    /// Whether a picture has come since the window was painted.
    pub(super) has_news: bool,
    /// Since when frames are left out, for the pictures that they asked for.
    pub(super) left_out: Option<Instant>,
    /// When the first input came that no frame has seen yet.
    pub(super) touched: Option<Instant>,
    /// What was done since the last frame.
    pub(super) busy: Duration,
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
    /// The folder of the shader files, if they are not the program's own, and who hears of its changes.
    pub(super) shaders: Option<(PathBuf, Option<Watch>)>,
    /// When these are to be read again.
    pub(super) reassembly: Option<Instant>,
    pub(super) player: Option<Player>,
}

impl Shown {
    pub(super) fn open(
        event_loop: &ActiveEventLoop,
        proxy: EventLoopProxy<Message>,
        options: Options,
    ) -> Result<Self, ViewerError> {
        let Options { stage, settings, backend, threads, gpu, shaders, size, screenshot, script } = options;
        let [width, height] = size;
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
        let mut session = Session::new(Arc::new(stage), settings, backend, threads, adapter, adapters());
        if let Some(folder) = &shaders {
            session.shaders = sources_in(folder).map_err(ViewerError::Shaders)?;
        }
        let shaders = shaders.map(|folder| {
            let watch = watch(shader_files(&folder), &proxy, || Message::ShadersWritten);
            (folder, watch)
        });
        let watch_of_scene = watch(files_of(&session.stage), &proxy, || Message::Written);
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
            newest_age: Duration::ZERO,
            has_news: false,
            left_out: None,
            touched: None,
            busy: Duration::ZERO,
            wake: None,
            is_measured: false,
            area: [0; 4],
            screenshot,
            frames: 0,
            awaited: 0,
            watch: watch_of_scene,
            reload: None,
            shaders,
            reassembly: None,
            player: script.map(|script| Player::new(script.path, script.events)),
        })
    }

    pub(super) fn window_event(
        &mut self,
        event_loop: &ActiveEventLoop,
        event: WindowEvent,
    ) -> Result<(), ViewerError> {
        if is_of_a_hand(&event) {
            self.touched.get_or_insert_with(Instant::now);
        }
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
        if self.reassembly.is_some_and(|reassembly| reassembly <= now) {
            self.reassembly = None;
            self.read_shaders();
        }
        let play = self.play(event_loop)?;
        Ok([self.wake, self.reload, self.reassembly, play].into_iter().flatten().min())
    }

    /// Whether the picture is what was asked for, complete and on the window, and compared where that is asked for.
    pub(super) fn is_at_rest(&self) -> bool {
        let look = &self.session.look;
        let is_compared = look.reference.is_some() || !look.needs_reference();
        self.session.is_complete() && self.unanswered.is_empty() && self.wanted.is_some() && is_compared
    }
}

/// Whether an event comes from mouse, keys or fingers.
fn is_of_a_hand(event: &WindowEvent) -> bool {
    matches!(
        event,
        WindowEvent::CursorMoved { .. }
            | WindowEvent::MouseInput { .. }
            | WindowEvent::MouseWheel { .. }
            | WindowEvent::KeyboardInput { .. }
            | WindowEvent::PinchGesture { .. }
            | WindowEvent::Touch(_)
    )
}
