//! The whole ray tree of one pixel: each ray with what it met, what it gave and why it ended.
//!
//! Both devices record [`TreeNode`]s in the order in which they trace; [`Tree`] finds the parents again, puts names to
//! bodies and media, and is shown as an outline, as JSON or as a drawing. [`part`] finds where two devices part.
//! There is one itinerary: the recorder listens to the loop that makes the pictures.

mod drawing;
mod node;
mod outline;
mod parting;
mod record;
mod section;
mod tree;

pub use drawing::drawing;
pub use node::{End, Hit, Node};
pub use outline::outline;
pub use parting::{Parting, part};
pub use record::{Recorded, on_cpu};
pub use tree::Tree;

#[cfg(doc)]
use crate::layout::TreeNode;
