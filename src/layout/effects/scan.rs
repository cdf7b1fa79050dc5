//! What a scene calls for, found out once.

use super::meeting::meeting;
use super::{Effect, Effects, Finding, Number, Numbers};
use crate::layout::{Attribute, FlatScene, Material, Settings};

/// Weights are products rounded to 24 bits, one rounding a level: each may be this much greater than its bound.
const ROUNDED_UP: f64 = 1.0 + 1e-6;

/// What a scene calls for, whatever the settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// By effect; those that settings decide are off here.
    findings: Vec<Finding>,
    lights: Number,
    /// What makes a ray of the tree wait for another, or that nothing does.
    branching: Result<String, String>,
    /// The greatest weight that a surface passes on to one child.
    gain: f64,
    media: Number,
}

impl Scan {
    /// Look at every face, material, body and light once.
    #[must_use]
    pub fn of(scene: &FlatScene) -> Self {
        let scanner = Scanner::new(scene);
        let meeting = meeting(scene);
        let find = |effect| match scanner.cause(effect, meeting.pair) {
            Ok(reason) => Finding { effect, on: true, reason },
            Err(reason) => Finding { effect, on: false, reason },
        };
        Self {
            findings: Effect::ALL.into_iter().map(find).collect(),
            lights: scanner.lights(),
            branching: scanner
                .material(|m| shines(m.reflection) && shines(m.transmission))
                .ok_or_else(|| "no material both reflects and transmits: the ray tree is a chain".to_owned()),
            gain: scanner.gain(),
            media: Number { value: meeting.most, reason: scanner.media_reason(meeting.pair) },
        }
    }

    /// What the scene calls for under these settings.
    #[must_use]
    pub fn effects(&self, settings: &Settings) -> Effects {
        let mut findings = self.findings.clone();
        for finding in &mut findings {
            let (on, reason) = match finding.effect {
                Effect::Antialiasing => (settings.samples > 1, samples(settings.samples)),
                Effect::Adaptive => adaptive(settings),
                Effect::Aovs if settings.aovs => (true, "auxiliary pictures are asked for".to_owned()),
                _ => continue,
            };
            (finding.on, finding.reason) = (on, reason);
        }
        let numbers = Numbers {
            lights: self.lights.clone(),
            waiting: self.waiting(settings),
            media: self.media.clone(),
        };
        Effects { findings, numbers }
    }

    /// Every level that is shaded and branches may leave one ray waiting.
    fn waiting(&self, settings: &Settings) -> Number {
        let name = match &self.branching {
            Err(reason) => return Number { value: 0, reason: reason.clone() },
            Ok(name) => name,
        };
        let faint = self.faint_beyond(settings.cutoff);
        let (deepest, why) = match faint {
            Some(depth) if depth < settings.depth => (depth, "beyond it every weight is below the cut-off"),
            _ => (settings.depth, "the depth that is asked for"),
        };
        let reason = format!("{name} both reflects and transmits, down to depth {deepest}, {why}");
        Number { value: deepest + 1, reason }
    }

    /// The depth beyond which no ray has the weight that is traced; none where weights need not fall.
    fn faint_beyond(&self, cutoff: f32) -> Option<u32> {
        let gain = self.gain * ROUNDED_UP;
        (gain < 1.0 && cutoff > 0.0).then(|| {
            let levels = f64::from(cutoff).ln() / gain.max(f64::MIN_POSITIVE).ln();
            levels.floor() as u32
        })
    }
}

/// The scene with the materials that its faces really use.
struct Scanner<'a> {
    scene: &'a FlatScene,
    used: Vec<usize>,
    /// A face with shading normals.
    smooth: Option<&'a Attribute>,
}

impl<'a> Scanner<'a> {
    fn new(scene: &'a FlatScene) -> Self {
        let mut used = vec![false; scene.materials.len()];
        let mut smooth = None;
        for face in &*scene.attributes {
            used[face.material as usize] = true;
            if smooth.is_none() && face.is_smooth() {
                smooth = Some(face);
            }
        }
        // What a body is made of counts even where none of its faces shows it.
        let transmissive = scene.bodies.iter().take(scene.transmissive_bodies as usize);
        transmissive.for_each(|body| used[body.material as usize] = true);
        let used = used.iter().enumerate().filter_map(|(i, &u)| u.then_some(i)).collect();
        Self { scene, used, smooth }
    }

    /// What in the scene turns an effect on, or why it is off.
    fn cause(&self, effect: Effect, meeting: Option<[u32; 2]>) -> Result<String, String> {
        let says = |name: String, what: &str| format!("{name} {what}");
        let found = match effect {
            Effect::Shadows => {
                let lit = self.lit()?;
                return Ok(format!("{} and {lit} is lit by it", there_are(self.scene.lights.len(), "light")));
            }
            Effect::TintedShadows => {
                self.lit()?;
                self.transmissive()
                    .map(|name| says(name, "lets light through"))
                    .ok_or("every blocker is opaque")
            }
            Effect::Specular => {
                self.shining()?;
                let found = self.material(|m| shines(m.specular));
                found
                    .map(|name| says(name, "has a specular colour"))
                    .ok_or("no material has a specular colour")
            }
            Effect::Reflection => {
                // Classic matter reflects totally, whatever its kr.
                let found =
                    self.material(|m| shines(m.reflection) || (shines(m.transmission) && m.fresnel == 0));
                found.map(|name| says(name, "reflects")).ok_or("no material reflects")
            }
            Effect::Transmission => {
                self.transmissive().map(|name| says(name, "transmits")).ok_or("no material transmits")
            }
            Effect::Fresnel => {
                let scatters = |m: &Material| shines(m.reflection) || shines(m.transmission);
                let found = self.material(|m| m.fresnel != 0 && scatters(m));
                found
                    .map(|name| says(name, "is weighted by Fresnel's equations"))
                    .ok_or("no reflecting or transmitting material asks for it")
            }
            Effect::Absorption => {
                let found = self.material(|m| shines(m.absorption) && shines(m.transmission));
                found.map(|name| says(name, "absorbs")).ok_or("no medium absorbs")
            }
            Effect::NestedMedia => match (meeting, self.scene.transmissive_bodies) {
                (Some([a, b]), _) => {
                    Ok(format!("{} and {} overlap, touch or hold each other", self.body(a), self.body(b)))
                }
                (None, 0) => Err("no body transmits"),
                (None, 1) => Err("only one body transmits"),
                (None, _) => Err("a plane stands between any two bodies that transmit"),
            },
            Effect::SmoothNormals => self
                .smooth
                .map(|face| says(self.body(face.body), "has interpolated normals or texture coordinates"))
                .ok_or("every face is flat and untextured"),
            Effect::Textures => self
                .material(|m| m.texture != Attribute::NONE)
                .map(|name| says(name, "has a texture"))
                .ok_or("no material has a texture"),
            Effect::Environment => match self.scene.environment {
                Some((picture, ..)) => {
                    Ok(format!("the background is a picture of {}×{} texels", picture.width, picture.height))
                }
                None => Err("the background is a colour or gradient"),
            },
            Effect::Falloff => {
                let falling = self.scene.lights.iter().position(|light| light.inverse_square != 0);
                falling
                    .map(|i| format!("light {} falls off with the squared distance", i + 1))
                    .ok_or("no light falls off")
            }
            Effect::Antialiasing | Effect::Adaptive | Effect::Aovs => {
                Err("no auxiliary picture is asked for")
            }
        };
        found.map_err(str::to_owned)
    }

    /// A material that point lights light, or why there is none.
    fn lit(&self) -> Result<String, String> {
        self.shining()?;
        self.material(|m| shines(m.diffuse) || shines(m.specular))
            .ok_or_else(|| "no material has a diffuse or specular colour".to_owned())
    }

    fn shining(&self) -> Result<(), String> {
        if self.scene.lights.is_empty() { Err("there is no light".to_owned()) } else { Ok(()) }
    }

    fn lights(&self) -> Number {
        match self.lit() {
            Ok(lit) => {
                let count = self.scene.lights.len();
                Number {
                    value: count as u32,
                    reason: format!("{}; {lit} answers", there_are(count, "light")),
                }
            }
            Err(reason) => Number { value: 0, reason },
        }
    }

    fn media_reason(&self, meeting: Option<[u32; 2]>) -> String {
        match (meeting, self.scene.transmissive_bodies) {
            (Some([a, b]), _) => format!("{} and {} and what they meet", self.body(a), self.body(b)),
            (None, 0) => "no body transmits".to_owned(),
            (None, 1) => "one body transmits".to_owned(),
            (None, count) => format!("{count} bodies transmit, each apart from the others"),
        }
    }

    /// The greatest channel of what a used material passes on: kr + kt on total reflection in classic matter.
    fn gain(&self) -> f64 {
        let weight = |m: &Material| {
            let channels = m.reflection.iter().zip(m.transmission).map(|(&kr, kt)| {
                let (kr, kt) = (f64::from(kr), f64::from(kt));
                if m.fresnel == 0 && shines(m.transmission) { kr + kt } else { kr.max(kt) }
            });
            channels.fold(0.0, f64::max)
        };
        self.used.iter().map(|&i| weight(&self.scene.materials[i])).fold(0.0, f64::max)
    }

    /// The first used material with a property, by name.
    fn material(&self, property: impl Fn(&Material) -> bool) -> Option<String> {
        let index = *self.used.iter().find(|&&i| property(&self.scene.materials[i]))?;
        let name = self.scene.material_names.get(index);
        Some(name.map_or_else(|| format!("material {index}"), |name| format!("material \"{name}\"")))
    }

    fn transmissive(&self) -> Option<String> {
        self.material(|m| shines(m.transmission))
    }

    fn body(&self, id: u32) -> String {
        let body = self.scene.bodies.get(id as usize);
        body.map_or_else(|| format!("body {id}"), |body| format!("model \"{}\"", body.name))
    }
}

fn shines(color: [f32; 3]) -> bool {
    color.iter().any(|&c| c > 0.0)
}

fn there_are(count: usize, noun: &str) -> String {
    if count == 1 { format!("there is 1 {noun}") } else { format!("there are {count} {noun}s") }
}

fn adaptive(settings: &Settings) -> (bool, String) {
    let reason = match (settings.threshold(), settings.adaptive) {
        (Some(threshold), _) => {
            return (true, format!("pixels are refined while one more sample moves them by {threshold}"));
        }
        (None, Some(_)) => format!("{}: too few to choose from", samples(settings.samples)),
        (None, None) => "it is not asked for".to_owned(),
    };
    (false, reason)
}

fn samples(count: u32) -> String {
    if count == 1 { "one sample a pixel".to_owned() } else { format!("{count} samples a pixel") }
}
