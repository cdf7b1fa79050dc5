//! What changes from frame to frame: the camera and the scene's small constants, as one record.

use bytemuck::{Pod, Zeroable};

use super::constants::{BOUND_ROWS, MEDIA_ROWS};

/// Camera, picture and scene constants: head of the buffer that ends with the lights. All vec3s are followed by a scalar.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct View {
    /// World position of the eye.
    pub eye: [f32; 3],
    /// Width of the whole picture in pixels.
    pub width: u32,
    /// Unit vector into the picture.
    pub forward: [f32; 3],
    /// Height of the whole picture in pixels.
    pub height: u32,
    /// To the right edge of the picture at distance 1: unit vector × tan(fov_y/2) × width/height.
    pub right: [f32; 3],
    /// Media mask at the eye.
    pub start_media: u32,
    /// To the top edge of the picture at distance 1: unit vector × tan(fov_y/2).
    pub up: [f32; 3],
    /// The deepest ray that is traced.
    pub depth: u32,
    /// Ia.
    pub ambient: [f32; 3],
    /// The least weight that is traced.
    pub cutoff: f32,
    /// Background at and below the horizon.
    pub horizon: [f32; 3],
    /// Samples per pixel.
    pub samples: u32,
    /// Background straight up.
    pub zenith: [f32; 3],
    /// Number of point lights.
    pub lights: u32,
    /// Least corner of the scene's box.
    pub scene_lo: [f32; 3],
    /// Number of transmissive bodies: lower body ids have a bit in the media mask.
    pub transmissive_bodies: u32,
    /// Greatest corner of the scene's box.
    pub scene_hi: [f32; 3],
    /// First word of the background picture, or `NONE`.
    pub environment: u32,
    /// Texels in a row of the background picture.
    pub environment_width: u32,
    /// Its rows.
    pub environment_height: u32,
    /// Turns of the background picture about +Y, in [0, 1).
    pub environment_turn: f32,
    /// Factor on its radiance.
    pub environment_intensity: f32,
    /// Left and top of the crop in pixels, then its width and height.
    pub crop: [u32; 4],
    /// Material of each transmissive body: the medium of its bit in the mask.
    pub media: [[u32; 4]; MEDIA_ROWS as usize],
    /// `FlatScene::radiance_bound` in rows of four.
    pub radiance_bound: [[f32; 4]; BOUND_ROWS as usize],
}

impl View {
    /// The same with a crop that is larger by so many pixels on each side, as far as the picture goes.
    #[must_use]
    pub fn grown(&self, by: u32) -> Self {
        let [left, top, width, height] = self.crop;
        let [x, y] = [left, top].map(|low| low.saturating_sub(by));
        let [right, bottom] = [(left + width + by).min(self.width), (top + height + by).min(self.height)];
        Self { crop: [x, y, right - x, bottom - y], ..*self }
    }

    /// Where the crop lies in the larger one of `outer`.
    #[must_use]
    pub fn crop_within(&self, outer: &Self) -> [u32; 4] {
        let [left, top, width, height] = self.crop;
        [left - outer.crop[0], top - outer.crop[1], width, height]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crop_grows_as_far_as_the_picture_goes() {
        let view = View { width: 100, height: 50, crop: [3, 20, 80, 28], ..View::zeroed() };
        assert_eq!(view.grown(5).crop, [0, 15, 88, 35]);
        assert_eq!(view.grown(0).crop, view.crop);
        assert_eq!(view.crop_within(&view.grown(5)), [3, 5, 80, 28]);
    }
}
