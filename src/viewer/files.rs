//! Files of a scene: read on another thread, watched, and written.

use std::fs;
use std::path::{Path, PathBuf};

use notify::{RecursiveMode, Watcher};
use toml_edit::{DocumentMut, Item, TomlError};

use super::stage::Stage;
use crate::film::{BitDepth, Development, EncodeError, Frame, Metadata, encode_png};
use crate::gpu::SOURCES;
use crate::scene::Scene;

/// Tells when a file of a scene was written.
pub(super) struct Watch {
    // Dropped, nothing is watched any more.
    _watcher: notify::RecommendedWatcher,
}

impl Watch {
    /// Watch files; `tell` is called from another thread.
    ///
    /// Their folders are watched, without those below: editors write a new file and put it in the old one's place.
    ///
    /// # Errors
    /// As the operating system's.
    pub(super) fn new(files: Vec<PathBuf>, tell: impl Fn() + Send + 'static) -> notify::Result<Self> {
        let folders: Vec<PathBuf> = {
            let mut folders: Vec<_> = files.iter().map(|file| folder_of(file)).collect();
            folders.sort_unstable();
            folders.dedup();
            folders
        };
        let mut watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
            let Ok(event) = event else { return };
            let is_written = !matches!(event.kind, notify::EventKind::Access(_));
            if is_written && event.paths.iter().any(|path| concerns(&files, path)) {
                tell();
            }
        })?;
        for folder in folders {
            watcher.watch(&folder, RecursiveMode::NonRecursive)?;
        }
        Ok(Self { _watcher: watcher })
    }
}

/// Everything that a scene was read from, but for the MTL files of its meshes.
pub(super) fn files_of(stage: &Stage) -> Vec<PathBuf> {
    let Scene { meshes, textures, .. } = &stage.scene;
    let paths =
        std::iter::once(&stage.path).chain(meshes).chain(textures.iter().map(|texture| &texture.path));
    paths.map(|path| whole(path)).collect()
}

/// The shader files of a folder.
pub(super) fn shader_files(folder: &Path) -> Vec<PathBuf> {
    SOURCES.iter().map(|(stem, _)| whole(&folder.join(stem).with_extension("wgsl"))).collect()
}

/// The path as the system tells of it.
fn whole(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_owned())
}

/// Whether a change of a file in a watched folder concerns the scene.
fn concerns(files: &[PathBuf], path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "mtl") || files.iter().any(|file| file == path)
}

fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if folder != Path::new("") => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// The text of a scene file with another `[camera]` table: all else, comments too, stays as it is.
pub(super) fn with_camera(text: &str, table: &str) -> Result<String, TomlError> {
    let mut document: DocumentMut = text.parse()?;
    let mut wanted: DocumentMut = table.parse()?;
    let Some(Item::Table(mut camera)) = wanted.remove("camera") else { return Ok(document.to_string()) };
    if let Some(before) = document.get_mut("camera").and_then(Item::as_table_mut) {
        before.retain(|key, _| camera.contains_key(key));
        for (key, item) in camera.iter_mut() {
            let mut new = std::mem::take(item);
            let Some(old) = before.get_mut(&key) else {
                before.insert(&key, new);
                continue;
            };
            if let (Some(value), Some(old)) = (new.as_value_mut(), old.as_value()) {
                *value.decor_mut() = old.decor().clone();
            }
            *old = new;
        }
    } else {
        // An inline table would stand among the first keys: a table stands behind all.
        document.remove("camera");
        camera.set_position(None);
        camera.decor_mut().set_prefix("\n");
        document.insert("camera", Item::Table(camera));
    }
    Ok(document.to_string())
}

/// A picture as a PNG file, with what it says about itself.
pub(super) fn png_of(
    frame: &Frame,
    development: Development,
    metadata: &Metadata,
) -> Result<Vec<u8>, EncodeError> {
    let display = development.apply(&frame.radiance());
    encode_png(frame.width, frame.height, &display, BitDepth::default(), metadata)
}

/// A new folder `STEM-turn-001`, `STEM-turn-002`, … of the working folder.
pub(super) fn free_folder(stem: &str) -> Result<PathBuf, String> {
    let names = (1..10_000).map(|number| PathBuf::from(format!("{stem}-turn-{number:03}")));
    let path = names.into_iter().find(|path| !path.exists()).ok_or("too many turntables here")?;
    fs::create_dir(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}

/// The first name `STEM-001.EXTENSION`, `STEM-002.EXTENSION`, … that is free in a folder.
pub(super) fn free_name(folder: &Path, stem: &str, extension: &str) -> Option<PathBuf> {
    (1..10_000)
        .map(|number| folder.join(format!("{stem}-{number:03}.{extension}")))
        .find(|path| !path.exists())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::sync::mpsc::channel;
    use std::time::Duration;

    use super::*;

    const TABLE: &str = "[camera]\neye = [1.0, 2.0, 3.0]\ntarget = [0.0, 0.5, 0.0]\n";

    #[test]
    fn only_the_camera_changes_and_comments_stay() {
        let text = "# A ball.\n[camera] # where\n# The eye.\neye = [0, 0, 0] # low\nright = [1, 0, 0]\ntarget = [\n  1, 0, 0]\n\n# Light\n[[light]]\nposition  = [0, 1, 0]\n";
        let expected = "# A ball.\n[camera] # where\n# The eye.\neye = [1.0, 2.0, 3.0] # low\ntarget = [0.0, 0.5, 0.0]\n\n# Light\n[[light]]\nposition  = [0, 1, 0]\n";
        assert_eq!(with_camera(text, TABLE).unwrap(), expected);
    }

    #[test]
    fn a_scene_without_a_camera_table_gets_one() {
        let expected = format!("# A ball.\n[[model]]\n\n{TABLE}");
        assert_eq!(with_camera("# A ball.\n[[model]]\n", TABLE).unwrap(), expected);
        let inline = "camera = { eye = [0, 0, 0], target = [0, 0, 1] }\n[[model]]\n";
        assert_eq!(with_camera(inline, TABLE).unwrap(), format!("[[model]]\n\n{TABLE}"));
        let dotted = "camera.eye = [0, 0, 0] # low\n[[model]]\n";
        let changed = with_camera(dotted, TABLE).unwrap();
        assert!(changed.starts_with("camera.eye = [1.0, 2.0, 3.0] # low\n"), "{changed}");
        assert!(changed.contains("camera.target = [0.0, 0.5, 0.0]\n"), "{changed}");
    }

    #[test]
    fn brackets_in_comments_and_texts_are_no_tables() {
        let text = "[material.m] # [camera]\nname = \"\"\"\n[camera]\n\"\"\"\n";
        assert_eq!(with_camera(text, TABLE).unwrap(), format!("{text}\n{TABLE}"));
    }

    #[test]
    fn no_file_is_written_over() {
        let folder = tempfile::tempdir().unwrap();
        let first = free_name(folder.path(), "ice", "png").unwrap();
        assert!(first.ends_with("ice-001.png"));
        std::fs::write(&first, "").unwrap();
        assert!(free_name(folder.path(), "ice", "png").unwrap().ends_with("ice-002.png"));
    }

    #[test]
    fn a_written_scene_is_heard_of_and_another_file_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ball.toml");
        let text = "[[model]]\nshape = { sphere = { radius = 1.0 } }\nmaterial = 'm'\n[material.m]\ndiffuse = { color = '#ffffff' }\n";
        std::fs::write(&path, text).unwrap();
        let stage = Stage::load(&path).map_err(|error| error.to_string()).unwrap();
        let (sender, receiver) = channel();
        let _watch = Watch::new(files_of(&stage), move || _ = sender.send(())).unwrap();
        std::fs::write(folder.path().join("picture.png"), "x").unwrap();
        assert!(receiver.recv_timeout(Duration::from_millis(200)).is_err());
        std::fs::write(&path, text).unwrap();
        assert!(receiver.recv_timeout(Duration::from_secs(5)).is_ok());
    }
}
