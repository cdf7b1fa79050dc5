//! What the panels leave for the window to do, most of it with files.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use std::{fs, thread};

use winit::event_loop::{ActiveEventLoop, EventLoopProxy};

use super::app::Message;
use super::cost::{Cost, Finished};
use super::files::{self, Watch, files_of, png_of};
use super::inspection::Inspection;
use super::session::Order;
use super::stage::Stage;
use super::turntable::{Turning, Turntable};
use super::window::Shown;
use super::{Screenshot, ViewerError};
use crate::film::{Development, Output, encode_preview, write_whole};
use crate::gpu::sources_in;
use crate::scene::{Scene, SceneError};

impl Shown {
    /// Take on a scene that was read; the one before stays where that failed.
    pub(super) fn loaded(&mut self, loaded: Result<Stage, SceneError>) {
        match loaded {
            Ok(stage) => {
                let is_other = stage.path != self.session.stage.path;
                self.window.set_title(&title(&stage.path));
                self.session.put(Arc::new(stage));
                self.session.toasts.retain(|toast| !toast.is_error);
                self.session.say(if is_other { "opened" } else { "read again: the file has changed" });
                self.watch = watch(files_of(&self.session.stage), &self.proxy, || Message::Written);
                // What was waited for is of another scene.
                self.unanswered.clear();
                self.ask(Instant::now());
            }
            Err(error) => self.session.complain(error.to_string()),
        }
    }

    /// Read a scene on another thread.
    pub(super) fn load(&self, path: PathBuf) {
        let proxy = self.proxy.clone();
        thread::spawn(move || {
            // Fails only when the loop has ended.
            let _ = proxy.send_event(Message::Loaded(Box::new(Stage::load(&path))));
        });
    }

    /// Read the shader files again, for the next picture.
    pub(super) fn read_shaders(&mut self) {
        let Some((folder, _)) = &self.shaders else { return };
        match sources_in(folder) {
            Ok(sources) => self.session.shaders = sources,
            Err(error) => self.session.complain(error.to_string()),
        }
        self.window.request_redraw();
    }

    /// Do what the panels left for the window to do.
    pub(super) fn carry_out(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        for order in std::mem::take(&mut self.session.orders) {
            match order {
                Order::Copy(text) => self.input.set_clipboard_text(text),
                Order::Open(path) => self.load(path),
                Order::UseAdapter(name) => {
                    let before = self.gpu.adapter.replace(name);
                    if let Err(error) = self.open_device() {
                        self.gpu.adapter = before;
                        self.open_device()?;
                        self.session.complain(error.to_string());
                    }
                }
                Order::SetPivot(pixel) => {
                    if let Some(point) = self.inspect(pixel).point() {
                        self.session.orbit.set_pivot(point);
                        // The click that came first showed the tree.
                        self.session.inspection = None;
                    }
                }
                Order::Compare(pixel) => {
                    if let Some(wanted) = self.inspected.clone() {
                        self.tracer.ask(wanted, pixel);
                    }
                }
                Order::Inspect(pixel) => {
                    self.session.inspection = Some(self.inspect(pixel));
                    self.inspected = Some(self.session.wanted([self.area[2], self.area[3]]));
                }
                Order::Screenshot => {
                    let saved = self.save_picture();
                    self.session.tell(saved);
                }
                Order::Turntable(pictures) => {
                    if let Err(message) = self.start_turntable(pictures) {
                        self.session.complain(message);
                    }
                }
                Order::SaveScene => {
                    let saved = self.save_scene();
                    self.session.tell(saved);
                }
                Order::Quit => event_loop.exit(),
            }
        }
        Ok(())
    }

    /// What a pixel of the picture is made of.
    fn inspect(&self, pixel: [u32; 2]) -> Inspection {
        let [_, _, width, height] = self.area;
        Inspection::of(&self.session, [width, height], pixel)
    }

    /// Write the finished picture, without the panel, to a new file of the working folder.
    fn save_picture(&self) -> Result<String, String> {
        let exposure = self.session.look.coarse.as_ref().filter(|_| self.session.is_complete());
        let exposure = exposure.ok_or("the picture is not complete yet: F12 writes it when it is")?;
        let frame = exposure.frame(&self.canvas.device).map_err(|error| error.to_string())?;
        let path =
            files::free_name(Path::new(""), &self.session.stem(), "png").ok_or("too many pictures here")?;
        let development = Development { exposure: self.session.look.exposure, ..Development::default() };
        let metadata = self.session.metadata();
        let bytes = png_of(&frame, development, &metadata).map_err(|error| error.to_string())?;
        write_whole(&path, &bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(format!("the picture is in {}", path.display()))
    }

    /// Have pictures from round the pivot traced and written.
    fn start_turntable(&mut self, pictures: u32) -> Result<(), String> {
        let Some(wanted) = self.wanted.clone() else { return Err("there is no picture yet".to_owned()) };
        let stem = self.session.stem();
        let stop = Arc::new(AtomicBool::new(false));
        let exposure = self.session.look.exposure;
        let turntable = Turntable {
            wanted,
            pictures,
            folder: files::free_folder(&stem)?,
            stem,
            development: Development { exposure, ..Development::default() },
            metadata: self.session.metadata(),
            stop: Arc::clone(&stop),
            done: 0,
        };
        self.session.turning = Some(Turning { done: 0, of: pictures, stop });
        self.tracer.turn(turntable);
        Ok(())
    }

    /// Write the scene file with this camera to a new file beside it.
    fn save_scene(&self) -> Result<String, String> {
        let path = &self.session.stage.path;
        if path.extension().is_none_or(|extension| extension != "toml") {
            return Err("a bare mesh has no place for a camera: C copies the table instead".to_owned());
        }
        let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let text = files::with_camera(&text, &self.session.orbit.table())
            .map_err(|error| format!("{}: {error}", path.display()))?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let target = files::free_name(folder, &self.session.stem(), "toml").ok_or("too many scenes there")?;
        // What cannot be read again is not written.
        Scene::parse(&target, &text).map_err(|error| error.to_string())?;
        write_whole(&target, text.as_bytes()).map_err(|error| format!("{}: {error}", target.display()))?;
        Ok(format!("the scene with this camera is in {}", target.display()))
    }

    /// Write the window to a file and quit, once the picture is complete.
    pub(super) fn take_screenshot(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let Some(Screenshot { path, frames }) = &self.screenshot else { return Ok(()) };
        if !self.is_at_rest() {
            return Ok(());
        }
        if self.frames < *frames {
            self.window.request_redraw();
            return Ok(());
        }
        let output = Output::new(path)?;
        self.write_window(&output)?;
        self.screenshot = None;
        event_loop.exit();
        Ok(())
    }

    /// Write what the window shows to a PNG file.
    pub(super) fn write_window(&mut self, output: &Output) -> Result<(), ViewerError> {
        let painted = self.run_panels(Instant::now());
        let (width, height, picture) = self.canvas.picture(painted, &self.session.look, self.area)?;
        let metadata = self.session.metadata();
        Ok(output.write(&encode_preview(width, height, &picture, &metadata)?)?)
    }

    /// Compare the finished picture with the last one of the same view, if its settings are others.
    pub(super) fn measure_cost(&mut self) -> Result<(), ViewerError> {
        let (Some(wanted), Some(exposure)) = (&self.wanted, &self.session.look.coarse) else { return Ok(()) };
        let before = self.finished.take().filter(|(of, _)| of.is_of_same_view(wanted));
        let frame = exposure.frame(&self.canvas.device)?;
        let ms = exposure.times.trace.as_secs_f64() * 1e3;
        let after = Finished { settings: wanted.settings, ms, frame };
        match before {
            None => self.session.cost = None,
            Some((_, before)) => self.session.cost = Cost::of(&before, &after).or(self.session.cost.take()),
        }
        self.finished = Some((wanted.clone(), after));
        Ok(())
    }
}

/// Hear of changes of files, where the system allows it.
pub(super) fn watch(
    files: Vec<PathBuf>,
    proxy: &EventLoopProxy<Message>,
    message: fn() -> Message,
) -> Option<Watch> {
    let proxy = proxy.clone();
    let watch = Watch::new(files, move || drop(proxy.send_event(message())));
    watch.inspect_err(|error| tracing::warn!("changes of files are not seen: {error}")).ok()
}

pub(super) fn title(path: &std::path::Path) -> String {
    format!("{} – Snellius", path.file_name().unwrap_or(path.as_os_str()).to_string_lossy())
}
