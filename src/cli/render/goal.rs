//! `--error` and `--time`: settings that keep a budget, and what is said about them.

use super::super::CliError;
use super::super::console::Console;
use super::super::device::Device;
use super::super::prepare::Prepared;
use super::super::values::name_of;
use crate::film::{Frame, Renderer};
use crate::flatten;
use crate::layout::{Precision, Settings};
use crate::study::{self, Choice, Goal};

/// Choose depth, cut-off and precision, and say what was chosen and what is estimated.
pub(super) fn choose(
    goal: Goal,
    device: &mut Device,
    prepared: &Prepared,
    size: [u32; 2],
    base: Settings,
    console: Console,
) -> Result<Choice, CliError> {
    let (scene, camera) = (&prepared.flat.scene, &prepared.scene.camera);
    let precisions = precisions(device);
    let mut time = |size: [u32; 2], settings: &Settings| {
        let view = flatten::view(camera, scene, size, None, settings);
        // The first run compiles and warms up.
        device.render(&view, settings, &())?;
        let times = device.render(&view, settings, &())?.times;
        Ok::<_, CliError>(times.trace + times.readback)
    };
    let choice = study::choose((scene, camera), size, base, precisions, goal, &mut time)?;
    console.note(chosen(&choice));
    console.note(estimate(goal, &choice));
    if !choice.meets {
        console.warn(match goal {
            Goal::Error { limit, .. } => format!("no settings were found that surely keep {limit}"),
            Goal::Time(most) => format!("not even the coarsest settings trace in {} ms", most.as_millis()),
        });
    }
    Ok(choice)
}

/// What the device can compute in, the cheaper first.
fn precisions(device: &Device) -> &'static [Precision] {
    let has_f64 = match device {
        Device::Cpu(_) => true,
        Device::Gpu(renderer) => renderer.adapter().f64,
    };
    if has_f64 { &[Precision::F32, Precision::F64] } else { &[Precision::F32] }
}

fn chosen(choice: &Choice) -> String {
    let Settings { depth, cutoff, samples, precision, .. } = choice.settings;
    format!(
        "chosen: depth {depth}, cutoff {cutoff}, {}; samples stay at {samples} ({} candidates on {} pixels)",
        name_of(precision),
        choice.tried,
        choice.probed
    )
}

fn estimate(goal: Goal, choice: &Choice) -> String {
    let name = match goal {
        Goal::Error { metric, .. } => metric.name(),
        Goal::Time(_) => "rmse",
    };
    let [figure, above] = choice.figure;
    let certified = choice.judge.certified.map_or(0.0, |certified| certified.rmse);
    format!(
        "estimated: {name} {figure:.2e}, with 95 % confidence below {above:.2e}, against the whole tree in f64 of the \
         same samples (itself within {certified:.1e} rmse of depth 64 uncut)"
    )
}

/// What the finished picture proves of itself.
pub(super) fn guarantee(frame: &Frame) -> String {
    let bounds = || frame.texels.iter().map(|texel| f64::from(texel.bound).min(1.0));
    let squares: f64 = bounds().map(|bound| bound * bound).sum();
    let rms = (squares / frame.texels.len().max(1) as f64).sqrt();
    let max = bounds().fold(0.0, f64::max);
    format!(
        "guaranteed: what was cut changes no pixel by more than {max:.2e}, all of them by rmse {rms:.2e} at most"
    )
}
