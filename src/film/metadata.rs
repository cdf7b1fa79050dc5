//! What a picture file says about itself.

/// Keys and values in the order that they are written: scene, settings, device, driver, effects, seconds.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Metadata(Vec<(&'static str, String)>);

impl Metadata {
    /// Key of the program's name and version, a predefined keyword of PNG and EXR.
    pub const SOFTWARE: &'static str = "Software";

    /// Metadata that names this program and its version.
    #[must_use]
    pub fn new() -> Self {
        let software = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
        Self(vec![(Self::SOFTWARE, software.to_owned())])
    }

    /// Add a key of 1 to 79 Latin letters (the limit of PNG keywords) and its value.
    #[must_use]
    pub fn with(mut self, key: &'static str, value: impl Into<String>) -> Self {
        self.0.push((key, value.into()));
        self
    }

    /// All keys and values.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.0.iter().map(|(key, value)| (*key, value.as_str()))
    }
}
