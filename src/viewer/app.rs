//! The window and its events.

use egui_winit::accesskit_winit;
use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::WindowId;

use super::stage::Stage;
use super::timings::Timings;
use super::tracer::Report;
use super::window::Shown;
use super::{Options, ViewerError};
use crate::scene::SceneError;

/// What comes to the window from elsewhere.
pub(super) enum Message {
    /// From the tracer of this device, by its number.
    Report(u32, Box<Report>),
    /// From a screen reader.
    Access(accesskit_winit::Event),
    /// A file of the scene was written.
    Written,
    /// A shader file was written.
    ShadersWritten,
    /// A scene was read.
    Loaded(Box<Result<Stage, SceneError>>),
}

impl From<accesskit_winit::Event> for Message {
    fn from(event: accesskit_winit::Event) -> Self {
        Self::Access(event)
    }
}

/// Open a window on a scene, until it is closed; returns what a script's session took.
///
/// # Errors
/// [`ViewerError`]: no display, no adapter that can show the window, a device that is lost again and again, a script whose
/// expectations are not met.
pub fn run(options: Options) -> Result<Option<Timings>, ViewerError> {
    let event_loop = EventLoop::with_user_event().build().map_err(ViewerError::Display)?;
    event_loop.set_control_flow(ControlFlow::Wait);
    let mut app = App { proxy: event_loop.create_proxy(), state: State::Waiting(Box::new(options)) };
    event_loop.run_app(&mut app).map_err(ViewerError::Display)?;
    match app.state {
        State::Failed(error) => Err(error),
        State::Closed(timings) => Ok(timings),
        State::Waiting(_) | State::Open(_) => Ok(None),
    }
}

struct App {
    proxy: EventLoopProxy<Message>,
    state: State,
}

enum State {
    /// For the event loop's leave to open windows.
    Waiting(Box<Options>),
    Open(Box<Shown>),
    Failed(ViewerError),
    Closed(Option<Timings>),
}

impl App {
    /// Go on, or end with the error.
    fn settle(&mut self, event_loop: &ActiveEventLoop, result: Result<(), ViewerError>) {
        if let Err(error) = result {
            self.state = State::Failed(error);
            event_loop.exit();
        }
    }
}

impl ApplicationHandler<Message> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        match std::mem::replace(&mut self.state, State::Closed(None)) {
            State::Waiting(options) => match Shown::open(event_loop, self.proxy.clone(), *options) {
                Ok(shown) => self.state = State::Open(Box::new(shown)),
                Err(error) => self.settle(event_loop, Err(error)),
            },
            other => self.state = other,
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let State::Open(shown) = &mut self.state else { return };
        let result = shown.window_event(event_loop, event);
        self.settle(event_loop, result);
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, message: Message) {
        let State::Open(shown) = &mut self.state else { return };
        let result = shown.message(message);
        self.settle(event_loop, result);
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let State::Open(shown) = &mut self.state else { return };
        match shown.until(event_loop) {
            Ok(until) => event_loop.set_control_flow(until.map_or(ControlFlow::Wait, ControlFlow::WaitUntil)),
            Err(error) => self.settle(event_loop, Err(error)),
        }
    }

    fn exiting(&mut self, _: &ActiveEventLoop) {
        // The window goes before its display does.
        if let State::Open(shown) = &self.state {
            self.state = State::Closed(shown.player.as_ref().map(|player| player.watch.timings()));
        }
    }
}
