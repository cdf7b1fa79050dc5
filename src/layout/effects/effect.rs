//! The parts of the light transport, and which of them need others.

use std::fmt;

/// A part of the light transport that a scene may do without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Rays towards lights. Without it every light is seen from everywhere.
    Shadows,
    /// Shadow rays go on through transmissive bodies. Without it every blocker is opaque.
    TintedShadows,
    /// The term ks·(s·r)^β.
    Specular,
    /// Reflected rays.
    Reflection,
    /// Refracted rays. Without it everything is opaque.
    Transmission,
    /// Weights by Fresnel's equations. Without it kr and kt count as they are.
    Fresnel,
    /// Beer–Lambert attenuation.
    Absorption,
    /// Bodies that overlap, touch or hold each other: a list of interiors, and interfaces of two bodies. Without it a ray
    /// is in the body that it entered last, or in the air.
    NestedMedia,
    /// Interpolated shading normals or texture coordinates.
    SmoothNormals,
    /// Diffuse textures.
    Textures,
    /// A background picture.
    Environment,
    /// Inverse-square falloff.
    Falloff,
    /// More than one sample a pixel.
    Antialiasing,
    /// More samples for some pixels than for others. Without it all have the same number.
    Adaptive,
    /// Auxiliary pictures.
    Aovs,
}

impl Effect {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 15] = [
        Self::Shadows,
        Self::TintedShadows,
        Self::Specular,
        Self::Reflection,
        Self::Transmission,
        Self::Fresnel,
        Self::Absorption,
        Self::NestedMedia,
        Self::SmoothNormals,
        Self::Textures,
        Self::Environment,
        Self::Falloff,
        Self::Antialiasing,
        Self::Adaptive,
        Self::Aovs,
    ];

    /// The name on the command line and in JSON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Shadows => "shadows",
            Self::TintedShadows => "tinted-shadows",
            Self::Specular => "specular",
            Self::Reflection => "reflection",
            Self::Transmission => "transmission",
            Self::Fresnel => "fresnel",
            Self::Absorption => "absorption",
            Self::NestedMedia => "nested-media",
            Self::SmoothNormals => "smooth-normals",
            Self::Textures => "textures",
            Self::Environment => "environment",
            Self::Falloff => "falloff",
            Self::Antialiasing => "antialiasing",
            Self::Adaptive => "adaptive",
            Self::Aovs => "aovs",
        }
    }

    /// The effects without which this one means nothing.
    #[must_use]
    pub const fn needs(self) -> &'static [Self] {
        match self {
            Self::TintedShadows => &[Self::Shadows, Self::Transmission],
            Self::Absorption | Self::NestedMedia => &[Self::Transmission],
            Self::Textures => &[Self::SmoothNormals],
            Self::Adaptive => &[Self::Antialiasing],
            _ => &[],
        }
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
