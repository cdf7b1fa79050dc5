//! False colours as 8-bit sRGB codes.

/// The perceptually even colour map *viridis* (Smith and van der Walt 2015), by Matt Zucker's
/// polynomial of degree six (Shadertoy WlfXRN, CC0): dark blue at 0, green, yellow at 1.
///
/// `t` outside [0, 1] is clamped.
#[must_use]
pub(super) fn viridis(t: f32) -> [u8; 3] {
    const COEFFICIENTS: [[f32; 3]; 7] = [
        [0.277_727_33, 0.005_407_344_5, 0.334_099_8],
        [0.105_093_04, 1.404_613_5, 1.384_590_2],
        [-0.330_861_83, 0.214_847_56, 0.095_095_16],
        [-4.634_230_5, -5.799_101, -19.332_441],
        [6.228_27, 14.179_933, 56.690_55],
        [4.776_385, -13.745_145, -65.353_03],
        [-5.435_456, 4.645_852_6, 26.312_435],
    ];
    let t = t.clamp(0.0, 1.0);
    let mut color = [0.0_f32; 3];
    for row in COEFFICIENTS.iter().rev() {
        for (channel, coefficient) in color.iter_mut().zip(row) {
            *channel = *channel * t + coefficient;
        }
    }
    color.map(code)
}

/// A colour for an id or a hash: neighbours in number are far apart in hue.
///
/// Fibonacci hashing (Knuth, The Art of Computer Programming 3, section 6.4): the golden ratio's
/// multiples spread evenly over the hue circle, and further bits choose among three brightnesses.
#[must_use]
pub(super) fn palette(id: u32) -> [u8; 3] {
    let spread = id.wrapping_mul(0x9E37_79B9);
    let hue = (spread >> 8) as f32 / 16_777_216.0;
    let value = [0.95, 0.75, 0.55][(id.wrapping_mul(0x85EB_CA6B) >> 16) as usize % 3];
    hue_color(hue, 0.65, value)
}

/// A grey of this brightness in [0, 1].
#[must_use]
pub(super) fn grey(t: f32) -> [u8; 3] {
    [code(t); 3]
}

/// HSV to RGB (Smith 1978), hue in turns.
fn hue_color(hue: f32, saturation: f32, value: f32) -> [u8; 3] {
    [5.0, 3.0, 1.0].map(|offset| {
        let k = (offset + hue * 6.0) % 6.0;
        code(value - value * saturation * k.min(4.0 - k).clamp(0.0, 1.0))
    })
}

fn code(display: f32) -> u8 {
    (display.clamp(0.0, 1.0) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viridis_meets_the_published_table() {
        // Rows 0, 127 and 255 of matplotlib's table.
        for (t, expected) in [(0.0, [68, 1, 84]), (0.498, [33, 144, 140]), (1.0, [253, 231, 37])] {
            for (got, want) in viridis(t).into_iter().zip(expected) {
                assert!(i32::from(got).abs_diff(want) <= 4, "viridis({t}) = {:?}", viridis(t));
            }
        }
    }

    #[test]
    fn the_first_ids_have_distinct_colours() {
        let mut colors: Vec<_> = (0..64).map(palette).collect();
        colors.sort_unstable();
        colors.dedup();
        assert_eq!(colors.len(), 64);
    }

    #[test]
    fn neighbouring_ids_are_easily_told_apart() {
        for id in 0..32 {
            let distance: u32 =
                palette(id).into_iter().zip(palette(id + 1)).map(|(a, b)| u32::from(a.abs_diff(b))).sum();
            assert!(distance > 100, "{id} and its successor differ by {distance} only");
        }
    }
}
