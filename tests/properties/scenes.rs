//! Random scenes of nested, touching and overlapping bodies, as the scene files that they would be.

use std::fmt;

use proptest::prelude::*;

/// A scene file.
#[derive(Clone)]
pub(super) struct SceneFile {
    eye: Point,
    target: Point,
    depth: u32,
    cutoff: f64,
    background: Background,
    ambient: f64,
    lights: Vec<Light>,
    bodies: Vec<Body>,
}

type Point = [f64; 3];

#[derive(Debug, Clone, Copy)]
enum Background {
    Color(f64),
    Gradient(f64, f64),
}

#[derive(Debug, Clone, Copy)]
struct Light {
    position: Point,
    intensity: f64,
    falls_off: bool,
}

#[derive(Debug, Clone, Copy)]
struct Body {
    shape: Shape,
    matter: Matter,
    priority: i32,
    rotate: Point,
    translate: Point,
    normals: &'static str,
}

#[derive(Debug, Clone, Copy)]
enum Shape {
    Box(Point),
    RoundedBox(Point),
    Sphere(f64),
    Cylinder(f64, f64),
    Torus(f64),
}

#[derive(Debug, Clone, Copy)]
enum Matter {
    Opaque { diffuse: f64, specular: f64, shininess: f64, reflection: f64 },
    Classic { reflection: f64, transmission: f64, ior: f64, absorption: f64 },
    Fresnel { diffuse: f64, ior: f64, absorption: f64 },
}

/// Scenes of one to five closed bodies. Half of all coordinates lie on a grid of exact numbers, so that faces touch and
/// coincide.
pub(super) fn scenes() -> impl Strategy<Value = SceneFile> {
    // In no face: it would be on neither side of that.
    let eye = place(3.0).prop_map(|place| place.map(|x| x + 0.125));
    let view = (eye, place(1.0), 0..=5_u32, prop::sample::select(vec![0.0, 1e-4, 0.05]));
    let surroundings = (background(), fraction(), prop::collection::vec(light(), 0..3));
    let bodies = prop::collection::vec(body(), 1..=5);
    let apart = |&((eye, target, ..), ..): &((Point, Point, u32, f64), _, _)| eye != target;
    (view, surroundings, bodies).prop_filter("the eye is on its target", apart).prop_map(
        |((eye, target, depth, cutoff), (background, ambient, lights), bodies)| SceneFile {
            eye,
            target,
            depth,
            cutoff,
            background,
            ambient,
            lights,
            bodies,
        },
    )
}

/// From −most to most: a multiple of 1/4, or any number.
fn coordinate(most: f64) -> impl Strategy<Value = f64> {
    let steps = (most * 4.0) as i32;
    prop_oneof![(-steps..=steps).prop_map(|step| f64::from(step) / 4.0), -most..most]
}

fn place(most: f64) -> impl Strategy<Value = Point> {
    prop::array::uniform3(coordinate(most))
}

/// From 1/2 to 3: a multiple of 1/2, or any number.
fn measure() -> impl Strategy<Value = f64> {
    prop_oneof![3 => (1..=6).prop_map(|step| f64::from(step) / 2.0), 1 => 0.5..3.0]
}

/// From 0 to 1, often one of the two.
fn fraction() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0]
}

fn background() -> impl Strategy<Value = Background> {
    prop_oneof![
        fraction().prop_map(Background::Color),
        (fraction(), fraction()).prop_map(|(zenith, horizon)| Background::Gradient(zenith, horizon)),
    ]
}

fn light() -> impl Strategy<Value = Light> {
    (place(4.0), 0.0..4.0, any::<bool>()).prop_map(|(position, intensity, falls_off)| Light {
        position,
        intensity,
        falls_off,
    })
}

fn body() -> impl Strategy<Value = Body> {
    let rotate = prop_oneof![
        3 => Just([0.0; 3]),
        1 => prop::array::uniform3((-2..=2).prop_map(|quarter| f64::from(quarter) * 90.0)),
        1 => prop::array::uniform3(-180.0..180.0),
    ];
    let normals = prop::sample::select(vec!["\"file\"", "\"flat\"", "60"]);
    (shape(), matter(), -1..=2, rotate, place(1.5), normals).prop_map(
        |(shape, matter, priority, rotate, translate, normals)| Body {
            shape,
            matter,
            priority,
            rotate,
            translate,
            normals,
        },
    )
}

fn shape() -> impl Strategy<Value = Shape> {
    let sides = || prop::array::uniform3(measure());
    prop_oneof![
        4 => sides().prop_map(Shape::Box),
        1 => sides().prop_map(Shape::RoundedBox),
        1 => measure().prop_map(Shape::Sphere),
        1 => (measure(), measure()).prop_map(|(radius, height)| Shape::Cylinder(radius, height)),
        1 => measure().prop_map(Shape::Torus),
    ]
}

fn matter() -> impl Strategy<Value = Matter> {
    let ior = || prop_oneof![Just(1.0), Just(1.31), Just(1.333), 0.5..2.5];
    let absorption = || prop_oneof![2 => Just(0.0), 1 => 0.0..3.0];
    prop_oneof![
        (fraction(), fraction(), 0.0..200.0, fraction()).prop_map(
            |(diffuse, specular, shininess, reflection)| Matter::Opaque {
                diffuse,
                specular,
                shininess,
                reflection
            }
        ),
        (fraction(), 0.01..=1.0, ior(), absorption()).prop_map(
            |(reflection, transmission, ior, absorption)| Matter::Classic {
                reflection,
                transmission,
                ior,
                absorption
            }
        ),
        (fraction(), ior(), absorption()).prop_map(|(diffuse, ior, absorption)| Matter::Fresnel {
            diffuse,
            ior,
            absorption
        }),
    ]
}

/// The file's text. That is also how a failing scene is shown: it becomes a file of `tests/regressions/` as it is.
impl fmt::Display for SceneFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { eye, target, depth, cutoff, background, ambient, lights, bodies } = self;
        // Looking straight up or down needs another direction to be up.
        let up = if eye[0] == target[0] && eye[2] == target[2] { [0, 0, 1] } else { [0, 1, 0] };
        writeln!(f, "[camera]\neye = {eye:?}\ntarget = {target:?}\nup = {up:?}\nfov_y = 60")?;
        writeln!(f, "[render]\nsize = [12, 9]\ndepth = {depth}\ncutoff = {cutoff:?}\nsamples = 1")?;
        writeln!(f, "[ambient]\nintensity = {ambient:?}")?;
        writeln!(f, "{background}")?;
        lights.iter().try_for_each(|light| writeln!(f, "{light}"))?;
        for (number, body) in bodies.iter().enumerate() {
            writeln!(f, "[material.m{number}]\n{}", body.matter)?;
            writeln!(f, "[[model]]\nmaterial = \"m{number}\"\n{body}")?;
        }
        Ok(())
    }
}

impl fmt::Debug for SceneFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

fn grey(value: f64) -> String {
    format!("[{value:?}, {value:?}, {value:?}]")
}

impl fmt::Display for Background {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Color(value) => write!(f, "[background]\ncolor = {}", grey(value)),
            Self::Gradient(zenith, horizon) => {
                write!(f, "[background]\nzenith = {}\nhorizon = {}", grey(zenith), grey(horizon))
            }
        }
    }
}

impl fmt::Display for Light {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { position, intensity, falls_off } = self;
        let falloff = if *falls_off { "inverse-square" } else { "none" };
        write!(f, "[[light]]\nposition = {position:?}\nintensity = {intensity:?}\nfalloff = \"{falloff}\"")
    }
}

impl fmt::Display for Matter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Opaque { diffuse, specular, shininess, reflection } => write!(
                f,
                "ambient = {{ k = {diffuse:?} }}\ndiffuse = {{ k = {diffuse:?} }}\n\
                 specular = {{ k = {specular:?}, shininess = {shininess:?} }}\nreflection = {reflection:?}"
            ),
            Self::Classic { reflection, transmission, ior, absorption } => write!(
                f,
                "specular = {{ k = 0.3 }}\nreflection = {reflection:?}\ntransmission = {transmission:?}\n\
                 ior = {ior:?}\nabsorption = {absorption:?}"
            ),
            Self::Fresnel { diffuse, ior, absorption } => write!(
                f,
                "diffuse = {{ k = {diffuse:?} }}\nreflection = 1.0\ntransmission = 1.0\nfresnel = true\n\
                 ior = {ior:?}\nabsorption = {absorption:?}"
            ),
        }
    }
}

impl fmt::Display for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { shape, priority, rotate, translate, normals, .. } = self;
        write!(
            f,
            "shape = {{ {shape} }}\npriority = {priority}\nnormals = {normals}\nrotate = {rotate:?}\n\
             translate = {translate:?}"
        )
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Box(size) => write!(f, "box = {{ size = {size:?} }}"),
            Self::RoundedBox(size) => {
                write!(f, "rounded_box = {{ size = {size:?}, radius = 0.125, level = 0 }}")
            }
            Self::Sphere(size) => write!(f, "sphere = {{ radius = {:?}, level = 2 }}", size / 2.0),
            Self::Cylinder(size, height) => {
                write!(f, "cylinder = {{ radius = {:?}, height = {height:?}, level = 1 }}", size / 2.0)
            }
            Self::Torus(size) => {
                write!(f, "torus = {{ major = {:?}, minor = {:?}, level = 0 }}", size / 2.0, size / 8.0)
            }
        }
    }
}
