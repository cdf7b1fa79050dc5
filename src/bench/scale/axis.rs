//! What grows, and where.

use super::scenes::{glass, lamps, mirrors, terrain};
use crate::bench::{BenchError, Stage, Target};
use crate::film::Frame;
use crate::layout::{Settings, View};

/// Width and height of the pictures in which something else than pixels grows.
const SIZE: [u32; 2] = [160, 120];
/// Those of terrain: more rays than the processor's caches hold triangles of their paths.
const TERRAIN_SIZE: [u32; 2] = [640, 480];

/// One quantity that grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Triangles of a terrain that fills the picture; primary rays only, and every one hits.
    Triangles,
    /// Rays of each path in a room of mirrors: its depth and one.
    Depth,
    /// Lamps.
    Lights,
    /// Pixels.
    Pixels,
    /// Samples a pixel.
    Samples,
    /// Threads of the CPU.
    Threads,
}

/// A point of an axis: a stage, how it is seen, and on what.
pub(super) struct Case {
    pub(super) value: u32,
    pub(super) stage: Stage,
    pub(super) view: View,
    pub(super) settings: Settings,
    pub(super) target: Target,
}

impl Axis {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Triangles, Self::Depth, Self::Lights, Self::Pixels, Self::Samples, Self::Threads];

    /// One word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Triangles => "triangles",
            Self::Depth => "depth",
            Self::Lights => "lights",
            Self::Pixels => "pixels",
            Self::Samples => "samples",
            Self::Threads => "threads",
        }
    }

    /// What is counted.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Triangles => "triangles of a terrain, primary rays that all hit",
            Self::Depth => "rays of each path between mirrors (depth + 1)",
            Self::Lights => "lamps over a painted ball",
            Self::Pixels => "pixels of a glass ball",
            Self::Samples => "samples a pixel of a glass ball",
            Self::Threads => "threads that trace a glass ball",
        }
    }

    /// The greatest slope that is accepted: a tree must not cost more than the fourth root of its triangles.
    #[must_use]
    pub fn limit(self) -> Option<f64> {
        (self == Self::Triangles).then_some(0.25)
    }

    /// Amounts, the least first; `threads` are those of the CPU.
    #[must_use]
    pub fn values(self, threads: u32) -> Vec<u32> {
        let doubling = |most: u32| (0..).map(|power| 1 << power).take_while(move |&n| n <= most);
        match self {
            // 10⁴ to 4·10⁶.
            Self::Triangles => [71, 122, 224, 388, 707, 1414].map(|side| 2 * side * side).to_vec(),
            Self::Depth | Self::Lights => doubling(64).collect(),
            Self::Pixels => [60, 120, 240, 480].map(|height| height * height * 4 / 3).to_vec(),
            Self::Samples => doubling(32).collect(),
            Self::Threads => {
                let mut values: Vec<u32> = doubling(threads).collect();
                values.extend((!threads.is_power_of_two()).then_some(threads));
                values
            }
        }
    }

    /// The point of one amount on a device; threads are the CPU's.
    pub(super) fn case(self, value: u32, target: &Target) -> Result<Case, BenchError> {
        let scene = match self {
            Self::Triangles => terrain((value / 2).isqrt()),
            Self::Depth => mirrors(),
            Self::Lights => lamps(value)?,
            Self::Pixels | Self::Samples | Self::Threads => glass()?,
        };
        let size = match self {
            Self::Triangles => TERRAIN_SIZE,
            Self::Pixels => [(value * 4 / 3).isqrt(), (value * 3 / 4).isqrt()],
            _ => SIZE,
        };
        let stage = Stage::of(format!("{value} {}", self.name()), &scene, size)?;
        let mut settings = stage.settings;
        match self {
            Self::Depth => settings.depth = value - 1,
            Self::Samples => settings.samples = value,
            _ => {}
        }
        let target =
            if self == Self::Threads { Target::Cpu { threads: value as usize } } else { target.clone() };
        Ok(Case { value, view: stage.view_of(size, &settings), stage, settings, target })
    }

    /// What is wrong with a picture that should show so much of it.
    pub(super) fn fault(self, value: u32, frame: &Frame) -> Option<String> {
        let rays = frame.rays;
        match self {
            Self::Triangles if frame.texels.iter().any(|texel| texel.radiance[0] == 0.0) => {
                Some("a primary ray misses the terrain".to_owned())
            }
            Self::Depth if rays.total() != rays.primary * u64::from(value) => {
                Some(format!("{} rays of {} paths of {value}", rays.total(), rays.primary))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::film::Renderer;

    const CPU: Target = Target::Cpu { threads: 0 };

    fn picture(case: &Case) -> Frame {
        case.target.open(&case.stage.scene).unwrap().render(&case.view, &case.settings, &()).unwrap()
    }

    #[test]
    fn each_axis_begins_at_its_least_and_only_grows() {
        for axis in Axis::ALL {
            let values = axis.values(6);
            assert!(
                values.windows(2).all(|pair| pair[0] < pair[1]) && values.len() >= 3,
                "{axis:?}: {values:?}"
            );
        }
        assert_eq!(Axis::Threads.values(6), [1, 2, 4, 6]);
        assert_eq!(Axis::Threads.values(1), [1]);
        let triangles = Axis::Triangles.values(1);
        assert!(triangles[0] >= 10_000 && triangles[5].abs_diff(4_000_000) < 2000);
    }

    #[test]
    fn a_terrain_has_the_triangles_and_every_primary_ray_hits() {
        let case = Axis::Triangles.case(2 * 30 * 30, &CPU).unwrap();
        assert_eq!(case.stage.scene.triangles.len(), 1800);
        let mut frame = picture(&case);
        assert_eq!((Axis::Triangles.fault(1800, &frame), frame.rays.total()), (None, 640 * 480));
        frame.texels[9].radiance = [0.0; 3];
        assert!(Axis::Triangles.fault(1800, &frame).is_some());
    }

    #[test]
    fn paths_between_mirrors_are_as_long_as_asked() {
        let frame = picture(&Axis::Depth.case(8, &CPU).unwrap());
        assert_eq!((Axis::Depth.fault(8, &frame), frame.rays.total()), (None, 160 * 120 * 8));
        assert!(Axis::Depth.fault(9, &frame).is_some());
    }

    #[test]
    fn the_other_axes_ask_for_more_of_one_thing() {
        let rays = |axis: Axis, value| picture(&axis.case(value, &CPU).unwrap()).rays;
        let [one, four] = [1, 4].map(|lamps| rays(Axis::Lights, lamps));
        assert!(four.shadow > 3 * one.shadow && four.primary == one.primary);
        assert_eq!(rays(Axis::Pixels, 4800).primary, 4800);
        assert_eq!(rays(Axis::Samples, 2).primary, 2 * rays(Axis::Samples, 1).primary);
        assert_eq!(rays(Axis::Threads, 2), rays(Axis::Threads, 1));
    }
}
