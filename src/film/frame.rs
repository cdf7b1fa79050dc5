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

impl RayCounts {
    /// Count more rays, by kind: primary, reflection, refraction, shadow.
    pub(crate) fn add(&mut self, [primary, reflection, refraction, shadow]: [u64; 4]) {
        self.primary += primary;
        self.reflection += reflection;
        self.refraction += refraction;
        self.shadow += shadow;
    }

    /// Rays of all kinds.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.primary + self.reflection + self.refraction + self.shadow
    }
}

/// How many samples the pixels of a frame have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SampleCounts {
    /// All that are finished the same.
    Same(u32),
    /// Each its own: adaptive antialiasing.
    Each(Vec<u32>),
}

impl SampleCounts {
    /// Of the pixel with this index.
    #[must_use]
    pub fn of(&self, pixel: usize) -> u32 {
        match self {
            Self::Same(samples) => *samples,
            Self::Each(samples) => samples.get(pixel).copied().unwrap_or(0),
        }
    }
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
    /// How many samples each is the mean of.
    pub samples: SampleCounts,
    /// As many, if `Settings::aovs`.
    pub aovs: Option<Vec<Aov>>,
    /// The arithmetic that was used: `Fast` where strict was asked for and the device cannot give it.
    pub float: Float,
    /// Rays traced: with adaptive antialiasing also those of the border that a crop or a band is traced with.
    pub rays: RayCounts,
    /// Where the time went.
    pub times: TraceTimes,
    /// False where tracing was stopped by [`Progress`]: some pixels are missing.
    pub complete: bool,
}

impl Frame {
    /// The pixels of a part (left, top, width and height in pixels), with all else of the whole.
    pub(crate) fn part(self, [left, top, width, height]: [u32; 4]) -> Self {
        let row = self.width as usize;
        let rows = top as usize..(top + height) as usize;
        let starts = || rows.clone().map(|y| y * row + left as usize);
        fn cut<T: Copy>(pixels: &[T], starts: impl Iterator<Item = usize>, width: u32) -> Vec<T> {
            starts.flat_map(|start| &pixels[start..start + width as usize]).copied().collect()
        }
        Self {
            width,
            height,
            texels: cut(&self.texels, starts(), width),
            samples: match self.samples {
                SampleCounts::Each(samples) => SampleCounts::Each(cut(&samples, starts(), width)),
                same @ SampleCounts::Same(_) => same,
            },
            aovs: self.aovs.map(|aovs| cut(&aovs, starts(), width)),
            ..self
        }
    }

    /// Put the pixels of a part as wide below, and count its rays.
    pub(crate) fn append(&mut self, part: Self) {
        self.height += part.height;
        self.texels.extend(part.texels);
        if let (SampleCounts::Each(samples), SampleCounts::Each(more)) = (&mut self.samples, part.samples) {
            samples.extend(more);
        }
        if let (Some(aovs), Some(more)) = (&mut self.aovs, part.aovs) {
            aovs.extend(more);
        }
        let RayCounts { primary, reflection, refraction, shadow } = part.rays;
        self.rays.add([primary, reflection, refraction, shadow]);
    }

    /// Fill up with black rows.
    pub(crate) fn pad_to(&mut self, height: u32) {
        let pixels = self.width as usize * height as usize;
        self.height = height;
        self.texels.resize(pixels, Texel::default());
        if let SampleCounts::Each(samples) = &mut self.samples {
            samples.resize(pixels, 0);
        }
        if let Some(aovs) = &mut self.aovs {
            aovs.resize(pixels, Aov::default());
        }
    }
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
