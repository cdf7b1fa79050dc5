//! The texel buffer: the sRGB table, packed textures, the background picture.

use std::collections::HashMap;

use super::number::narrow;
use crate::layout::FlatTexture;
use crate::scene::{Pixels, Scene, Texture, TextureId, linear_from_srgb8};

/// Grows the words of [`FlatScene::texels`](crate::layout::FlatScene::texels).
pub(super) struct Texels {
    words: Vec<u32>,
    table: [f32; 256],
    placed: HashMap<TextureId, FlatTexture>,
}

impl Texels {
    /// The table alone.
    pub(super) fn new() -> Self {
        let table = std::array::from_fn(|code| narrow(linear_from_srgb8(code as u8)));
        Self { words: table.map(f32::to_bits).to_vec(), table, placed: HashMap::new() }
    }

    /// Where a texture lies, packed as 0x00BBGGRR; appended when it is asked for the first time. Linear pixels
    /// are clamped to [0, 1] and rounded to the nearest code.
    pub(super) fn texture(&mut self, scene: &Scene, id: TextureId) -> FlatTexture {
        if let Some(&placed) = self.placed.get(&id) {
            return placed;
        }
        let texture = &scene.textures[id.0];
        let placed = self.next(texture);
        let pack = |[r, g, b]: [u8; 3]| u32::from_le_bytes([r, g, b, 0]);
        match &texture.pixels {
            Pixels::Srgb8(pixels) => self.words.extend(pixels.iter().map(|&pixel| pack(pixel))),
            Pixels::Linear(pixels) => {
                let table = self.table;
                self.words.extend(pixels.iter().map(|pixel| pack(pixel.map(|x| nearest_code(&table, x)))));
            }
        }
        self.placed.insert(id, placed);
        placed
    }

    /// Append a background picture as three floats a texel.
    pub(super) fn environment(&mut self, scene: &Scene, id: TextureId) -> FlatTexture {
        let texture = &scene.textures[id.0];
        let placed = self.next(texture);
        match &texture.pixels {
            Pixels::Srgb8(pixels) => {
                let table = self.table;
                self.words.extend(pixels.iter().flatten().map(|&code| table[usize::from(code)].to_bits()));
            }
            Pixels::Linear(pixels) => {
                self.words.extend(pixels.iter().flatten().map(|&x| narrow(f64::from(x)).to_bits()));
            }
        }
        placed
    }

    /// All words.
    pub(super) fn into_words(self) -> Vec<u32> {
        self.words
    }

    fn next(&self, texture: &Texture) -> FlatTexture {
        FlatTexture { first: self.words.len() as u32, width: texture.width, height: texture.height }
    }
}

/// The code whose linear value is nearest.
fn nearest_code(table: &[f32; 256], x: f32) -> u8 {
    let above = table.partition_point(|&value| value < x).min(255);
    let below = above.saturating_sub(1);
    if x - table[below] < table[above] - x { below as u8 } else { above as u8 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene_of(pixels: Vec<Pixels>) -> Scene {
        let texture = |pixels| Texture { path: "a.png".into(), width: 2, height: 1, pixels };
        Scene {
            textures: pixels.into_iter().map(texture).collect(),
            ..crate::flatten::samples::empty_scene()
        }
    }

    #[test]
    fn the_table_is_the_srgb_curve() {
        let words = Texels::new().into_words();
        let value = |code: usize| f32::from_bits(words[code]);
        assert_eq!((words.len(), value(0), value(255)), (256, 0.0, 1.0));
        assert!((value(128) - 0.215_860_5).abs() < 1e-7 && (value(10) - 0.003_035_27).abs() < 1e-8);
    }

    #[test]
    fn a_texture_is_packed_once() {
        let scene = scene_of(vec![Pixels::Srgb8(vec![[1, 2, 3], [255, 0, 4]])]);
        let mut texels = Texels::new();
        let first = texels.texture(&scene, TextureId(0));
        assert_eq!(texels.texture(&scene, TextureId(0)), first);
        assert_eq!(first, FlatTexture { first: 256, width: 2, height: 1 });
        assert_eq!(texels.into_words()[256..], [0x0003_0201, 0x0004_00FF]);
    }

    #[test]
    fn linear_pixels_of_a_texture_take_the_nearest_code() {
        let table = Texels::new().table;
        for code in 0..=255 {
            let exact = table[usize::from(code)];
            assert_eq!(nearest_code(&table, exact), code);
            assert_eq!(nearest_code(&table, exact + 1e-5), code);
        }
        assert_eq!((nearest_code(&table, 7.0), nearest_code(&table, 0.0)), (255, 0));
    }

    #[test]
    fn a_background_of_either_kind_is_three_floats_a_texel() {
        let linear = vec![[0.5, 2.0, 1e-40], [7.0, 0.0, 1.0]];
        let scene = scene_of(vec![Pixels::Linear(linear), Pixels::Srgb8(vec![[255, 0, 255]; 2])]);
        let mut texels = Texels::new();
        let a = texels.environment(&scene, TextureId(0));
        let b = texels.environment(&scene, TextureId(1));
        assert_eq!((a.first, b.first), (256, 262));
        let floats: Vec<f32> = texels.into_words()[256..].iter().map(|&word| f32::from_bits(word)).collect();
        assert_eq!(floats, [0.5, 2.0, 0.0, 7.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
    }
}
