//! Compiled pipelines on disk, so that the next start does not compile them again.
//!
//! A cache is a convenience: whatever goes wrong with it is logged, and the pipeline is compiled.

use std::fs;
use std::hash::Hasher;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tracing::{debug, warn};

/// Bytes of the check sum before the driver's data.
const SUM: usize = size_of::<u64>();

/// The pipelines that a driver has compiled before, if it lets them be kept.
pub(super) struct PipelineCache {
    kept: Option<Kept>,
}

struct Kept {
    cache: wgpu::PipelineCache,
    path: PathBuf,
}

impl PipelineCache {
    /// What the folder holds for this adapter; nothing is kept without a folder, or where the device lacks the feature.
    pub(super) fn open(device: &wgpu::Device, adapter: &wgpu::AdapterInfo, folder: Option<&Path>) -> Self {
        let offered = device.features().contains(wgpu::Features::PIPELINE_CACHE);
        let key = wgpu::util::pipeline_cache_key(adapter);
        let (true, Some(folder), Some(key)) = (offered, folder, key) else { return Self { kept: None } };
        let path = folder.join(key);
        let data = load(&path);
        let descriptor =
            wgpu::PipelineCacheDescriptor { label: Some("pipelines"), data: data.as_deref(), fallback: true };
        // SAFETY: the data is what `get_data` gave for this adapter, as its check sum tells; wgpu and the driver compare
        // their versions with those in its head.
        let cache = unsafe { device.create_pipeline_cache(&descriptor) };
        Self { kept: Some(Kept { cache, path }) }
    }

    /// For the descriptor of a pipeline.
    pub(super) fn cache(&self) -> Option<&wgpu::PipelineCache> {
        self.kept.as_ref().map(|kept| &kept.cache)
    }

    /// Keep what was compiled since.
    pub(super) fn save(&self) {
        let Some(Kept { cache, path }) = &self.kept else { return };
        let Some(data) = cache.get_data() else { return };
        match store(path, &data) {
            Ok(()) => debug!("{} bytes of pipelines kept in {}", data.len(), path.display()),
            Err(error) => warn!("cannot keep pipelines in {}: {error}", path.display()),
        }
    }
}

/// The data of a cache file; none where there is no file, or a damaged one.
fn load(path: &Path) -> Option<Vec<u8>> {
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return None,
        Err(error) => {
            warn!("cannot read pipelines from {}: {error}", path.display());
            return None;
        }
    };
    let data =
        bytes.split_first_chunk::<SUM>().filter(|(sum, data)| u64::from_le_bytes(**sum) == sum_of(data));
    if data.is_none() {
        warn!("{} is damaged: its pipelines are compiled anew", path.display());
    }
    data.map(|(_, data)| data.to_vec())
}

/// Write a cache file whole or not at all: another program may read it at the same time.
fn store(path: &Path, data: &[u8]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(&sum_of(data).to_le_bytes())?;
    file.write_all(data)?;
    file.persist(path)?;
    Ok(())
}

/// A check sum against damage (SipHash of the standard library, with its fixed key).
fn sum_of(data: &[u8]) -> u64 {
    let mut hasher = std::hash::DefaultHasher::new();
    hasher.write(data);
    hasher.finish()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_file_gives_back_what_was_stored() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/pipelines");
        assert_eq!(load(&path), None);
        for data in [&b"first"[..], &b""[..], &b"second"[..]] {
            store(&path, data).unwrap();
            assert_eq!(load(&path).as_deref(), Some(data));
        }
        assert_eq!(
            fs::read_dir(folder.path().join("new")).unwrap().count(),
            1,
            "nothing else is left behind"
        );
    }

    #[test]
    fn a_damaged_file_is_not_used() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pipelines");
        store(&path, b"compiled").unwrap();
        let sound = fs::read(&path).unwrap();
        let mut flipped = sound.clone();
        flipped[SUM] ^= 1;
        for bytes in [&flipped[..], &sound[..sound.len() - 1], &sound[..3], &[]] {
            fs::write(&path, bytes).unwrap();
            assert_eq!(load(&path), None);
        }
    }

    #[test]
    fn a_folder_that_cannot_be_written_is_no_error_of_the_render() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(store(&file.join("pipelines"), b"data").is_err());
        assert_eq!(load(&file.join("pipelines")), None);
    }
}
