//! How much of a picture an adapter traces at a time.

/// How much of a picture an adapter traces at a time. No picture shows it; small portions prove that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Portions {
    /// Rounds of its loops after which an invocation rests between two rays, to be resumed by the next dispatch.
    pub steps: u32,
    /// Pixels of a band: whole rows of blocks, one at least, and no more than one buffer holds.
    pub pixels: u64,
}
