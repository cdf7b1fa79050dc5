//! The flags of `snellius render`.

use std::path::PathBuf;

use super::super::device::DeviceArgs;
use super::super::values::{
    AovFile, Crop, ErrorMetric, ProgressStyle, Size, effect_choice, number_in, whole_in,
};
use crate::film::{BitDepth, Tone};
use crate::layout::constants::MAX_DEPTH;
use crate::layout::{EffectChoice, Float, Intersector, Precision};

/// Render a scene to a picture
///
/// The whole tree of reflected and refracted rays is traced. The scene file's [render] table holds the
/// defaults of --size, --depth, --cutoff, --samples and --adaptive.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius render scenes/ice.toml -o ice.png
  snellius render scenes/ice.toml -o ice.exr --backend cpu --size 640x480 --samples 16
  snellius render scenes/ice.toml -o ice.png --samples 64 --adaptive 0.01
  snellius render scenes/ice.toml -o - --crop 600,300,64,64 > detail.png
  snellius render scenes/ice.toml --aov depth=depth.exr --aov rays=rays.png
  snellius render scenes/ice.toml -o ice.png --json > ice.json
  snellius render scenes/whitted.toml -o whitted.png --error 0.002
  snellius render scenes/ice.toml -o ice.png --turntable 36
  snellius render scenes/ice.toml -o plain.png --effects reflection,transmission,environment

Ctrl-C stops the trace, writes what is finished (the rest is black) and exits with 130.
Pixels that are not finite are counted and reported; in PNG and HDR they are magenta.")]
pub(in crate::cli) struct RenderArgs {
    /// The scene: .toml or .obj
    pub(super) scene: PathBuf,
    /// The picture: .png (sRGB), .exr (linear, exact) or .hdr (linear); - is standard output as PNG
    #[arg(short, long, value_name = "PATH", required_unless_present_any = ["aov", "json"])]
    pub(super) output: Option<PathBuf>,
    /// Width and height of the picture in pixels, 1 to 16384 each [default: the scene's, else 1280x720]
    #[arg(long, value_name = "WxH")]
    pub(super) size: Option<Size>,
    /// Deepest ray that is traced, 0 to 64; the ray from the eye has depth 0 [default: the scene's, else 16]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, 0, MAX_DEPTH))]
    pub(super) depth: Option<u32>,
    /// Least weight of a ray that is traced, 0 to 1 [default: the scene's, else 0.0001]
    #[arg(long, value_name = "W", value_parser = |text: &str| number_in(text, 0.0, 1.0))]
    pub(super) cutoff: Option<f64>,
    /// Samples per pixel, 1 to 65536 [default: the scene's, else 4]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, 1, 65536))]
    pub(super) samples: Option<u32>,
    /// Give a pixel more samples, up to --samples, only while one more is expected to move it by more than this part of
    /// the display's range, 0 to 1: 0.01 is good, 0.03 fast, 0 the same as without [default: the scene's, else off]
    #[arg(long, value_name = "T", value_parser = |text: &str| number_in(text, 0.0, 1.0))]
    pub(super) adaptive: Option<f64>,
    /// Effects to simulate: auto for those that the scene calls for, all (the same picture, more slowly), none, or a
    /// list of names with commas, as `check` prints them; a list brings what its effects need
    #[arg(long, value_name = "LIST", default_value = "auto", value_parser = effect_choice)]
    pub(super) effects: EffectChoice,
    /// Choose depth, cut-off, samples, threshold and precision: the cheapest that keep this error against samples without
    /// end of the whole tree in f64, in linear RGB clamped to [0, 1]. With --samples or --adaptive these stay, and the
    /// error is that against the whole tree of the same samples. At most 4096 samples are asked for
    #[arg(long, value_name = "E", conflicts_with_all = ["depth", "cutoff", "time"], help_heading = "Budget",
        value_parser = |text: &str| number_in(text, 0.0, 1.0))]
    pub(super) error: Option<f64>,
    /// What --error limits: the root mean square, the greatest error, or the mean error that a person sees
    #[arg(long, value_name = "METRIC", default_value = "rmse", requires = "error", help_heading = "Budget")]
    pub(super) metric: ErrorMetric,
    /// Choose the same settings: the most accurate that trace in so many milliseconds. Choosing comes before, and takes
    /// its own time
    #[arg(long, value_name = "MS", conflicts_with_all = ["depth", "cutoff"], help_heading = "Budget",
        value_parser = |text: &str| number_in(text, 1.0, 1e9))]
    pub(super) time: Option<f64>,
    /// Write so many pictures instead of one, from round the target: OUT-000.png, OUT-001.png …, the first as without
    #[arg(long, value_name = "N", requires = "output", conflicts_with_all = ["aov", "json", "error", "time"],
        value_parser = |text: &str| whole_in(text, 1, 1000))]
    pub(super) turntable: Option<u32>,
    /// Trace only this part of the picture: left, top, width and height in pixels
    #[arg(long, value_name = "X,Y,W,H")]
    pub(super) crop: Option<Crop>,
    /// Write what else is known of each pixel: exactly to .exr, in false colours to .png; may be repeated.
    /// Names: depth, normal, body, medium, rays, samples, dropped, bound, primitive-hash, body-hash
    #[arg(long, value_name = "NAME=PATH")]
    pub(super) aov: Vec<AovFile>,
    /// Tone curve of PNG files
    #[arg(long, value_name = "CURVE", default_value = "none")]
    pub(super) tone: Tone,
    /// Exposure of PNG files in stops: radiance is multiplied by 2^EV
    #[arg(long, value_name = "EV", default_value = "0", allow_negative_numbers = true,
        value_parser = |text: &str| number_in(text, -100.0, 100.0))]
    pub(super) exposure: f64,
    /// Bits per channel of PNG files
    #[arg(long, value_name = "N", default_value = "8")]
    pub(super) bits: BitDepth,
    #[command(flatten)]
    pub(super) device: DeviceArgs,
    #[command(flatten)]
    pub(super) arithmetic: ArithmeticArgs,
    /// Print one JSON object: settings, device, rays, times, errors
    #[arg(long, help_heading = "Messages")]
    pub(super) json: bool,
    /// Progress on standard error
    #[arg(long, value_name = "STYLE", default_value = "auto", help_heading = "Messages")]
    pub(super) progress: ProgressStyle,
}

/// Flags that choose how rays are traced.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Arithmetic")]
pub(in crate::cli) struct ArithmeticArgs {
    /// Arithmetic of the trace
    #[arg(long, value_name = "BITS", default_value = "f32")]
    pub(in crate::cli) precision: Precision,
    /// What a shader compiler may do to arithmetic; the CPU is always strict
    #[arg(long, value_name = "MODE", default_value = "strict")]
    pub(in crate::cli) float: Float,
    /// Test of a ray against a triangle
    #[arg(long, value_name = "TEST", default_value = "watertight")]
    pub(in crate::cli) intersector: Intersector,
}
