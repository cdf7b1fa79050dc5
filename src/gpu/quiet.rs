//! Panics of wgpu that are caught, and told in other words.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;

thread_local! {
    /// Whether a panic of this thread is about to be caught.
    static CAUGHT: Cell<bool> = const { Cell::new(false) };
}

/// Run `task`; none if it panics, of which nothing is printed.
///
/// The process's panic hook is wrapped once, and hears of every other panic as before.
pub(super) fn catch<T>(task: impl FnOnce() -> T) -> Option<T> {
    static WRAPPED: Once = Once::new();
    WRAPPED.call_once(|| {
        let report = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            if !CAUGHT.get() {
                report(panic);
            }
        }));
    });
    let outer = CAUGHT.replace(true);
    let result = catch_unwind(AssertUnwindSafe(task));
    CAUGHT.set(outer);
    result.ok()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_caught_panic_is_none() {
        assert_eq!(catch(|| 7), Some(7));
        assert_eq!(catch(|| -> u32 { panic!("a caught panic") }), None);
    }

    #[test]
    fn nothing_is_printed_of_a_caught_panic() {
        let output = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["gpu::quiet::tests::a_caught_panic_is_none", "--exact", "--nocapture"])
            .output()
            .unwrap();
        let printed = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert!(printed.contains("1 passed") && !printed.contains("a caught panic\n"), "{printed}");
    }
}
