//! What a picture took.

use egui::{ProgressBar, RichText, Ui};

use super::super::Backend;
use super::super::session::{Session, Status};
use super::super::tracer::{Kind, Traced};
use super::{grid, short, warning};

impl Status {
    /// Take note of a picture.
    pub fn learn(&mut self, traced: &Traced) {
        let exposure = &traced.exposure;
        self.kind = Some(traced.kind);
        self.size = [exposure.film.width, exposure.film.height];
        self.samples = [exposure.passes, exposure.samples];
        let blocks = exposure.columns() * exposure.film.height.div_ceil(8);
        let passes = exposure.passes as f32 + exposure.blocks as f32 / blocks.max(1) as f32;
        self.done = passes / exposure.samples.max(1) as f32;
        self.rays = exposure.rays;
        self.times = exposure.times;
        if traced.kind == Kind::Motion {
            self.motion_size = self.size;
            self.motion_time = exposure.times.trace;
        }
    }
}

/// The device and how far the picture is, in two lines.
pub(super) fn status(ui: &mut Ui, session: &Session) {
    let Status { size: [width, height], samples: [taken, all], .. } = session.status;
    let device = match session.backend {
        Backend::Gpu => session.adapter.name.as_str(),
        Backend::Cpu { .. } => "CPU",
    };
    ui.add(egui::Label::new(RichText::new(device).weak()).truncate());
    let status = &session.status;
    if let Some(failure) = &status.failure {
        let color = warning(ui);
        ui.colored_label(color, failure);
        return;
    }
    let (part, text) = match status.kind {
        _ if status.is_compiling => (0.0, "compiling the shader …".to_owned()),
        None => (0.0, "tracing …".to_owned()),
        Some(Kind::Motion) => (0.0, format!("{width}×{height}, moving")),
        Some(Kind::Growing) => {
            (status.done, format!("{width}×{height}, sample {} of {all}", (taken + 1).min(all)))
        }
        Some(Kind::Complete | Kind::Reference) => {
            (1.0, format!("{width}×{height}, {all} {}", if all == 1 { "sample" } else { "samples" }))
        }
    };
    ui.add(ProgressBar::new(part).text(RichText::new(text).small()).desired_height(16.0).corner_radius(3));
}

/// Figures of the last picture.
pub(super) fn show(ui: &mut Ui, session: &Session) {
    let Status { rays, times, motion_size, motion_time, kind, .. } = session.status;
    let seconds = times.trace.as_secs_f64();
    let row = |ui: &mut Ui, name: &str, value: String, hint: &str| {
        ui.label(name).on_hover_text(hint);
        ui.monospace(value);
        ui.end_row();
    };
    grid(ui, "statistics", |ui| {
        row(ui, "trace", format!("{:.1} ms", seconds * 1e3), "Tracing the picture that is shown, so far");
        row(ui, "compile", format!("{:.1} ms", times.compile.as_secs_f64() * 1e3), "Before its first ray");
        let rate = |count: u64| {
            if seconds > 0.0 { format!("{}rays/s", short(count as f64 / seconds)) } else { "–".to_owned() }
        };
        for (name, count) in [
            ("primary", rays.primary),
            ("reflected", rays.reflection),
            ("refracted", rays.refraction),
            ("shadow", rays.shadow),
            ("all", rays.total()),
        ] {
            row(
                ui,
                name,
                format!("{:>8}  {}", short(count as f64), rate(count)),
                "Rays traced, and how many a second",
            );
        }
        let [width, height] = motion_size;
        row(
            ui,
            "moving",
            format!("{width}×{height} in {:.1} ms", motion_time.as_secs_f64() * 1e3),
            "The last picture while something moved: it is to take 30 ms",
        );
        row(ui, "triangles", short(session.stage.flat.scene.triangles.len() as f64), "Of the whole scene");
        if let Some(ranges) = session.ranges.filter(|_| kind == Some(Kind::Complete)) {
            row(ui, "dropped", format!("≤ {:.2e}", ranges.dropped), "Greatest weight of a pixel's cut rays");
            row(
                ui,
                "error",
                format!("≤ {:.2e}", ranges.bound),
                "Certified bound on any pixel's truncation error, as radiance",
            );
        }
    });
}
