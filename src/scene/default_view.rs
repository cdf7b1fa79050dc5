//! A pleasant view of models that come without a camera, and the light for a bare mesh.

use glam::DVec3;

use super::document::DEFAULT_FOV_Y;
use super::model::world_bounds;
use super::{Background, Camera, Falloff, Light, Material, Model};

/// From the middle of the models towards the eye: a little from the right and from above.
const TOWARDS_EYE: DVec3 = DVec3::new(0.55, 0.42, 1.0);
/// From the middle of the models towards the light.
const TOWARDS_LIGHT: DVec3 = DVec3::new(-0.5, 1.0, 0.7);
/// Room around the bounding sphere, as a factor on the distance.
const MARGIN: f64 = 1.08;

/// A ball around models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    pub(super) center: DVec3,
    pub(super) radius: f64,
}

/// A small ball around everything: its centre is that of the bounding box.
pub(super) fn bounding_ball(models: &[Model]) -> Ball {
    let [lo, hi] = models
        .iter()
        .map(world_bounds)
        .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
        .unwrap_or([DVec3::ZERO; 2]);
    let center = lo.midpoint(hi);
    let radius = models.iter().map(|model| reach(model, center)).fold(0.0, f64::max);
    Ball { center, radius }
}

/// The greatest distance of a model's point from `center`, copies included (an upper bound with copies).
fn reach(model: &Model, center: DVec3) -> f64 {
    let last = model.repeat.step * (glam::UVec3::from(model.repeat.count) - 1).as_dvec3();
    let farthest = |&position: &DVec3| {
        let offset = model.world_from_object.transform_point3(position) - center;
        offset.abs().max((offset + last).abs()).length()
    };
    model.mesh.positions.iter().map(farthest).fold(0.0, f64::max)
}

/// A camera that sees the whole ball, in a picture at least as wide as it is high.
pub(super) fn camera(ball: Ball) -> Camera {
    let radius = ball.radius.max(f64::from(f32::MIN_POSITIVE));
    let distance = MARGIN * radius / (DEFAULT_FOV_Y / 2.0).to_radians().sin();
    let forward = -TOWARDS_EYE.normalize();
    let right = forward.cross(DVec3::Y).normalize();
    Camera {
        eye: ball.center - forward * distance,
        right,
        up: right.cross(forward),
        forward,
        target_distance: distance,
        fov_y: DEFAULT_FOV_Y,
    }
}

/// One white light, far enough to reach every side that the camera sees.
pub(super) fn light(ball: Ball) -> Light {
    let position = ball.center + TOWARDS_LIGHT.normalize() * (4.0 * ball.radius);
    Light { position, intensity: DVec3::splat(0.9), falloff: Falloff::None }
}

/// Ia under which the sides away from the light stay visible.
pub(super) const AMBIENT: DVec3 = DVec3::splat(0.18);

/// A pale sky.
pub(super) const BACKGROUND: Background =
    Background::Gradient { zenith: DVec3::new(0.22, 0.36, 0.62), horizon: DVec3::new(0.82, 0.86, 0.9) };

/// What faces without a material are made of.
pub(super) fn material() -> Material {
    Material {
        name: "default".into(),
        ambient: DVec3::splat(0.7),
        diffuse: DVec3::splat(0.7),
        texture: None,
        specular: DVec3::splat(0.2),
        shininess: super::document::DEFAULT_SHININESS,
        reflection: DVec3::ZERO,
        transmission: DVec3::ZERO,
        fresnel: false,
        ior: super::document::DEFAULT_IOR,
        absorption: DVec3::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DAffine3;

    use super::*;
    use crate::scene::{Mesh, Normals, Repeat};

    fn model(positions: &[[f64; 3]], repeat: Repeat) -> Model {
        let positions = positions.iter().map(|&position| DVec3::from_array(position)).collect();
        Model {
            name: String::new(),
            mesh: Arc::new(Mesh { positions, ..Mesh::default() }),
            materials: Vec::new(),
            priority: 0,
            world_from_object: DAffine3::from_translation(DVec3::X * 10.0),
            normals: Normals::File,
            repeat,
            location: None,
        }
    }

    /// Sine of the widest angle between a point of the ball and the direction of view.
    fn half_view(camera: &Camera, ball: Ball) -> f64 {
        ball.radius / (ball.center - camera.eye).length()
    }

    #[test]
    fn the_ball_touches_the_farthest_point() {
        let ball =
            bounding_ball(&[model(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.5, 0.0]], Repeat::default())]);
        assert_eq!(ball.center, DVec3::new(10.0, 0.25, 0.0));
        assert!((ball.radius - 1.0625_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn copies_are_inside_the_ball() {
        let repeat = Repeat { count: [3, 1, 1], step: DVec3::new(-2.0, 0.0, 0.0) };
        let ball = bounding_ball(&[model(&[[0.0; 3]], repeat)]);
        assert_eq!(ball, Ball { center: DVec3::X * 8.0, radius: 2.0 });
    }

    #[test]
    fn everything_is_in_view() {
        for radius in [1e-6, 1.0, 1e6] {
            let ball = Ball { center: DVec3::new(3.0, -2.0, 1.0), radius };
            let camera = camera(ball);
            let sine = half_view(&camera, ball);
            assert!(sine < (camera.fov_y / 2.0).to_radians().sin() && sine > 0.25, "{sine}");
            assert!(
                (camera.eye + camera.forward * camera.target_distance - ball.center).length()
                    < 1e-9 * radius.max(1.0)
            );
            assert!((camera.right.cross(camera.up) + camera.forward).length() < 1e-15);
        }
    }

    #[test]
    fn nothing_at_all_still_gives_a_camera() {
        let camera = camera(bounding_ball(&[]));
        assert!(camera.eye.is_finite() && camera.target_distance > 0.0);
    }
}
