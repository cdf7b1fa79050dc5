//! What `snellius render` is to do, once its flags are checked against each other.

use std::path::PathBuf;
use std::time::Duration;

use super::super::CliError;
use super::super::device::Choice;
use super::super::values::{AovFile, Crop, ProgressStyle, Size};
use super::args::RenderArgs;
use super::export::PngOptions;
use crate::film::{AovKind, Development, Format, Output};
use crate::layout::{EffectChoice, Float, Intersector, Precision, Settings};
use crate::scene::RenderDefaults;
use crate::study::Goal;

/// What `render` is to do, as far as the flags tell; the scene settles the rest.
pub(super) struct RenderConfig {
    pub(super) scene: PathBuf,
    pub(super) output: Option<Output>,
    pub(super) aovs: Vec<(AovKind, Output)>,
    pub(super) device: Choice,
    pub(super) precision: Precision,
    pub(super) float: Float,
    pub(super) size: Option<[u32; 2]>,
    pub(super) depth: Option<u32>,
    pub(super) cutoff: Option<f64>,
    pub(super) samples: Option<u32>,
    pub(super) adaptive: Option<f64>,
    pub(super) effects: EffectChoice,
    pub(super) intersector: Intersector,
    /// What settings are to be chosen for.
    pub(super) goal: Option<Goal>,
    pub(super) crop: Option<Crop>,
    /// How many pictures from round the target, if not one.
    pub(super) turntable: Option<u32>,
    pub(super) png: PngOptions,
    pub(super) json: bool,
    pub(super) progress: ProgressStyle,
}

impl RenderConfig {
    pub(super) fn new(args: RenderArgs) -> Result<Self, CliError> {
        let output = args.output.as_deref().map(Output::new).transpose()?;
        let aovs = args.aov.into_iter().map(aov_output).collect::<Result<Vec<_>, _>>()?;
        let development = Development { tone: args.tone, exposure: args.exposure as f32 };
        let png = PngOptions { development, bits: args.bits };
        check_outputs(output.iter().chain(aovs.iter().map(|(_, output)| output)), args.json)?;
        check_png_options(output.as_ref(), png)?;
        if args.turntable.is_some() && output == Some(Output::Stdout) {
            return Err(CliError::usage(
                "--turntable writes several pictures, and standard output holds one",
            )
            .hint("name a file: -o ice.png becomes ice-000.png, ice-001.png …"));
        }
        let metric = args.metric.into();
        let goal = args.error.map(|limit| Goal::Error { limit, metric });
        let goal = goal.or_else(|| args.time.map(|ms| Goal::Time(Duration::from_secs_f64(ms / 1e3))));
        Ok(Self {
            scene: args.scene,
            output,
            aovs,
            device: args.device.choice()?,
            precision: args.arithmetic.precision,
            float: args.arithmetic.float,
            size: args.size.map(|size| size.0),
            depth: args.depth,
            cutoff: args.cutoff,
            samples: args.samples,
            adaptive: args.adaptive,
            effects: args.effects,
            intersector: args.arithmetic.intersector,
            goal,
            crop: args.crop,
            turntable: args.turntable,
            png,
            json: args.json,
            progress: args.progress,
        })
    }

    /// The scene's defaults, overridden by flags.
    pub(super) fn overridden(&self, defaults: &RenderDefaults) -> RenderDefaults {
        RenderDefaults {
            size: self.size.unwrap_or(defaults.size),
            depth: self.depth.unwrap_or(defaults.depth),
            cutoff: self.cutoff.unwrap_or(defaults.cutoff),
            samples: self.samples.unwrap_or(defaults.samples),
            adaptive: self.adaptive.or(defaults.adaptive),
        }
    }

    pub(super) fn settings(&self, render: &RenderDefaults) -> Settings {
        Settings {
            depth: render.depth,
            cutoff: render.cutoff as f32,
            samples: render.samples,
            adaptive: render.adaptive.map(|threshold| threshold as f32),
            precision: self.precision,
            float: self.float,
            intersector: self.intersector,
            aovs: self.aovs.iter().any(|(kind, _)| kind.needs_aovs()),
            effects: self.effects,
        }
    }

    /// The part to trace, if not the whole.
    pub(super) fn crop(&self, size: [u32; 2]) -> Result<Option<[u32; 4]>, CliError> {
        match self.crop {
            None => Ok(None),
            Some(crop) if crop.fits(size) => Ok(Some(crop.0)),
            Some(crop) => {
                Err(CliError::usage(format!("--crop {crop} is not inside the picture of {}", Size(size))))
            }
        }
    }
}

/// The defaults with what was chosen in place of them.
pub(super) fn chosen(render: &RenderDefaults, settings: &Settings) -> RenderDefaults {
    RenderDefaults {
        size: render.size,
        depth: settings.depth,
        cutoff: f64::from(settings.cutoff),
        samples: settings.samples,
        adaptive: settings.adaptive.map(f64::from),
    }
}

fn aov_output(file: AovFile) -> Result<(AovKind, Output), CliError> {
    let output = Output::new(&file.path)?;
    if output.format() == Format::Hdr {
        return Err(CliError::usage(format!("--aov {}={output}: .hdr cannot hold it", file.kind.name()))
            .hint("use .exr for exact values, .png for false colours"));
    }
    Ok((file.kind, output))
}

/// No two pictures, nor a picture and the report, may go to the same place.
fn check_outputs<'a>(outputs: impl Iterator<Item = &'a Output>, json: bool) -> Result<(), CliError> {
    let mut seen = Vec::new();
    if json {
        seen.push(&Output::Stdout);
    }
    for output in outputs {
        if seen.contains(&output) {
            return Err(CliError::usage(format!("more than one thing is to be written to {output}")));
        }
        seen.push(output);
    }
    Ok(())
}

/// A tone curve on a linear file would be lost in silence.
fn check_png_options(output: Option<&Output>, png: PngOptions) -> Result<(), CliError> {
    match output {
        Some(output) if output.format() != Format::Png && png != PngOptions::default() => {
            Err(CliError::usage(format!(
                "--tone, --exposure and --bits are for PNG; {output} holds linear radiance"
            ))
            .hint("leave them out, or end the name with .png"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use clap::{Args, FromArgMatches};

    use super::*;

    /// The configuration of a command line after `snellius render`, or its error as it is printed.
    fn config(line: &str) -> Result<RenderConfig, String> {
        let command = RenderArgs::augment_args(clap::Command::new("render").no_binary_name(true));
        let matches =
            command.try_get_matches_from(line.split_whitespace()).map_err(|error| error.to_string())?;
        let args = RenderArgs::from_arg_matches(&matches).map_err(|error| error.to_string())?;
        RenderConfig::new(args).map_err(|error| error.render(false))
    }

    fn message(line: &str) -> String {
        config(line).err().unwrap()
    }

    #[test]
    fn flags_override_the_scene_and_absent_flags_do_not() {
        let scene = RenderDefaults { size: [10, 20], depth: 3, cutoff: 0.5, samples: 7, adaptive: Some(0.5) };
        let untouched = config("a.toml -o a.png").unwrap();
        assert_eq!(untouched.overridden(&scene), scene);
        let overridden =
            config("a.toml -o a.png --size 64x32 --depth 0 --cutoff 0 --samples 1 --adaptive 0").unwrap();
        let expected =
            RenderDefaults { size: [64, 32], depth: 0, cutoff: 0.0, samples: 1, adaptive: Some(0.0) };
        assert_eq!(overridden.overridden(&scene), expected);
    }

    #[test]
    fn first_hit_aovs_are_traced_only_where_they_are_asked_for() {
        let settings = |line| config(line).unwrap().settings(&RenderDefaults::default());
        assert!(!settings("a.toml -o a.png").aovs);
        assert!(!settings("a.toml --aov rays=a.png").aovs);
        assert!(settings("a.toml --aov rays=a.png --aov depth=b.exr").aovs);
    }

    #[test]
    fn a_render_that_leaves_nothing_behind_is_refused() {
        assert!(message("a.toml").contains("--output <PATH>"));
        assert!(config("a.toml --json").is_ok());
    }

    #[test]
    fn two_things_are_not_written_to_one_place() {
        for line in ["a.toml -o - --json", "a.toml -o a.png --aov depth=a.png"] {
            assert!(message(line).contains("more than one thing is to be written to"), "{line}");
        }
    }

    #[test]
    fn display_options_are_not_lost_on_linear_files() {
        for flag in ["--tone aces", "--exposure -1", "--bits 16"] {
            assert!(config(&format!("a.toml -o a.png {flag}")).is_ok());
            assert!(message(&format!("a.toml -o a.exr {flag}")).contains("are for PNG"), "{flag}");
        }
    }

    #[test]
    fn an_aov_is_not_squeezed_into_hdr() {
        assert!(message("a.toml --aov depth=a.hdr").contains("use .exr for exact values"));
    }

    #[test]
    fn a_crop_outside_the_picture_is_refused_with_both_figures() {
        let config = config("a.toml -o a.png --crop 60,0,10,10").unwrap();
        assert_eq!(config.crop([70, 10]).unwrap(), Some([60, 0, 10, 10]));
        let message = config.crop([64, 48]).unwrap_err().render(false);
        assert!(message.contains("--crop 60,0,10,10 is not inside the picture of 64x48"), "{message}");
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        let wrong = [
            "--depth 65",
            "--cutoff 2",
            "--cutoff NaN",
            "--samples 0",
            "--adaptive 1.5",
            "--adaptive NaN",
            "--bits 9",
            "--size 0x4",
            "--threads 0",
        ];
        for flag in wrong {
            assert!(config(&format!("a.toml -o a.png {flag}")).is_err(), "{flag}");
        }
    }
}
