//! `snellius diff`: how far two pictures are apart.

use std::path::PathBuf;

use super::console::{Console, print, print_json};
use super::values::Threshold;
use super::{CliError, Outcome};
use crate::film::{Difference, Format, Metadata, Output, Picture, difference_preview, encode_preview, load};

/// How far two pictures are apart
///
/// Errors are those of linear R, G, B (PNG is decoded from sRGB) with 1 as the peak. EXR files are
/// compared exactly: a pixel differs if any bit of any plane does, so that depths, ids and hashes can be
/// compared too. FLIP is the difference that a person sees (Andersson et al. 2020), from 0 to 1.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius diff gpu.exr cpu.exr --fail-above differing_pixels=0
  snellius diff before.png after.png --fail-above flip=0.01 -o diff.png

Exit code: 0, or 1 if a figure is above its threshold, or 2 if the pictures cannot be compared.")]
pub(super) struct DiffArgs {
    /// A picture: .exr, .png or .hdr
    a: PathBuf,
    /// A picture of the same size with the same planes
    b: PathBuf,
    /// Exit with 1 if a metric is above this: rmse, max, flip or differing_pixels; may be repeated
    #[arg(long, value_name = "METRIC=VALUE")]
    fail_above: Vec<Threshold>,
    /// Write a false-colour picture of the differences (PNG): black where every bit agrees, then dark
    /// blue to yellow for differences from 1e-7 to 1
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What `diff` is to do.
struct DiffConfig {
    a: PathBuf,
    b: PathBuf,
    thresholds: Vec<Threshold>,
    output: Option<Output>,
    json: bool,
}

impl DiffConfig {
    fn new(args: DiffArgs) -> Result<Self, CliError> {
        let output = args.output.as_deref().map(Output::new).transpose()?;
        if let Some(output) = &output
            && output.format() != Format::Png
        {
            return Err(
                CliError::usage("the picture of the differences is a PNG").hint("end its name with .png")
            );
        }
        if args.json && output == Some(Output::Stdout) {
            return Err(CliError::usage("--json and --output - both want standard output"));
        }
        Ok(Self { a: args.a, b: args.b, thresholds: args.fail_above, output, json: args.json })
    }
}

pub(super) fn run(args: DiffArgs, console: Console) -> Result<Outcome, CliError> {
    let config = DiffConfig::new(args)?;
    let (a, b) = (load(&config.a)?, load(&config.b)?);
    let difference = Difference::between(&a, &b)?;
    let exceeded = exceeded(&difference, &config.thresholds)?;
    if let Some(output) = &config.output {
        write_preview(output, &config, &a, &b)?;
    }
    if config.json {
        print_json(&difference)?;
    } else if config.output != Some(Output::Stdout) {
        print(&table(&difference))?;
    }
    for failure in &exceeded {
        console.note(failure);
    }
    Ok(if exceeded.is_empty() { Outcome::Done } else { Outcome::Failed })
}

/// One line for each threshold that is exceeded; NaN exceeds any.
fn exceeded(difference: &Difference, thresholds: &[Threshold]) -> Result<Vec<String>, CliError> {
    let mut lines = Vec::new();
    for Threshold { metric, limit } in thresholds {
        let value = metric.of(difference).ok_or_else(|| {
            CliError::usage(format!("{metric} needs planes R, G, B, which these pictures lack"))
        })?;
        if value.is_nan() || value > *limit {
            lines.push(format!("{metric} is {value}, above {limit}"));
        }
    }
    Ok(lines)
}

fn write_preview(output: &Output, config: &DiffConfig, a: &Picture, b: &Picture) -> Result<(), CliError> {
    let preview = difference_preview(&a.channels, &b.channels, a.pixels());
    let pair = format!("{} and {}", config.a.display(), config.b.display());
    let bytes = encode_preview(a.width, a.height, &preview, &Metadata::new().with("difference of", pair))?;
    Ok(output.write(&bytes)?)
}

fn table(difference: &Difference) -> String {
    let flip = difference.flip.map_or_else(|| "- (no colours)".to_owned(), |flip| flip.to_string());
    format!(
        "rmse              {}\nmax               {}\npsnr              {} dB\nflip              {flip}\n\
         differing pixels  {} of {}\n",
        difference.rmse, difference.max, difference.psnr, difference.differing_pixels, difference.pixels
    )
}
