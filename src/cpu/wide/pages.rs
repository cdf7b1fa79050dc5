//! Memory in pages of 2 MiB, where the system has them.
//!
//! Rays that go anywhere touch a tree all over: of a million triangles it fills some 20 000 pages of 4 KiB, ten times
//! as many as a processor keeps the addresses of.

/// An empty vector with room for `capacity` elements, which asks for large pages before any is touched.
pub(super) fn with_capacity<T>(capacity: usize) -> Vec<T> {
    let vec = Vec::with_capacity(capacity);
    #[cfg(target_os = "linux")]
    advise(&vec);
    vec
}

/// Where ranges of a hint begin and end, on most machines; others refuse it.
#[cfg(target_os = "linux")]
const PAGE: usize = 4096;
#[cfg(target_os = "linux")]
const LARGE_PAGE: usize = 2 << 20;

/// Ask for large pages. Only a hint: where it is refused, pages are small.
#[cfg(target_os = "linux")]
fn advise<T>(vec: &Vec<T>) {
    use rustix::mm::{Advice, madvise};
    let bytes = vec.capacity() * size_of::<T>();
    if bytes < 2 * LARGE_PAGE {
        return;
    }
    let first = (vec.as_ptr() as usize).next_multiple_of(PAGE);
    let length = (vec.as_ptr() as usize + bytes - first) / PAGE * PAGE;
    // SAFETY: the range lies in the vector's own allocation, and the advice changes nothing of what is in it.
    let _ = unsafe { madvise(first as *mut _, length, Advice::LinuxHugepage) };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_there_in_pages_of_any_size() {
        for capacity in [0, 1, 1 << 10, 3 << 20] {
            let mut vec = with_capacity(capacity);
            assert!(vec.capacity() >= capacity);
            vec.extend(0..capacity as u32);
            assert!(vec.iter().copied().eq(0..capacity as u32));
        }
    }
}
