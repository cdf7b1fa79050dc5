//! `snellius render`: a scene to a picture.

mod args;
mod config;
mod export;
mod goal;
mod report;
mod turntable;

use std::time::{Duration, Instant};

use super::console::{Console, print_json};
use super::device::Device;
use super::prepare::Prepared;
use super::progress::RenderProgress;
use super::values::{Size, name_of};
use super::{CliError, Outcome};
use crate::film::{Frame, Metadata, Renderer, Summary};
use crate::flatten;
use crate::layout::constants::BASE_SAMPLES;
use crate::layout::{EffectSet, Effects, Settings};
use crate::scene::{Diagnostic, RenderDefaults};
use crate::study::Request;
pub(super) use args::{ArithmeticArgs, RenderArgs};
use config::RenderConfig;
use report::{RenderReport, Times};

pub(super) fn run(args: RenderArgs, console: Console) -> Result<Outcome, CliError> {
    let started = Instant::now();
    let config = RenderConfig::new(args)?;
    let prepared = Prepared::new(&config.scene)?;
    prepared.warnings().for_each(|warning| console.warn_of(warning));
    let (scene, flat) = (&prepared.scene, &prepared.flat.scene);
    let mut render = config.overridden(&scene.render);
    let mut settings = config.settings(&render);
    let crop = config.crop(render.size)?;
    warn_of_lacking(&Effects::of(flat, &settings), &settings, console);
    let mut device = config.device.clone().settle(config.precision, console).open(flat)?;
    if let Some(goal) = config.goal {
        let request = Request {
            scene: flat,
            camera: &scene.camera,
            size: render.size,
            base: settings,
            keeps_samples: config.samples.is_some() || config.adaptive.is_some(),
            precisions: &[],
        };
        settings = goal::choose(goal, &mut device, request, console)?.settings;
        render = config::chosen(&render, &settings);
    }
    let simulated = Effects::of(flat, &settings).plan(&settings).effects;
    if let Some(pictures) = config.turntable {
        let how = (&render, settings, simulated);
        return turntable::run(pictures, &config, &prepared, &mut device, how, console);
    }
    let view = flatten::view(&scene.camera, flat, render.size, crop, &settings);
    let frame = {
        let progress = RenderProgress::start(config.progress, console);
        device.render(&view, &settings, &progress)?
    };
    let job = Job {
        config: &config,
        prepared: &prepared,
        render,
        settings,
        simulated,
        device: &device,
        frame: &frame,
    };
    let encode = job.write_pictures(console)?;
    let times = Times::new(prepared.load, prepared.flat.bvh_time, frame.times, encode, started.elapsed());
    if config.json {
        print_json(&job.report(times))?;
    }
    job.summarise(times, console);
    if let Some(goal) = config.goal {
        console.note(goal::kept(goal, &frame));
    }
    Ok(if frame.complete { Outcome::Done } else { Outcome::Interrupted })
}

/// Say what the scene calls for and the picture will lack.
fn warn_of_lacking(effects: &Effects, settings: &Settings, console: Console) {
    let simulated = effects.plan(settings).effects;
    let lacking: Vec<_> = effects.findings().iter().filter(|f| f.on && !simulated.has(f.effect)).collect();
    if !lacking.is_empty() {
        let names: EffectSet = lacking.iter().map(|finding| finding.effect).collect();
        let reasons: Vec<_> = lacking.iter().map(|finding| finding.reason.as_str()).collect();
        let message = format!("--effects leaves out what the scene calls for: {names}");
        console.warn_of(&Diagnostic::warning(message).hint(reasons.join("; ")));
    }
}

/// A traced frame and all that is known of how it came about.
struct Job<'a> {
    config: &'a RenderConfig,
    prepared: &'a Prepared,
    render: RenderDefaults,
    settings: Settings,
    simulated: EffectSet,
    device: &'a Device<'a>,
    frame: &'a Frame,
}

impl Job<'_> {
    /// Write the picture and the AOVs; returns the time that took.
    fn write_pictures(&self, console: Console) -> Result<Duration, CliError> {
        let started = Instant::now();
        let metadata = self.metadata();
        if let Some(output) = &self.config.output {
            export::write_radiance(self.frame, output, self.config.png, &metadata)?;
        }
        for (kind, output) in &self.config.aovs {
            export::write_aov(self.frame, *kind, output, &metadata, console)?;
        }
        Ok(started.elapsed())
    }

    fn metadata(&self) -> Metadata {
        let summary = Summary::of(self.frame);
        let metadata = Metadata::new()
            .with("scene", self.config.scene.display().to_string())
            .with("settings", self.settings_line())
            .with("device", self.device.name())
            .with("driver", self.device.driver())
            .with("effects", self.simulated.to_string())
            .with("seconds", format!("{:.3}", self.frame.times.trace.as_secs_f64()))
            .with("complete", if self.frame.complete { "yes" } else { "no: interrupted, the rest is black" });
        match summary.non_finite_pixels {
            0 => metadata,
            pixels => metadata.with("pixels not finite", pixels.to_string()),
        }
    }

    fn settings_line(&self) -> String {
        let RenderDefaults { size, depth, cutoff, samples, adaptive } = self.render;
        let Settings { precision, intersector, .. } = self.settings;
        let words = [name_of(precision), name_of(self.frame.float), name_of(intersector)];
        let adaptive = adaptive.map_or_else(String::new, |threshold| format!(", adaptive {threshold}"));
        let crop = self.config.crop.map_or_else(String::new, |crop| format!(", crop {crop}"));
        format!(
            "{}, depth {depth}, cutoff {cutoff}, samples {samples}{adaptive}, {}{crop}",
            Size(size),
            words.join(", ")
        )
    }

    fn report(&self, times_ms: Times) -> RenderReport {
        let Summary { dropped, bound, samples, .. } = Summary::of(self.frame);
        RenderReport {
            scene: self.config.scene.display().to_string(),
            backend: name_of(self.device.backend()),
            adapter: self.device.name(),
            driver: self.device.driver(),
            precision: name_of(self.settings.precision),
            float: name_of(self.frame.float),
            size: self.render.size,
            depth: self.render.depth,
            cutoff: self.render.cutoff,
            samples: self.render.samples,
            adaptive: self.render.adaptive,
            samples_taken: samples,
            triangles: self.prepared.flat.scene.triangles.len(),
            effects: self.simulated.iter().map(|effect| effect.name().to_owned()).collect(),
            rays: self.frame.rays.into(),
            times_ms,
            dropped,
            bound,
            max_radiance: self.prepared.flat.scene.radiance_bound.last().copied().unwrap_or_default(),
        }
    }

    /// What a person wants to know at the end, and what may surprise.
    fn summarise(&self, times: Times, console: Console) {
        let Summary { non_finite_pixels, dropped, bound, samples } = Summary::of(self.frame);
        if non_finite_pixels > 0 {
            console
                .warn(format!("{non_finite_pixels} pixels are not finite; in PNG and HDR they are magenta"));
        }
        if self.frame.float != self.settings.float {
            console.warn(format!(
                "{} traced with --float {}, not {}",
                self.device.name(),
                name_of(self.frame.float),
                name_of(self.settings.float)
            ));
        }
        if self.settings.adaptive.is_some() && self.settings.threshold().is_none() {
            console.warn(format!(
                "--adaptive has nothing to choose with --samples {}: each pixel gets {BASE_SAMPLES} at the least",
                self.settings.samples
            ));
        }
        if !self.frame.complete {
            console.warn("interrupted: a part of the picture is missing");
        }
        if let Some(output) = &self.config.output {
            console.note(format!("{output}: {}; {:.2} s", self.settings_line(), times.total / 1e3));
        }
        console.detail(times);
        if self.settings.threshold().is_some() {
            console.detail(format!("samples: mean {:.2}, greatest {}", samples.mean, samples.max));
        }
        console.detail(format!(
            "weight of cut rays: mean {:.3e}, greatest {:.3e}; error of a pixel at most {:.3e}",
            dropped.mean, dropped.max, bound.max
        ));
    }
}
