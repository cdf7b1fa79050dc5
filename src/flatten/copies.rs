//! Copies of one body that run into each other.

use super::place::Placed;
use crate::scene::Diagnostic;

/// Overlapping copies may touch by this part of the step before it is said: models of exactly the step's size
/// are meant to touch.
const TOUCH: f64 = 1e-6;

/// A warning where the boxes of neighbouring copies of a transmissive model overlap: they are one body, and
/// where its matter lies twice, leaving it once is leaving it.
pub(super) fn overlap(placed: &Placed) -> Option<Diagnostic> {
    let model = placed.model;
    let [lo, hi] = placed.bounds();
    let (size, step, count) = (hi - lo, model.repeat.step.abs(), model.repeat.count);
    let axis = (0..3).find(|&axis| count[axis] > 1 && size[axis] - step[axis] > TOUCH * size[axis])?;
    let name = ["x", "y", "z"][axis];
    let message = format!(
        "copies of `{}` overlap along {name}: it measures {}, the step is {}",
        model.name, size[axis], step[axis]
    );
    Some(super::at(Diagnostic::warning(message), model).hint("make the step at least as long as the model"))
}
