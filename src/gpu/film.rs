//! The film in device memory: a head that is told and counts, the invocations of one dispatch, and the pixels.

use bytemuck::{bytes_of, from_bytes};

use super::context::Context;
use super::{GpuError, Variant};
use crate::layout::{Aov, FilmHead, Statistics, Texel};

/// Bytes of the head.
const HEAD: u64 = size_of::<FilmHead>() as u64;
/// Where a pixel's AOV lies, or what follows instead.
const AOV_AT: u64 = size_of::<Texel>() as u64;

/// What the film holds of a pixel: its texel, then what the variant asks for. `FilmTexel` of the shaders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PixelLayout {
    pub(super) aovs: bool,
    pub(super) statistics: bool,
}

impl PixelLayout {
    /// Of the variant's films.
    pub(super) fn of(variant: &Variant) -> Self {
        Self { aovs: variant.aovs(), statistics: variant.adaptive() }
    }

    /// Bytes of a pixel.
    pub(super) fn size(self) -> u64 {
        self.statistics_at() + if self.statistics { size_of::<Statistics>() as u64 } else { 0 }
    }

    fn statistics_at(self) -> u64 {
        AOV_AT + if self.aovs { size_of::<Aov>() as u64 } else { 0 }
    }
}

/// Pixels of a film in host memory.
#[derive(Debug, Default)]
pub(super) struct Pixels {
    pub(super) texels: Vec<Texel>,
    /// As many, if the film has them.
    pub(super) aovs: Vec<Aov>,
    /// As many, if the film has them.
    pub(super) statistics: Vec<Statistics>,
}

/// A film in device memory: of the whole picture, or of a band of it.
pub(super) struct FilmBuffer {
    pub(super) buffer: wgpu::Buffer,
    head: wgpu::Buffer,
    /// Bytes before the texels.
    texels_at: u64,
    pixels: u64,
    layout: PixelLayout,
}

impl FilmBuffer {
    /// Room for so many pixels, `texels_at` bytes from the start.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub(super) fn new(
        context: &Context,
        texels_at: u64,
        pixels: u64,
        layout: PixelLayout,
    ) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        Ok(Self {
            buffer: context.buffer("the picture", texels_at + pixels * layout.size(), usage)?,
            head: context.staging(HEAD)?,
            texels_at,
            pixels,
            layout,
        })
    }

    /// Whether it is laid out so, with room for as many pixels.
    pub(super) fn fits(&self, texels_at: u64, pixels: u64, layout: PixelLayout) -> bool {
        (self.texels_at, self.layout) == (texels_at, layout) && self.pixels >= pixels
    }

    /// Bytes before the texels.
    pub(super) fn texels_at(&self) -> u64 {
        self.texels_at
    }

    /// What it holds of a pixel.
    pub(super) fn layout(&self) -> PixelLayout {
        self.layout
    }

    /// How many pixels fit a buffer of `limit` bytes.
    pub(super) fn most_pixels(limit: u64, texels_at: u64, layout: PixelLayout) -> u64 {
        limit.saturating_sub(texels_at) / layout.size()
    }

    /// Bytes of a film like this one of so many pixels.
    pub(super) fn size_for(&self, pixels: u64) -> u64 {
        self.texels_at + pixels * self.layout.size()
    }

    /// Forget the first `pixels` of its pixels.
    pub(super) fn clear(&self, context: &Context, pixels: u64) {
        let mut encoder = context.encoder();
        encoder.clear_buffer(&self.buffer, self.texels_at, Some(pixels * self.layout.size()));
        context.submit(Some(encoder.finish()));
    }

    /// Tell the next submission what to trace, and where its counters begin.
    pub(super) fn set_head(&self, context: &Context, head: FilmHead) {
        context.queue.write_buffer(&self.buffer, 0, bytes_of(&head));
    }

    /// Bring the head out at the end of a submission.
    pub(super) fn take_head(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.buffer, 0, &self.head, 0, HEAD);
    }

    /// The head of the last submission, once that is done.
    pub(super) fn head(&self, context: &Context) -> Result<FilmHead, GpuError> {
        context.map(&self.head, HEAD, |bytes| *from_bytes(bytes))
    }

    /// Append the first `count` pixels to `pixels`.
    pub(super) fn read(&self, context: &Context, count: u64, pixels: &mut Pixels) -> Result<(), GpuError> {
        let layout = self.layout;
        let size = layout.size();
        let range = self.texels_at..self.texels_at + count * size;
        context.read(&self.buffer, range, size, |bytes| {
            let records = || bytes.chunks_exact(size as usize);
            pixels.texels.extend(records().map(|record| field::<Texel>(record, 0)));
            if layout.aovs {
                pixels.aovs.extend(records().map(|record| field::<Aov>(record, AOV_AT)));
            }
            if layout.statistics {
                let at = layout.statistics_at();
                pixels.statistics.extend(records().map(|record| field::<Statistics>(record, at)));
            }
        })
    }
}

/// A part of a pixel.
fn field<T: bytemuck::AnyBitPattern>(record: &[u8], at: u64) -> T {
    *from_bytes(&record[at as usize..at as usize + size_of::<T>()])
}
