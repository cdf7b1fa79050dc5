//! ꟻLIP: the difference that a person sees when alternating between two pictures.
//!
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. Fairchild, "ꟻLIP: A Difference
//! Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. Section numbers
//! below are that paper's; the constants are those of its tables and of the authors' implementation.

use rayon::prelude::*;

/// Pixels per degree of the paper's observer: 0.7 m from a display 0.7 m and 3840 pixels wide (section 6).
const PIXELS_PER_DEGREE: f32 = 0.7 * (3840.0 / 0.7) * (std::f32::consts::PI / 180.0);
/// Exponent that compresses large colour differences (section 4.1.3).
const Q_C: f32 = 0.7;
/// Share of the greatest colour difference below which the map to [0, 1] is steep (section 4.1.3).
const P_C: f32 = 0.4;
/// Where that share lands (section 4.1.3).
const P_T: f32 = 0.95;
/// Width of the feature detectors in degrees (section 4.2).
const FEATURE_WIDTH: f32 = 0.082;
/// Exponent on feature differences (section 4.2).
const Q_F: f32 = 0.5;

/// The ꟻLIP error of every pixel, in [0, 1], for two linear RGB pictures of `width` pixels a row.
///
/// This is LDR-ꟻLIP: channels are clamped to [0, 1], as a display would. A NaN spreads to the pixels
/// around it. The two pictures have the same number of pixels.
#[must_use]
pub fn flip(reference: &[[f32; 3]], test: &[[f32; 3]], width: usize) -> Vec<f32> {
    let [reference, test] = [reference, test].map(|pixels| Seen::new(pixels, width));
    let c_max = hyab(perceived([0.0, 1.0, 0.0]), perceived([0.0, 0.0, 1.0])).powf(Q_C);
    let error = |i: usize| {
        let color = redistribute(hyab(reference.colors[i], test.colors[i]).powf(Q_C), c_max);
        let edge = (reference.edges[i] - test.edges[i]).abs();
        let point = (reference.points[i] - test.points[i]).abs();
        // f32::max would drop a NaN; the sum of comparisons keeps it.
        let feature = if edge >= point { edge } else { point };
        color.powf(1.0 - (feature * std::f32::consts::FRAC_1_SQRT_2).powf(Q_F))
    };
    (0..reference.colors.len()).into_par_iter().map(error).collect()
}

/// What the observer perceives of a picture.
struct Seen {
    /// Filtered colours in L*a*b* with Hunt's adjustment.
    colors: Vec<[f32; 3]>,
    /// Strength of edges.
    edges: Vec<f32>,
    /// Strength of points.
    points: Vec<f32>,
}

impl Seen {
    fn new(pixels: &[[f32; 3]], width: usize) -> Self {
        let opponent: Vec<_> =
            pixels.iter().map(|rgb| opponent_from_rgb(rgb.map(|v| v.clamp(0.0, 1.0)))).collect();
        let plane = |i: usize| opponent.iter().map(|color| color[i]).collect::<Vec<_>>();
        let luminance: Vec<f32> = opponent.iter().map(|color| (color[0] + 16.0) / 116.0).collect();
        let (edges, points) = features(&luminance, width);
        Self { colors: filtered_colors([plane(0), plane(1), plane(2)], width), edges, points }
    }
}

/// Blur by the eye's contrast sensitivity, then go to a perceptually even space (section 4.1.1 and 4.1.2).
fn filtered_colors([achromatic, red_green, blue_yellow]: [Vec<f32>; 3], width: usize) -> Vec<[f32; 3]> {
    // Table 1: sums of Gaussians a·√(π/b)·exp(−π²x²/b), x in degrees.
    let achromatic = contrast_filter(&achromatic, width, &[(1.0, 0.0047)]);
    let red_green = contrast_filter(&red_green, width, &[(1.0, 0.0053)]);
    let blue_yellow = contrast_filter(&blue_yellow, width, &[(34.1, 0.04), (13.5, 0.025)]);
    achromatic
        .into_par_iter()
        .zip(red_green)
        .zip(blue_yellow)
        .map(|((a, rg), by)| perceived(rgb_from_opponent([a, rg, by]).map(|v| v.clamp(0.0, 1.0))))
        .collect()
}

/// A normalised sum of Gaussians, each separable though the sum is not.
fn contrast_filter(plane: &[f32], width: usize, gaussians: &[(f32, f32)]) -> Vec<f32> {
    use std::f32::consts::PI;
    // Three standard deviations of the widest Gaussian of all channels: σ² = b/(2π²).
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as isize;
    let terms: Vec<(f32, Vec<f32>)> = gaussians
        .iter()
        .map(|&(a, b)| {
            let kernel = kernel(radius, |x| {
                let degrees = x / PIXELS_PER_DEGREE;
                (-PI * PI * degrees * degrees / b).exp()
            });
            (a * (PI / b).sqrt(), kernel)
        })
        .collect();
    let total: f32 = terms.iter().map(|(a, kernel)| a * kernel.iter().sum::<f32>().powi(2)).sum();
    let mut filtered = vec![0.0; plane.len()];
    for (a, kernel) in &terms {
        for (sum, value) in filtered.iter_mut().zip(convolve(plane, width, kernel, kernel)) {
            *sum += a / total * value;
        }
    }
    filtered
}

/// Magnitudes of the first and second derivatives of a blurred luminance (section 4.2).
fn features(luminance: &[f32], width: usize) -> (Vec<f32>, Vec<f32>) {
    let sigma = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as isize;
    let gaussian = move |x: f32| (-x * x / (2.0 * sigma * sigma)).exp();
    let blur = balanced(kernel(radius, gaussian));
    let first = balanced(kernel(radius, |x| -x * gaussian(x)));
    let second = balanced(kernel(radius, |x| (x * x / (sigma * sigma) - 1.0) * gaussian(x)));
    let magnitude = |derivative: &[f32]| -> Vec<f32> {
        let along_x = convolve(luminance, width, derivative, &blur);
        let along_y = convolve(luminance, width, &blur, derivative);
        along_x.into_iter().zip(along_y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
    };
    (magnitude(&first), magnitude(&second))
}

fn kernel(radius: isize, weight: impl Fn(f32) -> f32) -> Vec<f32> {
    (-radius..=radius).map(|x| weight(x as f32)).collect()
}

/// Scale positive weights to sum to 1 and negative ones to −1.
fn balanced(kernel: Vec<f32>) -> Vec<f32> {
    let positive: f32 = kernel.iter().filter(|w| **w > 0.0).sum();
    let negative: f32 = -kernel.iter().filter(|w| **w < 0.0).sum::<f32>();
    kernel
        .into_iter()
        .map(|w| if w > 0.0 { w / positive } else { w / negative.max(f32::MIN_POSITIVE) })
        .collect()
}

/// Correlate with `across` along rows and `down` along columns; the picture's rim is repeated outwards.
fn convolve(plane: &[f32], width: usize, across: &[f32], down: &[f32]) -> Vec<f32> {
    let height = plane.len() / width.max(1);
    let tap = |centre: usize, k: usize, taps: usize, size: usize| {
        (centre + k).saturating_sub(taps / 2).min(size - 1)
    };
    let mut rows = vec![0.0; plane.len()];
    rows.par_chunks_mut(width.max(1)).zip(plane.par_chunks(width.max(1))).for_each(|(out, row)| {
        for (x, out) in out.iter_mut().enumerate() {
            *out = across.iter().enumerate().map(|(k, w)| w * row[tap(x, k, across.len(), width)]).sum();
        }
    });
    let mut columns = vec![0.0; plane.len()];
    columns.par_chunks_mut(width.max(1)).enumerate().for_each(|(y, out)| {
        for (k, weight) in down.iter().enumerate() {
            let first = tap(y, k, down.len(), height) * width;
            for (out, value) in out.iter_mut().zip(&rows[first..first + width]) {
                *out += weight * value;
            }
        }
    });
    columns
}

/// CIE XYZ of linear sRGB, by the exact chromaticities of IEC 61966-2-1.
const XYZ_FROM_RGB: [[f32; 3]; 3] = [
    [0.412_390_8, 0.357_584_34, 0.180_480_8],
    [0.212_639, 0.715_168_7, 0.072_192_32],
    [0.019_330_818, 0.119_194_78, 0.950_532_14],
];
/// Its inverse.
const RGB_FROM_XYZ: [[f32; 3]; 3] = [
    [3.240_97, -1.537_383_2, -0.498_610_76],
    [-0.969_243_64, 1.875_967_5, 0.041_555_06],
    [0.055_630_08, -0.203_976_96, 1.056_971_5],
];
/// XYZ of white, D65.
const WHITE: [f32; 3] = [0.950_455_9, 1.0, 1.089_057_7];

fn transform(matrix: &[[f32; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// XYZ relative to white.
fn relative_xyz(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = transform(&XYZ_FROM_RGB, rgb);
    [x / WHITE[0], y / WHITE[1], z / WHITE[2]]
}

/// YCxCz: a linear opponent space (section 4.1.1).
fn opponent_from_rgb(rgb: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = relative_xyz(rgb);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn rgb_from_opponent([a, rg, by]: [f32; 3]) -> [f32; 3] {
    let y = (a + 16.0) / 116.0;
    let (x, z) = (y + rg / 500.0, y - by / 200.0);
    transform(&RGB_FROM_XYZ, [x * WHITE[0], y * WHITE[1], z * WHITE[2]])
}

/// CIE L*a*b* with Hunt's adjustment: chroma weakens with lightness (section 4.1.2).
fn perceived(rgb: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let [x, y, z] = relative_xyz(rgb)
        .map(|t| if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 });
    let lightness = 116.0 * y - 16.0;
    [lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)]
}

/// The HyAB distance (section 4.1.3): city block in lightness, Euclidean in chroma.
fn hyab(a: [f32; 3], b: [f32; 3]) -> f32 {
    (a[0] - b[0]).abs() + ((a[1] - b[1]).powi(2) + (a[2] - b[2]).powi(2)).sqrt()
}

/// Map [0, c_max] to [0, 1], with most of the range for small differences (section 4.1.3).
fn redistribute(error: f32, c_max: f32) -> f32 {
    let knee = P_C * c_max;
    if error < knee { P_T / knee * error } else { P_T + (error - knee) / (c_max - knee) * (1.0 - P_T) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::linear_from_srgb;

    const WIDTH: usize = 64;
    const HEIGHT: usize = 48;

    fn mean(map: &[f32]) -> f32 {
        map.iter().sum::<f32>() / map.len() as f32
    }

    fn picture(code: impl Fn(usize, usize) -> [usize; 3]) -> Vec<[f32; 3]> {
        let linear = |code: usize| linear_from_srgb(code as f64 / 255.0) as f32;
        (0..WIDTH * HEIGHT).map(|i| code(i % WIDTH, i / WIDTH).map(linear)).collect()
    }

    fn pattern(x: usize, y: usize) -> [usize; 3] {
        [x * 4 % 256, y * 5 % 256, x * y / 4 % 256]
    }

    fn changed_pattern(x: usize, y: usize) -> [usize; 3] {
        let mut code = pattern(x, y);
        if (20..40).contains(&x) && (12..28).contains(&y) {
            code = code.map(|v| 255 - v);
        }
        if (x + y).is_multiple_of(7) {
            code[1] = (code[1] + 40).min(255);
        }
        code
    }

    /// Figures of `flip_evaluator.evaluate(a, b, "LDR")`, PyPI package flip-evaluator 1.7, for the same codes.
    #[test]
    fn the_authors_implementation_gives_the_same_figures() {
        let map = flip(&picture(pattern), &picture(changed_pattern), WIDTH);
        assert!((mean(&map) - 0.263_717_3).abs() < 1e-4, "mean {}", mean(&map));
        for (x, y, want) in [
            (0, 0, 0.251_344_5),
            (30, 20, 0.937_816),
            (20, 12, 0.842_792_2),
            (63, 47, 0.080_019_7),
            (39, 27, 0.522_859_16),
        ] {
            let got = map[y * WIDTH + x];
            assert!((got - want).abs() < 1e-3, "({x}, {y}): {got}, not {want}");
        }
    }

    /// From the same package: black against white, sRGB 0.5 against 0.6.
    #[test]
    fn plain_pictures_differ_by_colour_alone() {
        let plain = |v: f64| vec![[linear_from_srgb(v) as f32; 3]; 16];
        assert!((mean(&flip(&plain(0.0), &plain(1.0), 4)) - 0.967_388_2).abs() < 1e-4);
        assert!((mean(&flip(&plain(0.5), &plain(0.6), 4)) - 0.285_063).abs() < 1e-4);
    }

    #[test]
    fn green_against_blue_is_the_greatest_difference() {
        let (green, blue) = (vec![[0.0, 1.0, 0.0]; 16], vec![[0.0, 0.0, 1.0]; 16]);
        assert!((mean(&flip(&green, &blue, 4)) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn equal_pictures_differ_by_exactly_nothing() {
        let a = picture(pattern);
        assert!(flip(&a, &a, WIDTH).iter().all(|&error| error == 0.0));
    }

    #[test]
    fn a_nan_is_not_lost() {
        let mut b = picture(pattern);
        b[100][1] = f32::NAN;
        assert!(mean(&flip(&picture(pattern), &b, WIDTH)).is_nan());
    }
}
