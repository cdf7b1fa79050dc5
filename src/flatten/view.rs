//! The view record of a frame.

use std::array;

use super::number::narrow3;
use super::winding::start_media;
use crate::layout::{Attribute, FlatScene, FlatTexture, Settings, View};
use crate::scene::Camera;

/// What a camera sees of a flat scene, as a picture of `size` pixels, or the part `crop` of it (left, top,
/// width, height in pixels). The basis and the media at the eye are computed in f64 and rounded once.
#[must_use]
pub fn view(
    camera: &Camera,
    scene: &FlatScene,
    size: [u32; 2],
    crop: Option<[u32; 4]>,
    settings: &Settings,
) -> View {
    let [width, height] = size;
    let eye = narrow3(camera.eye);
    let half_height = (camera.fov_y.to_radians() / 2.0).tan();
    let half_width = half_height * f64::from(width) / f64::from(height);
    let absent = (FlatTexture { first: Attribute::NONE, width: 0, height: 0 }, 0.0, 0.0);
    let (environment, environment_turn, environment_intensity) = scene.environment.unwrap_or(absent);
    let bound = |level: usize| scene.radiance_bound.get(level).copied().unwrap_or(0.0);
    View {
        eye,
        width,
        forward: narrow3(camera.forward),
        height,
        right: narrow3(camera.right * half_width),
        // Where rays start: the rounded eye.
        start_media: start_media(scene, eye.map(f64::from)),
        up: narrow3(camera.up * half_height),
        depth: settings.depth,
        ambient: scene.ambient,
        cutoff: settings.cutoff,
        horizon: scene.horizon,
        samples: settings.samples,
        zenith: scene.zenith,
        lights: scene.lights.len() as u32,
        scene_lo: scene.bounds[0],
        transmissive_bodies: scene.transmissive_bodies,
        scene_hi: scene.bounds[1],
        environment: environment.first,
        environment_width: environment.width,
        environment_height: environment.height,
        environment_turn,
        environment_intensity,
        crop: crop.unwrap_or([0, 0, width, height]),
        media: array::from_fn(|row| array::from_fn(|column| medium(scene, row * 4 + column))),
        radiance_bound: array::from_fn(|row| array::from_fn(|column| bound(row * 4 + column))),
    }
}

/// The material of a transmissive body; the air's beyond the last.
fn medium(scene: &FlatScene, body: usize) -> u32 {
    scene.bodies[..scene.transmissive_bodies as usize].get(body).map_or(0, |body| body.material)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::flatten::flatten;
    use crate::flatten::samples::{ICE, WATER, cube, cuboid, model, scene_of};
    use crate::layout::{EffectChoice, Float, Intersector, Precision};

    const SETTINGS: Settings = Settings {
        depth: 7,
        cutoff: 0.01,
        samples: 3,
        adaptive: None,
        precision: Precision::F32,
        float: Float::Strict,
        intersector: Intersector::Watertight,
        aovs: false,
        effects: EffectChoice::Auto,
    };

    #[test]
    fn the_basis_reaches_to_the_edges_of_the_picture() {
        let scene = scene_of(vec![]);
        let flat = flatten(&scene).unwrap().scene;
        let view = view(&scene.camera, &flat, [200, 100], None, &SETTINGS);
        let close = |found: [f32; 3], expected: [f32; 3]| {
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?}");
        };
        close(view.right, [2.0, 0.0, 0.0]);
        close(view.up, [0.0, 1.0, 0.0]);
        close(view.forward, [0.0, 0.0, -1.0]);
        assert_eq!((view.width, view.height, view.crop), (200, 100, [0, 0, 200, 100]));
        assert_eq!((view.depth, view.cutoff, view.samples), (7, 0.01, 3));
        assert_eq!(
            (view.start_media, view.environment, view.media),
            (0, Attribute::NONE, Default::default())
        );
    }

    #[test]
    fn media_name_materials_and_the_eye_knows_where_it_is() {
        let far = cuboid(DVec3::splat(20.0), DVec3::splat(21.0));
        let mut scene = scene_of(vec![model("far", far, WATER), model("around", cube(6.0), ICE)]);
        scene.camera.eye = DVec3::new(0.25, 0.5, 5.0);
        let flat = flatten(&scene).unwrap().scene;
        let view = view(&scene.camera, &flat, [4, 4], Some([1, 1, 2, 2]), &SETTINGS);
        assert_eq!((view.start_media, view.crop), (0b10, [1, 1, 2, 2]));
        let names: Vec<&str> =
            view.media[0][..3].iter().map(|&row| flat.material_names[row as usize].as_str()).collect();
        assert_eq!(names, ["water", "ice", "air"]);
        assert_eq!(view.radiance_bound[16][0], flat.radiance_bound[64]);
    }
}
