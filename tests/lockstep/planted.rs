//! Copies of the shaders with a fault in them.

use snellius::gpu::{SOURCES, Source};

/// The shader files, one of them changed.
pub(crate) struct Planted(Vec<(&'static str, String)>);

impl Planted {
    /// Put `fault` in place of the first `sound` text of the file `stem`.
    pub(crate) fn new(stem: &str, sound: &str, fault: &str) -> Self {
        let text = SOURCES.iter().find(|source| source.0 == stem).map(|source| source.1);
        assert!(text.is_some_and(|text| text.contains(sound)), "{stem} holds no {sound:?} to change");
        let change = |&(name, text): &Source<'static>| {
            (name, if name == stem { text.replacen(sound, fault, 1) } else { text.to_owned() })
        };
        Self(SOURCES.iter().map(change).collect())
    }

    pub(crate) fn sources(&self) -> Vec<Source<'_>> {
        self.0.iter().map(|(stem, text)| (*stem, text.as_str())).collect()
    }

    /// The files for devices, which keep them.
    pub(crate) fn leak(self) -> &'static [Source<'static>] {
        let files = self.0.into_iter().map(|(stem, text)| (stem, &*text.leak()));
        files.collect::<Vec<_>>().leak()
    }
}
