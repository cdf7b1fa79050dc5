//! The orbit camera: a scene's camera, moved by hand about a pivot.

use glam::{DQuat, DVec2, DVec3};

use crate::scene::Camera;

/// Radians that a drag over the picture's height turns.
const TURN: f64 = std::f64::consts::PI;
/// Closest to straight up or down that a drag leads: degrees from the pole.
const POLE: f64 = 0.5;
/// Least and greatest distance from the pivot, in radii of the scene.
const DISTANCES: [f64; 2] = [1e-3, 50.0];
/// Room around the scene when it is framed, as a factor on the distance.
const MARGIN: f64 = 1.08;
/// Field of view that stands for none at all, in degrees: the rays of a picture are parallel within it.
pub(super) const TELEPHOTO: f64 = 1.0;

/// A camera that turns about a pivot. World up is +Y; a roll of the scene's own camera is kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// What the renderers see.
    pub camera: Camera,
    /// The scene's own camera.
    home: Camera,
    center: DVec3,
    pub(super) radius: f64,
    /// The field of view to go back to.
    fov_y: f64,
}

/// A side to look at the scene from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// From +Z.
    Front,
    /// From −Z.
    Back,
    /// From +X.
    Right,
    /// From −X.
    Left,
    /// From +Y.
    Top,
    /// From −Y.
    Bottom,
}

impl Orbit {
    /// The scene's camera; `bounds` are the least and greatest corner of the scene's box.
    #[must_use]
    pub fn new(camera: &Camera, bounds: [[f32; 3]; 2]) -> Self {
        let [lo, hi] = bounds.map(|corner| DVec3::from(corner.map(f64::from)));
        Self {
            camera: camera.clone(),
            home: camera.clone(),
            center: lo.midpoint(hi),
            radius: ((hi - lo).length() / 2.0).max(1e-6),
            fov_y: camera.fov_y,
        }
    }

    /// This view of another version of the scene, whose own view is `home`.
    #[must_use]
    pub fn within(&self, home: Self) -> Self {
        Self { camera: self.camera.clone(), fov_y: self.fov_y, ..home }
    }

    /// Half of the diagonal of the scene's box, in scene units.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// What the camera turns about.
    #[must_use]
    pub fn pivot(&self) -> DVec3 {
        self.camera.eye + self.camera.forward * self.camera.target_distance
    }

    /// Whether the picture is nearly without perspective.
    #[must_use]
    pub fn is_telephoto(&self) -> bool {
        self.camera.fov_y == TELEPHOTO
    }

    /// Back to the scene's own camera.
    pub fn reset(&mut self) {
        self.camera = self.home.clone();
        self.fov_y = self.home.fov_y;
    }

    /// Turn about the pivot: `drag` is the pointer's way as parts of the picture's height, +y downwards.
    pub fn orbit(&mut self, drag: DVec2) {
        let pivot = self.pivot();
        let yaw = DQuat::from_axis_angle(DVec3::Y, -drag.x * TURN);
        // How far the view is from straight up, before and after.
        let pole = self.camera.forward.dot(DVec3::Y).clamp(-1.0, 1.0).acos();
        let limit = POLE.to_radians();
        let wanted = (pole + drag.y * TURN).clamp(limit, std::f64::consts::PI - limit);
        let pitch = DQuat::from_axis_angle(self.camera.right, pole - wanted);
        self.turn(yaw * pitch);
        self.camera.eye = pivot - self.camera.forward * self.camera.target_distance;
    }

    /// Move eye and pivot with the picture's plane, so that what lies at the pivot's distance follows the pointer.
    pub fn pan(&mut self, drag: DVec2) {
        let height = 2.0 * self.camera.target_distance * (self.camera.fov_y.to_radians() / 2.0).tan();
        self.camera.eye += (self.camera.up * drag.y - self.camera.right * drag.x) * height;
    }

    /// Multiply the distance from the pivot.
    pub fn dolly(&mut self, factor: f64) {
        let pivot = self.pivot();
        self.camera.target_distance = self.clamped(self.camera.target_distance * factor);
        self.camera.eye = pivot - self.camera.forward * self.camera.target_distance;
    }

    /// The same towards a point of the picture, which stays where it is. `place` is relative to the picture's middle, in
    /// parts of its height, +y upwards.
    pub fn dolly_to(&mut self, factor: f64, place: DVec2) {
        let before = self.camera.target_distance;
        let height = 2.0 * (self.camera.fov_y.to_radians() / 2.0).tan();
        let aside = (self.camera.right * place.x + self.camera.up * place.y) * height;
        self.dolly(factor);
        self.camera.eye += aside * (before - self.camera.target_distance);
    }

    /// Go by so much along the camera's right, up and forward, in radii of the scene; the pivot comes along.
    pub fn fly(&mut self, by: DVec3) {
        let Camera { right, up, forward, .. } = self.camera;
        self.camera.eye += (right * by.x + up * by.y + forward * by.z) * self.radius;
    }

    /// Turn about this point from now on, and look at it.
    pub fn set_pivot(&mut self, point: DVec3) {
        let offset = point - self.camera.eye;
        let Some(forward) = offset.try_normalize() else { return };
        self.turn(DQuat::from_rotation_arc(self.camera.forward, forward));
        self.camera.target_distance = self.clamped(offset.length());
    }

    /// See the whole scene from where the camera looks.
    pub fn frame(&mut self) {
        let distance = MARGIN * self.radius / (self.camera.fov_y.to_radians() / 2.0).sin();
        self.camera.target_distance = distance;
        self.camera.eye = self.center - self.camera.forward * distance;
    }

    /// Look at the pivot along an axis.
    pub fn look_from(&mut self, side: Side) {
        let pivot = self.pivot();
        let (forward, up) = match side {
            Side::Front => (DVec3::NEG_Z, DVec3::Y),
            Side::Back => (DVec3::Z, DVec3::Y),
            Side::Right => (DVec3::NEG_X, DVec3::Y),
            Side::Left => (DVec3::X, DVec3::Y),
            Side::Top => (DVec3::NEG_Y, DVec3::NEG_Z),
            Side::Bottom => (DVec3::Y, DVec3::Z),
        };
        (self.camera.forward, self.camera.up, self.camera.right) = (forward, up, forward.cross(up));
        self.camera.eye = pivot - forward * self.camera.target_distance;
    }

    /// Nearly no perspective, from as far away as keeps the pivot's size; and back.
    pub fn toggle_telephoto(&mut self) {
        let wanted = if self.is_telephoto() { self.fov_y } else { TELEPHOTO };
        if !self.is_telephoto() {
            self.fov_y = self.camera.fov_y;
        }
        let half = |degrees: f64| (degrees.to_radians() / 2.0).tan();
        let pivot = self.pivot();
        self.camera.target_distance *= half(self.camera.fov_y) / half(wanted);
        self.camera.fov_y = wanted;
        self.camera.eye = pivot - self.camera.forward * self.camera.target_distance;
    }

    fn turn(&mut self, turn: DQuat) {
        let Camera { up, forward, .. } = self.camera;
        let forward = (turn * forward).normalize();
        let right = forward.cross(turn * up).normalize();
        (self.camera.forward, self.camera.right, self.camera.up) = (forward, right, right.cross(forward));
    }

    fn clamped(&self, distance: f64) -> f64 {
        let far = if self.is_telephoto() { DISTANCES[1] * 60.0 } else { DISTANCES[1] };
        distance.clamp(DISTANCES[0] * self.radius, far * self.radius)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
pub(super) mod tests {
    use super::*;

    pub(in crate::viewer) fn orbit() -> Orbit {
        let camera = Camera {
            eye: DVec3::new(0.0, 1.0, 5.0),
            right: DVec3::X,
            up: DVec3::Y,
            forward: DVec3::NEG_Z,
            target_distance: 5.0,
            fov_y: 40.0,
        };
        Orbit::new(&camera, [[-1.0; 3], [1.0, 3.0, 1.0]])
    }

    fn is_sound(camera: &Camera) -> bool {
        let Camera { right, up, forward, .. } = *camera;
        (right.cross(up) + forward).length() < 1e-12 && (forward.length() - 1.0).abs() < 1e-12
    }

    #[test]
    fn a_drag_turns_about_the_pivot_and_keeps_the_distance() {
        let mut orbit = orbit();
        let pivot = orbit.pivot();
        for _ in 0..200 {
            orbit.orbit(DVec2::new(0.031, 0.017));
            assert!(is_sound(&orbit.camera) && (orbit.pivot() - pivot).length() < 1e-9);
            assert!(orbit.camera.up.y > 0.0, "never upside down");
        }
        // Straight down, but for half a degree.
        assert!(orbit.camera.forward.y.abs() > 0.999);
    }

    #[test]
    fn dragging_to_the_right_shows_the_left_side() {
        let mut orbit = orbit();
        orbit.orbit(DVec2::new(0.25, 0.0));
        assert!(orbit.camera.eye.x < -3.0, "{}", orbit.camera.eye);
        orbit.orbit(DVec2::new(0.0, 0.1));
        assert!(orbit.camera.eye.y > 2.0, "dragging down looks from above: {}", orbit.camera.eye);
    }

    #[test]
    fn what_lies_at_the_pivot_follows_the_pointer() {
        let mut orbit = orbit();
        let point = orbit.pivot();
        orbit.pan(DVec2::new(0.2, -0.1));
        let place = orbit.project(point, 2.0).unwrap();
        assert!((place - DVec2::new(0.5 + 0.2 / 2.0, 0.4)).length() < 1e-9, "{place}");
    }

    #[test]
    fn the_point_under_the_cursor_stays_while_dollying_to_it() {
        let mut orbit = orbit();
        let place = DVec2::new(0.3, 0.2);
        let height = 2.0 * 5.0 * 20_f64.to_radians().tan();
        let point = orbit.pivot() + DVec3::new(place.x, place.y, 0.0) * height;
        let before = orbit.project(point, 1.5).unwrap();
        orbit.dolly_to(0.5, place);
        assert!((orbit.project(point, 1.5).unwrap() - before).length() < 1e-9);
        assert_eq!(orbit.camera.target_distance, 2.5);
    }

    #[test]
    fn the_distance_stays_within_reach_of_the_scene() {
        let mut orbit = orbit();
        (0..1000).for_each(|_| orbit.dolly(0.8));
        assert_eq!(orbit.camera.target_distance, DISTANCES[0] * orbit.radius);
        (0..1000).for_each(|_| orbit.dolly(1.25));
        assert_eq!(orbit.camera.target_distance, DISTANCES[1] * orbit.radius);
    }

    #[test]
    fn a_framed_scene_fits_the_picture_from_any_side() {
        for side in [Side::Front, Side::Back, Side::Right, Side::Left, Side::Top, Side::Bottom] {
            let mut orbit = orbit();
            orbit.look_from(side);
            orbit.frame();
            assert!(is_sound(&orbit.camera));
            for corner in 0..8 {
                let axis = |bit: u32, lo, hi| if corner >> bit & 1 == 0 { lo } else { hi };
                let point = DVec3::new(axis(0, -1.0, 1.0), axis(1, -1.0, 3.0), axis(2, -1.0, 1.0));
                let place = orbit.project(point, 1.0).unwrap();
                assert!(place.min_element() > 0.0 && place.max_element() < 1.0, "{side:?}: {place}");
            }
        }
    }

    #[test]
    fn without_perspective_the_pivot_keeps_its_size_and_all_comes_back() {
        let mut orbit = orbit();
        let before = orbit.clone();
        let point = orbit.pivot() + DVec3::X;
        let place = orbit.project(point, 1.0).unwrap();
        orbit.toggle_telephoto();
        assert!(orbit.is_telephoto() && (orbit.project(point, 1.0).unwrap() - place).length() < 1e-9);
        orbit.toggle_telephoto();
        assert!((orbit.camera.eye - before.camera.eye).length() < 1e-9);
        assert_eq!(orbit.camera.fov_y, before.camera.fov_y);
    }

    #[test]
    fn a_new_pivot_comes_to_the_middle() {
        let mut orbit = orbit();
        let point = DVec3::new(0.5, 2.0, 0.5);
        let eye = orbit.camera.eye;
        orbit.set_pivot(point);
        assert!(is_sound(&orbit.camera) && (orbit.pivot() - point).length() < 1e-9);
        assert_eq!(orbit.camera.eye, eye);
        orbit.reset();
        assert_eq!(orbit.camera, orbit.home);
    }
}
