//! What a scene calls for: each effect is on or off, with a reason that a person can read.

use std::fmt;

use super::{Attribute, FlatScene, Settings};

/// A part of the light transport that a scene may do without.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Rays towards lights.
    Shadows,
    /// Shadow rays go on through transmissive bodies.
    TintedShadows,
    /// The term ks·(s·r)^β.
    Specular,
    /// Reflected rays.
    Reflection,
    /// Refracted rays.
    Transmission,
    /// Weights by Fresnel's equations.
    Fresnel,
    /// Beer–Lambert attenuation.
    Absorption,
    /// More than one transmissive body: a list of interiors.
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
    /// More samples for some pixels than for others.
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
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Whether an effect is called for, and by what.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The effect.
    pub effect: Effect,
    /// Whether the scene or the settings call for it.
    pub on: bool,
    /// What does, or that nothing does.
    pub reason: String,
}

/// What a scene and its settings call for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Effects {
    findings: Vec<Finding>,
}

impl Effects {
    /// Scan a scene.
    #[must_use]
    pub fn of(scene: &FlatScene, settings: &Settings) -> Self {
        let scan = Scan::new(scene);
        let findings = Effect::ALL
            .into_iter()
            .map(|effect| match scan.cause(effect, settings) {
                Ok(reason) => Finding { effect, on: true, reason },
                Err(reason) => Finding { effect, on: false, reason: reason.to_owned() },
            })
            .collect();
        Self { findings }
    }

    /// Every effect, on or off, in the order of [`Effect::ALL`].
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// The effects that are on.
    pub fn on(&self) -> impl Iterator<Item = Effect> + '_ {
        self.findings.iter().filter(|f| f.on).map(|f| f.effect)
    }

    /// Whether an effect is on.
    #[must_use]
    pub fn has(&self, effect: Effect) -> bool {
        self.on().any(|e| e == effect)
    }
}

/// The scene with the materials that its faces really use.
struct Scan<'a> {
    scene: &'a FlatScene,
    used: Vec<usize>,
}

impl<'a> Scan<'a> {
    fn new(scene: &'a FlatScene) -> Self {
        let mut used = vec![false; scene.materials.len()];
        for face in &scene.attributes {
            used[face.material as usize] = true;
        }
        let used = used.iter().enumerate().filter_map(|(i, &u)| u.then_some(i)).collect();
        Self { scene, used }
    }

    /// What turns an effect on, or why it is off.
    fn cause(&self, effect: Effect, settings: &Settings) -> Result<String, &'static str> {
        let scene = self.scene;
        match effect {
            Effect::Shadows => {
                if scene.lights.is_empty() {
                    return Err("there is no light");
                }
                self.material(|i| {
                    let m = &scene.materials[i];
                    shines(m.diffuse) || shines(m.specular)
                })
                .map(|name| format!("{} and {name} is lit by it", count(scene.lights.len(), "light")))
                .ok_or("no material has a diffuse or specular colour")
            }
            Effect::TintedShadows => {
                if self.cause(Effect::Shadows, settings).is_err() {
                    return Err("there are no shadows");
                }
                self.transmissive()
                    .map(|name| format!("{name} lets light through"))
                    .ok_or("every blocker is opaque")
            }
            Effect::Specular => {
                if scene.lights.is_empty() {
                    return Err("there is no light");
                }
                self.material(|i| shines(scene.materials[i].specular))
                    .map(|name| format!("{name} has a specular colour"))
                    .ok_or("no material has a specular colour")
            }
            Effect::Reflection => self
                .material(|i| {
                    let m = &scene.materials[i];
                    shines(m.reflection) || (shines(m.transmission) && m.fresnel == 0)
                })
                .map(|name| format!("{name} reflects"))
                .ok_or("no material reflects"),
            Effect::Transmission => {
                self.transmissive().map(|name| format!("{name} transmits")).ok_or("no material transmits")
            }
            Effect::Fresnel => self
                .material(|i| {
                    let m = &scene.materials[i];
                    m.fresnel != 0 && (shines(m.reflection) || shines(m.transmission))
                })
                .map(|name| format!("{name} is weighted by Fresnel's equations"))
                .ok_or("no reflecting or transmitting material asks for it"),
            Effect::Absorption => self
                .material(|i| {
                    let m = &scene.materials[i];
                    shines(m.absorption) && shines(m.transmission)
                })
                .map(|name| format!("{name} absorbs"))
                .ok_or("no medium absorbs"),
            Effect::NestedMedia => match scene.transmissive_bodies {
                0 => Err("no body transmits"),
                1 => Err("only one body transmits"),
                n => Ok(format!("{n} bodies transmit and may overlap or touch")),
            },
            Effect::SmoothNormals => scene
                .attributes
                .iter()
                .find(|face| face.corners != Attribute::NONE)
                .map(|face| {
                    format!("{} has interpolated normals or texture coordinates", self.body(face.body))
                })
                .ok_or("every face is flat and untextured"),
            Effect::Textures => self
                .material(|i| scene.materials[i].texture != Attribute::NONE)
                .map(|name| format!("{name} has a texture"))
                .ok_or("no material has a texture"),
            Effect::Environment => match scene.environment {
                Some((picture, _, _)) => {
                    Ok(format!("the background is a picture of {}×{} texels", picture.width, picture.height))
                }
                None => Err("the background is a colour or gradient"),
            },
            Effect::Falloff => scene
                .lights
                .iter()
                .position(|light| light.inverse_square != 0)
                .map(|i| format!("light {} falls off with the squared distance", i + 1))
                .ok_or("no light falls off"),
            Effect::Antialiasing => match settings.samples {
                1 => Err("one sample a pixel"),
                n => Ok(format!("{n} samples a pixel")),
            },
            Effect::Adaptive => match (settings.threshold(), settings.adaptive) {
                (Some(threshold), _) => {
                    Ok(format!("pixels are refined while one more sample is worth {threshold}"))
                }
                (None, Some(_)) => Err("there are too few samples to choose from"),
                (None, None) => Err("it is not asked for"),
            },
            Effect::Aovs => {
                if settings.aovs {
                    Ok("auxiliary pictures are asked for".to_owned())
                } else {
                    Err("no auxiliary picture is asked for")
                }
            }
        }
    }

    /// The first used material with a property, by name.
    fn material(&self, property: impl Fn(usize) -> bool) -> Option<String> {
        let index = *self.used.iter().find(|&&i| property(i))?;
        Some(format!("material \"{}\"", self.scene.material_names[index]))
    }

    fn transmissive(&self) -> Option<String> {
        self.material(|i| shines(self.scene.materials[i].transmission))
    }

    fn body(&self, id: u32) -> String {
        format!("model \"{}\"", self.scene.bodies[id as usize].name)
    }
}

fn shines(color: [f32; 3]) -> bool {
    color.iter().any(|&c| c > 0.0)
}

fn count(n: usize, noun: &str) -> String {
    if n == 1 { format!("there is 1 {noun}") } else { format!("there are {n} {noun}s") }
}
