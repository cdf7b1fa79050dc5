//! Plays a script: one act after the other, each once the one before has had its effect.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use super::acts::{Act, Place, acts};
use super::script::{Event, Expectation};
use super::timings::Stopwatch;

/// How long an event's effect may take.
const PATIENCE: Duration = Duration::from_secs(180);
/// How long a message may take: a shader may have to be compiled for it.
const TOAST_PATIENCE: Duration = Duration::from_secs(60);

/// A script in play.
pub(super) struct Player {
    path: PathBuf,
    events: VecDeque<(usize, Event)>,
    acts: VecDeque<Act>,
    /// Line of the event in play.
    line: usize,
    /// Since when the act in play is waited for.
    since: Option<Instant>,
    /// Whether the event in play moves the camera again and again.
    is_moving: bool,
    /// What the session takes.
    pub(super) watch: Stopwatch,
}

impl Player {
    pub(super) fn new(path: PathBuf, events: Vec<(usize, Event)>) -> Self {
        // Nothing can be dragged before there is a window with a picture.
        let acts = VecDeque::from([Act::AwaitPicture]);
        Self {
            path,
            events: events.into(),
            acts,
            line: 0,
            since: None,
            is_moving: false,
            watch: Stopwatch::default(),
        }
    }

    /// Line of the event in play, from 1; 0 before the first.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// Whether the event in play moves the camera again and again.
    pub(super) fn is_moving(&self) -> bool {
        self.is_moving
    }

    /// The act in play; none at the end of the script.
    pub(super) fn act(&mut self, place: Place) -> Option<Act> {
        while self.acts.is_empty() {
            let (line, event) = self.events.pop_front()?;
            self.line = line;
            self.is_moving = matches!(event, Event::Drag { .. } | Event::Wheel { .. });
            self.acts = acts(event, place).into();
        }
        self.since.get_or_insert_with(Instant::now);
        self.acts.front().cloned()
    }

    /// How long the act in play has been waited for.
    pub(super) fn waited(&self) -> Duration {
        self.since.map_or(Duration::ZERO, |since| since.elapsed())
    }

    /// The act in play has had its effect.
    pub(super) fn next(&mut self) {
        self.acts.pop_front();
        self.since = None;
    }

    /// Why the act in play is waited for in vain, if it is.
    pub(super) fn overdue(&self) -> Option<String> {
        let act = self.acts.front()?;
        let (patience, what) = match act {
            Act::Inputs(_) => (PATIENCE, "no frame came".to_owned()),
            Act::AwaitPicture => (PATIENCE, "no picture came".to_owned()),
            Act::AwaitRest => (PATIENCE, "the picture is not complete".to_owned()),
            Act::Expect(Expectation::Toast(text)) => (TOAST_PATIENCE, format!("no message holds `{text}`")),
            _ => return None,
        };
        (self.waited() > patience).then_some(what)
    }

    /// An error at the line in play.
    pub(super) fn fault(&self, message: String) -> (PathBuf, usize, String) {
        (self.path.clone(), self.line, message)
    }
}
