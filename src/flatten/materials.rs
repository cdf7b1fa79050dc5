//! The material table: the air, then every material that a face wears.

use super::number::{narrow, narrow3};
use super::texels::Texels;
use crate::layout::{Attribute, FlatTexture, Material};
use crate::scene::{self, MaterialId, Scene};

/// Which row of the table each material of the scene has.
pub(super) struct Rows {
    row: Vec<Option<u32>>,
    textured: Vec<bool>,
}

impl Rows {
    /// Give rows, from 1, to the materials that some triangle wears, in the scene's order: what is only
    /// defined must not turn effects on.
    pub(super) fn new(scene: &Scene) -> Self {
        let mut worn = vec![false; scene.materials.len()];
        for model in &scene.models {
            for triangle in &model.mesh.triangles {
                worn[model.materials[triangle.material as usize].0] = true;
            }
        }
        let mut rows = 1..;
        let row = worn.iter().map(|&worn| if worn { rows.next() } else { None }).collect();
        let textured = scene.materials.iter().map(|material| material.texture.is_some()).collect();
        Self { row, textured }
    }

    /// The row of a material; the air's where nothing wears it.
    pub(super) fn row(&self, id: MaterialId) -> u32 {
        self.row[id.0].unwrap_or(0)
    }

    /// Whether texture coordinates matter to a material.
    pub(super) fn is_textured(&self, id: MaterialId) -> bool {
        self.textured[id.0]
    }
}

/// The table and its names; textures are appended to the texels.
pub(super) fn table(scene: &Scene, rows: &Rows, texels: &mut Texels) -> (Vec<Material>, Vec<String>) {
    let worn = (0..).zip(&scene.materials).filter(|&(index, _)| rows.row(MaterialId(index)) > 0);
    let (materials, names): (Vec<_>, Vec<_>) = worn
        .map(|(_, material)| {
            let texture = material.texture.map(|id| texels.texture(scene, id));
            (record(material, texture), material.name.clone())
        })
        .unzip();
    ([&[AIR], materials.as_slice()].concat(), [&["air".to_owned()], names.as_slice()].concat())
}

/// Transparent, with no effect at all.
const AIR: Material = Material {
    ambient: [0.0; 3],
    ior: 1.0,
    diffuse: [0.0; 3],
    shininess: 0.0,
    specular: [0.0; 3],
    fresnel: 0,
    reflection: [0.0; 3],
    texture: Attribute::NONE,
    transmission: [1.0; 3],
    texture_width: 0,
    absorption: [0.0; 3],
    texture_height: 0,
};

/// Put changed materials in place of those of a table; false where one became transmissive, or ceased to be.
pub(super) fn revise(scene: &Scene, table: &mut [Material]) -> bool {
    let rows = Rows::new(scene);
    let changed =
        (0..).zip(&scene.materials).map(|(index, material)| (rows.row(MaterialId(index)), material));
    for (row, material) in changed.filter(|&(row, _)| row > 0) {
        let Some(before) = table.get_mut(row as usize) else { return false };
        if (before.transmission != [0.0; 3]) != material.is_transmissive() {
            return false;
        }
        let Material { texture: first, texture_width: width, texture_height: height, .. } = *before;
        let texture = material.texture.map(|_| FlatTexture { first, width, height });
        *before = record(material, texture);
    }
    true
}

fn record(material: &scene::Material, texture: Option<FlatTexture>) -> Material {
    Material {
        ambient: narrow3(material.ambient),
        ior: narrow(material.ior),
        diffuse: narrow3(material.diffuse),
        shininess: narrow(material.shininess),
        specular: narrow3(material.specular),
        fresnel: u32::from(material.fresnel),
        reflection: narrow3(material.reflection),
        texture: texture.map_or(Attribute::NONE, |texture| texture.first),
        transmission: narrow3(material.transmission),
        texture_width: texture.map_or(0, |texture| texture.width),
        absorption: narrow3(material.absorption),
        texture_height: texture.map_or(0, |texture| texture.height),
    }
}
