//! How large a picture, and how many rounds of it, fit a time that all sides share.

use std::time::Duration;

use crate::bench::Ratio;

/// Heights that are tried, the largest first; pictures are 4:3.
const HEIGHTS: [u32; 7] = [480, 360, 240, 180, 120, 90, 60];
/// The most rounds: more would narrow no interval that matters.
const MOST_ROUNDS: usize = 51;
/// Pictures of a side before its rounds: the checked one, and the warm-up.
const BEFORE: usize = 2;

/// Width and height of the largest picture of which every side can trace enough in time; the least if none.
///
/// `pilot` is what one picture of `pixels` pixels took all sides together.
pub(super) fn size_within(left: Duration, pilot: Duration, pixels: u32) -> [u32; 2] {
    let seconds_a_pixel = pilot.as_secs_f64() / f64::from(pixels);
    let pictures = (BEFORE + Ratio::LEAST_ROUNDS) as f64;
    let fits = |&[width, height]: &[u32; 2]| {
        f64::from(width * height) * seconds_a_pixel * pictures <= left.as_secs_f64()
    };
    let sizes = HEIGHTS.map(|height| [height * 4 / 3, height]);
    sizes.into_iter().find(fits).unwrap_or(sizes[HEIGHTS.len() - 1])
}

/// Rounds that fit, of which one takes all sides so long together: from as few as make an interval.
pub(in crate::bench) fn rounds_within(left: Duration, one: Duration) -> usize {
    let fitting = (left.as_secs_f64() / one.as_secs_f64().max(1e-6)) as usize;
    // The warm-up is a round too.
    fitting.saturating_sub(1).clamp(Ratio::LEAST_ROUNDS, MOST_ROUNDS)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn a_picture_is_as_large_as_its_eight_runs_have_time() {
        let pixels = 1000;
        // 320×240 pixels eight times are 614 400.
        assert_eq!(size_within(SECOND * 615, SECOND, pixels), [320, 240]);
        assert_eq!(size_within(SECOND * 614, SECOND, pixels), [240, 180]);
        assert_eq!(size_within(SECOND * 1_000_000, SECOND, pixels), [640, 480]);
        assert_eq!(size_within(Duration::ZERO, SECOND, pixels), [80, 60]);
    }

    #[test]
    fn rounds_leave_time_for_the_warm_up_and_never_too_few_for_an_interval() {
        assert_eq!(rounds_within(SECOND * 21, SECOND), 20);
        assert_eq!(rounds_within(SECOND * 3, SECOND), Ratio::LEAST_ROUNDS);
        assert_eq!(rounds_within(SECOND * 3, Duration::ZERO), MOST_ROUNDS);
    }
}
