//! `render --turntable`: pictures from round the target.

use super::super::console::Console;
use super::super::device::Device;
use super::super::prepare::Prepared;
use super::super::progress::RenderProgress;
use super::super::{CliError, Outcome};
use super::Job;
use super::config::RenderConfig;
use super::export::write_radiance;
use crate::film::{Output, Renderer, numbered};
use crate::flatten;
use crate::layout::{EffectSet, Settings};
use crate::scene::RenderDefaults;

/// Write the pictures one by one, each as soon as it is traced.
pub(super) fn run(
    pictures: u32,
    config: &RenderConfig,
    prepared: &Prepared,
    device: &mut Device<'_>,
    (render, settings, simulated): (&RenderDefaults, Settings, EffectSet),
    console: Console,
) -> Result<Outcome, CliError> {
    let Some(Output::File { path, .. }) = &config.output else { return Ok(Outcome::Done) };
    let crop = config.crop(render.size)?;
    let flat = &prepared.flat.scene;
    for picture in 0..pictures {
        let degrees = 360.0 * f64::from(picture) / f64::from(pictures);
        let camera = prepared.scene.camera.turned(degrees);
        let view = flatten::view(&camera, flat, render.size, crop, &settings);
        let frame = device.render(&view, &settings, &RenderProgress::start(config.progress, console))?;
        let output = Output::new(&numbered(path, picture))?;
        let (render, device) = (render.clone(), &*device);
        let job = Job { config, prepared, render, settings, simulated, device, frame: &frame };
        let metadata = job.metadata().with("turned", format!("{degrees} degrees"));
        write_radiance(&frame, &output, config.png, &metadata)?;
        console.note(format!("{output}: {degrees:.1}°"));
        if !frame.complete {
            return Ok(Outcome::Interrupted);
        }
    }
    Ok(Outcome::Done)
}
