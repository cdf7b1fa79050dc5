//! The film in device memory: a head that is told and counts, the invocations of one dispatch, and the pixels.

use bytemuck::{Pod, Zeroable, bytes_of, cast_slice, from_bytes};

use super::GpuError;
use super::context::Context;
use crate::layout::{Aov, FilmHead, Texel, Tile};

/// Bytes of the head.
const HEAD: u64 = size_of::<FilmHead>() as u64;

/// A pixel of a variant with AOVs.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct FullTexel {
    texel: Texel,
    aov: Aov,
}

/// A film in device memory: of the whole picture, or of a band of it. A clone is the same film.
#[derive(Clone)]
pub(super) struct FilmBuffer {
    pub(super) buffer: wgpu::Buffer,
    head: wgpu::Buffer,
    /// Bytes before the texels.
    texels_at: u64,
    pixels: u64,
    aovs: bool,
}

impl FilmBuffer {
    /// Room for so many pixels, `texels_at` bytes from the start.
    ///
    /// # Errors
    /// [`GpuError::TooLarge`].
    pub(super) fn new(context: &Context, texels_at: u64, pixels: u64, aovs: bool) -> Result<Self, GpuError> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        Ok(Self {
            buffer: context.buffer("the picture", texels_at + pixels * texel_size(aovs), usage)?,
            head: context.staging(HEAD)?,
            texels_at,
            pixels,
            aovs,
        })
    }

    /// Whether it is laid out so.
    pub(super) fn fits(&self, texels_at: u64, pixels: u64, aovs: bool) -> bool {
        (self.texels_at, self.pixels, self.aovs) == (texels_at, pixels, aovs)
    }

    /// How many pixels fit a buffer of `limit` bytes.
    pub(super) fn most_pixels(limit: u64, texels_at: u64, aovs: bool) -> u64 {
        limit.saturating_sub(texels_at) / texel_size(aovs)
    }

    /// Forget the pixels.
    pub(super) fn clear(&self, context: &Context) {
        let mut encoder = context.encoder();
        encoder.clear_buffer(&self.buffer, self.texels_at, None);
        context.queue.submit([encoder.finish()]);
    }

    /// Tell the next submission what to trace, with all counters at zero.
    pub(super) fn set_tile(&self, context: &Context, tile: Tile) {
        let head = FilmHead { tile, ..FilmHead::default() };
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

    /// Append the first `pixels` to `texels`, and to `aovs` if the film has them.
    pub(super) fn read(
        &self,
        context: &Context,
        pixels: u64,
        texels: &mut Vec<Texel>,
        aovs: Option<&mut Vec<Aov>>,
    ) -> Result<(), GpuError> {
        let range = self.texels_at..self.texels_at + pixels * texel_size(self.aovs);
        match aovs {
            None => context.read(&self.buffer, range, |bytes| texels.extend_from_slice(cast_slice(bytes))),
            Some(aovs) => context.read(&self.buffer, range, |bytes| {
                let pixels: &[FullTexel] = cast_slice(bytes);
                texels.extend(pixels.iter().map(|pixel| pixel.texel));
                aovs.extend(pixels.iter().map(|pixel| pixel.aov));
            }),
        }
    }
}

fn texel_size(aovs: bool) -> u64 {
    if aovs { size_of::<FullTexel>() as u64 } else { size_of::<Texel>() as u64 }
}
