//! What the window leaves for the tracer's thread: the last request, and a question beside it.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::tracer::Wanted;
use super::turntable::Turntable;

#[derive(Default)]
pub(super) struct Inbox {
    pub(super) letter: Mutex<Letter>,
    pub(super) changed: Condvar,
    /// Of the last request.
    pub(super) serial: AtomicU64,
    /// Whether the window was painted since the thread asked for it.
    is_painted: Mutex<bool>,
    painted: Condvar,
}

#[derive(Default)]
pub(super) struct Letter {
    pub(super) wanted: Option<(Wanted, Instant)>,
    /// A pixel whose tree is asked for, of this picture.
    pub(super) question: Option<(Wanted, [u32; 2])>,
    /// Pictures from round the target.
    pub(super) turntable: Option<Turntable>,
    pub(super) quits: bool,
}

impl Inbox {
    pub(super) fn lock(&self) -> MutexGuard<'_, Letter> {
        self.letter.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn serial(&self) -> u64 {
        self.serial.load(Ordering::Acquire)
    }

    /// The window was painted.
    pub(super) fn note_paint(&self) {
        *self.is_painted.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.painted.notify_one();
    }

    /// Say something that has the window painted, and wait until it is, but not for long: the device paints before it
    /// traces on.
    pub(super) fn have_painted(&self, patience: Duration, say: impl FnOnce()) {
        *self.is_painted.lock().unwrap_or_else(PoisonError::into_inner) = false;
        say();
        let is_painted = self.is_painted.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.painted.wait_timeout_while(is_painted, patience, |is_painted| !*is_painted);
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }

    /// What is to be done next; none at the end, or when `patience` is over.
    pub(super) fn wait(&self, patience: Option<Duration>) -> Option<Task> {
        let nothing_new = |letter: &mut Letter| {
            letter.wanted.is_none()
                && letter.question.is_none()
                && letter.turntable.is_none()
                && !letter.quits
        };
        let letter = self.lock();
        let mut letter = match patience {
            None => self.changed.wait_while(letter, nothing_new).unwrap_or_else(PoisonError::into_inner),
            Some(patience) => {
                let waited = self.changed.wait_timeout_while(letter, patience, nothing_new);
                waited.unwrap_or_else(PoisonError::into_inner).0
            }
        };
        if letter.quits {
            return None;
        }
        if let Some((wanted, since)) = letter.wanted.take() {
            return Some(Task::Trace(Request { wanted, since, serial: self.serial() }));
        }
        if let Some((wanted, pixel)) = letter.question.take() {
            return Some(Task::Answer(wanted, pixel));
        }
        letter.turntable.take().map(Task::Turn)
    }
}

/// What the thread is to do.
pub(super) enum Task {
    Trace(Request),
    /// Trace the tree of a pixel.
    Answer(Wanted, [u32; 2]),
    /// Trace pictures from round the target.
    Turn(Turntable),
}

/// A request, its time and its number.
pub(super) struct Request {
    pub(super) wanted: Wanted,
    pub(super) since: Instant,
    pub(super) serial: u64,
}
