//! Files of a scene: read on another thread, watched, and written.

use std::path::{Path, PathBuf};

use notify::{RecursiveMode, Watcher};

use super::stage::Stage;
use crate::scene::Scene;

/// Tells when a file of a scene was written.
pub(super) struct Watch {
    // Dropped, nothing is watched any more.
    _watcher: notify::RecommendedWatcher,
}

impl Watch {
    /// Watch the files that a scene was read from; `tell` is called from another thread.
    ///
    /// Their folders are watched, without those below: editors write a new file and put it in the old one's place.
    ///
    /// # Errors
    /// As the operating system's.
    pub(super) fn new(stage: &Stage, tell: impl Fn() + Send + 'static) -> notify::Result<Self> {
        let files = files(stage);
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
fn files(stage: &Stage) -> Vec<PathBuf> {
    let Scene { meshes, textures, .. } = &stage.scene;
    let paths =
        std::iter::once(&stage.path).chain(meshes).chain(textures.iter().map(|texture| &texture.path));
    paths.map(|path| path.canonicalize().unwrap_or_else(|_| path.clone())).collect()
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

/// The text of a scene file with another `[camera]` table.
pub(super) fn with_camera(text: &str, table: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let is_header = |line: &&str| line.trim_start().starts_with('[');
    let start = lines.iter().position(|line| {
        line.split('#').next().unwrap_or_default().replace(char::is_whitespace, "") == "[camera]"
    });
    let Some(start) = start else {
        // Before the first table, where the keys of none stand.
        let first = lines.iter().position(is_header).unwrap_or(lines.len());
        let (head, tail) = lines.split_at(first);
        return join(&[head, &[table.trim_end(), ""], tail]);
    };
    let after = lines[start + 1..].iter().position(is_header);
    let end = after.map_or(lines.len(), |after| start + 1 + after);
    // Comments above the next table are its own.
    let own = lines[start + 1..end]
        .iter()
        .rposition(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let end = start + 1 + own.map_or(0, |own| own + 1);
    join(&[&lines[..start], &[table.trim_end()], &lines[end..]])
}

fn join(parts: &[&[&str]]) -> String {
    parts.concat().join("\n") + "\n"
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

    const TABLE: &str = "[camera]\neye = [1.0, 2.0, 3.0]\n";

    #[test]
    fn only_the_camera_changes() {
        let text = "# A ball.\n[camera] # where\neye = [0, 0, 0]\ntarget = [\n  1, 0, 0]\n\n# Light\n[[light]]\nposition = [0, 1, 0]\n";
        let expected =
            "# A ball.\n[camera]\neye = [1.0, 2.0, 3.0]\n\n# Light\n[[light]]\nposition = [0, 1, 0]\n";
        assert_eq!(with_camera(text, TABLE), expected);
    }

    #[test]
    fn a_scene_without_camera_gets_one() {
        let expected = "# A ball.\n[camera]\neye = [1.0, 2.0, 3.0]\n\n[[model]]\n";
        assert_eq!(with_camera("# A ball.\n[[model]]\n", TABLE), expected);
        assert_eq!(with_camera("", TABLE), "[camera]\neye = [1.0, 2.0, 3.0]\n\n");
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
        let _watch = Watch::new(&stage, move || _ = sender.send(())).unwrap();
        std::fs::write(folder.path().join("picture.png"), "x").unwrap();
        assert!(receiver.recv_timeout(Duration::from_millis(200)).is_err());
        std::fs::write(&path, text).unwrap();
        assert!(receiver.recv_timeout(Duration::from_secs(5)).is_ok());
    }
}
