//! What a renderer returns, and the trait that both devices implement.

use std::ops::ControlFlow;
use std::time::Duration;

use crate::layout::{Aov, Float, Settings, Texel, View};

/// Rays traced, by kind. Every traced ray counts, escaping ones too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RayCounts {
    /// From the eye.
    pub primary: u64,
    /// Children by reflection.
    pub reflection: u64,
    /// Children by refraction.
    pub refraction: u64,
    /// Towards lights: one for each light and shading point that is asked, however many interfaces it crosses.
    pub shadow: u64,
}

/// Where a render's time went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TraceTimes {
    /// Scene to device memory; zero on the CPU.
    pub upload: Duration,
    /// Shader assembly and pipeline creation; zero on the CPU.
    pub compile: Duration,
    /// Tracing alone.
    pub trace: Duration,
    /// Film to host memory; zero on the CPU.
    pub readback: Duration,
}

/// A picture: linear f32, row by row from the top left, cropped to `View::crop`.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` pixels; zero where tracing was stopped before.
    pub texels: Vec<Texel>,
    /// As many, if `Settings::aovs`.
    pub aovs: Option<Vec<Aov>>,
    /// The arithmetic that was used: `Fast` where strict was asked for and the device cannot give it.
    pub float: Float,
    /// Rays traced.
    pub rays: RayCounts,
    /// Where the time went.
    pub times: TraceTimes,
    /// False where tracing was stopped by [`Progress`]: some pixels are missing.
    pub complete: bool,
}

/// Hears how far a render is, and may stop it.
pub trait Progress: Sync {
    /// Called now and then with the work done and the whole of it, in any monotone unit; `Break` stops the
    /// render, which then returns what is finished.
    fn advance(&self, done: u64, total: u64) -> ControlFlow<()>;
}

/// Never reports, never stops.
impl Progress for () {
    fn advance(&self, _done: u64, _total: u64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// A device that turns a view of its scene into a picture.
pub trait Renderer {
    /// What can go wrong on this device.
    type Error: std::error::Error + Send + Sync + 'static;

    /// Trace the view.
    ///
    /// # Errors
    /// What the device reports: see the implementation.
    fn render(
        &mut self,
        view: &View,
        settings: &Settings,
        progress: &dyn Progress,
    ) -> Result<Frame, Self::Error>;
}
