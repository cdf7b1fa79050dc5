//! What `check` finds, as `--json` prints it.

use serde::Serialize;

use super::super::prepare::Prepared;
use crate::bvh;
use crate::layout::{self, Aov, Effects, FlatScene, Settings, Texel};
use crate::scene::{self, Background, Falloff, Scene};

#[derive(Serialize)]
pub(super) struct Report {
    pub(super) scene: String,
    pub(super) triangles: usize,
    pub(super) bodies: Vec<Body>,
    /// What light passes through.
    pub(super) media: Vec<Medium>,
    pub(super) lights: Vec<Light>,
    pub(super) textures: Vec<Texture>,
    /// "color", "gradient" or "image".
    pub(super) background: &'static str,
    pub(super) buffers: Vec<Buffer>,
    pub(super) bvh: Bvh,
    pub(super) effects: Vec<Effect>,
    pub(super) numbers: Vec<Number>,
    /// As they are shown to a person, several lines each.
    pub(super) warnings: Vec<String>,
}

#[derive(Serialize)]
pub(super) struct Body {
    pub(super) name: String,
    /// Higher wins where bodies overlap.
    pub(super) priority: i32,
    pub(super) material: String,
    pub(super) transmissive: bool,
    pub(super) triangles: u32,
}

#[derive(Serialize)]
pub(super) struct Medium {
    pub(super) name: String,
    pub(super) fresnel: bool,
    pub(super) ior: f64,
    /// Per scene unit and channel.
    pub(super) absorption: [f64; 3],
}

#[derive(Serialize)]
pub(super) struct Light {
    pub(super) position: [f64; 3],
    /// Linear RGB.
    pub(super) intensity: [f64; 3],
    pub(super) falloff: &'static str,
}

#[derive(Serialize)]
pub(super) struct Texture {
    pub(super) path: String,
    pub(super) size: [u32; 2],
}

#[derive(Serialize)]
pub(super) struct Buffer {
    pub(super) name: &'static str,
    pub(super) bytes: u64,
}

#[derive(Serialize)]
pub(super) struct Bvh {
    pub(super) nodes: usize,
    pub(super) depth: u32,
}

#[derive(Serialize)]
pub(super) struct Effect {
    pub(super) name: &'static str,
    pub(super) on: bool,
    pub(super) reason: String,
}

#[derive(Serialize)]
pub(super) struct Number {
    pub(super) name: &'static str,
    pub(super) value: u32,
    pub(super) reason: String,
}

impl Report {
    pub(super) fn new(prepared: &Prepared) -> Self {
        let (scene, flat) = (&prepared.scene, &prepared.flat.scene);
        let called_for = called_for(scene, flat);
        let media = scene.materials.iter().filter(|material| material.is_transmissive());
        Self {
            scene: scene.source.display().to_string(),
            triangles: flat.triangles.len(),
            bodies: flat.bodies.iter().map(|body| Body::new(body, &flat.material_names)).collect(),
            media: media.map(Medium::new).collect(),
            lights: scene.lights.iter().map(Light::new).collect(),
            textures: scene.textures.iter().map(Texture::new).collect(),
            background: match scene.background {
                Background::Color(_) => "color",
                Background::Gradient { .. } => "gradient",
                Background::Image { .. } => "image",
            },
            buffers: buffers(flat, scene.render.size),
            bvh: Bvh { nodes: flat.nodes.len(), depth: flat.bvh_depth },
            effects: called_for.findings().iter().map(Effect::new).collect(),
            numbers: called_for.numbers().named().into_iter().map(Number::new).collect(),
            warnings: prepared.warnings().map(|warning| warning.render(false)).collect(),
        }
    }
}

impl Body {
    fn new(body: &layout::Body, materials: &[String]) -> Self {
        Self {
            name: body.name.clone(),
            priority: body.priority,
            material: materials.get(body.material as usize).cloned().unwrap_or_default(),
            transmissive: body.transmissive,
            triangles: body.triangles,
        }
    }
}

impl Medium {
    fn new(material: &scene::Material) -> Self {
        Self {
            name: material.name.clone(),
            fresnel: material.fresnel,
            ior: material.ior,
            absorption: material.absorption.to_array(),
        }
    }
}

impl Light {
    fn new(light: &scene::Light) -> Self {
        Self {
            position: light.position.to_array(),
            intensity: light.intensity.to_array(),
            falloff: match light.falloff {
                Falloff::None => "none",
                Falloff::InverseSquare => "inverse-square",
            },
        }
    }
}

impl Texture {
    fn new(texture: &scene::Texture) -> Self {
        Self { path: texture.path.display().to_string(), size: [texture.width, texture.height] }
    }
}

impl Effect {
    fn new(finding: &layout::Finding) -> Self {
        Self { name: finding.effect.name(), on: finding.on, reason: finding.reason.clone() }
    }
}

impl Number {
    fn new((name, number): (&'static str, &layout::Number)) -> Self {
        Self { name, value: number.value, reason: number.reason.clone() }
    }
}

/// Bytes of every storage buffer; the film's for the scene's own picture size, AOVs only where asked for.
fn buffers(flat: &FlatScene, [width, height]: [u32; 2]) -> Vec<Buffer> {
    let pixels = u64::from(width) * u64::from(height);
    let packed = bvh::pack(&flat.nodes, &flat.triangles);
    let sized = [
        ("nodes", size_of_val(packed.nodes.as_slice()) as u64),
        ("triangles", size_of_val(&*flat.triangles) as u64),
        ("attributes", size_of_val(&*flat.attributes) as u64),
        ("texture coordinates", size_of_val(&*flat.uvs) as u64),
        ("materials", size_of_val(flat.materials.as_slice()) as u64),
        ("lights", size_of_val(flat.lights.as_slice()) as u64),
        ("texels", size_of_val(&*flat.texels) as u64),
        ("film", pixels * size_of::<Texel>() as u64),
        ("film with AOVs", pixels * (size_of::<Texel>() + size_of::<Aov>()) as u64),
    ];
    sized.into_iter().map(|(name, bytes)| Buffer { name, bytes }).collect()
}

/// What a render without flags calls for.
fn called_for(scene: &Scene, flat: &FlatScene) -> Effects {
    let scene::RenderDefaults { depth, cutoff, samples, .. } = scene.render;
    Effects::of(flat, &Settings { depth, cutoff: cutoff as f32, samples, ..Settings::default() })
}
