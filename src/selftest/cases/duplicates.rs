//! T14: of faces in the same place one is met, whichever way the work is done.
//!
//! Two equal faces are hit at the same distance, bit for bit, and ties go to the lowest primitive id: copies behind the
//! originals never show. The bound is 0 pixels, for any rounding.
//!
//! Copies in a scene are merged before a device sees them, and so are those of two bodies that coincide. Others are put
//! among the flattened triangles, where only the device's own rule for ties keeps them from showing.

use glam::DVec3;

use crate::bvh;
use crate::layout::{FlatScene, Texel, Triangle};
use crate::scene::{Diagnostic, Falloff, Light, Material, MaterialId, Mesh, Model, Scene, SceneError};
use crate::selftest::{Bound, Case, Device, DeviceError, Effort, Finding, Random, Stage, solids};

/// Duplicated faces.
pub(super) const T14: Case = Case {
    id: "T14",
    title: "duplicated faces never show",
    claim: "where every face is there twice the lower primitive id wins: the picture is that of the mesh without copies, \
            however the work is shared out",
    run: duplicates,
};

/// Where the copies are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Copies {
    Nowhere,
    /// In the scene: flattening merges them.
    InScene,
    /// Among the flattened triangles: every device meets them.
    InFlatScene,
}

fn duplicates(device: &mut dyn Device, effort: Effort) -> Result<Vec<Finding>, DeviceError> {
    let size = match effort {
        Effort::Quick => [24, 18],
        Effort::Short => [64, 48],
        Effort::Long => [256, 192],
    };
    let mut findings = Vec::new();
    for (name, transmissive) in [("painted ball", false), ("ball of ice", true)] {
        let plain = stage(size, transmissive, Copies::Nowhere)?;
        let reference = device.picture(&plain, &plain.settings)?;
        for (place, copies) in [("scene", Copies::InScene), ("flat scene", Copies::InFlatScene)] {
            let double = stage(size, transmissive, copies)?;
            for (way, picture) in device.shared_out(&double, &double.settings)? {
                let pixels = reference.texels.iter().zip(&picture.texels);
                let differing = pixels.filter(|(a, b)| seen(a) != seen(b)).count();
                findings.push(Finding {
                    what: format!("pixels of the {name} that show copies in the {place}, {way}"),
                    figure: differing as f64,
                    bound: Bound::AtMost(0.0),
                    trials: picture.texels.len() as u64,
                });
            }
        }
    }
    Ok(findings)
}

/// Bits of the colour, and which primitives were met. (The number of a body behind the copy is another one.)
fn seen(texel: &Texel) -> ([u32; 3], u32) {
    (texel.radiance.map(f32::to_bits), texel.primitive_hash)
}

/// A bumpy ball over a mirror, under a lamp. Copies of an opaque mesh's faces are faces of it, in random order; the copy
/// of a transmissive one, which must be closed, is a second body.
fn stage(size: [u32; 2], transmissive: bool, copies: Copies) -> Result<Stage, DeviceError> {
    let is_double = copies == Copies::InScene;
    let mesh = solids::jittered_sphere(12, &mut Random::new("duplicates"));
    let paint = Material {
        diffuse: DVec3::new(0.7, 0.5, 0.3),
        specular: DVec3::splat(0.3),
        shininess: 20.0,
        reflection: DVec3::splat(0.2),
        ..Material::black("paint")
    };
    let mirror = Material { reflection: DVec3::splat(0.9), ..Material::black("mirror") };
    let worn = MaterialId(usize::from(transmissive));
    let ball = Model::of("ball", if is_double && !transmissive { doubled(mesh.clone()) } else { mesh }, worn);
    let ground = Mesh::cuboid(DVec3::new(-9.0, -2.0, -9.0), DVec3::new(9.0, -1.2, 9.0));
    let mut models = vec![ball.clone(), Model::of("ground", ground, MaterialId(2))];
    if is_double && transmissive {
        models.push(Model { name: "copy".into(), ..ball });
    }
    let mut scene = Scene::of(vec![paint, Material::clear("ice", 1.31), mirror], models);
    (scene.render.size, scene.render.samples, scene.render.depth) = (size, 1, 6);
    scene.background = crate::scene::Background::Color(DVec3::new(0.2, 0.3, 0.5));
    scene.lights.push(Light {
        position: DVec3::new(3.0, 5.0, 4.0),
        intensity: DVec3::ONE,
        falloff: Falloff::None,
    });
    let stage = Stage::new(&scene)?;
    if copies != Copies::InFlatScene {
        return Ok(stage);
    }
    Ok(Stage { flat: doubled_flat(stage.flat)?, ..stage })
}

/// Every face once more, behind all the others, in another order.
fn doubled(mut mesh: Mesh) -> Mesh {
    let mut copies = mesh.triangles.clone();
    shuffle(&mut copies);
    mesh.triangles.extend(copies);
    mesh
}

/// Every triangle once more, with a higher id, in a tree in which either of two may come first.
fn doubled_flat(flat: FlatScene) -> Result<FlatScene, SceneError> {
    let count = flat.attributes.len() as u32;
    let copies = flat.triangles.iter().map(|triangle| Triangle { id: triangle.id + count, ..*triangle });
    let mut triangles: Vec<_> = flat.triangles.iter().copied().chain(copies).collect();
    shuffle(&mut triangles);
    let tree =
        bvh::build(&triangles, bvh::Preset::default()).map_err(|e| Diagnostic::error(e.to_string()))?;
    Ok(FlatScene {
        triangles: tree.order.iter().map(|&index| triangles[index as usize]).collect(),
        nodes: tree.nodes.into(),
        bvh_depth: tree.depth,
        attributes: flat.attributes.repeat(2).into(),
        ..flat
    })
}

/// Put them in an order that is the same for ever (Fisher and Yates).
fn shuffle<T>(items: &mut [T]) {
    let mut random = Random::new("copies");
    for last in (1..items.len()).rev() {
        items.swap(last, random.below(last as u32 + 1) as usize);
    }
}
