//! One ray of the tree, in words.

use serde::Serialize;

use crate::kernel::material::fresnel;
use crate::layout::constants::{
    CHILD_REFLECTION, CHILD_REFRACTION, END_BACKGROUND, END_DEPTH, END_SURFACE, END_WEIGHT, RAY_PRIMARY,
    RAY_REFLECTION,
};
use crate::layout::{FlatScene, Material, TreeNode, View};

/// One ray of the tree.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Node {
    /// Its place in the order of tracing; the ray from the eye has 0.
    pub id: usize,
    /// The ray that it came from.
    pub parent: Option<usize>,
    /// "primary", "reflection" or "refraction".
    pub kind: &'static str,
    /// 0 for the ray from the eye.
    pub depth: u32,
    /// Where it starts.
    pub origin: [f32; 3],
    /// Unit direction.
    pub direction: [f32; 3],
    /// What its radiance counts for in the pixel, per channel.
    pub weight: [f32; 3],
    /// The medium that it starts in.
    pub medium: String,
    /// How it ended.
    pub end: End,
    /// What it added to the pixel itself, without its children.
    pub contribution: [f32; 3],
    /// What it met.
    pub hit: Option<Hit>,
}

/// How a ray ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// It met a surface from which rays go on.
    Surface,
    /// It met a surface that neither reflects nor transmits.
    Opaque,
    /// It met nothing and sees the background.
    Background,
    /// Not traced: deeper than `depth`. It takes the background.
    CutByDepth,
    /// Not traced: its weight is below the cut-off. It takes the background.
    CutByWeight,
    /// It met too many interfaces without effect.
    Stuck,
}

impl End {
    /// Why the ray ended, in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Surface => "goes on",
            Self::Opaque => "ends: opaque",
            Self::Background => "background",
            Self::CutByDepth => "cut: too deep",
            Self::CutByWeight => "cut: too faint",
            Self::Stuck => "cut: stuck between interfaces",
        }
    }

    /// Whether the ray was cut, and is not traced.
    #[must_use]
    pub fn is_untraced(self) -> bool {
        matches!(self, Self::CutByDepth | Self::CutByWeight)
    }
}

/// What a ray met.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Hit {
    /// World position.
    pub point: [f32; 3],
    /// Unit shading normal on the ray's side.
    pub normal: [f32; 3],
    /// Distance travelled.
    pub distance: f32,
    /// Primitive id.
    pub primitive: u32,
    /// The body's name.
    pub body: String,
    /// "outside" or "inside" of the body: where the ray comes from.
    pub side: &'static str,
    /// The surface's material.
    pub material: String,
    /// The medium that the ray comes through.
    pub before: String,
    /// The medium behind the surface.
    pub behind: String,
    /// Between ray and normal, in degrees.
    pub angle_deg: f64,
    /// Fresnel reflectance in f64 at that angle; `None` for a material of fixed weights.
    pub reflectance: Option<f64>,
    /// Total internal reflection.
    pub is_total: bool,
    /// What is left of the ray's weight after the medium's absorption.
    pub weight: [f32; 3],
    /// Shadow rays traced.
    pub shadow_rays: u32,
    /// Whether a reflected ray goes on.
    pub reflects: bool,
    /// Whether a refracted ray goes on.
    pub transmits: bool,
}

impl Node {
    /// Put names to what a device recorded.
    pub(super) fn new(
        id: usize,
        parent: Option<usize>,
        record: &TreeNode,
        scene: &FlatScene,
        view: &View,
    ) -> Self {
        let hit = (record.end == END_SURFACE).then(|| Hit::new(record, scene, view));
        let goes_on = hit.as_ref().is_some_and(|hit| hit.reflects || hit.transmits);
        Self {
            id,
            parent,
            kind: match record.kind {
                RAY_PRIMARY => "primary",
                RAY_REFLECTION => "reflection",
                _ => "refraction",
            },
            depth: record.depth,
            origin: record.origin,
            direction: record.direction,
            weight: record.weight,
            medium: name(scene, medium(view, record.media)),
            end: match record.end {
                END_SURFACE if goes_on => End::Surface,
                END_SURFACE => End::Opaque,
                END_BACKGROUND => End::Background,
                END_DEPTH => End::CutByDepth,
                END_WEIGHT => End::CutByWeight,
                _ => End::Stuck,
            },
            contribution: record.light,
            hit,
        }
    }

    /// The largest channel of its weight.
    #[must_use]
    pub fn greatest_weight(&self) -> f32 {
        self.weight.into_iter().fold(0.0, f32::max)
    }
}

impl Hit {
    fn new(record: &TreeNode, scene: &FlatScene, view: &View) -> Self {
        let face = scene.attributes.get(record.id as usize);
        let row = face.map_or(0, |face| face.material);
        let (before, behind) = (medium(view, record.media), medium(view, record.media_behind));
        let cosine = -dot(record.direction, record.normal).clamp(-1.0, 1.0);
        let material = scene.materials.get(row as usize).copied();
        let transmits = record.children & CHILD_REFRACTION != 0;
        let is_clear = material.is_some_and(|material| material.transmission != [0.0; 3]);
        // Opaque matter has its own index behind the face.
        let inner = if is_clear { behind } else { row };
        Self {
            point: record.point,
            normal: record.normal,
            distance: record.distance,
            primitive: record.id,
            body: scene.bodies.get(record.body as usize).map_or_else(String::new, |body| body.name.clone()),
            side: if record.front == 1 { "outside" } else { "inside" },
            material: name(scene, row),
            before: name(scene, before),
            behind: name(scene, behind),
            angle_deg: cosine.max(0.0).acos().to_degrees(),
            reflectance: material
                .filter(|material| material.fresnel != 0)
                .map(|_| fresnel(cosine.max(0.0), ior(scene, inner) / ior(scene, before)).reflectance),
            is_total: is_clear && !transmits,
            weight: record.arriving,
            shadow_rays: record.shadow_rays,
            reflects: record.children & CHILD_REFLECTION != 0,
            transmits,
        }
    }
}

/// The material of the medium of a mask: that of its lowest bit, as in [`crate::kernel::media`].
fn medium(view: &View, mask: u32) -> u32 {
    if mask == 0 {
        return 0;
    }
    let body = mask.trailing_zeros() as usize;
    view.media[body >> 2][body & 3]
}

fn name(scene: &FlatScene, material: u32) -> String {
    scene.material_names.get(material as usize).cloned().unwrap_or_default()
}

fn ior(scene: &FlatScene, material: u32) -> f64 {
    scene.materials.get(material as usize).map_or(1.0, |material: &Material| f64::from(material.ior))
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| f64::from(a) * f64::from(b)).sum()
}
