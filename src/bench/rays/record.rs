//! Rays and answers, and their files: a count as u32, then the records, all little-endian.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use bytemuck::{Pod, Zeroable};
use thiserror::Error;

use crate::bvh::BvhError;
use crate::kernel::Real;
use crate::kernel::bvh::Hit;
use crate::layout::constants::NONE;

/// A ray of a `.rays` file.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct RayRecord {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Where it begins to count, in units of the direction's length: 0.
    pub tmin: f32,
    /// Unit direction.
    pub direction: [f32; 3],
    /// Where it ends.
    pub tmax: f32,
}

/// An answer of a `.hits` file.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct RayAnswer {
    /// Distance of the nearest hit; 0 for a miss, and where only asked whether there is any.
    pub t: f32,
    /// The face hit, in the order of the file; 0 where only asked whether there is any; `NONE` for a miss.
    pub face: u32,
}

impl RayAnswer {
    /// Nothing hit.
    pub const MISS: Self = Self { t: 0.0, face: NONE };

    /// Of a kernel's nearest hit.
    pub(super) fn nearest<R: Real>(hit: &Hit<R>) -> Self {
        if hit.id == NONE { Self::MISS } else { Self { t: hit.t.to_f32(), face: hit.id } }
    }

    /// Of whether there is any.
    pub(super) fn any(hit: bool) -> Self {
        if hit { Self { t: 0.0, face: 0 } } else { Self::MISS }
    }

    /// Whether anything was hit.
    #[must_use]
    pub fn is_hit(&self) -> bool {
        self.face != NONE
    }
}

/// What is wrong with a mesh or a file of rays.
#[derive(Debug, Error)]
pub enum RayError {
    /// The file cannot be read or written.
    #[error("cannot {what} {}: {error}", path.display())]
    Io {
        /// `read` or `write`.
        what: &'static str,
        /// The file.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// The file is not as long as its count says.
    #[error("{} holds {bytes} bytes, but a count and {count} records take {expected}: {format}", path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// Its length.
        bytes: usize,
        /// Its count.
        count: u32,
        /// How long it should be.
        expected: usize,
        /// What such a file is.
        format: &'static str,
    },
    /// A ray does not begin at its origin.
    #[error("ray {ray} of {} begins at tmin = {tmin}: rays are traced from 0; move its origin instead", path.display())]
    Start {
        /// The file.
        path: PathBuf,
        /// Which ray, from 0.
        ray: usize,
        /// Where it begins.
        tmin: f32,
    },
    /// The mesh reaches too far.
    #[error("the mesh reaches beyond ±2^60")]
    Range,
    /// No tree can be built over the mesh.
    #[error(transparent)]
    Bvh(#[from] BvhError),
}

/// Read a file of rays.
///
/// # Errors
/// [`RayError::Io`], [`RayError::Length`], [`RayError::Start`].
pub fn read_rays(path: &Path) -> Result<Vec<RayRecord>, RayError> {
    let format = "a file of rays is a u32 count, then 8 f32 a ray: origin, tmin, direction, tmax";
    let record = |[a, b, c, tmin, d, e, f, tmax]: [u32; 8]| RayRecord {
        origin: [a, b, c].map(f32::from_bits),
        tmin: f32::from_bits(tmin),
        direction: [d, e, f].map(f32::from_bits),
        tmax: f32::from_bits(tmax),
    };
    let rays: Vec<_> = read(path, format)?.into_iter().map(record).collect();
    match rays.iter().position(|ray| ray.tmin != 0.0) {
        Some(ray) => Err(RayError::Start { path: path.into(), ray, tmin: rays[ray].tmin }),
        None => Ok(rays),
    }
}

/// Read a file of answers.
///
/// # Errors
/// [`RayError::Io`], [`RayError::Length`].
pub fn read_answers(path: &Path) -> Result<Vec<RayAnswer>, RayError> {
    let format = "a file of hits is a u32 count, then f32 t and u32 face a ray";
    let record = |[t, face]: [u32; 2]| RayAnswer { t: f32::from_bits(t), face };
    Ok(read(path, format)?.into_iter().map(record).collect())
}

/// A count, then as many records of N words.
fn read<const N: usize>(path: &Path, format: &'static str) -> Result<Vec<[u32; N]>, RayError> {
    let bytes = fs::read(path).map_err(|error| RayError::Io { what: "read", path: path.into(), error })?;
    let (head, body) = bytes.split_first_chunk::<4>().unwrap_or((&[0; 4], &[]));
    let count = u32::from_le_bytes(*head);
    let expected = 4 + count as usize * N * 4;
    if bytes.len() != expected {
        return Err(RayError::Length { path: path.into(), bytes: bytes.len(), count, expected, format });
    }
    let word = |bytes: &[u8; 4]| u32::from_le_bytes(*bytes);
    Ok(body.as_chunks::<4>().0.as_chunks::<N>().0.iter().map(|words| words.each_ref().map(word)).collect())
}

/// Write a file of rays.
///
/// # Errors
/// [`RayError::Io`].
pub fn write_rays(path: &Path, rays: &[RayRecord]) -> Result<(), RayError> {
    write(path, rays.len(), bytemuck::cast_slice(rays))
}

/// Write a file of answers.
///
/// # Errors
/// [`RayError::Io`].
pub fn write_answers(path: &Path, answers: &[RayAnswer]) -> Result<(), RayError> {
    write(path, answers.len(), bytemuck::cast_slice(answers))
}

/// A count of records, then their words.
fn write(path: &Path, count: usize, words: &[u32]) -> Result<(), RayError> {
    let write = || {
        let mut file = io::BufWriter::new(fs::File::create(path)?);
        file.write_all(&(count as u32).to_le_bytes())?;
        words.iter().try_for_each(|word| file.write_all(&word.to_le_bytes()))?;
        file.flush()
    };
    write().map_err(|error| RayError::Io { what: "write", path: path.into(), error })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const RAY: RayRecord =
        RayRecord { origin: [1.0, 2.0, 3.0], tmin: 0.0, direction: [0.0, 0.0, -1.0], tmax: 9.0 };

    #[test]
    fn rays_come_back_as_they_were_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.rays");
        write_rays(&path, &[RAY, RayRecord { tmax: 4.0, ..RAY }]).unwrap();
        assert_eq!(fs::read(&path).unwrap()[..8], [2, 0, 0, 0, 0, 0, 0x80, 0x3f]);
        assert_eq!(read_rays(&path).unwrap(), [RAY, RayRecord { tmax: 4.0, ..RAY }]);
    }

    #[test]
    fn answers_are_distance_and_face() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.hits");
        write_answers(&path, &[RayAnswer { t: 1.0, face: 7 }, RayAnswer::MISS]).unwrap();
        let words = [2, 0x3f80_0000, 7, 0, u32::MAX];
        assert_eq!(fs::read(&path).unwrap(), words.map(u32::to_le_bytes).concat());
        assert_eq!(read_answers(&path).unwrap(), [RayAnswer { t: 1.0, face: 7 }, RayAnswer::MISS]);
    }

    #[test]
    fn a_file_of_another_length_or_start_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.rays");
        for bytes in [vec![], vec![1, 0], vec![1, 0, 0, 0, 5], 2_u32.to_le_bytes().to_vec()] {
            fs::write(&path, bytes).unwrap();
            assert!(matches!(read_rays(&path), Err(RayError::Length { .. })));
        }
        write_rays(&path, &[RAY, RayRecord { tmin: 0.5, ..RAY }]).unwrap();
        assert!(matches!(read_rays(&path), Err(RayError::Start { ray: 1, .. })));
        assert!(matches!(read_rays(folder.path()), Err(RayError::Io { .. })));
    }
}
