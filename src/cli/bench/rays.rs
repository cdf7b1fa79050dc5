//! `snellius bench --rays`: raw traversal.

use std::fs;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::super::console::{Console, print, print_json};
use super::super::device::cpu_name;
use super::super::values::Point;
use super::super::{CliError, Outcome};
use super::{BenchArgs, adapters_of};
use crate::bench::Target;
use crate::bench::rays::{
    Measured, Mode, Pinhole, Query, RayAdapter, RayError, RayRecord, RayRun, RaySets, RayStage, SIDE,
    measure, read_rays, write_answers, write_rays,
};
use crate::bvh::Preset;

/// Which rays against which mesh.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Rays")]
pub(super) struct RayArgs {
    /// Trace rays against this mesh, without shading
    #[arg(id = "mesh", long = "rays", value_name = "MESH.obj")]
    pub(super) mesh: Option<PathBuf>,
    /// Where the primary rays start [default: where all of the mesh is seen]
    #[arg(long, value_name = "X,Y,Z", requires = "mesh", allow_hyphen_values = true)]
    eye: Option<Point>,
    /// What the middle one goes to
    #[arg(long, value_name = "X,Y,Z", requires = "mesh", allow_hyphen_values = true)]
    target: Option<Point>,
    /// Angle between the uppermost and the lowest, in degrees
    #[arg(long, value_name = "DEGREES", requires = "mesh", value_parser = angle)]
    fov: Option<f64>,
    /// How the tree is built
    #[arg(long, value_name = "PRESET", requires = "mesh", default_value = "best", value_parser = ["fast", "best"])]
    preset: String,
    /// Write MESH.{P,R,D,S}.rays and .hits into this folder
    #[arg(long, value_name = "DIR", requires = "mesh")]
    dump: Option<PathBuf>,
    /// Trace the rays of a file instead: u32 count, then 8 f32 a ray (origin, tmin, direction, tmax), little-endian
    #[arg(long, value_name = "FILE", requires = "mesh", conflicts_with_all = ["eye", "target", "fov"])]
    ray_file: Option<PathBuf>,
    /// Ask of the file's rays only whether they hit anything
    #[arg(long, requires = "ray_file")]
    any: bool,
}

fn angle(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(angle) if angle > 0.0 && angle < 180.0 => Ok(angle),
        _ => Err("expected an angle between 0 and 180".to_owned()),
    }
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct RayReport {
    /// The mesh's file.
    mesh: String,
    triangles: usize,
    /// Trees built, encoding and collapsing included, with all threads.
    build_ms: f64,
    /// Of the tree that rays go through, triangles included.
    bytes_per_triangle: f64,
    runs: Vec<RayRun>,
}

pub(super) fn run(mesh: &Path, args: &BenchArgs, console: Console) -> Result<Outcome, CliError> {
    if mesh.extension().is_none_or(|end| !end.eq_ignore_ascii_case("obj")) {
        let error =
            CliError::usage(format!("--rays takes a mesh, and {} is not an .obj file", mesh.display()));
        return Err(error.hint("scenes are measured without --rays"));
    }
    let RayArgs { eye, target, fov, .. } = &args.rays;
    let pinhole = Pinhole { eye: eye.map(|at| at.0), target: target.map(|at| at.0), fov: *fov };
    let preset = if args.rays.preset == "fast" { Preset::Fast } else { Preset::Best };
    let stage = RayStage::load(mesh, preset, pinhole)?;
    let mut adapters = Vec::new();
    for target in adapters_of(args)? {
        if let Target::Adapter(adapter) = target {
            adapters.push(RayAdapter::new(&adapter, &stage)?);
        }
    }
    let mut report = RayReport {
        mesh: mesh.file_name().unwrap_or(mesh.as_os_str()).to_string_lossy().into_owned(),
        triangles: stage.triangles(),
        build_ms: stage.build_time().as_secs_f64() * 1e3,
        bytes_per_triangle: stage.bytes_per_triangle(),
        runs: Vec::new(),
    };
    let mut faults = 0;
    let mut measured = |set: &str, rays: &[RayRecord], query: Query| {
        console.detail(format!("{set}: {} rays", rays.len()));
        let Measured { runs, answers, faults: found } =
            measure(&stage, &mut adapters, set, rays, query, args.rounds_or_default() as usize)?;
        faults += found.len();
        found.into_iter().for_each(|fault| console.warn(fault));
        report.runs.extend(runs);
        Ok::<_, CliError>(answers)
    };
    if let Some(file) = &args.rays.ray_file {
        let set = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy();
        let query = if args.rays.any { Query::Any } else { Query::Nearest };
        let rays = read_rays(file)?;
        let answers = measured(&set, &rays, query)?;
        if let Some(folder) = &args.rays.dump {
            make_folder(folder)?;
            write_answers(&folder.join(&*set).with_extension("hits"), &answers)?;
        }
    } else {
        let sets = RaySets::of(&stage, SIDE);
        for (letter, rays, query) in sets.by_letter() {
            let answers = measured(letter, rays, query)?;
            if let Some(folder) = &args.rays.dump {
                make_folder(folder)?;
                let stem = mesh.file_stem().unwrap_or(mesh.as_os_str()).to_string_lossy();
                write_rays(&folder.join(format!("{stem}.{letter}.rays")), rays)?;
                write_answers(&folder.join(format!("{stem}.{letter}.hits")), &answers)?;
            }
        }
    }
    if args.json {
        print_json(&report)?
    } else {
        print(&page(&report, args.rounds_or_default()))?
    }
    Ok(if faults == 0 { Outcome::Done } else { Outcome::Failed })
}

fn make_folder(folder: &Path) -> Result<(), RayError> {
    fs::create_dir_all(folder).map_err(|error| RayError::Io { what: "write", path: folder.into(), error })
}

/// A table for people.
fn page(report: &RayReport, rounds: u32) -> String {
    let mut text =
        String::from("| rays | device | threads | mode | Mrays/s | hits |\n|---|---|--:|---|--:|--:|\n");
    for run in &report.runs {
        let mode = match run.mode {
            Mode::Single => "single",
            Mode::Coherent => "coherent",
        };
        let RayRun { set, device, threads, mrays_per_s, hits, .. } = run;
        let threads = if *threads == 0 { "–".to_owned() } else { threads.to_string() };
        text += &format!("| {set} | {device} | {threads} | {mode} | {mrays_per_s:.2} | {hits} |\n");
    }
    let RayReport { mesh, triangles, build_ms, bytes_per_triangle, .. } = report;
    text + &format!(
        "\n{mesh}: {triangles} triangles, built in {build_ms:.0} ms, {bytes_per_triangle:.0} bytes a triangle; medians of \
         {rounds} runs in turn; every hit has the bits of the scalar kernel's. {}.\n",
        cpu_name()
    )
}
