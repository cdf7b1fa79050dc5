//! What can be counted before a ray is traced.

/// A number that a kernel is made for, and where it comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Number {
    /// How many.
    pub value: u32,
    /// What makes it so.
    pub reason: String,
}

/// The numbers that a kernel is made for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Numbers {
    /// Point lights that light anything.
    pub lights: Number,
    /// Rays that may wait at once while another is traced: 0 where the tree is a chain.
    pub waiting: Number,
    /// Transmissive bodies that a point may be in at once, at most.
    pub media: Number,
}

impl Numbers {
    /// All of them by name, in the order of tables.
    #[must_use]
    pub fn named(&self) -> [(&'static str, &Number); 3] {
        [("lights", &self.lights), ("waiting-rays", &self.waiting), ("media", &self.media)]
    }
}
