//! What an MTL material means: its illumination model in the terms of a Whitted [`Material`].
//!
//! | illum | local light | kr | kt | Fresnel |
//! |---|---|---|---|---|
//! | 0 | none: Kd, constant under the ambient light | 0 | 0 | |
//! | 1 | Ka, Kd | 0 | 0 | |
//! | 2 (default), 8, 10 | Ka, Kd, Ks | 0 | 0 | |
//! | 3 | Ka, Kd, Ks | Ks | 0 | no |
//! | 4 | Ka, Kd, Ks | Ks | (1 − d)·Tf | no |
//! | 5 | Ka, Kd, Ks | Ks | 0 | yes |
//! | 6 | Ka, Kd, Ks | Ks | (1 − Ks)·t·Tf | no |
//! | 7 | Ka, Kd, Ks | Ks | t·Tf | yes |
//! | 9 | Ka, Kd, Ks | 0 | (1 − d)·Tf | no |
//!
//! t is 1 − d where d (or Tr) makes the material less than fully there, else 1, for most writers leave d at 1
//! where they mean glass. The specification approximates Fresnel's reflectance by Ks; here it comes from Ni,
//! so that (1 − Ks) of model 7 is left to it. Models 8 and 9 are 3 and 4 without rays for reflections. The
//! invisible shadow catcher 10 is shown as 2. Silent statements: Ka, Kd, Ks black (Kd white under map_Kd),
//! Tf white, d 1, Ns 32, Ni 1 (1.5 in models 5 and 7, where 1 would reflect nothing).

use glam::DVec3;

use super::document::{DEFAULT_IOR, DEFAULT_SHININESS};
use super::mtl::Mtl;
use super::{Material, TextureId};

/// The material of an MTL's statements.
pub(super) fn material(mtl: &Mtl, texture: Option<TextureId>) -> Material {
    let model = mtl.illumination.unwrap_or(2);
    let [ambient, diffuse, specular] = local(mtl, model);
    let fresnel = matches!(model, 5 | 7);
    Material {
        name: mtl.name.clone(),
        ambient,
        diffuse,
        texture,
        specular,
        shininess: mtl.shininess.unwrap_or(DEFAULT_SHININESS),
        reflection: if matches!(model, 3..=7) { mtl.specular.unwrap_or_default() } else { DVec3::ZERO },
        transmission: transmission(mtl, model),
        fresnel,
        ior: mtl.ior.unwrap_or(if fresnel { DEFAULT_IOR } else { 1.0 }),
        absorption: DVec3::ZERO,
    }
}

/// Whether the file asks for transparency that its illumination model does not have.
pub(super) fn ignores_dissolve(mtl: &Mtl) -> bool {
    mtl.dissolve.is_some_and(|dissolve| dissolve < 1.0)
        && transmission(mtl, mtl.illumination.unwrap_or(2)) == DVec3::ZERO
}

/// Ambient, diffuse and specular colour.
fn local(mtl: &Mtl, model: u8) -> [DVec3; 3] {
    let [ambient, specular] = [mtl.ambient, mtl.specular].map(Option::unwrap_or_default);
    let untold = if mtl.texture.is_some() { DVec3::ONE } else { DVec3::ZERO };
    let diffuse = mtl.diffuse.unwrap_or(untold);
    match model {
        0 => [diffuse, DVec3::ZERO, DVec3::ZERO],
        1 => [ambient, diffuse, DVec3::ZERO],
        _ => [ambient, diffuse, specular],
    }
}

/// kt.
fn transmission(mtl: &Mtl, model: u8) -> DVec3 {
    let filter = mtl.filter.unwrap_or(DVec3::ONE);
    let transparency = 1.0 - mtl.dissolve.unwrap_or(1.0);
    let glass = if transparency > 0.0 { transparency } else { 1.0 };
    match model {
        4 | 9 => transparency * filter,
        6 => (DVec3::ONE - mtl.specular.unwrap_or_default()).max(DVec3::ZERO) * glass * filter,
        7 => glass * filter,
        _ => DVec3::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Location;
    use crate::scene::statement::Reference;

    fn with(illumination: u8, dissolve: Option<f64>) -> Material {
        let mtl = Mtl {
            ambient: Some(DVec3::splat(0.1)),
            diffuse: Some(DVec3::splat(0.2)),
            specular: Some(DVec3::splat(0.25)),
            filter: Some(DVec3::new(1.0, 0.5, 0.0)),
            illumination: Some(illumination),
            dissolve,
            ..Mtl::default()
        };
        material(&mtl, None)
    }

    #[test]
    fn every_model_follows_the_table() {
        let (ks, none) = (0.25, 0.0);
        for (model, reflection, transmission, fresnel) in [
            (0, none, none, false),
            (1, none, none, false),
            (2, none, none, false),
            (3, ks, none, false),
            (4, ks, 0.5, false),
            (5, ks, none, true),
            (6, ks, 0.375, false),
            (7, ks, 0.5, true),
            (8, none, none, false),
            (9, none, 0.5, false),
            (10, none, none, false),
        ] {
            let material = with(model, Some(0.5));
            assert_eq!(material.reflection, DVec3::splat(reflection), "illum {model}");
            assert_eq!(material.transmission, transmission * DVec3::new(1.0, 0.5, 0.0), "illum {model}");
            assert_eq!(material.fresnel, fresnel, "illum {model}");
        }
    }

    #[test]
    fn local_light_follows_the_table() {
        let (ka, kd, ks, none) = (DVec3::splat(0.1), DVec3::splat(0.2), DVec3::splat(0.25), DVec3::ZERO);
        for (model, expected) in
            [(0, [kd, none, none]), (1, [ka, kd, none]), (2, [ka, kd, ks]), (7, [ka, kd, ks])]
        {
            let material = with(model, None);
            assert_eq!([material.ambient, material.diffuse, material.specular], expected, "illum {model}");
        }
    }

    #[test]
    fn glass_need_not_be_dissolved_but_dissolving_it_counts() {
        for dissolve in [None, Some(1.0)] {
            assert_eq!(with(7, dissolve).transmission.x, 1.0);
            assert_eq!(with(4, dissolve).transmission.x, 0.0);
        }
        assert_eq!(with(7, Some(0.75)).transmission.x, 0.25);
    }

    #[test]
    fn silent_statements_have_their_defaults() {
        let material = material(&Mtl::default(), None);
        assert_eq!((material.ior, material.shininess, material.diffuse), (1.0, 32.0, DVec3::ZERO));
        assert_eq!(with(5, None).ior, 1.5);
    }

    #[test]
    fn a_texture_without_a_colour_shows_as_it_is() {
        let location = Location { file: "a.mtl".into(), line: 1, column: 1, length: 1, text: String::new() };
        let texture = Some(Reference { name: "a.png".into(), location });
        let mtl = Mtl { texture, ..Mtl::default() };
        assert_eq!(material(&mtl, None).diffuse, DVec3::ONE);
        assert_eq!(material(&Mtl { diffuse: Some(DVec3::X), ..mtl }, None).diffuse, DVec3::X);
    }

    #[test]
    fn transparency_of_an_opaque_model_is_noticed() {
        let mtl = |illumination| Mtl { dissolve: Some(0.5), illumination, ..Mtl::default() };
        assert!(ignores_dissolve(&mtl(None)) && ignores_dissolve(&mtl(Some(2))));
        assert!(!ignores_dissolve(&mtl(Some(4))) && !ignores_dissolve(&Mtl::default()));
    }
}
