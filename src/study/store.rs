//! What is finished of a study, in its folder: `study.json` and the references' pictures.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::metrics::Seen;
use super::{Report, StudyError};
use crate::film::{Channel, Metadata, Output, Picture, Samples, encode_exr, load, write_whole};

/// The folder of a study.
pub(super) struct Store {
    folder: PathBuf,
}

impl Store {
    /// Use a folder; it is made if it is not there.
    pub(super) fn open(folder: &Path) -> Result<Self, StudyError> {
        let store = Self { folder: folder.to_owned() };
        for sub in ["", "references", "errors"] {
            let path = folder.join(sub);
            fs::create_dir_all(&path).map_err(|error| StudyError::Io { path, error })?;
        }
        Ok(store)
    }

    /// The study that was begun here with the same key.
    pub(super) fn resume(&self, key: &str) -> Option<Report> {
        let text = fs::read_to_string(self.report_path()).ok()?;
        serde_json::from_str(&text).ok().filter(|report: &Report| report.key == key)
    }

    /// Keep what is finished.
    pub(super) fn save(&self, report: &Report) -> Result<(), StudyError> {
        let mut text = serde_json::to_string_pretty(report)?;
        text.push('\n');
        self.write("study.json", text.as_bytes())
    }

    /// Write a file of the study, whole or not at all.
    pub(super) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), StudyError> {
        let path = self.folder.join(name);
        write_whole(&path, bytes).map_err(|error: io::Error| StudyError::Io { path, error })
    }

    /// Keep a reference's picture.
    pub(super) fn keep_picture(&self, name: &str, seen: &Seen) -> Result<(), StudyError> {
        let bytes = encode_exr(&picture_of(seen), &Metadata::new().with("reference", name))?;
        Ok(Output::new(&self.picture_path(name))?.write(&bytes)?)
    }

    /// A reference's picture, if it is here and whole.
    pub(super) fn picture(&self, name: &str) -> Option<Seen> {
        seen_of(&load(&self.picture_path(name)).ok()?)
    }

    fn report_path(&self) -> PathBuf {
        self.folder.join("study.json")
    }

    fn picture_path(&self, name: &str) -> PathBuf {
        self.folder.join("references").join(name).with_extension("exr")
    }
}

fn picture_of(seen: &Seen) -> Picture {
    let Picture { width, height, mut channels } = Picture::from_rgb(seen.width, seen.height, &seen.radiance);
    channels.push(Channel::f32("bound", seen.bounds.iter().copied()));
    channels.push(Channel::u32("path", seen.paths.iter().copied()));
    channels.push(Channel::u32("rays", seen.rays.iter().copied()));
    Picture::new(width, height, channels)
}

fn seen_of(picture: &Picture) -> Option<Seen> {
    let words = |name| match &picture.channel(name)?.samples {
        Samples::U32(values) => Some(values.clone()),
        Samples::F32(_) => None,
    };
    let [r, g, b] = picture.rgb()?;
    let pixel = |i| [r, g, b].map(|channel| channel.samples.value(i) as f32);
    let bounds = picture.channel("bound")?;
    Some(Seen {
        width: picture.width,
        height: picture.height,
        radiance: (0..picture.pixels()).map(pixel).collect(),
        paths: words("path")?,
        bounds: (0..picture.pixels()).map(|i| bounds.samples.value(i) as f32).collect(),
        rays: words("rays")?,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::metrics::tests::seen;
    use super::*;

    #[test]
    fn a_reference_comes_back_as_it_went() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let mut picture = seen(&[0.1, 7.5, 0.0]);
        picture.paths[1] = u32::MAX;
        picture.bounds[2] = 1e-30;
        store.keep_picture("sampling", &picture).unwrap();
        assert_eq!(store.picture("sampling"), Some(picture));
        assert_eq!(store.picture("truncation"), None);
    }

    #[test]
    fn a_broken_file_is_no_reference_and_no_study() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::open(folder.path()).unwrap();
        fs::write(store.picture_path("sampling"), b"no picture").unwrap();
        fs::write(store.report_path(), b"{\"key\": ").unwrap();
        assert_eq!(store.picture("sampling"), None);
        assert_eq!(store.resume("key"), None);
    }
}
