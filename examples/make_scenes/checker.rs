//! The red and yellow checks of the floor of 1980.

use image::{Rgb, RgbImage};

use crate::product::{Make, Product};

/// The texture.
pub(crate) fn products() -> Vec<Product> {
    vec![Product { path: "textures/checker.png", make: Make::Png(checker) }]
}

/// Two by two checks, with pixels enough that bilinear lookup keeps their edges sharp.
fn checker() -> RgbImage {
    const PIXELS: u32 = 512;
    RgbImage::from_fn(PIXELS, PIXELS, |x, y| {
        Rgb(if (x < PIXELS / 2) == (y < PIXELS / 2) { [205, 28, 24] } else { [244, 214, 46] })
    })
}
