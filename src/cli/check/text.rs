//! What `check` finds, as a person reads it.

use std::fmt::{self, Display, Formatter};

use super::report::{Body, Buffer, Effect, Light, Medium, Number, Report, Texture};

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} triangles, {} background", self.scene, self.triangles, self.background)?;
        section(f, "Bodies", &self.bodies)?;
        section(f, "Media", &self.media)?;
        section(f, "Lights", &self.lights)?;
        section(f, "Textures", &self.textures)?;
        section(f, "Buffers", &self.buffers)?;
        writeln!(f, "\nBVH\n  {} nodes, depth {}", self.bvh.nodes, self.bvh.depth)?;
        section(f, "Effects", &self.effects)?;
        section(f, "Numbers", &self.numbers)?;
        section(f, "Warnings", &self.warnings.iter().map(|text| Indented(text)).collect::<Vec<_>>())
    }
}

/// A title and one line for each item, or that there is none.
fn section<T: Display>(f: &mut Formatter<'_>, title: &str, items: &[T]) -> fmt::Result {
    writeln!(f, "\n{title}")?;
    if items.is_empty() {
        writeln!(f, "  none")?;
    }
    items.iter().try_for_each(|item| writeln!(f, "  {item}"))
}

impl Display for Body {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { name, priority, material, transmissive, triangles } = self;
        let matter = if *transmissive { "transmissive" } else { "opaque" };
        write!(f, "{name:<20} {material:<16} {matter:<12} priority {priority:<4} {triangles:>8} triangles")
    }
}

impl Display for Medium {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { name, fresnel, ior, absorption: [r, g, b] } = self;
        let weights = if *fresnel { "Fresnel" } else { "classic" };
        write!(f, "{name:<20} ior {ior}, {weights}, absorption {r} {g} {b} per scene unit")
    }
}

impl Display for Light {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { position: [x, y, z], intensity: [r, g, b], falloff } = self;
        write!(f, "at {x:.4} {y:.4} {z:.4}, intensity {r:.4} {g:.4} {b:.4}, falloff {falloff}")
    }
}

impl Display for Texture {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { path, size: [width, height] } = self;
        write!(f, "{path}, {width}×{height}")
    }
}

impl Display for Buffer {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{:<20} {:>12} bytes", self.name, self.bytes)
    }
}

impl Display for Effect {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { name, on, reason } = self;
        write!(f, "{name:<16} {}: {reason}", if *on { "on" } else { "off" })
    }
}

impl Display for Number {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { name, value, reason } = self;
        write!(f, "{name:<16} {value}: {reason}")
    }
}

/// Several lines under each other.
struct Indented<'a>(&'a str);

impl Display for Indented<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.replace('\n', "\n  "))
    }
}
