//! How bright a ray tree can be: what the certified bound of a cut ray rests on.

use glam::DVec3;

use super::distance::{greatest_lift, least_distance};
use super::number::{narrow_up, widen3};
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{FlatScene, Light, Material};

/// 2^100: as much as no bound at all. Millions of cut rays may add up as much and stay within f32.
const BOUNDLESS: f64 = 1.267_650_600_228_229_4e30;

/// L₀ … L of `MAX_DEPTH` + 1 levels: `L₀ = B`, `Lₖ₊₁ = max(B, A + g·Lₖ)`, with B the brightest background, A the
/// largest local term and g the largest weight that a surface passes on: a ray meets a surface or sees the background.
/// So the series never falls, and bounds what a cut ray is given, `L₀`, too. Rounded up, and capped at [`BOUNDLESS`].
pub(super) fn bounds(scene: &FlatScene) -> Vec<f32> {
    let (local, passed) = (largest_local_term(scene), largest_weight(scene));
    let background = brightest_background(scene).min(BOUNDLESS);
    let levels = std::iter::successors(Some(background), |&radiance| {
        Some((local + passed * radiance).clamp(background, BOUNDLESS))
    });
    levels.take(MAX_DEPTH as usize + 1).map(narrow_up).collect()
}

/// B: the brightest channel of any direction.
fn brightest_background(scene: &FlatScene) -> f64 {
    let Some((picture, _, intensity)) = scene.environment else {
        return widen3(scene.horizon).max(widen3(scene.zenith)).max_element();
    };
    let first = picture.first as usize;
    let words = &scene.texels[first..first + 3 * picture.width as usize * picture.height as usize];
    let brightest = words.iter().map(|&word| f32::from_bits(word)).fold(0.0, f32::max);
    f64::from(brightest) * f64::from(intensity)
}

/// A: the largest channel of ka·Ia + Σj Ij·(kd + ks) over all materials, every light unshadowed and, where it
/// falls off, as close as it comes to any surface. Textures multiply by at most 1, and n·l, (s·r)^β are at
/// most 1.
fn largest_local_term(scene: &FlatScene) -> f64 {
    let lift =
        if scene.lights.iter().any(|light| light.inverse_square != 0) { greatest_lift(scene) } else { 0.0 };
    let light: DVec3 = scene.lights.iter().map(|light| strongest(scene, light, lift)).sum();
    let ambient = widen3(scene.ambient);
    let local = |material: &Material| {
        let scattered = light * (widen3(material.diffuse) + widen3(material.specular));
        // A light on a surface is boundless, but gives nothing to a black one: 0·∞ = 0 here.
        let scattered = DVec3::select(scattered.is_nan_mask(), DVec3::ZERO, scattered);
        (ambient * widen3(material.ambient) + scattered).max_element()
    };
    scene.materials.iter().map(local).fold(0.0, f64::max)
}

/// The intensity of a light at the nearest surface.
fn strongest(scene: &FlatScene, light: &Light, lift: f64) -> DVec3 {
    let intensity = widen3(light.intensity);
    if light.inverse_square == 0 || intensity == DVec3::ZERO {
        return intensity;
    }
    let distance = least_distance(scene, widen3(light.position), lift);
    DVec3::select(intensity.cmpgt(DVec3::ZERO), intensity / (distance * distance), DVec3::ZERO)
}

/// g: the largest channel of kr + kt of a classic material (total internal reflection adds them), or of either
/// of a Fresnel one (which divides between them). The air is no surface.
fn largest_weight(scene: &FlatScene) -> f64 {
    let weight = |material: &Material| {
        let (kr, kt) = (widen3(material.reflection), widen3(material.transmission));
        if material.fresnel == 0 { (kr + kt).max_element() } else { kr.max(kt).max_element() }
    };
    scene.materials[1..].iter().map(weight).fold(0.0, f64::max)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::flatten::flatten;
    use crate::flatten::samples::{STONE, cube, lamp, model, scene_of};
    use crate::scene::{Background, Falloff, Material, Scene};

    /// A cube of half side 1 of a material that is changed from stone.
    fn bounds_of(material: impl Fn(&mut Material), scene: impl Fn(&mut Scene)) -> Vec<f32> {
        let mut sample = scene_of(vec![model("cube", cube(1.0), STONE)]);
        material(&mut sample.materials[STONE.0]);
        scene(&mut sample);
        flatten(&sample).unwrap().scene.radiance_bound
    }

    fn assert_close(found: f32, expected: f64) {
        assert!(
            f64::from(found) >= expected && f64::from(found) <= expected * 1.000_01,
            "{found} {expected}"
        );
    }

    #[test]
    fn the_series_has_its_closed_form() {
        let bounds = bounds_of(
            |stone| {
                stone.ambient = DVec3::splat(0.2);
                stone.specular = DVec3::splat(0.25);
                stone.reflection = DVec3::splat(0.5);
                stone.transmission = DVec3::splat(0.25);
            },
            |scene| {
                scene.ambient = DVec3::splat(0.5);
                scene.background = Background::Color(DVec3::new(0.0, 3.0, 0.0));
                scene.lights = vec![lamp(DVec3::splat(9.0), 2.0, Falloff::None); 2];
            },
        );
        let (local, passed) = (0.5 * 0.2 + 2.0 * 2.0 * (0.5 + 0.25), 0.75_f64);
        assert_eq!(bounds.len(), 65);
        for (level, &bound) in bounds.iter().enumerate() {
            let power = passed.powi(level as i32);
            assert_close(bound, 3.0 * power + local * (1.0 - power) / (1.0 - passed));
        }
    }

    #[test]
    fn falloff_counts_from_the_nearest_surface() {
        let bounds = bounds_of(
            |_| {},
            |scene| scene.lights = vec![lamp(DVec3::new(0.0, 3.0, 0.0), 8.0, Falloff::InverseSquare)],
        );
        assert_close(bounds[1], 8.0 / 4.0 * 0.5);
    }

    #[test]
    fn surfaces_that_pass_on_little_do_not_hide_the_background() {
        let white = |scene: &mut Scene| scene.background = Background::Color(DVec3::ONE);
        let bounds = bounds_of(|stone| stone.reflection = DVec3::splat(0.5), white);
        assert!(bounds.iter().all(|&bound| bound == 1.0), "{bounds:?}");
    }

    #[test]
    fn a_light_on_a_surface_gives_a_finite_bound() {
        let touching = |scene: &mut Scene| scene.lights = vec![lamp(DVec3::X, 1.0, Falloff::InverseSquare)];
        assert_eq!(bounds_of(|_| {}, touching)[1], BOUNDLESS as f32);
        assert_eq!(bounds_of(|stone| stone.diffuse = DVec3::ZERO, touching)[1], 0.0);
    }

    #[test]
    fn fresnel_divides_what_a_classic_material_adds() {
        let glass = |fresnel: bool| {
            move |stone: &mut Material| {
                (stone.reflection, stone.transmission) = (DVec3::ONE, DVec3::ONE);
                (stone.fresnel, stone.ior) = (fresnel, 1.5);
            }
        };
        let white = |scene: &mut Scene| scene.background = Background::Color(DVec3::ONE);
        assert!(bounds_of(glass(true), white).iter().all(|&bound| bound == 1.0));
        assert_eq!(bounds_of(glass(false), white)[10], 1024.0);
    }
}
