//! How many pixels are traced while the camera moves: as many as keep a frame within its time.

use std::time::Duration;

/// What a frame is meant to take while something moves.
pub const TARGET: Duration = Duration::from_millis(30);
/// Long side of the smallest picture, in pixels.
pub const LEAST_SIDE: u32 = 128;
/// A frame that takes less than this part of the target may grow: between the two nothing changes, so that the picture
/// does not flicker between two sizes.
const IDLE: f64 = 0.6;
/// What a changed frame is meant to take, as a part of the target.
const AIM: f64 = 0.85;
/// The part of a window's width and height that a moving picture is traced at, up to 1. The first frame is the smallest:
/// its time tells how large the next may be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scale {
    factor: f64,
    is_late: bool,
}

impl Scale {
    /// The size of a moving picture in a window of this size: not above it, with a long side of at least
    /// [`LEAST_SIDE`] where the window has that.
    #[must_use]
    pub fn of(self, size: [u32; 2]) -> [u32; 2] {
        scaled(size, self.factor.max(least(size)))
    }

    /// Learn what a picture took that was traced at [`Scale::of`] the window's size.
    pub fn took(&mut self, size: [u32; 2], time: Duration) {
        let load = time.as_secs_f64() / TARGET.as_secs_f64();
        self.is_late = load > 1.0 && self.factor <= least(size);
        if !(IDLE..=1.0).contains(&load) {
            // Time grows with the area.
            let wanted = self.factor.max(least(size)) * (AIM / load.max(1e-3)).sqrt();
            self.factor = wanted.clamp(least(size), 1.0);
        }
    }

    /// Whether not even the smallest picture came within its time.
    #[must_use]
    pub fn is_late(self) -> bool {
        self.is_late
    }
}

/// The least scale for a window.
fn least([width, height]: [u32; 2]) -> f64 {
    (f64::from(LEAST_SIDE) / f64::from(width.max(height).max(1))).min(1.0)
}

/// A size multiplied by a factor in (0, 1], with at least one pixel on each side.
#[must_use]
pub(super) fn scaled(size: [u32; 2], factor: f64) -> [u32; 2] {
    size.map(|side| ((f64::from(side) * factor).round() as u32).clamp(1, side.max(1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: [u32; 2] = [960, 540];

    /// Frames of a device that traces so many pixels in a millisecond: their sizes and times.
    fn frames(speed: f64, count: usize) -> Vec<([u32; 2], f64)> {
        let mut scale = Scale::default();
        let mut frame = || {
            let [width, height] = scale.of(WINDOW);
            let ms = f64::from(width * height) / speed;
            scale.took(WINDOW, Duration::from_secs_f64(ms / 1e3));
            ([width, height], ms)
        };
        (0..count).map(|_| frame()).collect()
    }

    #[test]
    fn a_frame_comes_within_its_time_and_the_size_stays() {
        for speed in [600.0, 2000.0, 9000.0] {
            let frames = frames(speed, 12);
            let (size, ms) = frames[11];
            assert!((15.0..=30.0).contains(&ms), "{speed} pixels a millisecond: {ms}");
            assert!(frames[4..].iter().all(|frame| frame.0 == size), "{frames:?}");
        }
    }

    #[test]
    fn the_first_frame_is_the_smallest_and_the_second_fits() {
        for speed in [200.0, 600.0, 9000.0, 1e6] {
            let frames = frames(speed, 2);
            assert_eq!(frames[0].0, [128, 72]);
            assert!(frames[1].1 <= 30.0 || frames[1].0 == [128, 72], "{frames:?}");
        }
    }

    #[test]
    fn a_fast_device_traces_every_pixel_and_a_slow_one_128() {
        assert_eq!(frames(1e6, 12)[11].0, WINDOW);
        assert_eq!(frames(1.0, 12)[11].0, [128, 72]);
    }

    #[test]
    fn late_is_who_cannot_trace_the_smallest_picture_in_its_time() {
        let mut scale = Scale::default();
        let mut took = |ms| {
            scale.took(WINDOW, Duration::from_millis(ms));
            (scale.is_late(), scale.of(WINDOW)[0] == 128)
        };
        assert_eq!(took(300), (true, true));
        // A part of its time: larger pictures come.
        assert_eq!(took(5), (false, false));
        assert_eq!(took(60), (false, false));
        assert_eq!(took(2000), (false, true));
        assert_eq!(took(300), (true, true));
    }

    #[test]
    fn a_small_window_is_not_enlarged() {
        assert_eq!(Scale::default().of([100, 60]), [100, 60]);
        assert_eq!(Scale::default().of([0, 0]), [1, 1]);
    }

    #[test]
    fn small_changes_of_speed_do_not_change_the_size() {
        let mut scale = Scale::default();
        for _ in 0..10 {
            scale.took(WINDOW, Duration::from_millis(90));
        }
        let before = scale.factor;
        for ms in [19, 29, 24, 22, 30] {
            scale.took(WINDOW, Duration::from_millis(ms));
        }
        assert_eq!(scale.factor, before);
    }
}
