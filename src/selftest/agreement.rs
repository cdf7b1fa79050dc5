//! How far two pictures of one view agree.

use crate::film::Frame;
use crate::layout::Texel;

/// Least percentage of pixels whose rays meet the same primitives where the driver may rewrite sums and products.
pub const LEAST_EQUAL_FAST: f64 = 99.9;
/// Least percentage of pixels whose rays meet the same bodies in f32 and f64.
pub const LEAST_EQUAL_F64: f64 = 97.0;
/// Most that f32 may differ from f64 in 99 of 100 such pixels, as part of what [`greatest_difference`] says.
const F64_TOLERANCE: f32 = 1e-4;

/// Most that f32 may differ from f64 in 99 of 100 pixels whose rays meet the same bodies, by the greatest radiance that the
/// scene can give ([`FlatScene::radiance_bound`](crate::layout::FlatScene::radiance_bound)), taken as 1 at least.
#[must_use]
pub fn greatest_difference(max_radiance: f32) -> f32 {
    F64_TOLERANCE * max_radiance.max(1.0)
}

/// How far a picture agrees with one that it is judged by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Pixels compared: as many as the larger picture has.
    pub pixels: usize,
    /// Pixels of which any bit differs: radiance, dropped weight, bound, number of rays, hashes.
    pub differing: usize,
    /// Whether as many rays of each kind were traced.
    pub same_rays: bool,
    /// Percentage of pixels whose rays meet the same primitives.
    pub same_primitives: f64,
    /// Percentage of pixels whose rays meet the same bodies.
    pub same_bodies: f64,
    /// 99th percentile of the largest channel's absolute difference over those pixels; 0 where there are none.
    pub p99: f32,
}

impl Agreement {
    /// Compare two pictures.
    #[must_use]
    pub fn between(reference: &Frame, picture: &Frame) -> Self {
        let pixels = reference.texels.len().max(picture.texels.len());
        let pairs = || reference.texels.iter().zip(&picture.texels);
        let count = |same: fn(&Texel, &Texel) -> bool| pairs().filter(|(a, b)| same(a, b)).count();
        let percent = |same| 100.0 * count(same) as f64 / pixels.max(1) as f64;
        Self {
            pixels,
            differing: pixels - count(|a, b| bits(a) == bits(b)),
            same_rays: reference.rays == picture.rays,
            same_primitives: percent(|a, b| a.primitive_hash == b.primitive_hash),
            same_bodies: percent(same_bodies),
            p99: p99(pairs().filter(|(a, b)| same_bodies(a, b)).map(|(a, b)| difference(a, b)).collect()),
        }
    }

    /// Whether every bit is the same.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.differing == 0 && self.same_rays
    }
}

fn same_bodies(a: &Texel, b: &Texel) -> bool {
    a.body_hash == b.body_hash
}

fn bits(texel: &Texel) -> [u32; 8] {
    bytemuck::cast(*texel)
}

/// The largest channel's.
fn difference(a: &Texel, b: &Texel) -> f32 {
    a.radiance.iter().zip(b.radiance).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

fn p99(mut differences: Vec<f32>) -> f32 {
    differences.sort_by(f32::total_cmp);
    differences.get(differences.len() * 99 / 100).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{RayCounts, SampleCounts, TraceTimes};
    use crate::layout::Float;

    /// A hundred pixels of which number k has a radiance of k thousandths and, from `other` on, other bodies.
    fn frame(step: f32, other: usize) -> Frame {
        let texel = |k: usize| Texel {
            radiance: [0.0, step * k as f32, 0.0],
            body_hash: u32::from(k >= other),
            ..Texel::default()
        };
        Frame {
            width: 10,
            height: 10,
            texels: (0..100).map(texel).collect(),
            aovs: None,
            samples: SampleCounts::Same(1),
            float: Float::Strict,
            rays: RayCounts::default(),
            times: TraceTimes::default(),
            complete: true,
        }
    }

    #[test]
    fn a_picture_agrees_with_itself() {
        let agreement = Agreement::between(&frame(1e-3, 60), &frame(1e-3, 60));
        assert!(agreement.is_exact());
        assert_eq!((agreement.same_bodies, agreement.same_primitives, agreement.p99), (100.0, 100.0, 0.0));
    }

    #[test]
    fn what_differs_is_counted_and_measured_where_bodies_agree() {
        let agreement = Agreement::between(&frame(0.0, 50), &frame(1.0, 100));
        assert_eq!((agreement.differing, agreement.same_bodies), (99, 50.0));
        // Of 0 to 49.
        assert_eq!(agreement.p99, 49.0);
    }

    #[test]
    fn missing_pixels_differ() {
        let mut short = frame(1e-3, 60);
        short.texels.truncate(90);
        assert_eq!(Agreement::between(&frame(1e-3, 60), &short).differing, 10);
    }
}
