//! The value that a scene's own header promises.

/// What every pixel of a scene must show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Expected {
    /// Linear radiance.
    pub(crate) radiance: [f64; 3],
    /// How far a channel may be off.
    pub(crate) within: f64,
}

/// How the line begins.
const PROMISE: &str = "# Expected: radiance ";

/// The promise in a scene file's text: `# Expected: radiance R [G B] within D.`
pub(crate) fn expected(text: &str) -> Option<Expected> {
    let line = text.lines().find_map(|line| line.strip_prefix(PROMISE))?;
    let (values, within) = line.trim_end_matches('.').split_once(" within ")?;
    let values = values.split(' ').map(|value| value.parse().ok()).collect::<Option<Vec<f64>>>()?;
    let radiance = match *values {
        [grey] => [grey; 3],
        [r, g, b] => [r, g, b],
        _ => return None,
    };
    Some(Expected { radiance, within: within.parse().ok()? })
}

impl Expected {
    /// The distance of the channel that is farthest off; NaN where a channel is none.
    pub(crate) fn distance(&self, pixels: &[[f32; 3]]) -> f64 {
        let apart =
            pixels.iter().flat_map(|pixel| (0..3).map(|c| (f64::from(pixel[c]) - self.radiance[c]).abs()));
        apart.fold(0.0, |most, d| if d <= most { most } else { d })
    }
}
