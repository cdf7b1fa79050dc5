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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;

    use crate::flatten::samples::{ICE, STONE, cube, flattened, model};
    use crate::flatten::start_media;
    use crate::scene::{MaterialId, Model, Repeat};

    fn row(step: f64, material: MaterialId) -> Model {
        let repeat = Repeat { count: [3, 1, 2], step: DVec3::new(step, 0.0, 5.0) };
        Model { repeat, ..model("cube", cube(1.0), material) }
    }

    #[test]
    fn overlapping_copies_of_a_transmissive_model_are_reported() {
        let warned = |step, material| {
            let flat = flattened(vec![row(step, material)]).unwrap();
            flat.warnings.iter().any(|warning| warning.message.contains("copies of `cube` overlap along x"))
        };
        assert!(warned(1.5, ICE) && warned(-1.5, ICE));
        assert!(!warned(2.0, ICE) && !warned(3.0, ICE) && !warned(1.5, STONE));
    }

    #[test]
    fn copies_are_one_body() {
        let scene = flattened(vec![row(4.0, ICE)]).unwrap().scene;
        assert_eq!((scene.bodies.len(), scene.bodies[0].triangles), (1, 72));
        let inside = [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [8.0, 5.0], [8.0, 2.5], [12.0, 0.0]];
        assert_eq!(inside.map(|[x, z]| start_media(&scene, [x + 0.1, 0.2, z + 0.3])), [1, 0, 1, 1, 0, 0]);
    }
}
