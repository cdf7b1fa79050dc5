//! What a script's session took.

use std::time::{Duration, Instant};

use serde::Serialize;

/// What a script's session took, in milliseconds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Timings {
    /// Frames of the window, from the script's first event on.
    pub frames: usize,
    /// The longest of them: as long the window answered nobody.
    pub slowest_frame_ms: f64,
    /// Inputs that moved the camera and were answered by a picture.
    pub answers: usize,
    /// From an input until the first pixels that it changed are painted, the median.
    pub median_answer_ms: f64,
    /// The same, the longest.
    pub slowest_answer_ms: f64,
    /// Processor time while nothing was to be done, in percent of one core, where it was asked for.
    pub idle_percent: Option<f64>,
    /// Each frame.
    pub each_frame: Vec<FrameTime>,
    /// Each answer.
    pub each_answer: Vec<AnswerTime>,
}

/// What a frame of the window took, in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FrameTime {
    /// Line of the script that was in play.
    pub line: usize,
    /// All of it, and what came before it since the last one: reports of the tracer, files.
    pub ms: f64,
    /// The panels' part.
    pub panels_ms: f64,
    /// The drawing's part.
    pub paint_ms: f64,
}

/// From an input until the first pixels that it changed are painted, in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AnswerTime {
    /// Line of the script that was in play.
    pub line: usize,
    /// All of it.
    pub ms: f64,
    /// The tracer's part: from the request to the picture, or to the first part of it.
    pub traced_ms: f64,
    /// Size of that picture.
    pub size: [u32; 2],
}

/// Notes what a session takes.
#[derive(Debug, Default)]
pub(super) struct Stopwatch {
    frames: Vec<FrameTime>,
    answers: Vec<AnswerTime>,
    /// Processor time and time of day when idling began.
    idle: Option<(Duration, Instant)>,
    idle_percent: Option<f64>,
}

impl Stopwatch {
    pub(super) fn frame(&mut self, frame: FrameTime) {
        self.frames.push(frame);
    }

    pub(super) fn answer(&mut self, answer: AnswerTime) {
        self.answers.push(answer);
    }

    /// Begin to idle.
    pub(super) fn start_idle(&mut self) {
        self.idle = processor_time().map(|time| (time, Instant::now()));
    }

    /// Processor time since, in percent of one core; none where it cannot be told.
    pub(super) fn end_idle(&mut self) -> Option<f64> {
        let (before, since) = self.idle.take()?;
        let used = processor_time()?.saturating_sub(before);
        self.idle_percent = Some(100.0 * used.as_secs_f64() / since.elapsed().as_secs_f64());
        self.idle_percent
    }

    /// The longest frame in milliseconds.
    pub(super) fn slowest_frame(&self) -> f64 {
        self.frames.iter().map(|frame| frame.ms).fold(0.0, f64::max)
    }

    /// The median of the answers in milliseconds.
    pub(super) fn median_answer(&self) -> f64 {
        let mut sorted: Vec<f64> = self.answers.iter().map(|answer| answer.ms).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or_default()
    }

    /// What all took.
    pub(super) fn timings(&self) -> Timings {
        Timings {
            frames: self.frames.len(),
            slowest_frame_ms: self.slowest_frame(),
            answers: self.answers.len(),
            median_answer_ms: self.median_answer(),
            slowest_answer_ms: self.answers.iter().map(|answer| answer.ms).fold(0.0, f64::max),
            idle_percent: self.idle_percent,
            each_frame: self.frames.clone(),
            each_answer: self.answers.clone(),
        }
    }
}

/// Milliseconds.
pub(super) fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// Processor time of this process, where Linux tells it (proc(5): fields 14 and 15 of /proc/self/stat, in ticks of which
/// a second has 100).
fn processor_time() -> Option<Duration> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name in parentheses may hold anything.
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field)?.parse::<u64>().ok();
    Some(Duration::from_millis(10 * (ticks(11)? + ticks(12)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_and_the_longest_are_told() {
        let mut watch = Stopwatch::default();
        for ms in [30.0, 10.0, 500.0] {
            watch.answer(AnswerTime { line: 1, ms, traced_ms: 5.0, size: [128, 72] });
            watch.frame(FrameTime { line: 1, ms: ms / 10.0, panels_ms: 1.0, paint_ms: 0.0 });
        }
        let timings = watch.timings();
        assert_eq!((timings.median_answer_ms, timings.slowest_answer_ms), (30.0, 500.0));
        assert_eq!((timings.frames, timings.slowest_frame_ms, timings.idle_percent), (3, 50.0, None));
        assert_eq!(timings.each_answer[1].ms, 10.0);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_processor_time_grows_with_work() {
        let before = processor_time();
        let mut x = 1_u64;
        while processor_time() < before.map(|time| time + Duration::from_millis(20)) {
            x = std::hint::black_box(x.wrapping_mul(3));
        }
        assert!(processor_time() > before && x != 0);
    }
}
