//! The scene file as it is written: one struct for each table, checked key by key by serde.
//!
//! `docs/scenes.md` describes the format to its users: a new key goes there too. What depends on several keys,
//! or on other files, is checked where a table is turned into its part of the scene.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::color::Color;
use super::normals::NormalsKey;
use super::number::{AboveZero, Any, NotNegative, Number, Unit, Vector, ViewAngle, Whole, Wholes};
use super::table::Table;
use super::triple::Triple;

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document {
    /// Without it the models are framed.
    pub(super) camera: Option<Spanned<Table<CameraTable>>>,
    #[serde(default)]
    pub(super) render: Table<RenderTable>,
    pub(super) ambient: Option<Table<AmbientTable>>,
    /// Without it everything behind the scene is black.
    pub(super) background: Option<Spanned<Table<BackgroundTable>>>,
    #[serde(default)]
    pub(super) light: Vec<Table<LightTable>>,
    #[serde(default)]
    pub(super) material: BTreeMap<Spanned<String>, Table<MaterialTable>>,
    #[serde(default)]
    pub(super) model: Vec<Spanned<Table<ModelTable>>>,
}

/// `[camera]`: `target` (and `up`), or all of `right`, `up` and `forward`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraTable {
    pub(super) eye: Vector<3>,
    pub(super) target: Option<Spanned<Vector<3>>>,
    /// Default +Y.
    pub(super) up: Option<Spanned<Vector<3>>>,
    pub(super) right: Option<Spanned<Vector<3>>>,
    pub(super) forward: Option<Spanned<Vector<3>>>,
    /// Degrees.
    #[serde(default = "default_fov")]
    pub(super) fov_y: Number<ViewAngle>,
}

/// Vertical field of view in degrees where none is given.
pub(super) const DEFAULT_FOV_Y: f64 = 35.0;

fn default_fov() -> Number<ViewAngle> {
    Number::literal(DEFAULT_FOV_Y)
}

/// `[render]`: defaults in [`super::RenderDefaults`].
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RenderTable {
    /// Pixels.
    pub(super) size: Option<Wholes<2, 1, 16384>>,
    pub(super) depth: Option<Whole<0, 64>>,
    pub(super) cutoff: Option<Number<Unit>>,
    pub(super) samples: Option<Whole<1, 65536>>,
    pub(super) adaptive: Option<Number<Unit>>,
}

/// `[ambient]`: Ia is `color` × `intensity`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AmbientTable {
    #[serde(default = "white")]
    pub(super) color: Color,
    #[serde(default = "one")]
    pub(super) intensity: Number<NotNegative>,
}

/// `[background]`: `color`, or `zenith` and `horizon`, or `image`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BackgroundTable {
    pub(super) color: Option<Color>,
    pub(super) zenith: Option<Color>,
    pub(super) horizon: Option<Color>,
    pub(super) image: Option<Spanned<String>>,
    /// Degrees about +Y; of an image only.
    pub(super) rotation_y: Option<Spanned<Number>>,
    #[serde(default = "one")]
    pub(super) intensity: Number<NotNegative>,
}

/// `[[light]]`: Ij is `color` × `intensity`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightTable {
    pub(super) position: Vector<3>,
    #[serde(default = "white")]
    pub(super) color: Color,
    #[serde(default = "one")]
    pub(super) intensity: Number<NotNegative>,
    #[serde(default)]
    pub(super) falloff: FalloffKey,
}

/// `falloff` of a light.
#[derive(Debug, Default, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum FalloffKey {
    #[default]
    None,
    InverseSquare,
}

/// `[material.NAME]`: what is left out has no effect, but for `ior`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialTable {
    /// ka.
    pub(super) ambient: Option<Table<AmbientTerm>>,
    /// kd.
    pub(super) diffuse: Option<Table<DiffuseTerm>>,
    /// ks.
    pub(super) specular: Option<Table<SpecularTerm>>,
    /// kr, for all channels or each.
    #[serde(default)]
    pub(super) reflection: Triple<NotNegative>,
    /// kt, for all channels or each.
    #[serde(default)]
    pub(super) transmission: Triple<NotNegative>,
    #[serde(default)]
    pub(super) fresnel: bool,
    #[serde(default = "default_ior")]
    pub(super) ior: Number<AboveZero>,
    /// σ per scene unit, for all channels or each.
    #[serde(default)]
    pub(super) absorption: Triple<NotNegative>,
}

/// Refractive index where none is given: glass, so that `fresnel = true` alone already shows.
pub(super) const DEFAULT_IOR: f64 = 1.5;
/// β where none is given.
pub(super) const DEFAULT_SHININESS: f64 = 32.0;

fn default_ior() -> Number<AboveZero> {
    Number::literal(DEFAULT_IOR)
}

fn default_shininess() -> Number<NotNegative> {
    Number::literal(DEFAULT_SHININESS)
}

/// `ambient` of a material.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AmbientTerm {
    #[serde(default = "white")]
    pub(super) color: Color,
    #[serde(default = "one")]
    pub(super) k: Number<NotNegative>,
}

/// `diffuse` of a material.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DiffuseTerm {
    #[serde(default = "white")]
    pub(super) color: Color,
    #[serde(default = "one")]
    pub(super) k: Number<NotNegative>,
    /// Multiplies the ambient and the diffuse colour.
    pub(super) texture: Option<Spanned<String>>,
}

/// `specular` of a material.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SpecularTerm {
    #[serde(default = "white")]
    pub(super) color: Color,
    #[serde(default = "one")]
    pub(super) k: Number<NotNegative>,
    #[serde(default = "default_shininess")]
    pub(super) shininess: Number<NotNegative>,
}

/// `[[model]]`: `mesh` or `shape`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ModelTable {
    pub(super) mesh: Option<Spanned<String>>,
    pub(super) shape: Option<Spanned<Shape>>,
    /// May be left out where the mesh names an MTL.
    pub(super) material: Option<Spanned<String>>,
    #[serde(default)]
    pub(super) priority: i32,
    #[serde(default = "unit_scale")]
    pub(super) scale: Triple<AboveZero>,
    /// Degrees about x, then y, then z.
    #[serde(default = "no_offset")]
    pub(super) rotate: Vector<3>,
    #[serde(default = "no_offset")]
    pub(super) translate: Vector<3>,
    #[serde(default)]
    pub(super) normals: NormalsKey,
    pub(super) repeat: Option<Spanned<Table<RepeatTable>>>,
}

/// `repeat` of a model.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RepeatTable {
    pub(super) count: Wholes<3, 1, 1_000_000>,
    pub(super) step: Vector<3>,
}

/// `shape` of a model: centred on the origin, closed (but for the plane), outward.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Shape {
    Sphere(Table<SphereTable>),
    Box(Table<BoxTable>),
    RoundedBox(Table<RoundedBoxTable>),
    Plane(Table<PlaneTable>),
    Cylinder(Table<CylinderTable>),
    Torus(Table<TorusTable>),
}

/// `sphere`: 8·4^`level` triangles, poles on the y axis.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereTable {
    pub(super) radius: Number<AboveZero>,
    #[serde(default = "level::<5, 9>")]
    pub(super) level: Whole<0, 9>,
}

/// `box`: 12 triangles.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BoxTable {
    pub(super) size: Vector<3, AboveZero>,
}

/// `rounded_box`: 12·(2·2^`level` + 1)² triangles.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RoundedBoxTable {
    pub(super) size: Vector<3, AboveZero>,
    /// Of the edges and corners; below half of the least size.
    pub(super) radius: Number<AboveZero>,
    #[serde(default = "level::<3, 7>")]
    pub(super) level: Whole<0, 7>,
}

/// `plane`: 2 triangles at y = 0, facing up; of an opaque material only, for it bounds no matter.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneTable {
    /// Along x and z.
    pub(super) size: Vector<2, AboveZero>,
    /// How often the texture repeats along x and z.
    #[serde(default = "once")]
    pub(super) uv_repeat: Vector<2, AboveZero>,
}

/// `cylinder`: 16·2^`level` triangles, its axis along y.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CylinderTable {
    pub(super) radius: Number<AboveZero>,
    pub(super) height: Number<AboveZero>,
    #[serde(default = "level::<5, 14>")]
    pub(super) level: Whole<0, 14>,
}

/// `torus`: 64·4^`level` triangles, its axis along y.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TorusTable {
    /// From the centre to the middle of the tube.
    pub(super) major: Number<AboveZero>,
    /// Of the tube; below `major`.
    pub(super) minor: Number<AboveZero>,
    #[serde(default = "level::<4, 7>")]
    pub(super) level: Whole<0, 7>,
}

fn level<const DEFAULT: u32, const MAX: u32>() -> Whole<0, MAX> {
    Whole(DEFAULT)
}

fn white() -> Color {
    Color::WHITE
}

fn one() -> Number<NotNegative> {
    Number::literal(1.0)
}

fn once() -> Vector<2, AboveZero> {
    Vector([Number::literal(1.0); 2])
}

fn unit_scale() -> Triple<AboveZero> {
    Triple::splat(1.0)
}

fn no_offset() -> Vector<3, Any> {
    Vector([Number::literal(0.0); 3])
}
