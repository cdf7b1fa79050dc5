//! `snellius trace`: the whole ray tree of one pixel.

mod report;

use std::path::PathBuf;
use std::str::FromStr;

use super::console::{Console, print, print_json};
use super::prepare::Prepared;
use super::render::ArithmeticArgs;
use super::values::{Size, name_of, number_in, whole_in};
use super::{CliError, Outcome};
use crate::film::write_whole;
use crate::flatten;
use crate::gpu::{GpuOptions, GpuRenderer};
use crate::layout::constants::{MAX_DEPTH, TREE_NODES};
use crate::layout::{FlatScene, Float, Precision, Settings, TreeNode, View};
use crate::trace::{Tree, drawing, on_cpu};
use report::{Told, TraceReport, heading, parted, text};

/// Show the whole ray tree of one pixel
///
/// Each ray with what it met, from which side, through which media, at which angle, what was reflected, what it
/// weighs, what it added to the pixel and why it ended. The tree is that of the pixel's first sample, recorded by the
/// loop that makes every picture.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  snellius trace scenes/ice.toml --pixel 640,360
  snellius trace scenes/ice.toml --pixel 640,360 --backend both
  snellius trace scenes/whitted.toml --pixel 500,400 --cutoff 0 --svg tree.svg")]
pub(super) struct TraceArgs {
    /// The scene: .toml or .obj
    scene: PathBuf,
    /// Column and row of the pixel, from the top left, from 0
    #[arg(long, value_name = "X,Y")]
    pixel: Pixel,
    /// Width and height of the whole picture in pixels [default: the scene's]
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
    /// Deepest ray that is traced, 0 to 64 [default: the scene's]
    #[arg(long, value_name = "N", value_parser = |text: &str| whole_in(text, 0, MAX_DEPTH))]
    depth: Option<u32>,
    /// Least weight of a ray that is traced, 0 to 1 [default: the scene's]
    #[arg(long, value_name = "W", value_parser = |text: &str| number_in(text, 0.0, 1.0))]
    cutoff: Option<f64>,
    /// Who traces; both: CPU f32, CPU f64 and the adapter, and where they part
    #[arg(long, value_name = "DEVICE", default_value = "cpu", help_heading = "Device")]
    backend: Who,
    /// Part of the name of a Vulkan adapter
    #[arg(long, value_name = "NAME", help_heading = "Device")]
    adapter: Option<String>,
    #[command(flatten)]
    arithmetic: ArithmeticArgs,
    /// Draw the tree, and the path from the side, to an SVG file
    #[arg(long, value_name = "PATH")]
    svg: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long, help_heading = "Messages")]
    json: bool,
}

/// Who traces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Who {
    /// The processor
    Cpu,
    /// A Vulkan adapter
    Gpu,
    /// CPU f32, CPU f64 and the adapter
    Both,
}

/// `X,Y`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Pixel([u32; 2]);

impl FromStr for Pixel {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers =
            text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
        numbers.map(Self).ok_or_else(|| "expected X,Y in pixels from the top left, as in 120,88".to_owned())
    }
}

/// A pixel of a scene, ready to be traced.
struct Subject<'a> {
    flat: &'a FlatScene,
    view: View,
    settings: Settings,
    pixel: [u32; 2],
}

pub(super) fn run(args: &TraceArgs, console: Console) -> Result<Outcome, CliError> {
    let prepared = Prepared::new(&args.scene)?;
    prepared.warnings().for_each(|warning| console.warn_of(warning));
    let (scene, flat) = (&prepared.scene, &prepared.flat.scene);
    let size = args.size.map_or(scene.render.size, |size| size.0);
    let pixel = args.pixel.0;
    if pixel[0] >= size[0] || pixel[1] >= size[1] {
        return Err(CliError::usage(format!(
            "--pixel {},{} is not inside the picture of {}",
            pixel[0],
            pixel[1],
            Size(size)
        ))
        .hint("columns and rows are counted from 0"));
    }
    let settings = Settings {
        depth: args.depth.unwrap_or(scene.render.depth),
        cutoff: args.cutoff.unwrap_or(scene.render.cutoff) as f32,
        samples: 1,
        precision: args.arithmetic.precision,
        float: args.arithmetic.float,
        intersector: args.arithmetic.intersector,
        ..Settings::default()
    };
    let view = flatten::view(&scene.camera, flat, size, None, &settings);
    let subject = Subject { flat, view, settings, pixel };
    let trees = trees(args, &subject, console)?;
    let partings = trees.iter().skip(1).map(|told| parted(&trees[0], told)).collect::<Vec<_>>();
    if let Some(path) = &args.svg {
        let told = &trees[0];
        let title = format!("{}, pixel {},{}: {}", args.scene.display(), pixel[0], pixel[1], heading(told));
        let svg = drawing(&told.tree, &told.records, flat, &title);
        write_whole(path, svg.as_bytes())
            .map_err(|error| CliError::usage(format!("cannot write {}: {error}", path.display())))?;
        console.note(format!("{}: drawn", path.display()));
    }
    if args.json {
        let scene = args.scene.display().to_string();
        let (depth, cutoff) = (settings.depth, f64::from(settings.cutoff));
        print_json(&TraceReport { scene, size, pixel, depth, cutoff, trees, partings })?;
    } else {
        print(&text(&trees, &partings))?;
    }
    Ok(Outcome::Done)
}

/// The trees that are asked for; the first is the one that others are held against.
fn trees(args: &TraceArgs, subject: &Subject, console: Console) -> Result<Vec<Told>, CliError> {
    let adapter = || on_adapter(args.adapter.clone(), subject, console);
    let cpu = |precision| on_processor(subject, precision);
    Ok(match args.backend {
        Who::Cpu => vec![cpu(subject.settings.precision)],
        Who::Gpu => vec![adapter()?],
        Who::Both => {
            let other = match subject.settings.precision {
                Precision::F32 => Precision::F64,
                Precision::F64 => Precision::F32,
            };
            vec![cpu(subject.settings.precision), cpu(other), adapter()?]
        }
    })
}

fn on_processor(subject: &Subject, precision: Precision) -> Told {
    let settings = Settings { precision, ..subject.settings };
    let recorded = on_cpu(subject.flat, &subject.view, &settings, subject.pixel);
    subject.told("CPU".to_owned(), precision, Float::Strict, recorded.texel.radiance, recorded.nodes)
}

fn on_adapter(adapter: Option<String>, subject: &Subject, console: Console) -> Result<Told, CliError> {
    let mut renderer = GpuRenderer::new(subject.flat, &GpuOptions { adapter, ..GpuOptions::default() })?;
    let traced = renderer.trace_tree(&subject.view, &subject.settings, subject.pixel)?;
    if traced.recorded > TREE_NODES {
        console.warn(format!("the tree has {} rays; only the first {TREE_NODES} are shown", traced.recorded));
    }
    let name = renderer.adapter().name.clone();
    Ok(subject.told(name, subject.settings.precision, traced.float, traced.texel.radiance, traced.nodes))
}

impl Subject<'_> {
    fn told(
        &self,
        device: String,
        precision: Precision,
        float: Float,
        radiance: [f32; 3],
        records: Vec<TreeNode>,
    ) -> Told {
        let tree = Tree::new(&records, self.flat, &self.view);
        Told {
            device,
            precision: name_of(precision),
            float: name_of(float),
            rays: tree.rays(),
            shadow_rays: tree.shadow_rays(),
            radiance,
            tree,
            records,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_a_column_and_a_row() {
        assert_eq!("120, 88".parse(), Ok(Pixel([120, 88])));
        for wrong in ["120", "1,2,3", "-1,2", "a,b", ""] {
            assert!(wrong.parse::<Pixel>().is_err(), "{wrong}");
        }
    }
}
