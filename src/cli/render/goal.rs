//! `--error` and `--time`: settings that keep a budget, and what is said about them.

use super::super::CliError;
use super::super::console::Console;
use super::super::device::Device;
use super::super::values::name_of;
use crate::film::{Frame, Metric, Renderer};
use crate::flatten;
use crate::layout::{Precision, Settings};
use crate::study::{self, Choice, Goal, MOST_SAMPLES, Request};

/// Choose settings, and say what was chosen and what is estimated; what the device can compute in is added to the
/// request. A goal that nothing meets is told before anything is traced in vain.
pub(super) fn choose(
    goal: Goal,
    device: &mut Device,
    request: Request<'_>,
    console: Console,
) -> Result<Choice, CliError> {
    let request = Request { precisions: precisions(device), ..request };
    let mut time = |size: [u32; 2], settings: &Settings| {
        let view = flatten::view(request.camera, request.scene, size, None, settings);
        // The first run compiles and warms up.
        device.render(&view, settings, &())?;
        let times = device.render(&view, settings, &())?.times;
        Ok::<_, CliError>(times.trace + times.readback)
    };
    console.note(format!("choosing settings for {}", words(goal)));
    let choice = study::choose(&request, goal, &mut time)?;
    if !choice.meets {
        return Err(unmet(goal, &choice, request.keeps_samples));
    }
    console.note(chosen(&choice));
    console.note(estimate(goal, &choice));
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

fn words(goal: Goal) -> String {
    match goal {
        Goal::Error { limit, .. } => format!("{} {limit}", metric_of(goal).name()),
        Goal::Time(most) => format!("{} ms", most.as_secs_f64() * 1e3),
    }
}

fn metric_of(goal: Goal) -> Metric {
    match goal {
        Goal::Error { metric, .. } => metric,
        Goal::Time(_) => Metric::Rmse,
    }
}

/// Why there is no picture, and what there could be.
fn unmet(goal: Goal, choice: &Choice, keeps_samples: bool) -> CliError {
    match goal {
        Goal::Time(_) => CliError::unmet(
            format!("not even the coarsest settings trace in {}", words(goal)),
            "a smaller --size takes less",
        ),
        Goal::Error { .. } if keeps_samples => CliError::unmet(
            format!("no settings surely keep {} against the same samples", words(goal)),
            format!("about {:.1e} can be had", choice.figure[1]),
        ),
        Goal::Error { .. } => CliError::unmet(
            format!("no settings surely keep {}, not even {MOST_SAMPLES} samples a pixel", words(goal)),
            format!(
                "about {:.1e} can be had; with --samples N the error is that against the same samples alone",
                choice.figure[1]
            ),
        ),
    }
}

fn chosen(choice: &Choice) -> String {
    let Settings { depth, cutoff, samples, precision, adaptive, .. } = choice.settings;
    let sampling = match adaptive {
        Some(threshold) => {
            format!("samples {samples}, adaptive {threshold} (about {:.0} a pixel)", choice.samples)
        }
        None => format!("samples {samples}"),
    };
    format!(
        "chosen: depth {depth}, cutoff {cutoff}, {sampling}, {} ({} settings tried on {} pixels)",
        name_of(precision),
        choice.tried,
        choice.probed
    )
}

fn estimate(goal: Goal, choice: &Choice) -> String {
    let [figure, above] = choice.figure;
    let against = match choice.sampling {
        Some([sampling, _]) => {
            format!(
                "samples without end ({sampling:.1e} of it from those that are missing) of the whole tree"
            )
        }
        None => "the same samples of the whole tree".to_owned(),
    };
    let certified = choice.judge.certified.map_or(0.0, |certified| certified.rmse);
    format!(
        "estimated: {} {figure:.2e}, with 95 % confidence below {above:.2e}, against {against} in f64, which is itself \
         within {certified:.1e} rmse of depth 64 uncut",
        metric_of(goal).name()
    )
}

/// What the finished picture proves of itself, and the time that it took where that was the goal.
pub(super) fn kept(goal: Goal, frame: &Frame) -> String {
    match goal {
        Goal::Error { .. } => guarantee(frame),
        Goal::Time(most) => {
            let [took, given] =
                [frame.times.trace + frame.times.readback, most].map(|time| time.as_secs_f64() * 1e3);
            format!("traced in {took:.0} ms of {given:.0} ms\n{}", guarantee(frame))
        }
    }
}

fn guarantee(frame: &Frame) -> String {
    let bounds = || frame.texels.iter().map(|texel| f64::from(texel.bound).min(1.0));
    let squares: f64 = bounds().map(|bound| bound * bound).sum();
    let rms = (squares / frame.texels.len().max(1) as f64).sqrt();
    let max = bounds().fold(0.0, f64::max);
    format!(
        "guaranteed: what was cut changes no pixel by more than {max:.2e}, all of them by rmse {rms:.2e} at most"
    )
}
