//! What an orbit camera sees: where points of the scene lie in the picture, and the camera as a scene file has it.

use glam::{DVec2, DVec3};

use super::orbit::Orbit;
use crate::scene::Camera;

/// Closest to the eye's plane that a segment is drawn, in radii of the scene.
const NEAR: f64 = 1e-4;

impl Orbit {
    /// Where a world point appears in a picture of width/height `aspect`: parts of its width and height from the top
    /// left; none behind the eye.
    #[must_use]
    pub fn project(&self, point: DVec3, aspect: f64) -> Option<DVec2> {
        let offset = point - self.camera.eye;
        let depth = offset.dot(self.camera.forward);
        let half = (self.camera.fov_y.to_radians() / 2.0).tan();
        (depth > 0.0).then(|| {
            let x = offset.dot(self.camera.right) / (depth * half * aspect);
            let y = offset.dot(self.camera.up) / (depth * half);
            DVec2::new(0.5 + 0.5 * x, 0.5 - 0.5 * y)
        })
    }

    /// The part of a segment that lies before the eye, if any.
    #[must_use]
    pub fn in_front(&self, [a, b]: [DVec3; 2]) -> Option<[DVec3; 2]> {
        let near = NEAR * self.radius;
        let depth = |point: DVec3| (point - self.camera.eye).dot(self.camera.forward) - near;
        let (from, to) = (depth(a), depth(b));
        let cut = || a + (b - a) * (from / (from - to));
        match (from > 0.0, to > 0.0) {
            (true, true) => Some([a, b]),
            (true, false) => Some([a, cut()]),
            (false, true) => Some([cut(), b]),
            (false, false) => None,
        }
    }

    /// The scene file's table of this camera.
    #[must_use]
    pub fn table(&self) -> String {
        let vector = |v: DVec3| format!("[{}, {}, {}]", number(v.x), number(v.y), number(v.z));
        let Camera { eye, up, fov_y, .. } = &self.camera;
        format!(
            "[camera]\neye = {}\ntarget = {}\nup = {}\nfov_y = {}\n",
            vector(*eye),
            vector(self.pivot()),
            vector(*up),
            number(*fov_y)
        )
    }
}

/// A number that TOML reads as a float, with the digits that f32 renderers see.
fn number(value: f64) -> String {
    let text = format!("{:.7}", value);
    let text = text.trim_end_matches('0');
    let text = if text.ends_with('.') { format!("{text}0") } else { text.to_owned() };
    if text == "-0.0" { "0.0".to_owned() } else { text }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::orbit::tests::orbit;
    use super::*;

    #[test]
    fn a_segment_is_cut_before_the_eye() {
        let orbit = orbit();
        let [a, b] = orbit.in_front([DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 10.0)]).unwrap();
        assert!(a.z == 0.0 && b.z < 5.0 && b.z > 4.99, "{b}");
        assert_eq!(orbit.in_front([DVec3::Z * 6.0, DVec3::Z * 7.0]), None);
    }

    #[test]
    fn the_table_reads_back_as_the_camera() {
        let mut orbit = orbit();
        orbit.orbit(DVec2::new(0.123, 0.045));
        let text = orbit.table()
            + "[[model]]\nshape = { sphere = { radius = 1.0 } }\nmaterial = \"m\"\n[material.m]\ndiffuse = { color = \"#ffffff\" }\n";
        let scene = crate::scene::Scene::parse("a.toml".as_ref(), &text);
        let camera = scene.map_err(|error| error.to_string()).unwrap().camera;
        assert!((camera.eye - orbit.camera.eye).length() < 1e-6);
        assert!((camera.forward - orbit.camera.forward).length() < 1e-6);
        assert!((camera.up - orbit.camera.up).length() < 1e-6 && camera.fov_y == 40.0);
    }
}
